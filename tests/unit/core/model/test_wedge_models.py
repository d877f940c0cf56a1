"""Models of a wedge: what breaks the symmetry is refused, and walls that meet those of the next sector are said."""

from types import SimpleNamespace

import numpy as np
import pytest
from turgor.loads import Force, Gravity, Moment, PointForce, Pressure, Traction

import turgor as tg
import wedge_cases
from refused import refused
from turgor.core.geometry.cad.read import read_here
from turgor.core.geometry.cad.symmetry import sector
from turgor.core.geometry.cad.symmetry.requested import RequestedSymmetry
from turgor.core.materials.laws.laws import Hooke
from turgor.core.meshing.bodies.combine import together
from turgor.core.meshing.bodies.placing import placed
from turgor.core.model.fibers import Fibers, Winding
from turgor.core.model.obstacles import Obstacle, Plane, Sphere
from turgor.core.model.points import ReferencePoint
from turgor.core.model.supports import Displacement, Fixed, PlaneSection, Shift
from turgor.core.solvers.checks.contact import meeting_walls
from turgor.core.solvers.checks.supports import check_supports
from turgor.units import deg, kPa, mm

RUBBER = tg.Material(law=tg.laws.NeoHooke(C10=0.1e6), name="rubber", density=1000.0)


def read(shape, path, asked):
    wedge_cases.written(shape, path)
    return read_here(path, faces=wedge_cases.ENDS, symmetry=RequestedSymmetry(asked))


@pytest.fixture(scope="module")
def sixth(tmp_path_factory):
    path = tmp_path_factory.mktemp("tube") / "tube.step"
    return tg.mesh(read(wedge_cases.tube(), path, "wedge"), size=6 * mm)


FIXED = Fixed("fixed")


def model(mesh, supports=(FIXED,), loads=(), obstacles=(), **more):
    contact = tg.Contact(self_contact=False, obstacles=list(obstacles))
    return tg.Model(mesh, {"body": RUBBER}, supports, loads, contact=contact, **more)


@pytest.mark.parametrize(
    ("load", "facts"),
    [
        (Gravity((0, 0, -1)), ("gravity", "-1 along z", "axis x", "60°")),
        (Force("tip", (0.0, 1.0, 0.0)), ("force on 'tip'", "1 N along y", "axis x", "60°")),
        (Traction("tip", (0.0, 0.0, 1.0)), ("traction on 'tip'", "1 Pa along z", "axis x", "60°")),
        (PointForce((0.0, 8 * mm, 0.0), (1.0, 0.0, 0.0)), ("point force", "once", "every sector")),
        (Pressure("cyclic_low", 1.0), ("Pressure", "'cyclic_low'")),
    ],
)
def test_loads_that_differ_from_sector_to_sector_are_refused(sixth, load, facts):
    with refused(*facts):
        model(sixth, loads=[load])


def test_a_shell_that_the_wedge_cuts_is_refused(sixth):
    film = tg.Material(name="film", law=tg.laws.Hooke(E=1e9, nu=0.3))
    materials = {"body": RUBBER, "outside": tg.Shell(film, 0.1 * mm)}
    with refused("shell", "'outside'", "wedge"):
        tg.Model(sixth, materials, [FIXED], [])
    tg.Model(sixth, {**materials, "outside": tg.Membrane(film, 0.1 * mm)}, [FIXED], [])


def test_a_moment_across_the_axis_is_refused(sixth):
    with refused("moment on 'plate'", "1 N m along y", "axis x", "60°"):
        model(sixth, [Fixed("fixed"), ReferencePoint("plate", "tip")], [Moment("plate", (0.0, 1.0, 0.0))])


@pytest.mark.parametrize(
    ("support", "facts"),
    [
        (Fixed("tip", "y"), ("y or z", "about x")),
        (Displacement("tip", Shift((0.0, 1 * mm, 0.0))), ("Displacement of 'tip'", "about x by 1/6")),
        (ReferencePoint("plate", "tip", at=(24 * mm, 1 * mm, 0.0)), ("'plate'", "1 mm along y", "wedge", "0 mm")),
    ],
)
def test_supports_that_differ_are_refused(sixth, support, facts):
    with refused(*facts):
        check_supports(model(sixth, [Fixed("fixed"), support]))


def test_what_keeps_the_symmetry_is_taken(sixth):
    check_supports(model(sixth, [Fixed("fixed"), PlaneSection("tip")], [Gravity((1, 0, 0)), Force("tip", (1.0, 0, 0))]))


def test_what_holds_no_turn_about_the_axis_is_not_enough(sixth):
    with refused("1 of 6", "B01"):
        check_supports(model(sixth, [Fixed("fixed", "x")]))


def test_obstacles_stand_on_the_axis(sixth):
    wall = Plane(point=(30 * mm, 0, 0), normal=(-1, 0, 0))
    model(sixth, obstacles=[Obstacle(name="wall", shape=wall)])
    model(sixth, obstacles=[Obstacle(name="ball", shape=Sphere(center=(40 * mm, 0, 0), radius=5 * mm))])
    floor = Plane(point=(0, 0, -9 * mm), normal=(0, 0, 1))
    with refused("obstacle 'floor'", "60°", "axis x"):
        model(sixth, obstacles=[Obstacle(name="floor", shape=floor)])


def test_single_threads_are_refused(sixth):
    winding = Winding(angle_from_axis=60 * deg, spacing=2 * mm, hand="right")
    nylon = tg.Material(name="nylon", law=Hooke(E=1e9, nu=0.3))
    threads = Fibers(face="outside", material=nylon, diameter=0.2 * mm, winding=winding, form="discrete")
    with refused("'outside'", "single threads", "wedge"):
        model(sixth, loads=[Pressure("cavity", 1 * kPa)], reinforcements=[threads])


def test_walls_that_meet_the_next_sector_are_said(tmp_path, monkeypatch):
    monkeypatch.setattr(sector, "cut_angle", lambda part, wedge: wedge.angle / 2)  # between two fins, not through one
    geometry = read(wedge_cases.finned(12, angle=0.0), tmp_path / "fins.step", "wedge 12")
    mesh = tg.mesh(geometry, size=4 * mm)
    middle = mesh.points[:, 1:].mean(axis=0)
    aside = np.array([0.0, -middle[1], middle[0]]) / np.hypot(*middle)
    wider = np.outer(mesh.points @ aside, aside)  # fins as thick as the room between them and more
    factors = (0.0, 0.25, 0.5, 0.75, 1.0)
    states = [SimpleNamespace(load_factor=s, displacement=2.0 * s * wider, pressures={}) for s in factors]
    findings = meeting_walls(model(mesh), states)
    assert [each.code for each in findings] == ["B02"]
    assert "met those of the next sector of the wedge at load factor 0." in findings[0].message
    assert meeting_walls(model(mesh), states[:1]) == ()


def test_a_sector_is_not_moved_or_combined(sixth):
    with refused("'tube'", "1/6 about x"):
        placed(sixth, shift=(1 * mm, 0, 0))
    with refused("'tube'", "1/6 about x"):
        together({"one": sixth, "two": sixth})
