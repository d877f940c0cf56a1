"""A refined mesh is the same body: cells are exact pieces of their parents, faces and regions stay."""

import numpy as np
import pytest
from lattice_cases import KINDS, curved, lattice, refined

from turgor.core.engine.cells.reference import reference_nodes, tables_at
from turgor.core.engine.faces.surfaces import area
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.core.meshing.refining.split_hexahedra import refine_hexahedra, sheets
from turgor.core.meshing.surface import cell_sides, corner_keys


@pytest.fixture(scope="module", params=KINDS)
def box(request: pytest.FixtureRequest) -> Mesh:
    return lattice((2, 3, 2), KINDS[request.param], curved)


@pytest.mark.parametrize("share", [0.1, 0.4, 1.0])
def test_the_parts_fill_each_cell(box: Mesh, share: float) -> None:
    fine = refined(box, share)
    volumes = np.bincount(fine.parent, cell_volumes(fine.mesh), minlength=len(box.cells))
    assert cell_volumes(fine.mesh).min() > 0
    assert volumes == pytest.approx(cell_volumes(box), rel=1e-12)
    if share == 1.0:
        assert (np.bincount(fine.parent) == 8).all()


@pytest.mark.parametrize("share", [0.1, 0.4, 1.0])
def test_every_node_lies_where_its_parent_has_it(box: Mesh, share: float) -> None:
    fine, nodes = refined(box, share), box.cell_type.nodes
    linear = tables_at(nodes, reference_nodes(nodes), np.ones(nodes)).M
    inside = np.einsum("nk,cki->cni", linear, fine.corners)
    at = np.stack([tables_at(nodes, each, np.ones(nodes)).N for each in inside])
    expected = np.einsum("cna,cai->cni", at, box.points[box.cells[fine.parent]])
    assert np.abs(fine.mesh.points[fine.mesh.cells] - expected).max() < 1e-14


@pytest.mark.parametrize("share", [0.1, 0.4, 1.0])
def test_the_mesh_conforms(box: Mesh, share: float) -> None:
    """Every side belongs to two cells, or to one at the surface, whose area stays; no node twice, none unused."""
    fine = refined(box, share).mesh
    assert area(fine.points, outer(fine)) == pytest.approx(area(box.points, outer(box)), rel=1e-3)
    assert np.array_equal(np.unique(fine.cells), np.arange(len(fine.points)))
    assert len(np.unique(np.round(fine.points, 10), axis=0)) == len(fine.points)


def outer(mesh: Mesh) -> np.ndarray:
    sides = cell_sides(mesh.cells)
    _, first, times = np.unique(corner_keys(sides, len(mesh.points)), return_index=True, return_counts=True)
    assert times.max() == 2
    return sides[first[times == 1]]


@pytest.mark.parametrize("share", [0.1, 0.4, 1.0])
def test_faces_and_regions_stay(box: Mesh, share: float) -> None:
    result = refined(box, share)
    fine = result.mesh
    keys = corner_keys(cell_sides(fine.cells), len(fine.points))
    for name, cells in box.regions.items():
        assert np.array_equal(np.unique(result.parent[fine.regions[name]]), cells)
    for name in box.faces:
        assert area(fine.points, fine.face(name)) == pytest.approx(area(box.points, box.face(name)), rel=1e-3)
        assert np.isin(corner_keys(fine.face(name), len(fine.points)), keys).all()


def test_a_flat_face_keeps_its_area_exactly() -> None:
    for kind in KINDS.values():
        box = lattice((2, 3, 2), kind)
        fine = refined(box, 0.5).mesh
        for name in box.faces:
            assert area(fine.points, fine.face(name)) == pytest.approx(area(box.points, box.face(name)), rel=1e-12)


def test_a_box_has_a_sheet_for_each_layer() -> None:
    of_cell = sheets(lattice((2, 3, 4), HEXAHEDRON))
    assert [len(np.unique(column)) for column in of_cell.T] == [2, 3, 4]
    assert int(of_cell.max()) + 1 == 2 + 3 + 4
    assert np.array_equal(np.unique(of_cell, axis=0, return_counts=True)[1], np.ones(24))


def test_a_sheet_is_cut_and_nothing_else() -> None:
    box = lattice((2, 3, 4), HEXAHEDRON)
    chosen = int(sheets(box)[0, 2])
    fine = refine_hexahedra(box, np.array([chosen]))
    inside = sheets(box)[:, 2] == chosen
    assert np.array_equal(np.bincount(fine.parent), np.where(inside, 2, 1))
    assert set(np.unique(fine.corners[np.isin(fine.parent, np.flatnonzero(inside)), :, 2])) == {0.0, 0.5, 1.0}


def test_refining_twice_stays_exact(box: Mesh) -> None:
    once = refined(box, 0.3)
    twice = refined(once.mesh, 0.3)
    volumes = np.bincount(once.parent[twice.parent], cell_volumes(twice.mesh))
    assert volumes == pytest.approx(cell_volumes(box), rel=1e-12)
