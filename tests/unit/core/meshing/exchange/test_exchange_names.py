"""Names of imported meshes: cavities by shape, by selector, by STL surface; regions; unit and axes."""

import exchange_cases as cases
import numpy as np
import pytest

from refused import refused
from turgor.core.geometry.cad.selectors import ByColor, ByName, InBox, NearestTo, WithNormal
from turgor.core.meshing.exchange.formats.stl import stl_bytes
from turgor.core.meshing.exchange.read import read_mesh
from turgor.core.meshing.quality.checks import check_mesh
from turgor.units import mm

CUBE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
CUBE_TRIANGLES = np.array(
    [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4], [1, 2, 6], [1, 6, 5]]
    + [[2, 3, 7], [2, 7, 6], [3, 0, 4], [3, 4, 7]]
)


@pytest.fixture(params=[True, False], ids=["tetrahedra", "hexahedra"])
def cube(request, tmp_path):
    points, cells, _ = cases.hollow_cube(request.param)
    file = tmp_path / "cube.vtk"
    file.write_bytes(cases.vtk_legacy(points, [(10 if request.param else 12, cells)]))
    return file


def cavity_stl(folder, low, high):
    file = folder / "cavity.stl"
    file.write_bytes(stl_bytes(low + (high - low) * CUBE, CUBE_TRIANGLES))
    return file


def box_of(mesh, face):
    points = mesh.points[mesh.face_nodes(face)]
    return np.stack([points.min(axis=0), points.max(axis=0)]) / mm


def test_inner_surface_is_a_cavity_with_normals_into_it(cube):
    mesh = read_mesh(cube)
    assert set(mesh.faces) == {"cavity", "outside"}
    assert box_of(mesh, "cavity") == pytest.approx(np.array([[10.0] * 3, [20.0] * 3]))
    assert [f.code for f in check_mesh(mesh) if f.code in ("G02", "G03", "G04")] == []
    (note,) = [f for f in mesh.findings if f.code == "G22"]
    assert "'cavity' (1000 mm³)" in note.message


def test_faces_by_selectors(cube):
    faces = {
        "fixed": WithNormal("-x"),
        "tip": NearestTo((0.1, 15 * mm, 15 * mm)),
        "corner": [InBox((-1, -1, -1), (15 * mm, 15 * mm, 1)), WithNormal("+z")],
    }
    mesh = read_mesh(cube, faces=faces)
    assert box_of(mesh, "fixed") == pytest.approx(np.array([[0.0, 0, 0], [0, 30, 30]]))
    assert box_of(mesh, "tip") == pytest.approx(np.array([[30.0, 0, 0], [30, 30, 30]]))
    assert box_of(mesh, "corner") == pytest.approx(np.array([[0.0, 0, 30], [10, 10, 30]]))
    assert box_of(mesh, "cavity") == pytest.approx(np.array([[10.0] * 3, [20.0] * 3]))
    with refused("ByColor", "CAD"):
        read_mesh(cube, faces={"fixed": ByColor("red")})
    with refused("name 'a'", "selectors"):
        read_mesh(cube, faces={"fixed": [ByName("a"), WithNormal("-x")]})


def plane(axis, position):
    low, high = [-1.0] * 3, [1.0] * 3
    low[axis] = high[axis] = position
    return InBox(tuple(low), tuple(high))


def test_half_cavity_at_a_mirror_plane(tmp_path):
    points, cells, _ = cases.hollow_cube()
    upper = cells[points[cells][:, :, 1].mean(axis=1) > 14]
    kept = upper[points[upper][:, :, 1].min(axis=1) > 9]
    file = tmp_path / "half.vtk"
    file.write_bytes(cases.vtk_legacy(points, [(12, kept)]))
    assert "cavity" not in read_mesh(file).faces
    mesh = read_mesh(file, faces={"symmetry_y": plane(1, 10 * mm)})
    assert box_of(mesh, "cavity") == pytest.approx(np.array([[10.0, 10, 10], [20, 20, 20]]))
    assert len(mesh.faces["cavity"]) == 5


def test_two_cavities_are_numbered_along_x(tmp_path):
    points, cells, _ = cases.hollow_cube()
    far = points + [30.0, 0, 0]
    file = tmp_path / "two.vtk"
    file.write_bytes(cases.vtk_legacy(np.vstack([far, points]), [(12, np.vstack([cells, cells + 64]))]))
    mesh = read_mesh(file)
    assert box_of(mesh, "cavity_1")[0, 0] == pytest.approx(10)
    assert box_of(mesh, "cavity_2")[0, 0] == pytest.approx(40)
    assert any("16 nodes at the place of another one were merged" in f.message for f in mesh.findings)


def test_cavity_by_its_stl_surface(cube, tmp_path):
    stl = cavity_stl(tmp_path, 10.0, 20.0)
    mesh = read_mesh(cube, cavities={"cavity_air": stl})
    assert box_of(mesh, "cavity_air") == pytest.approx(np.array([[10.0] * 3, [20.0] * 3]))
    (finding,) = [f for f in mesh.findings if f.code == "G23"]
    assert finding.severity == "note"
    assert "it holds 1000 mm³, the surface 1000 mm³" in finding.message


def test_cavity_that_does_not_fit_well_is_a_warning(cube, tmp_path):
    mesh = read_mesh(cube, cavities={"cavity": cavity_stl(tmp_path, 10.0, 19.5)})
    (finding,) = [f for f in mesh.findings if f.code == "G23"]
    assert finding.severity == "warning"
    assert "at most 0.866 mm away; it holds 1000 mm³, the surface 857.37 mm³" in finding.message


def test_cavity_elsewhere_or_of_a_solid_mesh(cube, tmp_path):
    stl = cavity_stl(tmp_path, 0.0, np.array([10.0, 10.0, 10.0]))
    with refused("'cavity'", stl, "17.3 mm"):
        read_mesh(cube, cavities={"cavity": stl})
    moved = cavity_stl(tmp_path, np.array([-20.0, 10.0, 10.0]), np.array([-10.0, 20.0, 20.0]))
    with refused("'cavity'", moved, "30 mm", "(-x, y, z)"):
        read_mesh(cube, cavities={"cavity": moved})
    points, cells, _ = cases.hollow_cube()
    full = np.vstack([cells, [[21, 37, 41, 25, 22, 38, 42, 26]]])
    with refused("no STL", tmp_path / "missing.stl"):
        read_mesh(cube, cavities={"cavity": tmp_path / "missing.stl"})
    solid = tmp_path / "solid.vtk"
    solid.write_bytes(cases.vtk_legacy(points, [(12, full)]))
    with refused("'cavity'", "cavity.stl", "solid", "mesh_surfaces"):
        read_mesh(solid, cavities={"cavity": cavity_stl(tmp_path, 10.0, 20.0)})


def test_regions_by_box(cube):
    mesh = read_mesh(cube, regions={"base": InBox((-1, -1, -1), (1, 1, 10 * mm))})
    centers = mesh.points[mesh.cells[:, :4]].mean(axis=1)
    assert centers[mesh.regions["base"], 2].max() < 10 * mm < centers[mesh.regions["body"], 2].max()


def test_axes_are_turned(cube):
    file_axes = read_mesh(cube, faces={"low": plane(2, 0.0)})
    turned = read_mesh(cube, axes=("-x", "z", "y"), faces={"low": plane(1, 0.0)})
    assert box_of(turned, "low") == pytest.approx(np.array([[-30.0, 0, 0], [0, 0, 30]]))
    assert len(turned.faces["low"]) == len(file_axes.faces["low"])
    assert [f for f in turned.findings if "mirrored" in f.message] == []


def test_a_tiny_part_in_a_file_without_a_unit_is_told(cube, tmp_path):
    """A mesh in centimeters or inches, read in millimeters."""
    points, cells, _ = cases.hollow_cube()
    file = tmp_path / "tiny.vtk"
    file.write_bytes(cases.vtk_legacy(points / 10, [(12, cells)]))
    (told,) = [each for each in read_mesh(file).findings if each.code == "P09"]
    assert told.message == "'tiny.vtk' states no unit; read in mm, the part is only 3 mm long."
    assert told.advice.startswith("State its unit; in cm the part is 30 mm long, in inches 76.2 mm.")
    for sure in (read_mesh(file, unit="mm"), read_mesh(file, unit="cm"), read_mesh(cube)):
        assert not [each for each in sure.findings if each.code == "P09"]


@pytest.mark.parametrize(
    ("given", "facts"),
    [
        ({"unit": "mmm"}, ("unit", "'mmm'", "'mm'")),
        ({"unit": "m"}, ("cube.vtk", "30000 mm", "1 mm to 2000 mm", "'cm'")),
        ({"axes": ("x", "y", "y")}, ("('x', 'y', 'y')", "x, y and z")),
        ({"axes": ("-x", "y", "z")}, ("-x, y, z", "left-handed")),
        ({"faces": {"fixed": plane(0, 0.5)}}, ("face 'fixed'", "cube.vtk", "x 0 to 30, y 0 to 30, z 0 to 30 mm")),
        ({"faces": {"fixed": "left"}}, ("face", "'left'")),
        ({"regions": {"base": InBox((1, 0, 0), (2, 1, 1))}}, ("region 'base'", "x 0 to 30, y 0 to 30, z 0 to 30 mm")),
        ({"regions": {"base": WithNormal("-x")}}, ("WithNormal", "regions")),
        ({"regions": {"base": "lower"}}, ("region", "'lower'")),
    ],
)
def test_wishes_that_cannot_be_met(cube, given, facts):
    with refused(*facts):
        read_mesh(cube, **given)


def test_overlapping_sets_are_no_regions(tmp_path):
    points, cells, _ = cases.hollow_cube()
    lines = [*cases.inp_nodes(points), *cases.inp_cells("C3D8", cells, elset="everything")]
    lines += ["*ELSET, ELSET=a, GENERATE", "1, 10", "*ELSET, ELSET=b, GENERATE", "5, 12"]
    file = tmp_path / "sets.inp"
    file.write_text("\n".join(lines))
    mesh = read_mesh(file)
    assert list(mesh.regions) == ["body"]
    assert any("overlap, so they are not regions" in f.message for f in mesh.findings)
    chosen = read_mesh(file, regions={"base": ByName("a")})
    assert {name: len(rows) for name, rows in chosen.regions.items()} == {"base": 10, "body": 16}
