"""Tetrahedra across a mirror plane are cut there: the half has half of everything, and answers as the whole does."""

from dataclasses import replace
from itertools import permutations
from pathlib import Path

import exchange_cases as cases
import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.meshing.bodies.half import half_of
from turgor.core.meshing.bodies.placing import placed
from turgor.core.meshing.exchange.read import read_mesh
from turgor.core.meshing.quality.cell_quality import cell_shapes, cell_volumes, jacobian_ratios
from turgor.core.meshing.surface import check_surface
from turgor.job.read import read_job
from turgor.units import mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.05e6))

#: Each cube in six tetrahedra around its diagonal, alike in all cubes: not the same on both sides of any plane.
SIX = [np.cumsum([[0, 0, 0], *np.eye(3, dtype=int)[list(order)]], axis=0) for order in permutations(range(3))]


def bar_file(folder: Path, shift: float = 0.0, slit: float = 0.0) -> Path:
    """A bar of 4 x 3 x 2 cubes of 5 mm, the middle ones across y = 0.

    Its middle nodes may be shifted along y [mm], and half of its middle cubes may be a slit of twice a width [mm].
    """
    counts = np.array([4, 3, 2])
    index = np.array(list(np.ndindex(*(counts + 1))))
    points = index * 5.0 + (0, -7.5, 0)
    inner = (index[:, 1] == 1) | (index[:, 1] == 2)
    points[inner, 1] += shift
    cubes = np.array(list(np.ndindex(*counts)))
    if slit:
        within = inner & (index[:, 0] >= 2)
        points[within, 1] = slit * np.sign(points[within, 1])
        cubes = cubes[(cubes[:, 0] < 2) | (cubes[:, 1] != 1)]
    corners = np.concatenate([cubes[:, None] + six for six in SIX])
    cells = np.ravel_multi_index(np.moveaxis(corners, -1, 0), counts + 1)
    a, b, c, d = (points[cells[:, k]] for k in range(4))
    turned = np.einsum("ci,ci->c", b - a, np.cross(c - a, d - a)) < 0
    cells[turned] = cells[turned][:, [0, 2, 1, 3]]
    sets = {
        "left": np.flatnonzero(index[:, 0] == 0),
        "right": np.flatnonzero(index[:, 0] == 4),
        "edge": np.flatnonzero((index[:, 0] == 4) & (index[:, 2] == 2)),
    }
    lines = [f"*NSET, NSET={name}\n" + "\n".join(map(str, nodes + 1)) for name, nodes in sets.items()]
    file = folder / "bar.inp"
    file.write_text(
        "\n".join([*cases.inp_nodes(points), *cases.inp_cells("C3D4", cells), *lines, ""]), encoding="utf-8"
    )
    return file


@pytest.mark.parametrize("shift", [0.0, 2.3, -2.45], ids=["in the middle", "near a layer of nodes", "nearer"])
def test_a_half_has_half_of_the_volume_and_of_each_face(tmp_path, shift):
    whole = read_mesh(bar_file(tmp_path, shift))
    half = half_of(whole, "y")
    assert cell_volumes(half).sum() == pytest.approx(cell_volumes(whole).sum() / 2, rel=1e-12)
    assert cell_volumes(half).min() > 0
    assert cell_shapes(half).min() > 0.09
    assert check_surface(half) == ()
    for name, area in (("symmetry_y", 200), ("left", 75), ("right", 75), ("outside", 500)):
        assert area_of(half, name) == pytest.approx(area * mm**2, rel=1e-9), name
    edge = half.points[half.node_sets["edge"]]
    assert edge[:, 1].min() == 0
    assert np.allclose(edge[:, [0, 2]], [20 * mm, 10 * mm])
    assert half.findings[-1].code == "G27"
    assert "y = 0" in half.findings[-1].message


def area_of(mesh, name):
    a, b, c = (mesh.points[mesh.faces[name][:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def test_two_planes_leave_a_quarter(tmp_path):
    """The second cut works on cells that the first one has made."""
    whole = placed(read_mesh(bar_file(tmp_path)), shift=(0, 0, -5 * mm))
    quarter = half_of(half_of(whole, "y"), "z")
    assert quarter.symmetry_faces == ("symmetry_y", "symmetry_z")
    assert cell_volumes(quarter).sum() == pytest.approx(cell_volumes(whole).sum() / 4, rel=1e-12)


def test_a_round_body_with_curved_cells_keeps_its_volume_and_its_names():
    whole = tg.mesh(tg.actuators.ExtendingCylinder(symmetric=False).build(), size=5 * mm, cells="tetrahedra")
    upper = half_of(whole, "z")
    lower = half_of(placed(whole, axis=(1, 0, 0), angle=np.pi), "z")
    both = cell_volumes(upper).sum() + cell_volumes(lower).sum()
    assert both == pytest.approx(cell_volumes(whole).sum(), rel=1e-3)
    assert set(upper.faces) == {*whole.faces, "symmetry_z"}
    assert check_surface(upper) == ()
    assert cell_shapes(upper).min() > 0.05
    assert jacobian_ratios(upper).min() > 0.2


def test_the_half_answers_as_the_whole_does(tmp_path):
    """Other cells at the plane: the force is the same, the deflection up to the error of these coarse meshes."""
    whole = read_mesh(bar_file(tmp_path))
    ends = []
    for mesh in (whole, half_of(whole, "y")):
        solution = tg.solve(tg.Model(mesh, RUBBER, ["left"], [tg.loads.Force("edge", (0, 0, -0.02))]))
        force = tg.measure(solution, "reaction", mesh_error=False).column("reaction")[-1]
        ends.append((force, solution.states[-1].displacement[mesh.face_nodes("right"), 2].mean()))
    assert ends[1][0] == pytest.approx(ends[0][0], rel=1e-6)
    assert ends[1][1] == pytest.approx(ends[0][1], rel=0.02)


def test_a_part_that_is_not_alike_on_both_sides_is_refused(tmp_path):
    whole = read_mesh(bar_file(tmp_path))
    with refused("mirror plane y = 0", "-6.5", "8.5"):
        half_of(placed(whole, shift=(0, 1 * mm, 0)), "y")
    points = whole.points.copy()
    above = points[:, 1] > 0
    points[above, 2] *= 1.2
    with refused("mirror plane y = 0", "volume"):
        half_of(replace(whole, points=points), "y")


def test_names_of_one_side_are_said(tmp_path):
    whole = read_mesh(bar_file(tmp_path))
    assert not [each for each in half_of(whole, "y").findings if "other side" in each.message]
    corner = np.flatnonzero((whole.points == whole.points.max(axis=0)).all(axis=1))
    half = half_of(replace(whole, node_sets={**whole.node_sets, "corner": corner}), "y")
    (said,) = [each for each in half.findings if "'corner'" in each.message]
    assert said.code == "G27"
    assert "'edge'" not in said.message


def test_a_job_takes_the_half(tmp_path):
    bar_file(tmp_path)
    file = tmp_path / "job.toml"
    file.write_text(
        '[mesh]\nfile = "bar.inp"\nmirror = ["y"]\n[materials]\nbody = { law = "neo_hooke", C10 = "0.12 MPa" }\n'
        '[supports]\nleft = "xyz"\n[loads]\nedge = { force = [0, 0, "-20 mN"] }\n',
        encoding="utf-8",
    )
    assert "symmetry_y" in read_job(file).geometry().faces


def test_walls_along_the_plane_stay_where_they_are(tmp_path):
    """A slit of 0.4 mm: corners of its walls are near the plane, and would close it if they were moved."""
    whole = read_mesh(bar_file(tmp_path, slit=0.2))
    half = half_of(whole, "y")
    assert cell_volumes(half).sum() / mm**3 == pytest.approx((20 * 15 - 10 * 0.4) * 10 / 2, rel=1e-9)
    assert area_of(half, "symmetry_y") == pytest.approx(100 * mm**2, rel=1e-9)


def test_hexahedra_of_a_file_are_split_before_they_are_cut(tmp_path):
    points, cells = cases.grid((2, 3, 2), (0.0, -7.5, 0.0), 5.0)
    file = tmp_path / "hexahedra.inp"
    file.write_text("\n".join([*cases.inp_nodes(points), *cases.inp_cells("C3D8", cells), ""]), encoding="utf-8")
    whole, half = tg.files.MeshFile(file=file), tg.files.MeshFile(file=file, mirror=("z", "y"), move=(0, 0, -5 * mm))
    assert whole.read().cells.shape[1] == 27
    quarter = half.read()
    assert quarter.cells.shape[1] == 10
    assert cell_volumes(quarter).sum() == pytest.approx(10 * 7.5 * 5 * mm**3, rel=1e-9)
    assert [each.code for each in quarter.findings].count("G27") == 2
