"""Discrete threads: where they lie, how they are cut, what they weigh in the equations, and what they refuse."""

from dataclasses import replace
from math import cos, pi

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.cells.reference import reference_nodes
from turgor.core.engine.fibers.fiber_trusses import discrete_threads
from turgor.core.engine.fibers.smeared import course_of, unit_axis
from turgor.core.engine.fibers.surface_unrolling import shape_values, unroll
from turgor.core.engine.fibers.tension import smooth_tension
from turgor.core.engine.fibers.truss_bending import bending_energy, bending_forces, bending_tangents, joints_of
from turgor.core.engine.system import System
from turgor.core.geometry.actuators.fiber_reinforced_cylinder import FiberReinforcedCylinder
from turgor.core.geometry.actuators.semicircular_bender import SemicircularBender
from turgor.core.materials.laws.laws import Hooke, NeoHooke
from turgor.core.meshing.generate import mesh
from turgor.core.model.fibers import Fibers, Winding
from turgor.core.results.fields.fibers import drawn_threads, fiber_results
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.measures import find_measure
from turgor.core.solvers.solution import State
from turgor.units import deg, kPa, mm

KEVLAR = tg.Material(name="kevlar", law=Hooke(E=31067e6, nu=0.36))
RUBBER = tg.Material(name="rubber", law=NeoHooke(C10=0.12e6))
LENGTH = 40 * mm
RADIUS = 8.35 * mm


def tube(cells="hexahedra", symmetric=False):
    return mesh(FiberReinforcedCylinder(length=LENGTH, symmetric=symmetric).build(), size=7 * mm, cells=cells)


def wound(face="outside", *, within=None, diameter=0.1778 * mm, **winding):
    winding = {"angle_from_circumference": 30 * deg, "spacing": 2 * mm} | winding
    return Fibers(
        face=face, material=KEVLAR, diameter=diameter, form="discrete", winding=Winding(**winding), within=within
    )


def model_of(mesh_, *fibers):
    return tg.Model(
        mesh_, dict.fromkeys(mesh_.regions, RUBBER), [tg.Fixed("fixed")], [tg.Pressure("cavity", 10 * kPa)],
        reinforcements=fibers,
    )  # fmt: skip


@pytest.mark.parametrize("nodes", [6, 8, 9])
def test_shape_values_belong_to_the_nodes(nodes):
    places = reference_nodes(9)[:8] if nodes == 8 else reference_nodes(nodes)
    values, slopes = shape_values(nodes, places)
    assert values == pytest.approx(np.eye(nodes), abs=1e-12)
    there, step = np.array([[0.3, 0.2]]), np.array([1e-6, 2e-6])
    change = shape_values(nodes, there + step)[0] - shape_values(nodes, there - step)[0]
    assert shape_values(nodes, there)[1][0] @ step == pytest.approx(change[0] / 2, abs=1e-12)
    assert slopes.sum(axis=1) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("cells", ["hexahedra", "tetrahedra"])
def test_development_of_a_tube_has_its_perimeter_and_finds_every_side(cells):
    body = tube(cells)
    face = unroll(body.points, body.face("outside"), np.array([1.0, 0, 0]), "outside")
    assert face.contour.closed
    assert face.contour.length == pytest.approx(2 * pi * RADIUS, rel=1e-4)
    generator = np.random.default_rng(1)
    share = generator.uniform(0.05, 0.95, (400, 2))
    points = np.c_[share[:, 0] * face.contour.length, share[:, 1] * LENGTH]
    side, place = face.find(points)
    assert (side >= 0).all()
    values, _ = shape_values(face.sides.shape[1], place)
    result = np.einsum("ka,kai->ki", values, body.points[face.sides[side]])
    around = points[:, 0] / RADIUS  # from the top, counterclockwise around x: towards −y
    exact = np.c_[points[:, 1], -RADIUS * np.sin(around), RADIUS * np.cos(around)]
    assert result == pytest.approx(exact, abs=0.02 * mm)
    outside = face.find(np.array([[1 * mm, -1 * mm], [1 * mm, LENGTH + 1 * mm]]))[0]
    assert (outside == -1).all()


@pytest.mark.parametrize("cells", ["hexahedra", "tetrahedra"])
@pytest.mark.parametrize("angle", [0, 30, 54.7356, 90])
def test_threads_have_the_length_of_exact_helices(cells, angle):
    body, fibers = tube(cells), wound(angle_from_circumference=angle * deg)
    threads = discrete_threads(body, fibers)
    turn = 2 * pi * RADIUS
    exact = turn if angle == 0 else LENGTH / np.sin(angle * deg)
    count = LENGTH / (2 * mm) if angle == 0 else turn * np.sin(angle * deg) / (2 * mm)
    assert threads.count == round(count)
    assert threads.lengths == pytest.approx(np.full(threads.count, exact), rel=2e-4)
    lines = threads.polylines(body.points)
    measured = [np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in lines]
    assert measured == pytest.approx(np.full(threads.count, exact), rel=0.01)  # chords of 20° are 0.5 % shorter
    radius = np.concatenate([np.hypot(line[:, 1], line[:, 2]) for line in lines])
    assert radius == pytest.approx(RADIUS, rel=1e-3)


@pytest.mark.parametrize("cells", ["hexahedra", "tetrahedra"])
def test_every_piece_lies_in_its_side_and_begins_where_the_last_one_ended(cells):
    body = tube(cells)
    threads = discrete_threads(body, wound())
    face = unroll(body.points, body.face("outside"), np.array([1.0, 0, 0]), "outside")
    corners = reference_nodes(face.sides.shape[1])
    low, high = corners.min(axis=0) - 1e-5, corners.max(axis=0) + 1e-5
    for values in (threads.begin, threads.end):
        place = values @ corners  # shape functions of these sides reproduce the reference coordinates
        assert ((place >= low) & (place <= high)).all()
        if corners.shape[0] == 6:
            assert (place.sum(axis=1) <= 1 + 1e-5).all()
        assert values.sum(axis=1) == pytest.approx(1)
    nodes = body.points[threads.pieces.sides]
    begin, end = (np.einsum("ka,kai->ki", values, nodes) for values in (threads.begin, threads.end))
    same = threads.thread[1:] == threads.thread[:-1]
    gap = np.linalg.norm(begin[1:] - end[:-1], axis=1)[same]
    assert gap.max() < 1e-3 * mm
    crossings = len(np.unique(threads.pieces.sides, axis=0))
    assert crossings == len(body.face("outside"))


def test_a_thread_turns_the_way_its_hand_says():
    body = tube()
    for hand, turn in (("right", 1), ("left", -1)):
        line = discrete_threads(body, wound(hand=hand, spacing=None, starts=1)).polylines(body.points)[0]
        assert (np.diff(line[:, 0]) > 0).all()
        angle = np.unwrap(np.arctan2(line[:, 2], line[:, 1]))
        assert (turn * np.diff(angle) > 0).all()
        assert abs(angle[-1] - angle[0]) == pytest.approx(LENGTH / np.tan(30 * deg) / RADIUS, rel=1e-3)


def test_turns_and_pitch_are_what_they_say():
    body = tube()
    for winding in ({"turns": 5.0}, {"pitch": 8 * mm}):
        threads = discrete_threads(body, wound(angle_from_circumference=None, spacing=None, starts=1, **winding))
        line = threads.polylines(body.points)[0]
        angle = np.unwrap(np.arctan2(line[:, 2], line[:, 1]))
        assert threads.count == 1
        assert (angle[-1] - angle[0]) / (2 * pi) == pytest.approx(5, rel=1e-3)


def test_a_quarter_has_a_quarter_of_the_threads():
    whole, quarter = tube(), tube(symmetric=True)
    for angle in (0, 40, 90):
        fibers = wound(angle_from_circumference=angle * deg, hand="both", starts=None)
        lengths = [discrete_threads(body, fibers).lengths.sum() for body in (whole, quarter)]
        assert 4 * lengths[1] == pytest.approx(lengths[0], rel=0.12)  # starts are rounded to an even number
    fibers = wound(hand="both", spacing=None, starts=12)
    lengths = [discrete_threads(body, fibers).lengths.sum() for body in (whole, quarter)]
    assert 4 * lengths[1] == pytest.approx(lengths[0], rel=1e-3)


@pytest.mark.parametrize("symmetric", [True, False])
def test_threads_go_around_a_half_disc_with_its_flat_bottom(symmetric):
    bender = SemicircularBender(length=30 * mm, symmetric=symmetric)
    body = mesh(bender.build(), size=5 * mm, cells="tetrahedra")
    threads = discrete_threads(body, wound(angle_from_circumference=0.0))
    low, high = body.points.min(axis=0), body.points.max(axis=0)
    half = high[1]
    straight = 2 * half + 2 * (high[2] - half - low[2])
    around = (pi * half + straight) / (2 if symmetric else 1)
    assert threads.lengths.sum() == pytest.approx(15 * around, rel=1e-3)
    points = np.concatenate(threads.polylines(body.points))
    assert (points[:, 2] < low[2] + 1e-9).any() and (points[:, 2] > high[2] - 0.01 * mm).any()


def test_two_windings_share_a_face_and_keep_to_their_sides():
    body = tube()
    up, down = ((-1.0, -1.0, 0.0), (1.0, 1.0, 1.0)), ((-1.0, -1.0, -1.0), (1.0, 1.0, 0.0))
    for within, sign in ((up, 1), (down, -1)):
        threads = discrete_threads(body, wound(within=within, hand="both"))
        points = np.concatenate(threads.polylines(body.points))
        assert (sign * points[:, 2]).min() > -0.05 * mm
        assert threads.lengths.sum() == pytest.approx(discrete_threads(body, wound()).lengths.sum(), rel=0.01)


def test_forces_balance_and_the_tangent_is_their_derivative():
    body = tube("tetrahedra")
    slack = tg.Model(body, {"body": RUBBER}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 1.0)])
    systems = [System(slack), System(model_of(body, wound()))]
    generator = np.random.default_rng(2)
    x = np.zeros(systems[0].size)
    stretched = np.c_[body.points[:, 0] * 0.1, 0.2 * body.points[:, 1:]] / systems[0].length
    x[: stretched.size] = stretched.ravel() + 1e-3 * generator.standard_normal(stretched.size)
    plain, threaded = (system.residual(x, 0.0) for system in systems)
    force = (threaded - plain)[: stretched.size].reshape(-1, 3)
    position = body.points / systems[0].length + x[: stretched.size].reshape(-1, 3)
    size = np.abs(force).sum()
    assert size > 1
    assert np.abs(force.sum(axis=0)).max() < 1e-11 * size
    assert np.abs(np.cross(position, force).sum(axis=0)).max() < 1e-10 * size
    direction = np.zeros_like(x)
    direction[: stretched.size] = generator.standard_normal(stretched.size)
    step = 1e-6
    change = (systems[1].residual(x + step * direction, 0.0) - systems[1].residual(x - step * direction, 0.0)) / (
        2 * step
    )
    product = systems[1].tangent(x, 0.0) @ direction
    assert np.linalg.norm(product - change) < 1e-5 * np.linalg.norm(change)


@pytest.mark.parametrize("cells", ["hexahedra", "tetrahedra"])
def test_bending_has_the_energy_of_a_beam_and_its_tangent_is_the_derivative_of_its_forces(cells):
    body = tube(cells)
    modulus, diameter = 31067e6, 0.1778 * mm
    fibers = wound(angle_from_circumference=0.0)
    beam = replace(fibers, bending=True, bending_diameter=1.0)
    joints = joints_of(discrete_threads(body, beam), beam, body.points)
    assert bending_energy(joints, body.points) == 0
    turn = np.array([[0.0, 0, 1], [1, 0, 0], [0, 1, 0]])
    assert bending_energy(joints, body.points @ turn.T) == pytest.approx(0, abs=1e-20)
    wide = body.points * np.array([1, 1.1, 1.1])
    flat = body.points * np.array([1, 1.0, 0.7])
    # a hoop that widens turns by the same angle: its curvature per initial length stays
    assert bending_energy(joints, wide) == pytest.approx(0, abs=1e-20)
    share = np.linspace(0, 2 * pi, 20001)
    slope = np.gradient(np.unwrap(np.arctan2(0.7 * np.cos(share), -np.sin(share))), share)
    exact = 20 * 0.5 * modulus * pi * diameter**4 / 64 * np.trapezoid((slope - 1) ** 2, share) / RADIUS
    assert bending_energy(joints, flat) == pytest.approx(exact, rel=0.15)  # 20 chords around
    generator = np.random.default_rng(3)
    x = flat + 0.01 * mm * generator.standard_normal(flat.shape)
    move, step = generator.standard_normal(flat.shape), 1e-8
    force = bending_forces(joints, x)
    change = (bending_energy(joints, x + step * move) - bending_energy(joints, x - step * move)) / (2 * step)
    assert (force * move[joints.nodes]).sum() == pytest.approx(change, rel=1e-6)
    both = bending_forces(joints, x + step * move) - bending_forces(joints, x - step * move)
    product = bending_tangents(joints, x) @ move[joints.nodes].reshape(len(joints.nodes), -1, 1)
    difference = both.reshape(product.shape) / (2 * step) - product
    assert np.linalg.norm(difference) < 1e-5 * np.linalg.norm(product)


def test_the_tangent_of_a_model_with_bent_threads_is_the_derivative_of_its_residual():
    body = tube()
    # rods so thick that bending counts as much as all the rest
    system = System(model_of(body, replace(wound(diameter=1.5 * mm), bending=True, bending_diameter=1.0)))
    generator = np.random.default_rng(4)
    count = 3 * len(body.points)
    x, direction = np.zeros(system.size), np.zeros(system.size)
    stretched = np.c_[body.points[:, 0] * 0.1, 0.2 * body.points[:, 1], 0.1 * body.points[:, 2]] / system.length
    x[:count] = stretched.ravel() + 1e-3 * generator.standard_normal(count)
    direction[:count] = generator.standard_normal(count)
    step = 1e-6
    change = (system.residual(x + step * direction, 0.0) - system.residual(x - step * direction, 0.0)) / (2 * step)
    product = system.tangent(x, 0.0) @ direction
    assert np.linalg.norm(product - change) < 1e-6 * np.linalg.norm(change)


def test_tension_of_a_stretched_tube_is_exact():
    body = tube(symmetric=True)
    model = model_of(body, wound(hand="both"))
    displacement = body.points * np.array([0.05, 0.02, 0.02])
    state = State(
        model=model, load_factor=1.0, displacement=displacement, mean_stress=np.zeros(body.vertex_count),
        nodal_force=np.zeros_like(displacement),
    )  # fmt: skip
    result = fiber_results(state)[0]
    stretch = np.hypot(1.05 * cos(60 * deg), 1.02 * cos(30 * deg))
    assert result.stretch == pytest.approx(np.full(len(result.stretch), stretch), abs=4e-4)  # chords are a bit steeper
    assert result.maximum_tension == pytest.approx(
        model.reinforcements[0].stretching_stiffness * (stretch - 1), rel=0.02
    )
    assert find_measure("maximum_fiber_tension")(state) == result.maximum_tension
    lines = drawn_threads(StateFields(state))
    assert len(lines) == 4 * result.threads.count
    assert max(line[:, 0].max() for line in lines) == pytest.approx(1.05 * LENGTH, rel=1e-4)


def test_tensions_are_averaged_around_each_piece_and_by_hand():
    pieces = discrete_threads(tube(), wound(hand="both")).pieces
    assert set(pieces.hand) == {0, 1}
    by_hand = 1.0 + pieces.hand
    assert smooth_tension(pieces, by_hand) == pytest.approx(by_hand)
    noise = np.random.default_rng(2).normal(1.0, 0.5, len(pieces.weights))
    assert smooth_tension(pieces, noise).std() < 0.5 * noise.std()
    assert np.average(smooth_tension(pieces, noise), weights=pieces.weights) == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize(
    ("winding", "facts"),
    [
        ({"spacing": 0.1 * mm}, ("outside", "0.1778 mm")),
        ({"angle_from_circumference": None, "pitch": 0.1 * mm, "spacing": None, "starts": 1}, ("0.1 mm", "0.1778 mm")),
        ({"axis": (0.0, 0.0, 1.0)}, ("outside", "axis (0.0, 0.0, 1.0)")),
        ({"within": ((1.0, 1.0, 1.0), (2.0, 2.0, 2.0))}, ("outside", "(1000, 1000, 1000) to (2000, 2000, 2000) mm")),
        ({"angle_from_circumference": 1 * deg, "spacing": 5 * mm}, ("outside", "5 mm", "52.46 mm", "starts")),
    ],
)
def test_windings_that_do_not_fit_are_refused(winding, facts):
    with refused(*facts):
        discrete_threads(tube(), wound(**winding))


def test_faces_and_mirror_planes_that_do_not_fit_are_refused():
    body, quarter = tube(), tube(symmetric=True)
    with refused("outsid", "outside"):
        model_of(body, wound("outsid"))
    with refused("tip", "axis (1.0, 0.0, 0.0)"):
        discrete_threads(body, wound("tip"))
    with refused("outside", "symmetry_y", "symmetric"):
        discrete_threads(quarter, wound())
    with refused("quarter", "starts", 3):
        discrete_threads(quarter, wound(hand="both", spacing=None, starts=3))
    with refused("starts", 0.4, "at least 1"):
        Winding(angle_from_axis=60 * deg, starts=0.4)  # type: ignore[arg-type]
    with refused("within", "((1.0, 0.0, 0.0), (0.0, 1.0, 1.0))"):
        wound(within=((1.0, 0.0, 0.0), (0.0, 1.0, 1.0)))


def test_course_counts_copies():
    fibers = wound(hand="both")
    assert [course_of(tube(symmetric=s), fibers).copies for s in (False, True)] == [1, 4]
    assert unit_axis(fibers.winding) == pytest.approx([1, 0, 0])
