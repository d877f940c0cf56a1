"""Meshes with flaws: what is mended is said, what cannot be mended is refused with its places."""

import exchange_cases as cases
import numpy as np
import pytest

from refused import refused
from turgor.core.meshing.exchange.read import read_mesh
from turgor.core.meshing.quality.cell_quality import cell_volumes


def written(folder, points, cells, kind=10):
    file = folder / "mesh.vtk"
    file.write_bytes(cases.vtk_legacy(points, [(kind, cells)]))
    return file


def messages(mesh, code):
    return " ".join(finding.message for finding in mesh.findings if finding.code == code)


def test_cells_in_mirrored_order_are_turned(tmp_path):
    points, cells, _ = cases.hollow_cube(True)
    mesh = read_mesh(written(tmp_path, points, cells[:, [0, 2, 1, 3]]))
    assert cell_volumes(mesh).sum() == pytest.approx(26e-6)
    assert "156 cells written in mirrored order were turned" in messages(mesh, "G20")
    some = cells.copy()
    some[::5] = some[::5][:, [1, 0, 2, 3]]
    mesh = read_mesh(written(tmp_path, points, some))
    assert (cell_volumes(mesh) > 0).all()
    assert "32 cells written in mirrored order" in messages(mesh, "G20")


def test_hexahedra_in_mirrored_order_are_turned(tmp_path):
    points, cells, _ = cases.hollow_cube()
    straight = read_mesh(written(tmp_path, points, cells, 12))
    mesh = read_mesh(written(tmp_path, points, cells[:, [4, 5, 6, 7, 0, 1, 2, 3]], 12))
    assert "26 cells written in mirrored order were turned" in messages(mesh, "G20")
    # every node, the middles too, lies where it does in the mesh that needed no turning
    order = np.argsort(straight.points[straight.cells].mean(axis=1) @ [1, 10, 100])
    for place in range(27):
        assert mesh.points[mesh.cells[order, place]] == pytest.approx(straight.points[straight.cells[order, place]])


def test_cell_turned_inside_out_is_refused_with_its_place(tmp_path):
    points, cells, _ = cases.hollow_cube(True)
    inner = points.copy()
    inner[21] = [10.0, 10.0, 25.0]  # a corner of the cavity, pulled through the cells above it
    with refused("mesh.vtk", "4 of 156", "negative volume", "(7.5, 5, 16.25) mm"):
        read_mesh(written(tmp_path, inner, cells))


def test_flat_cells_are_refused(tmp_path):
    points, cells, _ = cases.hollow_cube()
    flat = points.copy()
    flat[0] = flat[1] + [0.5, 0, 0]
    with refused("mesh.vtk", "1 of 26", "flat", "(5.062, 5, 6.25) mm"):
        read_mesh(written(tmp_path, flat, cells, 12))


def test_collapsed_hexahedra_become_tetrahedra(tmp_path):
    points, cells, _ = cases.hollow_cube()
    points[0] = points[1]  # another number, the same place
    mesh = read_mesh(written(tmp_path, points, cells, 12))
    assert "26 hexahedron8" in messages(mesh, "G20")
    assert cell_volumes(mesh).sum() == pytest.approx(26e-6 - 1e-6 / 3)
    assert (cell_volumes(mesh) > 0).all()


def test_overlap_without_negative_volumes_is_a_warning(tmp_path):
    points = np.array([[0.0, 0, 0], [10, 0, 0], [0, 10, 0], [0, 0, 10], [2, 2, 8]])
    mesh = read_mesh(written(tmp_path, points, np.array([[0, 1, 2, 3], [0, 1, 2, 4]])))
    assert "2 of 2 cells of 'mesh.vtk' lie partly in their neighbors" in messages(mesh, "G24")


def test_cells_written_twice_are_taken_once(tmp_path):
    points, cells, _ = cases.hollow_cube(True)
    mesh = read_mesh(written(tmp_path, points, np.vstack([cells, cells[3:5]])))
    assert len(mesh.cells) == 156
    assert "2 cells written twice were taken once" in messages(mesh, "G20")


def test_third_cell_at_a_side_is_refused(tmp_path):
    points = np.array([[0.0, 0, 0], [10, 0, 0], [0, 10, 0], [0, 0, 10], [2, 2, 8], [0, 0, -10]])
    cells = np.array([[0, 1, 2, 3], [0, 1, 2, 4], [0, 2, 1, 5]])
    with refused("mesh.vtk", "3 cells", "two others", "(2.5, 2.5, 2.5) mm"):
        read_mesh(written(tmp_path, points, cells))


def test_nodes_of_no_cell_are_left_out(tmp_path):
    points, cells, _ = cases.hollow_cube(True)
    mesh = read_mesh(written(tmp_path, np.vstack([[[1e6, 0, 0]] * 3, points]), cells + 3))
    assert "3 nodes that belong to no solid cell were left out" in messages(mesh, "G20")
    assert np.ptp(mesh.points, axis=0) == pytest.approx([0.03] * 3)


def test_surface_alone_is_refused(tmp_path):
    points, cells, _ = cases.hollow_cube(True)
    with refused("mesh.vtk", "no solid", "156 triangle3"):
        read_mesh(written(tmp_path, points, cells[:, :3], 5))


def test_straight_edges_on_a_curved_surface_are_a_warning(tmp_path):
    points, cells, _ = cases.hollow_cube(True)
    bent = points.copy()
    bent[:, 0] += 3 * np.sin(bent[:, 2] / 10)
    bent[:, 1] += 3 * np.sin(bent[:, 0] / 10)
    assert messages(read_mesh(written(tmp_path, points, cells)), "G21") == ""
    assert "have straight edges, but its surface is curved" in messages(
        read_mesh(written(tmp_path, bent, cells)), "G21"
    )
