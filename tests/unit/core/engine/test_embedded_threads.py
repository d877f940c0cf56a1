"""Threads embedded in cells: where they lie, what they weigh in the equations, and what they refuse."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.fibers.fiber_trusses import discrete_threads
from turgor.core.engine.system import System
from turgor.core.geometry.actuators.fiber_reinforced_cylinder import FiberReinforcedCylinder
from turgor.core.materials.laws.laws import Hooke, NeoHooke
from turgor.core.meshing.generate import mesh
from turgor.units import MPa, mm

STEEL = tg.Material(name="steel", law=Hooke(E=2000 * MPa, nu=0.3))
RUBBER = tg.Material(name="rubber", law=NeoHooke(C10=0.2 * MPa), bulk_modulus=2 * MPa)
TILTED = [[(-9 * mm, -4 * mm, 1 * mm), (0, 0, 0), (10 * mm, 3 * mm, 2 * mm)]]


def block(cells="hexahedra", mirrors=""):
    solid = tg.bodies.Block(length=20 * mm, width=10 * mm, height=10 * mm, mirrors=mirrors)
    return mesh(solid.build(), size=10 * mm, cells=cells)


def rods(through, diameter=1 * mm, **values):
    values = {"compression": 1.0, "form": "discrete", "winding": tg.bodies.EmbeddedThreads(through=through)} | values
    return tg.Fibers(material=STEEL, diameter=diameter, **values)


def system(body, *fibers):
    return System(tg.Model(body, {"body": RUBBER}, [tg.Fixed("ends")], [], reinforcements=fibers))


@pytest.mark.parametrize("cells", ["hexahedra", "tetrahedra"])
def test_trusses_join_the_points_in_cells_that_hold_them(cells):
    body = block(cells)
    laid = discrete_threads(body, rods(TILTED))
    (line,) = laid.polylines(body.points)
    assert len(line) > 2
    for point in np.array(TILTED[0]):
        assert np.linalg.norm(line - point, axis=1).min() < 1e-5 * mm
    assert laid.lengths == pytest.approx([np.linalg.norm(np.diff(TILTED[0], axis=0), axis=1).sum()], rel=1e-6)
    at = laid.ends(body.points).mean(axis=1)
    corners = body.points[laid.pieces.sides[:, : body.cell_type.corners]]
    assert ((at > corners.min(axis=1) - 1e-9) & (at < corners.max(axis=1) + 1e-9)).all()


def test_forces_balance_turn_with_the_body_and_have_the_tangent_of_their_differences():
    body = block("tetrahedra")
    plain, threaded = system(body), system(body, rods(TILTED, bending=True))
    generator = np.random.default_rng(3)
    count, step = 3 * len(body.points), 1e-6
    x, direction = np.zeros(threaded.size), np.zeros(threaded.size)
    turn = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
    x[:count] = (body.points @ turn.T - body.points).ravel() / plain.length
    assert np.abs(threaded.residual(x, 0.0) - plain.residual(x, 0.0)).max() < 1e-9
    x[:count] += 2e-3 * generator.standard_normal(count)
    force = (threaded.residual(x, 0.0) - plain.residual(x, 0.0))[:count].reshape(-1, 3)
    position = body.points / plain.length + x[:count].reshape(-1, 3)
    assert np.abs(force).sum() > 0.1
    assert np.abs(force.sum(axis=0)).max() < 1e-10 * np.abs(force).sum()
    assert np.abs(np.cross(position, force).sum(axis=0)).max() < 1e-10 * np.abs(force).sum()
    direction[:count] = generator.standard_normal(count)
    ends = [threaded.residual(x + sign * step * direction, 0.0) for sign in (1, -1)]
    change = (ends[0] - ends[1]) / (2 * step)
    assert np.linalg.norm(threaded.tangent(x, 0.0) @ direction - change) < 1e-5 * np.linalg.norm(change)


@pytest.mark.parametrize(
    ("through", "facts"),
    [
        ([[(0, 0, 0), (12 * mm, 0, 0)]], ("threads", "point 2", "2 mm")),
        ([[(0, 0, 0), (1 * mm, 0, 0)], [(0, 0, 9 * mm), (0, 0, 0)]], ("point 1", "thread 2", "4 mm")),
    ],
)
def test_points_outside_are_refused_with_their_distance(through, facts):
    with refused(*facts):
        discrete_threads(block(), rods(through))


def test_a_point_just_outside_is_put_onto_the_surface():
    body = block()
    laid = discrete_threads(body, rods([[(-10.1 * mm, 0, 0), (10.1 * mm, 0, 0)]]))
    (line,) = laid.polylines(body.points)
    assert line[[0, -1], 0] == pytest.approx([-10 * mm, 10 * mm])


def test_a_thread_in_a_mirror_plane_is_refused():
    with refused("threads", "thread 1", "y"):
        discrete_threads(block(mirrors="y"), rods([[(-5 * mm, 0, 1 * mm), (5 * mm, 0, 2 * mm)]]))


def test_a_thread_through_a_cavity_is_refused():
    tube = mesh(FiberReinforcedCylinder(length=20 * mm, symmetric=False).build(), size=7 * mm, cells="hexahedra")
    with refused("10, 0, -7", "10, 0, 7"):
        discrete_threads(tube, rods([[(10 * mm, 0, -7 * mm), (10 * mm, 0, 7 * mm)]]))


@pytest.mark.parametrize("values", [{"face": "outside"}, {"form": "smeared"}])
def test_embedded_threads_have_no_face(values):
    with refused(*values.values()):
        rods(TILTED, **values)
