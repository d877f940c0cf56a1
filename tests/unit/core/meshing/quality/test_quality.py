"""Jacobians, volumes and shapes of cells that are known by hand."""

import numpy as np
import pytest

from refused import refused
from turgor.core.meshing.mesh import TETRAHEDRON_EDGES, Mesh
from turgor.core.meshing.quality.cell_quality import (
    cell_volumes,
    jacobian_range,
    jacobian_ratios,
    quality,
    refuse_inverted,
)

UNIT = np.vstack([np.zeros(3), np.eye(3)])


def one_cell(corners: np.ndarray, shift: np.ndarray | None = None) -> Mesh:
    """One tetrahedron with mid nodes in the middle of its edges, shifted by `shift` (6, 3)."""
    mids = np.array([(corners[a] + corners[b]) / 2 for a, b in TETRAHEDRON_EDGES])
    points = np.vstack([corners, mids if shift is None else mids + shift])
    return Mesh(points=points, cells=np.arange(10)[None], regions={"body": np.array([0])}, faces={})


def test_a_straight_cell_has_a_constant_jacobian() -> None:
    mesh = one_cell(UNIT * [2, 3, 4])
    low, high = jacobian_range(mesh)
    assert low == pytest.approx([24])
    assert high == pytest.approx([24])
    assert cell_volumes(mesh) == pytest.approx([4])


def test_quality_of_a_corner_cell_is_that_of_the_formula() -> None:
    measured = quality(one_cell(UNIT))
    assert measured.min_shape == pytest.approx(12 * (3 / 6) ** (2 / 3) / 9)
    assert measured.mean_shape == measured.min_shape
    assert (measured.cells, measured.points, measured.vertices, measured.unknowns) == (1, 10, 4, 34)
    assert (measured.min_edge, measured.max_edge) == pytest.approx((1, np.sqrt(2)))
    assert measured.mean_edge == pytest.approx((3 + 3 * np.sqrt(2)) / 6)
    assert measured.min_jacobian_ratio == pytest.approx(1)
    assert measured.inverted == 0


def test_a_curved_cell_has_the_jacobian_and_volume_of_its_map() -> None:
    # shifting the mid node of edge (0, 1) by (0, 0, h): z = t + 4 h r (1 − r − s − t), so dz/dt = 1 − 4 h r
    h = 0.1
    shift = np.zeros((6, 3))
    shift[0, 2] = h
    mesh = one_cell(UNIT, shift)
    low, high = jacobian_range(mesh)
    assert (low[0], high[0]) == pytest.approx((1 - 4 * h, 1))
    assert cell_volumes(mesh) == pytest.approx([1 / 6 - 4 * h / 24])  # ∫ r dV = 1/24
    assert quality(mesh).min_jacobian_ratio == pytest.approx(1 - 4 * h)


def test_the_volume_of_a_quadratic_map_is_exact() -> None:
    # x = r + a r², y = s, z = t: volume = 1/6 + 2 a / 24
    a = 0.3
    corners = UNIT.copy()
    corners[1, 0] = 1 + a
    shift = np.zeros((6, 3))
    for i, (p, q) in enumerate(TETRAHEDRON_EDGES):
        middle = (UNIT[p] + UNIT[q]) / 2
        shift[i, 0] = middle[0] + a * middle[0] ** 2 - (corners[p, 0] + corners[q, 0]) / 2
    assert cell_volumes(one_cell(corners, shift)) == pytest.approx([1 / 6 + a / 12])


def test_a_cell_turned_inside_out_by_its_mid_node_is_refused() -> None:
    shift = np.zeros((6, 3))
    shift[0, 2] = 0.3  # 1 − 4 h < 0 at corner 1
    mesh = one_cell(UNIT * 1e-3, shift * 1e-3)
    assert quality(mesh).inverted == 1
    assert quality(mesh).min_jacobian_ratio < 0
    assert quality(mesh).min_shape > 0  # its corners alone do not show it
    with refused("1 of 1", "(0.25, 0.25, 0.28) mm"):
        refuse_inverted(mesh)


@pytest.mark.filterwarnings("error")
def test_a_flat_cell_has_the_jacobian_ratio_0_and_counts_as_inverted() -> None:
    flat = one_cell(UNIT * [1, 1, 0])
    assert jacobian_ratios(flat).tolist() == [0.0]
    measured = quality(flat)
    assert (measured.inverted, measured.min_jacobian_ratio, measured.min_shape) == (1, 0.0, 0.0)


def test_a_cell_of_negative_or_no_volume_is_refused() -> None:
    for corners in (UNIT[[0, 2, 1, 3]], UNIT * [1, 1, 0]):
        with refused("1 of 1", "(250, 250,"):
            refuse_inverted(one_cell(corners))
    refuse_inverted(one_cell(UNIT))


def test_a_mesh_larger_than_a_chunk_is_looked_at_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("turgor.core.meshing.quality.cell_quality.CHUNK", 2)
    copies = [one_cell(UNIT * [1, 1, scale]).points for scale in (1, 2, 3)]
    points = np.vstack([p[:4] for p in copies] + [p[4:] for p in copies])
    cells = np.array([[*range(4 * i, 4 * i + 4), *range(12 + 6 * i, 18 + 6 * i)] for i in range(3)])
    mesh = Mesh(points=points, cells=cells, regions={"body": np.arange(3)}, faces={})
    assert jacobian_range(mesh)[0] == pytest.approx([1, 2, 3])
