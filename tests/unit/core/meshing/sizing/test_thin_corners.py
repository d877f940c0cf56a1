"""Corners about which thin walls bend are found from the geometry and get smaller cells; other corners do not."""

import numpy as np
import pytest

from turgor.core.geometry.thin_corners import find_thin_corners
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.sizing.local_sizes import local_sizes
from turgor.namespaces import actuators
from turgor.units import mm

SECTORS = actuators.OmnidirectionalActuator(chamber_shape="ring_sector", length=30 * mm, symmetric=True)

#: Family, and corners of each cavity.
FOUND = {
    "long box": (actuators.RectangularBender(), {"cavity": 8}),
    "half circle": (actuators.SemicircularBender(), {"cavity": 1}),
    "circles": (actuators.OmnidirectionalActuator(), {}),
    "half circles in a thick wall": (
        actuators.OmnidirectionalActuator(chamber_shape="semicircular_flat_inward", chamber_size=6 * mm),
        {},
    ),
    "tube": (actuators.ExtendingCylinder(), {}),
    "chambers": (actuators.FastPneuNet(), {}),
}


@pytest.mark.parametrize("name", FOUND)
def test_corners_are_found_where_thin_walls_bend(name: str) -> None:
    family, wanted = FOUND[name]
    assert {result.name: len(result.lines) for result in find_thin_corners(family.build())} == wanted


def test_the_long_corner_of_a_ring_sector_lies_where_arch_and_web_meet() -> None:
    results = {each.name: each for each in find_thin_corners(SECTORS.build())}
    radius = np.hypot(results["cavity_1"].lines[..., 1], results["cavity_1"].lines[..., 2])
    along = np.ptp(results["cavity_1"].lines[..., 0], axis=1) > 1 * mm
    outer = along & (radius[:, 0] > 10 * mm)
    assert outer.sum() == 1
    assert radius[outer] == pytest.approx(10.5 * mm)  # 12.5 mm less the wall of 2 mm


def test_cells_at_corners_are_small_and_the_shape_forgets_it() -> None:
    part = SECTORS.build()
    corner = local_sizes(part, 4 * mm, {}).lines
    made = mesh(part, size=4 * mm)
    for start, end in corner:
        along = end - start
        share = (made.points[: made.vertex_count] - start) @ along / (along @ along)
        off = np.linalg.norm(made.points[: made.vertex_count] - start - share[:, None] * along, axis=1)
        steps = np.diff(np.sort(share[(off < 1e-6 * mm)])) * np.linalg.norm(along)
        assert steps.max() < 0.5 * 4 * mm
    plain = {"cavity_1": 4 * mm, "cavity_2": 4 * mm}
    coarse = mesh(part, size=4 * mm, face_sizes=plain)
    assert len(coarse.cells) < 0.7 * len(made.cells)
    assert np.array_equal(mesh(part, size=4 * mm).points, made.points)


def test_sizes_scale_with_the_mesh_and_given_ones_come_first() -> None:
    part = SECTORS.build()
    coarse, fine = local_sizes(part, 4 * mm, {}), local_sizes(part, 2 * mm, {})
    assert coarse.line_size == pytest.approx(2 * fine.line_size)
    assert coarse.faces.keys() == fine.faces.keys()
    given = local_sizes(part, 4 * mm, {"cavity_1": 3 * mm, "tip": 2 * mm})
    assert np.unique(np.round(list(given.faces.values()), 9)) == pytest.approx([2 * mm, 2.8 * mm, 3 * mm])
    assert (len(coarse.lines), len(given.lines)) == (4, 2)  # two of each cavity
