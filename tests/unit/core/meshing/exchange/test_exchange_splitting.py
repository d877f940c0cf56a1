"""Wedges, pyramids, collapsed hexahedra and mixed cells become tetrahedra that fit each other and keep their volume."""

from pathlib import Path

import exchange_cases as cases
import numpy as np
import pytest
from lattice_cases import curved

from turgor.core.meshing.exchange.read import read_mesh
from turgor.core.meshing.exchange.splitting import EDGES
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.core.meshing.surface import outer_triangles

DATA = Path(__file__).parents[3] / "data" / "meshes"
#: VTK's numbers of the kinds, of first and second order.
VTK = {"tetrahedron": (10, 24), "hexahedron": (12, 25), "wedge": (13, 26), "pyramid": (14, 27)}
#: Volume of the curved row of cubes: the integral of the determinant of `curved` over it.
ROW = 1 / 16 + 0.005 / 48 - 0.02 / 4 / 4**4 + 0.0032 / 3 / 2 / 4**3 - 0.001 / 2 / 3 / 4**4


def row_of_cubes(order):
    """Points and blocks of four cubes along x: a hexahedron, two wedges, six pyramids, two collapsed hexahedra."""
    points, blocks = [], []

    def node(at):
        at = tuple(float(x) for x in at)
        if at not in points:
            points.append(at)
        return points.index(at)

    def add(shape, corners):
        corners = np.array(corners, dtype=float)
        middles = [corners[list(edge)].mean(axis=0) for edge in EDGES[shape]] if order == 2 else []
        blocks.append((VTK[shape][order - 1], np.array([[node(at) for at in (*corners, *middles)]])))

    def cube(x):
        low = [(x, 0, 0), (x + 1, 0, 0), (x + 1, 1, 0), (x, 1, 0)]
        return np.array([*low, *((a, b, 1) for a, b, _ in low)], dtype=float)

    add("hexahedron", cube(0))
    for corners in ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)):
        add("wedge", cube(1)[list(corners)])
    for side in ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)):
        add("pyramid", [*cube(2)[list(side)], cube(2).mean(axis=0)])
    for corners in ((0, 1, 2, 2, 4, 5, 6, 6), (0, 2, 3, 3, 4, 6, 7, 7)):
        add("hexahedron", cube(3)[list(corners)])
    return np.array(points) / 4, blocks


def read(folder, points, blocks):
    file = folder / "row.vtk"
    file.write_bytes(cases.vtk_legacy(points, blocks))
    return read_mesh(file, unit="cm")


@pytest.mark.parametrize("order", [1, 2])
def test_a_row_of_four_kinds_of_cells_keeps_its_volume(tmp_path, order):
    points, blocks = row_of_cubes(order)
    straight = read(tmp_path, points, blocks)
    assert cell_volumes(straight).sum() == pytest.approx(1e-6 / 16, rel=1e-12)
    assert (cell_volumes(straight) > 0).all()
    assert len(straight.cells) == 6 + 6 + 12 + 6
    # cells fit each other: the surface is that of the row, whose area is 18 squares of a side of 2.5 mm
    corners = straight.points[outer_triangles(straight)[:, :3]]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    assert areas.sum() == pytest.approx(18 * 2.5e-3**2, rel=1e-12)
    (note,) = [each for each in straight.findings if each.code == "G20"]
    assert "hexahedron" in note.message
    assert "30 tetrahedra" in note.message


def test_mid_side_nodes_and_new_middles_follow_a_curved_row(tmp_path):
    points, blocks = row_of_cubes(2)
    mesh = read(tmp_path, curved(points), blocks)
    assert cell_volumes(mesh).sum() == pytest.approx(ROW * 1e-6, rel=1e-10)


def test_kinds_of_two_orders_meet(tmp_path):
    points, blocks = row_of_cubes(2)
    (kind, first), *rest = blocks
    assert kind == VTK["hexahedron"][1]
    mesh = read(tmp_path, curved(points), [(VTK["hexahedron"][0], first[:, :8]), *rest])
    # straight edges where only the first cell has them; those that it shares are curved as its neighbor's
    assert cell_volumes(mesh).sum() == pytest.approx(ROW * 1e-6, rel=0.02)
    assert len(mesh.cells) == 30


@pytest.mark.parametrize(("merge", "shared"), [(False, 0), (True, 6)])
def test_bodies_that_stay_apart_share_no_middles(tmp_path, merge, shared):
    wedges, start = [], 0
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], dtype=float)
    points = np.vstack([corners, [corners[list(edge)].mean(axis=0) for edge in EDGES["wedge"]]])
    for _ in range(2):  # one below the other, with nodes of its own
        wedges.append((VTK["wedge"][1], start + np.arange(15)[None]))
        start += 15
    file = tmp_path / "two.vtk"
    file.write_bytes(cases.vtk_legacy(np.vstack([points, points - [0, 0, 1]]), wedges))
    mesh = read_mesh(file, unit="cm", merge=merge)
    upper = mesh.points[mesh.cells].mean(axis=1)[:, 2] > 0
    assert len(np.intersect1d(mesh.cells[upper], mesh.cells[~upper])) == shared


def test_files_of_gmsh_with_wedges_and_pyramids_keep_names_and_volume():
    disk = read_mesh(DATA / "disk_wedges.msh")
    assert {name: len(disk.faces[name]) for name in ("fixed", "rim", "tip")} == {"fixed": 7, "rim": 14, "tip": 7}
    assert cell_volumes(disk).sum() == pytest.approx(3137.44e-9, rel=1e-5)
    rim = disk.points[disk.face_nodes("rim")]
    assert np.hypot(*rim[:, :2].T) == pytest.approx(10e-3, rel=2e-3)
    cubes = read_mesh(DATA / "two_cubes.msh")
    assert set(cubes.regions) == {"left", "right"}
    assert [cell_volumes(cubes)[rows].sum() for rows in cubes.regions.values()] == pytest.approx([1e-6, 1e-6])
    for mesh, bend in ((disk, 0.15), (cubes, 1e-9)):  # mid-side nodes lie on their own edges
        ends, middles = mesh.points[mesh.cells[:, EDGES["tetrahedron"]]], mesh.points[mesh.cells[:, 4:]]
        off = np.linalg.norm(middles - ends.mean(axis=2), axis=2)
        assert (off <= bend * np.linalg.norm(np.diff(ends, axis=2)[:, :, 0], axis=2)).all()
    assert cubes.points[cubes.face_nodes("tip"), 0] == pytest.approx(20e-3)
