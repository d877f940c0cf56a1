"""Every format gives the same hollow cube: cells, names, volumes."""

from dataclasses import fields

import exchange_cases as cases
import numpy as np
import pytest
from results_cases import body, model, state

import turgor as tg
from refused import refused
from turgor.core.meshing.exchange.boundary import enclosed_volume, sides_of
from turgor.core.meshing.exchange.frame import Frame
from turgor.core.meshing.exchange.read import READERS, read_mesh
from turgor.core.meshing.exchange.solids import read_solids
from turgor.core.results.files.mesh_vtu import write_mesh_vtu
from turgor.core.results.files.vtu import write_state

MM3 = 1e-9


def written(folder, name, content):
    file = folder / name
    if isinstance(content, bytes):
        file.write_bytes(content)
    else:
        file.write_text(content, encoding="utf-8")
    return file


def volume(file):
    solids = read_solids(READERS[file.suffix](file), Frame())
    sides = sides_of(solids)
    return enclosed_volume(sides, np.flatnonzero(sides.outer), np.zeros(3))


def check_cube(mesh, cells):
    """The hollow cube with one cavity of 10 x 10 x 10 mm in 30 x 30 x 30 mm."""
    per_square = 1 if mesh.cells.shape[1] == 27 else 2
    assert len(mesh.cells) == cells
    assert set(mesh.faces) >= {"cavity", "outside"}
    assert len(mesh.faces["cavity"]) == 6 * per_square
    assert np.ptp(mesh.points, axis=0) == pytest.approx([0.03, 0.03, 0.03])
    inner = mesh.points[mesh.face_nodes("cavity")]
    assert inner.min() == pytest.approx(0.01)
    assert inner.max() == pytest.approx(0.02)


@pytest.mark.parametrize("tetrahedra", [True, False])
@pytest.mark.parametrize("version", [2, 4])
@pytest.mark.parametrize("binary", [None, "<", ">"])
def test_gmsh_groups_become_regions_and_faces(tmp_path, tetrahedra, version, binary):
    points, cells, low = cases.hollow_cube(tetrahedra)
    flat = (cases.triangles_at if tetrahedra else cases.quads_at)(cells, points, 0, 0.0)
    solid, sheet = (4, 2) if tetrahedra else (5, 3)
    if version == 2:
        blocks = [(15, [np.array([0])], [7]), (sheet, flat, [3] * len(flat)), (solid, cells, np.where(low, 1, 2))]
        write, swapped = cases.gmsh_2, cases.gmsh_2_binary
    else:
        blocks = [(2, 3, sheet, flat), (3, 1, solid, cells[low]), (3, 2, solid, cells[~low])]
        write, swapped = cases.gmsh_4, cases.gmsh_4_binary
    names = {(3, 1): "base", (3, 2): "body", (2, 3): "fixed"}
    content = swapped(points, blocks, names, binary) if binary else write(points, blocks, names)
    mesh = read_mesh(written(tmp_path, "cube.msh", content))
    check_cube(mesh, len(cells))
    assert {name: len(rows) for name, rows in mesh.regions.items()} == {
        "base": int(low.sum()),
        "body": int((~low).sum()),
    }
    assert len(mesh.faces["fixed"]) == len(flat)
    assert np.abs(mesh.points[mesh.face_nodes("fixed"), 0]).max() == 0


@pytest.mark.parametrize("tetrahedra", [True, False])
def test_gmsh_second_order_keeps_curved_mid_side_nodes(tmp_path, tetrahedra):
    points, cells, _ = cases.hollow_cube(tetrahedra)
    kind = "msh" if tetrahedra else "vtk"
    content = (
        cases.gmsh_2(points, [(4, cells, [1] * len(cells))], {})
        if tetrahedra
        else cases.vtk_legacy(points, [(12, cells)])
    )
    straight = read_mesh(written(tmp_path, f"first.{kind}", content))
    moved = straight.points * 1e3
    moved[straight.vertex_count :] += 0.1 * np.sin(moved[straight.vertex_count :])
    order, number = (cases.GMSH_TETRAHEDRON_10, 11) if tetrahedra else (cases.GMSH_HEXAHEDRON_20, 17)
    nodes = straight.cells[:, list(order)]
    used = np.unique(nodes)
    place = np.zeros(len(moved), dtype=int)
    place[used] = np.arange(len(used))
    text = cases.gmsh_2(moved[used], [(number, place[nodes], [1] * len(nodes))], {})
    mesh = read_mesh(written(tmp_path, "second.msh", text))
    assert mesh.points[mesh.cells[:, :20]] == pytest.approx(moved[straight.cells[:, :20]] * 1e-3, abs=1e-15)
    assert not [finding for finding in mesh.findings if finding.code == "G21"]


def test_abaqus_sets_and_surfaces(tmp_path):
    points, cells, low = cases.hollow_cube()
    lines = ["*Heading", "a cube", "** a comment", *cases.inp_nodes(points)]
    lines += cases.inp_cells("C3D8R", cells[low], elset="lower")
    lines += cases.inp_cells("C3D8R", cells[~low], first=101, elset="Upper")
    lines += [
        "*NSET, NSET=left, GENERATE",
        "1, 16, 1",
        "*Nset, nset=some",
        "left, 20",
        "*ELSET, ELSET=first,",
        "generate",
    ]
    lines += ["1, 3", "*SURFACE, NAME=bottom, TYPE=ELEMENT", "lower, S1", "*SURFACE, NAME=one", "2, S1", "3, S1"]
    lines += ["*NODE PRINT", "U", "*SOLID SECTION, ELSET=LOWER, MATERIAL=x", "*SOLID SECTION, ELSET=upper, MATERIAL=y"]
    mesh = read_mesh(written(tmp_path, "cube.inp", "\n".join(lines)))
    check_cube(mesh, 26)
    assert {name: len(rows) for name, rows in mesh.regions.items()} == {"lower": 9, "Upper": 17}
    assert {name: len(mesh.faces[name]) for name in ("left", "some", "bottom", "one")} == {
        "left": 9,
        "some": 9,
        "bottom": 9,
        "one": 2,
    }
    assert "all" not in mesh.faces
    assert np.abs(mesh.points[mesh.face_nodes("bottom"), 2]).max() == 0
    assert np.abs(mesh.points[mesh.face_nodes("left"), 0]).max() == 0


@pytest.mark.parametrize("face", range(4))
def test_abaqus_counts_the_faces_of_tetrahedra_as_its_manual(tmp_path, face):
    corners = ((1, 2, 3), (1, 4, 2), (2, 4, 3), (3, 4, 1))[face]
    points = np.array([[0.0, 0, 0], [10, 0, 0], [0, 10, 0], [0, 0, 10]])
    lines = [*cases.inp_nodes(points), "*ELEMENT, TYPE=C3D4", "1, 1, 2, 3, 4", "*SURFACE, NAME=it", f"1, S{face + 1}"]
    mesh = read_mesh(written(tmp_path, "one.inp", "\n".join(lines)))
    (side,) = mesh.faces["it"]
    assert mesh.points[side[:3]].sum(axis=0) == pytest.approx(points[np.array(corners) - 1].sum(axis=0) * 1e-3)


@pytest.mark.parametrize(("binary", "version"), [(False, 2), (True, 2), (False, 5), (True, 5)])
def test_legacy_vtk_with_lower_cells_first(tmp_path, binary, version):
    points, cells, low = cases.hollow_cube(True)
    blocks = [(1, np.array([[0], [5]])), (3, np.array([[0, 1]])), (5, np.array([[0, 1, 5]])), (10, cells)]
    labels = np.concatenate([np.zeros(4, dtype=int), low])
    content = cases.vtk_legacy(points, blocks, binary, version, labels)
    file = written(tmp_path, "cube.vtk", content)
    mesh = read_mesh(file, regions={"base": "material 1"})
    check_cube(mesh, 156)
    assert {name: len(rows) for name, rows in mesh.regions.items()} == {"base": 54, "body": 102}
    assert volume(file) == pytest.approx(26e3 * MM3)


@pytest.mark.parametrize("form", ["ascii", "base64", "raw", "appended-base64"])
@pytest.mark.parametrize("compressed", [False, True])
@pytest.mark.parametrize(("header", "order"), [("UInt32", "LittleEndian"), ("UInt64", "BigEndian")])
def test_vtu_in_all_its_encodings(tmp_path, form, compressed, header, order):
    points, cells, _ = cases.hollow_cube()
    content = cases.vtu(points, [(9, cells[:2, :4]), (12, cells)], form, compressed, header, order)
    mesh = read_mesh(written(tmp_path, "cube.vtu", content))
    check_cube(mesh, 26)


def test_own_vtu_files_are_read_again(tmp_path):
    mesh = body()
    file = tmp_path / "state.vtu"
    write_state(file, state(model(mesh)))
    again = read_mesh(file)
    assert list(again.regions) == list(mesh.regions)
    assert again.points[again.cells] == pytest.approx(mesh.points[mesh.cells], abs=1e-7)
    assert len(again.faces["cavity"]) == len(mesh.faces["cavity"])


@pytest.mark.parametrize("version", [2, 4])
@pytest.mark.parametrize("kept", [0.4, 0.8, 0.95])
def test_binary_gmsh_files_that_break_off_are_told(tmp_path, version, kept):
    points, cells, _ = cases.hollow_cube()
    if version == 2:
        content = cases.gmsh_2_binary(points, [(5, cells, [1] * len(cells))], {})
    else:
        content = cases.gmsh_4_binary(points, [(3, 1, 5, cells)], {})
    with refused("cube.msh", "section $Elements"):
        read_mesh(written(tmp_path, "cube.msh", content[: int(kept * len(content))]))


def test_binary_gmsh_files_with_wrong_counts_are_told(tmp_path):
    points, cells, _ = cases.hollow_cube()
    content = cases.gmsh_2_binary(points, [(5, cells, [1] * len(cells))], {})
    at = content.index(b"$Elements") + 10
    block = content.index(b"\n", at) + 5  # the number of cells of the first block
    for count in (0, -1, 10**6):
        damaged = content[:block] + count.to_bytes(4, "little", signed=True) + content[block + 4 :]
        with refused("cube.msh", "damaged"):
            read_mesh(written(tmp_path, "cube.msh", damaged))


@pytest.mark.parametrize("cells", ["tetrahedra", "hexahedra"])
def test_meshes_that_were_written_come_back_with_all_names(tmp_path, cells):
    mesh = tg.mesh(tg.FastPneuNet(chambers=2, length=20e-3).build(), size=4e-3, cells=cells)
    write_mesh_vtu(tmp_path / "finger.vtu", mesh)
    again = read_mesh(tmp_path / "finger.vtu")
    assert list(again.regions) == list(mesh.regions)
    assert {name: len(rows) for name, rows in again.regions.items()} == {n: len(r) for n, r in mesh.regions.items()}
    assert {name: len(face) for name, face in again.faces.items()} == {n: len(f) for n, f in mesh.faces.items()}
    assert np.array_equal(again.points[again.cells], mesh.points[mesh.cells])
    assert not again.findings
    for name in mesh.faces:
        assert cases.centers(again, name) == pytest.approx(cases.centers(mesh, name), abs=1e-12)


def test_a_face_with_a_node_too_many_is_told(tmp_path):
    mesh = body()
    wrong = {name: np.full_like(face, 10**6) for name, face in mesh.faces.items()}
    broken = object.__new__(type(mesh))
    for item in fields(mesh):
        object.__setattr__(broken, item.name, wrong if item.name == "faces" else getattr(mesh, item.name))
    write_mesh_vtu(tmp_path / "a.vtu", broken)
    with refused("a.vtu", "face 'fixed'", "node 1000000", "0..557"):
        read_mesh(tmp_path / "a.vtu")


@pytest.mark.parametrize(
    ("name", "content", "facts"),
    [
        ("a.msh", "$MeshFormat\n4.0 0 8\n$EndMeshFormat\n", ("a.msh", "version 4.0", "2.2 and 4.1")),
        ("a.msh", b"$MeshFormat\n4.1 1 8\n\1\0\0\0\n$EndMeshFormat\n", ("a.msh", "$Nodes")),
        ("a.msh", "hello", ("a.msh", "$MeshFormat")),
        (
            "a.msh",
            "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 5 1 5\n$EndNodes\n$Elements\n0\n",
            ("a.msh", "damaged"),
        ),
        ("a.vtk", "hello", ("a.vtk", "legacy VTK", "first line")),
        (
            "a.vtk",
            "# vtk DataFile Version 2.0\n\nASCII\nDATASET POLYDATA\n",
            ("a.vtk", "POLYDATA", "UNSTRUCTURED_GRID"),
        ),
        (
            "a.vtk",
            "# vtk DataFile Version 2.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 float\n0 0 0",
            ("a.vtk", "breaks off"),
        ),
        ("a.vtu", "<VTKFile", ("a.vtu", "no VTU", "line 1")),
        ("a.vtu", '<VTKFile type="PolyData"/>', ("a.vtu", "PolyData", "UnstructuredGrid")),
        ("a.inp", "*NODE\n1, 0, zero, 0", ("a.inp", "'1, 0, zero, 0'", "a node")),
        ("a.inp", "*NODE\n1,0,0,0\n*ELEMENT, TYPE=C3D27\n1,1", ("a.inp", "C3D27", "C3D4, C3D10, C3D8 and C3D20")),
        ("a.inp", "*HEADING\n", ("a.inp", "*NODE")),
        ("a.inp", "*NODE\n1,0,0,0\n*ELEMENT, TYPE=C3D4\n1,1,2,3,4", ("a.inp", "node 2")),
        ("a.inp", "*NODE\n1,0,0,0\n*ELEMENT, TYPE=C3D4\n1,1,2,3", ("a.inp", "C3D4", "5 numbers")),
        ("a.inp", "*PART\n*NODE\n1,0,0,0\n*PART\n", ("a.inp", "several parts")),
        ("a.inp", "*NODE\n1,0,0,0\n*INSTANCE\n0,0,5\n", ("a.inp", "instance")),
        ("a.inp", "*NODE, SYSTEM=C\n1,1,90,0\n", ("a.inp", "line 1", "*NODE", "SYSTEM", "Cartesian")),
        ("a.inp", "*NODE\n1,0,0,0\n*NSET, NSET=A, ELSET=B\n", ("a.inp", "line 3", "*NSET", "ELSET")),
        ("a.inp", "*NODE\n1,0,0,0\n*ELEMENT, TYPE=C3D4, INPUT=b.txt\n", ("a.inp", "line 3", "INPUT")),
        ("a.inp", "*NODE\n1,0,0,0\n*SURFACE, NAME=A, COMBINE=UNION\nB, C\n", ("a.inp", "line 3", "COMBINE")),
        ("a.inp", "*PART\n*NODE\n1,0,0,0\n*END PART\n*NODE\n1,5,0,0\n", ("a.inp", "line 5", "node 1", "reference")),
        ("a.inp", "*PART\n*NODE\n1,0,0,0\n*END PART\n*INSTANCE\n*INSTANCE\n", ("a.inp", "several instances")),
        ("a.inp", "*NODE\n1,0,0,0\n", ("a.inp", "no cells")),
        ("a.stl", "solid", ("a.stl", "'.stl'", ".msh, .inp, .vtk, .vtu")),
    ],
)
def test_files_that_cannot_be_read(tmp_path, name, content, facts):
    with refused(*facts):
        read_mesh(written(tmp_path, name, content))


def test_missing_file_names_the_near_one(tmp_path):
    written(tmp_path, "finger.msh", "")
    with refused("fnger.msh", "finger.msh"):
        read_mesh(tmp_path / "fnger.msh")


def test_a_count_below_zero_is_no_endless_loop(tmp_path):
    points, cells, _ = cases.hollow_cube()
    content = cases.vtk_legacy(points, [(12, cells)], binary=True)
    file = written(tmp_path, "cube.vtk", content.replace(b"POINTS 64 double", b"POINTS -1 double"))
    with refused("cube.vtk", "-3 numbers"):
        read_mesh(file)


def test_numbers_that_are_no_points_are_told(tmp_path):
    points, cells, _ = cases.hollow_cube()
    content = cases.vtu(points, [(12, cells)]).replace(b">0.0 0.0 0.0", b">0.0 0.0", 1)
    with refused("cube.vtu", "damaged"):
        read_mesh(written(tmp_path, "cube.vtu", content))
