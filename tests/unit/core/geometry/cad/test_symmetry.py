"""Mirror planes and rotations of CAD parts are found, and a half or quarter is the part of the whole."""

import numpy as np
import pytest
from netgen.occ import Axes, Axis, Box, Cylinder, Dir, Glue, Pnt, WorkPlane, X
from turgor.cad import NearestTo, WithNormal, read_cad

import turgor as tg
from refused import refused
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.cad.naming import name_faces
from turgor.core.geometry.cad.part import load_part
from turgor.core.geometry.cad.symmetry.find import find_symmetry
from turgor.units import mm

pytestmark = pytest.mark.usefixtures("read_here")

ENDS = {"fixed": WithNormal("-x"), "tip": WithNormal("+x")}


def tube():
    """A closed tube along x."""
    return Cylinder(Pnt(0, 0, 0), X, r=8, h=40) - Cylinder(Pnt(3, 0, 0), X, r=6, h=34)


def hexagon():
    """A block with six round chambers around x."""
    body = Cylinder(Pnt(0, 0, 0), X, r=12, h=30)
    chamber = Cylinder(Pnt(2, 8, 0), X, r=2, h=26)
    for turn in range(6):
        body = body - chamber.Rotate(Axis(Pnt(0, 0, 0), X), 60 * turn)
    return body


def oval():
    """A rod whose section is an ellipse."""
    plane = WorkPlane(Axes(Pnt(0, 0, 0), n=Dir(1, 0, 0), h=Dir(0, 1, 0)))
    return plane.Ellipse(8, 6).Face().Extrude(30)


def lopsided():
    """A box with a chamber that is off the middle in y only."""
    return Box(Pnt(0, -5, -5), Pnt(30, 5, 5)) - Box(Pnt(3, -3, -3), Pnt(27, 4, 3))


def found(shape, path, **names):
    shape.WriteStep(str(path))
    part = load_part(path)
    return find_symmetry(part, name_faces(part, names, None).names)


@pytest.mark.parametrize(
    ("make", "mirrors", "fold", "axis"),
    [(tube, "xyz", 0, "x"), (hexagon, "xyz", 6, "x"), (oval, "xyz", 2, "x"), (lopsided, "xz", 2, "y")],
)
def test_mirror_planes_and_rotations_are_found(make, mirrors, fold, axis, tmp_path):
    symmetry = found(make(), tmp_path / "part.step")
    assert "".join(plane.normal for plane in symmetry.mirrors) == mirrors
    assert symmetry.fold == fold
    assert symmetry.axis == axis


def test_the_position_of_a_plane_is_that_of_the_part(tmp_path):
    symmetry = found(Box(Pnt(0, 2, 3), Pnt(10, 8, 11)), tmp_path / "box.step")
    assert [plane.position for plane in symmetry.mirrors] == pytest.approx([5, 5, 7])


def test_a_body_on_one_side_breaks_the_symmetry(tmp_path):
    left, right = Box(Pnt(0, -5, 0), Pnt(30, 0, 5)), Box(Pnt(0, 0, 0), Pnt(30, 5, 5))
    left.name, right.name = "soft", "hard"
    assert "y" not in [plane.normal for plane in found(Glue([left, right]), tmp_path / "two.step").mirrors]


def test_a_quarter_is_a_quarter(tmp_path):
    path = tmp_path / "tube.step"
    tube().WriteStep(str(path))
    whole, quarter = read_cad(path, faces=ENDS), read_cad(path, faces=ENDS, symmetry="automatic")
    assert quarter.faces == ("cavity", "fixed", "outside", "symmetry_y", "symmetry_z", "tip")
    assert quarter.solid_volume == pytest.approx(whole.solid_volume / 4, rel=1e-9)
    assert quarter.cavity_volume == pytest.approx(whole.cavity_volume / 4, rel=1e-9)
    assert quarter.findings[-1].code == "D07"
    mesh = tg.mesh(quarter, size=4 * mm)
    assert mesh.symmetry_factor == 4
    assert np.min(mesh.points[:, 1:]) > -1e-9


@pytest.mark.slow
def test_names_stay_and_halves_solve_alike(tmp_path):
    path = tmp_path / "finger.step"
    FastPneuNet(chambers=2, length=20e-3, symmetric=False).build().shape.WriteStep(str(path))
    grip = {"grip": WithNormal("+z")}
    whole, half = (read_cad(path, faces=grip, symmetry=each) for each in ("none", "automatic"))
    assert set(half.faces) - set(whole.faces) == {"symmetry_y"}
    assert half.cavity_volume == pytest.approx(whole.cavity_volume / 2, rel=1e-9)
    angles = [bending(tg.mesh(part, size=4 * mm)) for part in (whole, half)]
    assert angles[1] == pytest.approx(angles[0], rel=0.03)  # two meshes of one size


def bending(mesh):
    rubber = tg.Material(law=tg.laws.NeoHooke(C10=0.1e6), name="rubber")
    loads = [tg.loads.Pressure("cavity", 2e3)]
    model = tg.Model(
        mesh=mesh,
        materials={"body": rubber, "base": rubber},
        supports=[tg.supports.Fixed("fixed")],
        loads=loads,
        contact=tg.Contact(self_contact=False),
    )
    return tg.measure(tg.solve(model), tg.measures.bending_angle).find("bending_angle").values[-1]


def test_cavities_with_names_of_their_own_keep_a_plane_from_use(tmp_path):
    path = tmp_path / "pair.step"
    body = Box(Pnt(0, -10, 0), Pnt(30, 10, 8))
    body = body - Box(Pnt(3, -8, 2), Pnt(27, -2, 6)) - Box(Pnt(3, 2, 2), Pnt(27, 8, 6))
    body.WriteStep(str(path))
    part = read_cad(path, symmetry="automatic")
    assert "symmetry_y" not in part.faces
    assert "it maps 'cavity_1' onto 'cavity_2'" in part.findings[-1].message
    both = {"cavity": NearestTo((15 * mm, -2 * mm, 4 * mm))}
    with refused("across y", "cavity", "outside"):
        read_cad(path, symmetry="y", faces=both)


@pytest.mark.parametrize(
    ("asked", "facts"),
    [
        ("y", ("part.step", "across y", "x, z")),
        ("half", ("'half'", "none", "automatic", "wedge")),
        ("yy", ("'yy'", "none", "automatic", "wedge")),
    ],
)
def test_a_plane_that_is_none_is_refused(asked, facts, tmp_path):
    path = tmp_path / "part.step"
    lopsided().WriteStep(str(path))
    with refused(*facts):
        read_cad(path, symmetry=asked)
