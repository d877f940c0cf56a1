"""One sector with cyclic faces stands for the whole of a part that is the same after each of n turns.

Tube: radii 10 and 15 mm, length 5 mm, neo-Hookean, under pressure inside and twisted along its axis, as a wedge of 60°;
both ends follow the exact solution at the pressure that belongs to it. Radius and angle of every particle are exact
(extension, inflation and torsion of an incompressible tube), pressure and torque by quadrature. The displacement
converges with the third power of the size.
Same mesh: the sector and its turned images, joined to one mesh, move as the sector does, to round-off: a closed tube
with skew fins that twists under pressure, its rotation prescribed, a plate with a moment, and a winding of one hand.
"""

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from netgen.occ import Cylinder, Pnt, X
from scipy.integrate import quad
from scipy.optimize import brentq
from turgor.cad import NearestTo, read_cad

import problems
import turgor as tg
import wedge_cases
from turgor.core.engine.chamber_volumes import Chambers
from turgor.core.engine.system import System
from turgor.core.materials.laws.laws import Hooke
from turgor.core.meshing.wedge import sectors
from turgor.core.model.fibers import Fibers, Winding
from turgor.core.model.loads import Moment
from turgor.core.model.points import ReferencePoint, Rotation
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.point_measures import of_point
from turgor.units import MPa, deg, kPa, mm

INNER, OUTER, LENGTH = 10 * mm, 15 * mm, 5 * mm
LAW = tg.laws.NeoHooke(C10=0.1 * MPa)
MU = 2 * LAW.C10
TWIST = 30.0  # rad/m
BORE = 20 * kPa


def pressure_inside(radius, twist):
    """Pressure at which the bore has a radius."""
    swollen = radius**2 - INNER**2

    def slope(r):
        rest = r**2 - swollen
        return MU * (r / rest + twist**2 * r - rest / r**3)

    return quad(slope, radius, np.sqrt(OUTER**2 + swollen))[0]


def bore_radius(share):
    """Radius of the bore at a share of the pressure and twist."""
    return brentq(lambda r: pressure_inside(r, share * TWIST) - share * BORE, 0.8 * INNER, 2 * INNER, xtol=1e-16)


def exact_motion(points, share):
    """Displacement of points of the tube at a share of the pressure and the twist."""
    swollen = bore_radius(share) ** 2 - INNER**2
    radius = np.hypot(points[:, 1], points[:, 2])
    angle = np.arctan2(points[:, 2], points[:, 1]) + share * TWIST * points[:, 0]
    now = np.sqrt(radius**2 + swollen)
    moved = np.stack([points[:, 0], now * np.cos(angle), now * np.sin(angle)], axis=1)
    return moved - points


@pytest.fixture(scope="module")
def ring(tmp_path_factory):
    shape = Cylinder(Pnt(0, 0, 0), X, r=15, h=5) - Cylinder(Pnt(0, 0, 0), X, r=10, h=5)
    path = wedge_cases.written(shape, tmp_path_factory.mktemp("ring") / "ring.step")
    names = wedge_cases.ENDS | {"bore": NearestTo((2.5 * mm, 10 * mm, 0))}
    return read_cad(path, faces=names, symmetry="wedge 6")


def twisted(ring, size):
    """Cell size, error of the displacement and of the torque of a tube whose ends follow the exact solution."""
    mesh = tg.mesh(ring, size=size)
    ends = [tg.supports.Displacement(face, exact_motion) for face in ("fixed", "tip")]
    model = problems.one_material(mesh, LAW, supports=ends, loads=[tg.Pressure("bore", BORE)])
    state = problems.solve(model).states[-1]
    moved = exact_motion(mesh.points, 1.0)
    error = np.linalg.norm(state.displacement - moved) / np.linalg.norm(moved)
    top = mesh.face_nodes("tip")
    place = (mesh.points + state.displacement)[top]
    torque = mesh.symmetry_factor * float(np.cross(place, state.nodal_force[top])[:, 0].sum())
    grown = bore_radius(1.0) ** 2 - INNER**2
    expected = pi / 2 * MU * TWIST * ((OUTER**2 + grown) ** 2 - (INNER**2 + grown) ** 2)
    return len(mesh.cells) ** (-1 / 3), error, abs(torque / expected - 1)


def test_a_twisted_tube_under_pressure_converges_to_the_exact_solution(ring, record_verification):
    (coarse, first, _), (fine, last, torque) = (twisted(ring, size) for size in (2.5 * mm, 0.8 * mm))
    rate = float(np.log(first / last) / np.log(coarse / fine))
    record_verification(
        claim="twisted tube under pressure, wedge of 60°: error of displacement, of torque; rate of the first",
        source="exact: extension, inflation and torsion",
        expected=[0.0, 0.0, 3.0],
        got=[last, torque, rate],
        tolerance="2e-5, 1e-6, 2.5 or more",
    )
    assert last < 2e-5
    assert torque < 1e-6
    assert rate > 2.5


@pytest.fixture(scope="module")
def fins(tmp_path_factory):
    path = wedge_cases.written(wedge_cases.finned(), tmp_path_factory.mktemp("fins") / "fins.step")
    return tg.mesh(read_cad(path, faces=wedge_cases.ENDS, symmetry="wedge"), size=4 * mm)


@pytest.fixture(scope="module")
def tube(tmp_path_factory):
    path = wedge_cases.written(wedge_cases.tube(), tmp_path_factory.mktemp("tube") / "tube.step")
    return tg.mesh(read_cad(path, faces=wedge_cases.ENDS, symmetry="wedge 5"), size=5 * mm)


def both(mesh, supports, loads, **more):
    """Last state of a sector and of the whole of its images, and the largest difference of their displacements."""
    whole = sectors(mesh)
    states = [
        problems.solve(replace_with(problems.one_material(each, LAW, supports=supports, loads=loads), more)).states[-1]
        for each in (mesh, whole.mesh)
    ]
    moved = whole.displacement(mesh.wedge, states[0].displacement)
    apart = float(np.abs(moved - states[1].displacement).max() / np.abs(moved).max())
    return [StateFields(each) for each in states], apart


def replace_with(model, more):
    return replace(model, **more) if more else model


def same(fields, *measures):
    """Largest relative difference of measures of a sector and of the whole."""
    values = np.array([[measure.function(each) for measure in measures] for each in fields])
    return float(np.abs(values[0] / values[1] - 1).max())


@pytest.mark.slow
def test_skew_fins_twist_a_tube_as_those_of_the_whole_do(fins, record_verification):
    fields, apart = both(fins, [tg.Fixed("fixed")], [tg.Pressure("cavity", 10 * kPa)])
    measured = [tg.measures.twist_angle.function(each) / deg for each in fields]
    record_verification(
        claim="tube with skew fins under pressure: twist of a wedge of 90° and of the whole of its images [°]",
        source="the same mesh",
        expected=measured[1],
        got=measured[0],
        tolerance="1e-7 of it; displacement and volume to 1e-8",
    )
    assert abs(measured[0]) > 0.1
    assert measured[0] == pytest.approx(measured[1], rel=1e-7)
    assert apart < 1e-8
    assert same(fields, tg.measures.cavity_volume, tg.measures.von_mises_p99) < 1e-8


def test_a_sector_that_reaches_its_axis_moves_as_the_whole(tube):
    supports = [tg.Fixed("fixed"), tg.supports.Displacement("tip", turned)]
    loads = [tg.Pressure("cavity", 5 * kPa)]
    fields, apart = both(tube, supports, loads)
    assert apart < 1e-9
    assert same(fields, tg.measures.twist_angle, tg.measures.cavity_volume, tg.measures.reaction) < 1e-8
    assert tg.measures.twist_angle.function(fields[0]) == pytest.approx(0.4, rel=1e-9)


def test_a_marker_in_any_sector_moves_as_on_the_whole(tube):
    supports = [tg.Fixed("fixed"), tg.supports.Displacement("tip", turned)]
    fields, _ = both(tube, supports, [tg.Pressure("cavity", 5 * kPa)])
    for angle in (10 * deg, 100 * deg, 200 * deg, 330 * deg):  # on the side, and 1 mm above the tip
        for x, radius in ((11.3 * mm, 8 * mm), (25 * mm, 5 * mm)):
            dot = (x, radius * np.cos(angle), radius * np.sin(angle))
            there, whole = ([each.function(at) for each in tg.measures.marker("dot", dot)] for at in fields)
            assert there == pytest.approx(whole, abs=2e-5 * mm)
            assert np.linalg.norm(np.array(there) - dot) > 1 * mm


def turned(points, share):
    """Displacement of points in a turn by 0.4 rad about x."""
    cosine, sine = np.cos(0.4 * share), np.sin(0.4 * share)
    turn = np.array([[1, 0, 0], [0, cosine, -sine], [0, sine, cosine]])
    return points @ turn.T - points


@pytest.mark.parametrize("coupling", ["rigid", "averaging"])
def test_a_plate_under_a_moment_turns_a_sector_as_the_whole(tube, coupling):
    plate = ReferencePoint("plate", "tip", coupling=coupling)
    loads = [Moment("plate", (0.02, 0.0, 0.0)), tg.loads.Force("plate", (0.5, 0.0, 0.0))]
    fields, apart = both(tube, [tg.Fixed("fixed"), plate], loads)
    assert apart < 1e-7
    assert same(fields, of_point("plate", "twist", "x"), of_point("plate", "displacement", "x")) < 1e-7
    assert abs(of_point("plate", "twist", "x").function(fields[0])) > 0.01


def test_a_prescribed_rotation_needs_the_moment_of_the_whole(tube):
    supports = [tg.Fixed("fixed"), ReferencePoint("plate", "tip"), Rotation("plate", 0.3, (1.0, 0.0, 0.0))]
    fields, apart = both(tube, supports, [tg.Pressure("cavity", 5 * kPa)])
    assert apart < 1e-8
    assert same(fields, of_point("plate", "reaction_moment", "x")) < 1e-7


def test_a_winding_of_one_hand_twists_a_sector_as_the_whole(tube):
    winding = Winding(angle_from_axis=60 * deg, spacing=2 * mm, hand="right")
    nylon = tg.Material(name="nylon", law=Hooke(E=100e6, nu=0.3))
    threads = Fibers(face="outside", material=nylon, diameter=0.2 * mm, winding=winding)
    fields, apart = both(tube, [tg.Fixed("fixed")], [tg.Pressure("cavity", 5 * kPa)], reinforcements=(threads,))
    assert apart < 1e-8
    assert same(fields, tg.measures.twist_angle) < 1e-7
    assert abs(tg.measures.twist_angle.function(fields[0])) > 0.5 * deg


def test_the_tangent_of_a_wedge_is_the_derivative_of_its_residual(tube):
    model = problems.one_material(tube, LAW, supports=[tg.Fixed("fixed")], loads=[tg.Pressure("cavity", 5 * kPa)])
    system = System(model)
    generator = np.random.default_rng(1)
    free = ~system.prescribed
    at, step = np.zeros(system.size), np.zeros(system.size)
    at[free], step[free] = 0.01 * generator.standard_normal(free.sum()), generator.standard_normal(free.sum())
    h = 1e-6
    difference = (system.residual(at + h * step, 1.0) - system.residual(at - h * step, 1.0)) / (2 * h)
    tangent = system.tangent(at, 1.0)
    assert np.abs((tangent @ step - difference)[free]).max() < 1e-7 * np.abs(difference[free]).max()
    assert system.terms.symmetric  # the cavity is closed by its images


def test_the_volume_of_a_cut_cavity_and_its_gradient(tube):
    model = problems.one_material(tube, LAW, supports=[tg.Fixed("fixed")])
    chambers = Chambers(System(model), ["cavity"])
    assert chambers.volumes(np.zeros(chambers.system.size))[0] * chambers.system.length**3 == pytest.approx(
        pi * (6 * mm) ** 2 * 20 * mm, rel=1e-3
    )
    generator = np.random.default_rng(2)
    free = ~chambers.system.prescribed
    at, step = np.zeros(chambers.system.size), np.zeros(chambers.system.size)
    at[free], step[free] = 0.1 * generator.standard_normal(free.sum()), generator.standard_normal(free.sum())
    h = 1e-5
    difference = (chambers.volumes(at + h * step) - chambers.volumes(at - h * step)) / (2 * h)
    assert chambers.gradients(at)[0] @ step == pytest.approx(difference[0], rel=1e-7)
