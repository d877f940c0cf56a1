"""CAD files are read with their unit; what is wrong with one is said with what to do."""

import cad_cases as cases
import numpy as np
import pytest
from netgen.occ import Box, Compound, Glue, Pnt

import turgor as tg
from refused import refused
from turgor.core.geometry.cad.facets import find_facets
from turgor.core.geometry.cad.files import load_file
from turgor.core.geometry.cad.read import read_here as read_cad
from turgor.core.geometry.cad.stl import read_stl
from turgor.core.geometry.cad.surface.crossing import crossings
from turgor.core.meshing.exchange.surface_filling import mesh_surfaces
from turgor.units import mm


def hollow_box():
    return Box(Pnt(0, 0, 0), Pnt(20, 10, 10)) - Box(Pnt(2, 2, 2), Pnt(18, 8, 8))


def triangles_of(shape):
    return find_facets(shape, list(dict.fromkeys(shape.faces))).corners()


def refused_part(path, *facts, **options):
    with refused(*facts):
        read_cad(path, **options)


def in_meters(path):
    """The same numbers, but as meters, as happens when a program exports without asking."""
    text = path.read_text(encoding="ascii")
    assert "SI_UNIT(.MILLI.,.METRE.)" in text
    other = path.with_name("meters.step")
    other.write_text(text.replace("SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT($,.METRE.)"), encoding="ascii")
    return other


def in_inches(path):
    """The same numbers as inches, stated as such."""
    text = path.read_text(encoding="ascii")
    number = next(line for line in text.splitlines() if "SI_UNIT(.MILLI.,.METRE.)" in line).split(" = ")[0]
    inch = (
        f"{number} = ( CONVERSION_BASED_UNIT('INCH',#90001) LENGTH_UNIT() NAMED_UNIT(#90003) );\n"
        "#90001 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#90002);\n"
        "#90002 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );\n"
        "#90003 = DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);"
    )
    lines = [inch if line.startswith(f"{number} = ") else line for line in text.splitlines()]
    other = path.with_name("inches.step")
    other.write_text("\n".join(lines), encoding="ascii")
    return other


@pytest.mark.parametrize("name", ["part.step", "part.STP", "part.brep"])
def test_every_kind_gives_the_same_part(name, tmp_path):
    path = cases.written(tmp_path, hollow_box(), name.lower()).rename(tmp_path / name)
    part = read_cad(path)
    assert part.solid_volume / mm**3 == pytest.approx(2000 - 16 * 36, rel=1e-12)
    assert part.cavity_volume / mm**3 == pytest.approx(16 * 36, rel=1e-9)
    assert part.regions == ("body",)
    assert part.smallest_wall / mm == pytest.approx(2, rel=1e-6)


def test_a_file_in_inches_is_25_times_larger_and_a_given_unit_wins(tmp_path):
    path = in_inches(cases.written(tmp_path, hollow_box()))
    assert load_file(path).unit == "in, from the file"
    assert read_cad(path).cavity_volume / mm**3 == pytest.approx(16 * 36 * 25.4**3, rel=1e-9)
    assert read_cad(path, unit="mm").cavity_volume / mm**3 == pytest.approx(16 * 36, rel=1e-9)
    assert load_file(path, "mm").unit == "mm, as given"


def test_names_survive_another_unit(tmp_path):
    shape = cases.FINGER.build().shape
    path = in_meters(cases.written(tmp_path, shape))
    part = read_cad(path, unit="mm")
    assert part.faces == ("cavity", "fixed", "outside", "strain_limiting_layer", "tip")
    assert part.regions == ("body", "base")
    assert part.cavity_volume == pytest.approx(cases.FINGER.cavity_volume, rel=1e-9)


def test_a_finger_of_38_m_is_refused_with_the_unit_that_would_fit(tmp_path):
    path = in_meters(cases.written(tmp_path, cases.finger()))
    refused_part(path, "meters.step", "3.8e+04 x 2e+04 x 1.5e+04 mm", "1 mm to 2000 mm", "unit='mm'", "38 mm")
    assert read_cad(path, unit="mm").cavity_volume == pytest.approx(cases.FINGER.cavity_volume, rel=1e-9)
    refused_part(path, "'furlong'", "m, cm, mm", unit="furlong")


@pytest.mark.parametrize(
    ("name", "content", "facts"),
    [
        ("part.step", None, ("no file",)),
        ("part.stl", b"no stl", ("STL", "solid")),
        ("part.stl", b"\0" * 80 + (7).to_bytes(4, "little") + b"\0" * 50, ("STL", "solid")),
        ("part.step", b"", ("''", "ISO-10303-21")),
        ("part.step", b"solid part", ("'solid part'", "ISO-10303-21")),
        ("part.step", b"ISO-10303-21;\nHEADER;\nrubbish", ("damaged",)),
        ("part.brep", b"DBRep_DrawableShape\nrubbish", ("damaged",)),
        ("part.sldprt", b"", (".step, .stp, .brep, .brp, .stl",)),
    ],
)
def test_a_missing_or_damaged_file_is_refused(name, content, facts, tmp_path, capfd):
    if content is not None:
        (tmp_path / name).write_bytes(content)
    refused_part(tmp_path / name, name, *facts)
    assert capfd.readouterr() == ("", "")


FLAT = np.tile(np.array([[0, 0, 0], [10, 0, 0], [10, 0, 0.0]]), (4, 1, 1))
TWICE = np.array([[[0, 0, 0], [10, 0, 0], [0, 10, 0]], [[0, 0, 0], [0, 10, 0], [10, 0, 0.0]]])


@pytest.mark.parametrize(
    ("triangles", "fact"),
    [(FLAT, "are flat"), (TWICE, "each other")],
)
def test_triangles_without_a_body_are_refused(triangles, fact, tmp_path):
    path = cases.write_stl(tmp_path / "flat.stl", triangles)
    refused_part(path, "flat.stl", "body", "triangles", fact)


def test_a_surface_file_without_a_surface_is_refused(tmp_path):
    with refused("flat.stl", "surface", "triangles"):
        mesh_surfaces(cases.write_stl(tmp_path / "flat.stl", FLAT))


def test_a_misspelled_file_gets_a_near_match(tmp_path):
    cases.written(tmp_path, hollow_box(), "finger.step")
    refused_part(tmp_path / "finge.step", "finge.step", "finger.step")


def test_half_a_step_file_is_damaged(tmp_path):
    path = cases.written(tmp_path, hollow_box())
    text = path.read_text(encoding="ascii")
    path.write_text(text[: len(text) // 2], encoding="ascii")
    refused_part(path, path, "damaged")


def test_surfaces_are_no_solid(tmp_path):
    path = cases.written(tmp_path, Glue(list(hollow_box().faces)[:5]))
    refused_part(path, path, "solid", "5 faces")


def test_bodies_that_overlap_or_leave_a_gap_are_refused(tmp_path):
    cup, plate = cases.cup_and_plate(gap=0.1)
    refused_part(cases.written(tmp_path, Compound([cup, plate])), "'body_", "0.1 mm", "leak")
    thick = Box(Pnt(0, 0, 0), Pnt(40, 20, 3))
    refused_part(cases.written(tmp_path, Compound([cup, thick])), "(body_1, body_2)", "overlap")
    within = [Box(Pnt(0, 0, 0), Pnt(10, 10, 10)), Box(Pnt(2, 2, 2), Pnt(5, 5, 5))]
    refused_part(cases.written(tmp_path, Compound(within)), "overlap", "27 mm³")


@pytest.mark.parametrize("text", [False, True])
def test_a_closed_stl_becomes_a_body_with_plane_walls(text, tmp_path):
    path = cases.write_stl(tmp_path / "part.stl", triangles_of(hollow_box()), text)
    part = read_cad(path)
    assert part.solid_volume / mm**3 == pytest.approx(2000 - 16 * 36, rel=1e-6)
    assert part.cavity_volume / mm**3 == pytest.approx(16 * 36, rel=1e-6)
    assert len(part.shape.faces) == 12
    mesh = tg.mesh(part, size=6 * mm)
    assert set(mesh.faces) == {"cavity", "outside"}
    # triangles that turn the other way are the same part
    turned = cases.write_stl(tmp_path / "turned.stl", triangles_of(hollow_box())[:, ::-1], text)
    assert read_cad(turned).cavity_volume == pytest.approx(part.cavity_volume, rel=1e-6)


def test_a_tiny_stl_has_its_unit_in_doubt(tmp_path):
    path = cases.write_stl(tmp_path / "part.stl", triangles_of(hollow_box()) / 5, False)
    codes = [[each.code for each in load_file(path, unit).findings] for unit in (None, "mm")]
    assert codes == [["P09"], []]


def test_an_open_stl_is_closed_and_tells_where(tmp_path):
    triangles = triangles_of(hollow_box())
    part = read_cad(cases.write_stl(tmp_path / "part.stl", triangles[1:]))
    assert part.solid_volume / mm**3 == pytest.approx(2000 - 16 * 36, rel=1e-6)
    (result,) = [finding for finding in part.findings if finding.code == "D06"]
    assert "1 hole closed, around (" in result.message


def test_bodies_that_cut_through_each_other_are_united(tmp_path):
    triangles = triangles_of(Box(Pnt(0, 0, 0), Pnt(10, 10, 10)))
    both = np.concatenate([triangles, triangles + [5.3, 4.1, 3.7]])
    part = read_cad(cases.write_stl(tmp_path / "part.stl", both))
    assert part.solid_volume / mm**3 == pytest.approx(2000 - 4.7 * 5.9 * 6.3, rel=1e-5)
    apart = np.concatenate([triangles, triangles + [25.3, 4.1, 3.7]])
    refused_part(cases.write_stl(tmp_path / "part.stl", apart), "part.stl", "not joined")


def test_an_stl_of_impossible_fineness_is_refused(tmp_path):
    path = cases.write_stl(tmp_path / "part.stl", np.random.default_rng(1).random((400_001, 3, 3)))
    refused_part(path, path, "400001 triangles", "at most 400000")
    assert len(read_stl(path)) == 400_001


def test_crossings_finds_a_needle_through_a_triangle_and_nothing_beside_it():
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.2, 0.2, -1], [0.2, 0.2, 1], [0.25, 0.3, 1.0]])
    triangles = np.array([[0, 1, 2], [3, 4, 5]])
    assert crossings(points, triangles).tolist() == [[0, 1]] or crossings(points, triangles).tolist() == [[1, 0]]
    points[3:] += [1, 1, 0]
    assert len(crossings(points, triangles)) == 0
