"""Cutting cells at edges gives a mesh of the same body: conforming, curved as before, with the same names."""

import numpy as np
import pytest
from meshing_cases import filleted_pneunet, thin_tube

from turgor.core.engine.faces.surfaces import area
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.mesh import TETRAHEDRON_EDGES, Mesh
from turgor.core.meshing.quality.cell_quality import cell_shapes, cell_volumes, jacobian_ratios
from turgor.core.meshing.quality.checks import check_mesh, crossings
from turgor.core.meshing.refining.split import split_edges
from turgor.core.meshing.sizing.wall_refinement import refine_walls
from turgor.core.meshing.surface import cell_sides, check_surface, corner_keys, outer_triangles
from turgor.foundation.finding import Severity
from turgor.units import mm


@pytest.fixture(scope="module")
def finger() -> Mesh:
    return mesh(FastPneuNet(chambers=2, length=20 * mm).build(), size=4 * mm)


@pytest.fixture(scope="module")
def curved() -> Mesh:
    return mesh(filleted_pneunet(), size=6 * mm)


def edges_of(made: Mesh) -> np.ndarray:
    return np.unique(np.sort(np.concatenate([made.cells[:, e] for e in TETRAHEDRON_EDGES]), axis=1), axis=0)


def check_same_body(fine: Mesh, coarse: Mesh) -> None:
    assert cell_volumes(fine).min() > 0
    for name, cells in coarse.regions.items():
        volume = cell_volumes(coarse)[cells].sum()
        assert cell_volumes(fine)[fine.regions[name]].sum() == pytest.approx(volume, rel=1e-12)
    for name in coarse.faces:
        assert area(fine.points, fine.face(name)) == pytest.approx(area(coarse.points, coarse.face(name)), rel=1e-4)
    assert all(finding.severity is Severity.NOTE for finding in check_surface(fine))  # an open inlet is one
    count = len(fine.points)
    times = np.unique(corner_keys(cell_sides(fine.cells), count), return_counts=True)[1]
    assert times.max() == 2  # no side belongs to three cells
    assert np.isin(np.arange(count), fine.cells).all()
    assert len(np.unique(np.round(fine.points / (1e-7 * mm)), axis=0)) == count  # no node twice
    interfaces = np.concatenate(list(fine.faces.values()))
    outer = np.sort(corner_keys(outer_triangles(fine), count))
    named = np.unique(corner_keys(interfaces, count))
    assert np.isin(outer, named).all()  # a gap between cells would be surface without a name


@pytest.mark.parametrize("share", [0.02, 0.3, 1.0])
@pytest.mark.parametrize("body", ["finger", "curved"])
def test_any_edges_can_be_cut(body: str, share: float, request: pytest.FixtureRequest) -> None:
    coarse = request.getfixturevalue(body)
    edges = edges_of(coarse)
    some = np.random.default_rng(1).permutation(edges)[: int(share * len(edges))]
    fine = split_edges(coarse, some)
    check_same_body(fine, coarse)
    assert fine.vertex_count == coarse.vertex_count + len(some)
    if share == 1:
        assert len(fine.cells) == 8 * len(coarse.cells)


def test_each_part_has_the_shape_of_its_parent_there(curved: Mesh) -> None:
    """Volumes agree to rounding above; the Jacobian of a part is that of its parent, scaled."""
    fine = split_edges(curved, edges_of(curved)[::7])
    assert jacobian_ratios(fine).min() >= jacobian_ratios(curved).min() - 1e-12


def test_the_order_of_the_edges_does_not_matter(finger: Mesh) -> None:
    edges = edges_of(finger)[::5]
    a, b = split_edges(finger, edges), split_edges(finger, edges[::-1, ::-1])
    assert np.array_equal(a.points, b.points)
    assert np.array_equal(a.cells, b.cells)


def test_no_edge_no_change(finger: Mesh) -> None:
    assert split_edges(finger, np.zeros((0, 2), dtype=np.int64)) is finger


@pytest.mark.parametrize("body", ["finger", "curved"])
def test_two_cells_reach_through_every_wall(body: str, request: pytest.FixtureRequest) -> None:
    coarse = request.getfixturevalue(body)
    assert "G01" in [finding.code for finding in check_mesh(coarse)]
    fine = refine_walls(coarse, 2)
    check_same_body(fine, coarse)
    assert len(crossings(fine)[0]) == 0
    assert cell_shapes(fine).min() > 0.15
    assert refine_walls(coarse, 1) is coarse
    assert refine_walls(fine, 2) is fine


def test_the_setting_does_the_same() -> None:
    geometry = thin_tube()
    fine = mesh(geometry, size=1.5 * mm, wall_cells=2)
    assert "G01" not in [finding.code for finding in check_mesh(fine)]
    assert len(fine.cells) < 6 * len(mesh(geometry, size=1.5 * mm).cells)
