"""Obstacles in reduced models: their place is an input, the force on them an answer with its rates."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from reduced_cases import ELASTOMER, KEY, LENGTH, PLACE, bellows, plate, pressing

import turgor as tg
from refused import refused
from turgor.accuracy.gradients.model_keys import model_variation
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import System
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import swept_mesh
from turgor.core.model.obstacles import Box, Obstacle, Plane, RigidSurface, Sphere
from turgor.core.model.obstacles.pose import Pose
from turgor.core.results.measures.contact_measures import force_on
from turgor.reduced.parts.obstacles import ObstructingAt
from turgor.reduced.path import solution_of
from turgor.reduced.reduce import Budget, Training
from turgor.reduced.states.estimate import KnownErrors
from turgor.reduced.states.newton import Balance, newton
from turgor.reduced.training.box import corners, inputs_of
from turgor.reduced.training.near import contact_parts, near_points
from turgor.reduced.training.places import Place
from turgor.units import kPa, mm


def test_forces_at_untrained_places_agree() -> None:
    errors = pressing().held_out
    away = (errors.inputs[:, None] - pressing().trained_inputs[:, 1:]) / [5 * kPa, 5 * mm]
    assert np.median(np.linalg.norm(away, axis=2).min(axis=1)) > 0.05
    assert errors.force.max() < 0.01
    assert errors.worst < 0.005
    assert errors.force.max() > 0


def test_forces_of_its_states_are_those_of_the_answer() -> None:
    answer = pressing().solve({"pressure": 4.5 * kPa, "point.1": LENGTH + 3 * mm})
    (force,) = answer.obstacle_forces.values()
    assert force[0] > 0.5
    assert force[1:] == pytest.approx([0.0, 0.0], abs=1e-12)
    measured = tg.measure(solution_of([answer]), force_on("plate"), mesh_error=False)
    assert measured.column("plate_force")[-1] == pytest.approx(force[0], rel=1e-4)
    assert answer.state().model.contact.obstacles[0].shape.point[0] == LENGTH + 3 * mm


def test_rates_of_forces_are_derivatives() -> None:
    here = {"pressure": 4.5 * kPa, "point.1": LENGTH + 3 * mm}
    one = pressing().solve(here)
    for place, (name, step) in enumerate({"pressure": 1.0, "point.1": 1e-6}.items()):
        ends = [pressing().solve(here | {name: here[name] + sign * step}, start=one) for sign in (1, -1)]
        slope = (ends[0].obstacle_forces["plate"] - ends[1].obstacle_forces["plate"]) / (2 * step)
        assert one.obstacle_force_rates["plate"][:, place] == pytest.approx(slope, rel=1e-3)
        assert one.tip_rates[:, place] == pytest.approx((ends[0].tip - ends[1].tip) / (2 * step), rel=1e-3)


def test_force_on_a_plate_is_the_derivative_of_the_energy_by_its_place() -> None:
    answer = pressing().solve({"pressure": 4.5 * kPa, "point.1": LENGTH + 3 * mm})
    (obstacle,) = pressing().equations.obstacles
    step = 1e-7

    def at(place: float) -> ObstructingAt:
        return obstacle.at(answer.q, np.array([1.0, 4.5 * kPa, place]))

    ends = at(LENGTH + 3 * mm + step), at(LENGTH + 3 * mm - step)
    slope = (ends[0].energy() - ends[1].energy()) / (2 * step)
    middle = at(LENGTH + 3 * mm)
    assert slope == pytest.approx(middle.every[-3:] @ obstacle.place[:, 2], rel=1e-6)
    assert ends[0].work(ends[1], np.array([0.0, 0.0, 2 * step])) == pytest.approx(2 * step * slope, rel=1e-6)


def test_random_jumps_into_the_plate_are_all_answered() -> None:
    box = pressing().inputs
    for share in np.random.default_rng(3).uniform(size=(40, 2)):
        assert pressing().at(box.low + share * (box.high - box.low)).iterations < 40


def test_updates_end_before_points_are_deep_in_the_plate() -> None:
    """From rest to all of the pressure at once; a whole update passes the plate by millimeters."""
    reduced = pressing()
    equations, inputs = reduced.equations, np.array([1.0, 5 * kPa, LENGTH + 1 * mm])
    rest = np.zeros(sum(equations.sizes))
    at = equations.at(rest, inputs)
    whole = equations.at(rest - np.linalg.solve(at.tangent(), at.residual), inputs)
    assert at.obstacles[0].share(whole.obstacles[0]) < 0.6
    assert at.obstacles[0].share(at.obstacles[0]) == 1.0
    assert isinstance(newton(equations, rest, inputs, reduced.size), Balance)


def test_file_has_its_obstacles(tmp_path) -> None:
    again = tg.load(pressing().save(tmp_path / "bellows"))
    here = {"pressure": 4 * kPa, "point.1": LENGTH + 2 * mm}
    force = pressing().solve(here).obstacle_forces["plate"]
    assert again.solve(here).obstacle_forces["plate"] == pytest.approx(force, rel=1e-5)


def sheet(level: float) -> RigidSurface:
    """A plane of two triangles below a finger."""
    points = np.array([[-0.05, -0.05, level], [0.05, -0.05, level], [0.05, 0.05, level], [-0.05, 0.05, level]])
    return RigidSurface(points=points, triangles=np.array([[0, 1, 2], [0, 2, 3]]))


@pytest.mark.parametrize(
    "shape",
    [
        Plane(point=(0, 0, 0.2 * mm), normal=(0.1, 0, 1)),
        Sphere(center=(8 * mm, 0, -9.5 * mm), radius=10 * mm),
        Box(center=(6 * mm, 0, -4 * mm), size=(6 * mm, 30 * mm, 8.6 * mm), rounding=2 * mm),
        sheet(0.2 * mm),
    ],
    ids=lambda shape: type(shape).__name__,
)
def test_forces_and_tangent_are_those_of_the_full_contact(shape: object) -> None:
    """At an arbitrary displacement, in which the finger is pressed into the obstacle, and with the obstacle moved."""
    mesh = swept_mesh(tg.FastPneuNet(chambers=1, length=12 * mm).build(), Fineness(size=6 * mm))
    contact = tg.Contact(False, [Obstacle(name="body", shape=shape)])
    model = tg.Model(mesh, {"body": ELASTOMER, "base": ELASTOMER}, [tg.Fixed("fixed")], [], contact=contact)
    system, random = System(model), np.random.default_rng(2)
    x = system.points / np.abs(system.points).max()
    fields = np.stack(
        [x @ random.standard_normal((3, 3)), np.sin(2 * x), x**2 @ random.standard_normal((3, 3))], axis=2
    )
    q, inputs = np.array([0.004, 0.003, 0.005]), np.array([1.0, 0.5])
    places = {"body": Place(np.array([0.01, 0, 0]), random.standard_normal((3, 2)) * 0.01)}
    close = near_points(system, [fields @ q], [inputs], places)
    _, (obstacle,) = contact_parts(system, close, fields.reshape(-1, 3), places)
    part, at = system.contact.parts[0], obstacle.at(q, inputs)
    position = system.points + fields @ q
    full = part.forces(position, part.look(position, Pose(places["body"].at(inputs))))
    assert np.abs(full).max() > 0
    projected = np.einsum("nir,ni->r", fields, full[: len(fields)])
    assert at.forces() == pytest.approx(projected, rel=1e-6)
    whole = 2 * system.stress_scale * system.length**2 * full[: len(fields)].sum(axis=0) * [1, 0, 1]
    assert at.force() == pytest.approx(whole, rel=1e-6)
    way, turn, step = random.standard_normal(3), np.array([0.3, 1.0]), 1e-7
    ends = [obstacle.at(q + sign * step * way, inputs + sign * step * turn) for sign in (1, -1)]
    slope = (ends[0].forces() - ends[1].forces()) / (2 * step)
    exact = at.tangent(None) @ way + at.by_inputs() @ turn
    assert exact == pytest.approx(slope, abs=1e-4 * np.abs(slope).max())


def test_corners_have_a_load() -> None:
    box = inputs_of(bellows(plate()), {KEY: (0.0, 1e3), PLACE: (LENGTH, LENGTH + 1 * mm)})
    assert [corner.tolist() for corner in corners(box)] == [[1e3, LENGTH + 1 * mm], [1e3, LENGTH]]


def test_what_obstacles_leave_out_is_refused_by_name() -> None:
    box = {KEY: (0.0, 1e3)}
    with refused("plate", "friction", "0.3"):
        tg.reduce(bellows(plate(friction=0.3)), box)
    with refused("plate", "springs"):
        tg.reduce(bellows(plate(spring=50.0)), box)
    with refused("plate", "obstacles.plate.point.3"):
        tg.reduce(bellows(plate(path=[(0, (0, 0, 0)), (0.5, (-1e-3, 0, 0)), (1, (0, 0, 0))])), box)
    with refused("obstacles.plate.pont.1", PLACE):
        tg.reduce(bellows(plate()), {"obstacles.plate.pont.1": (0.03, 0.04)})


def test_every_other_path_of_the_training_presses(monkeypatch: pytest.MonkeyPatch) -> None:
    """Estimates are of displacements: the worst input may be one at which no obstacle is near."""
    made, model = pressing(), bellows(plate())
    shares = np.array([[0.2, 1.0], [0.9, 0.0]])  # far, and pressing
    monkeypatch.setattr("turgor.reduced.reduce.random_shares", lambda *_: shares)
    box = made.inputs
    aims = np.column_stack([np.ones(2), box.low + shares * (box.high - box.low)])
    known = KnownErrors(places=aims * made.weights, errors=np.array([0.1, 1e-4]), sizes=np.ones(2),
                        indicators=np.array([made.at(aim[1:]).indicator for aim in aims]))  # fmt: skip
    training = Training(model, model_variation(model, list(box.keys), inputs=True).model, box, Budget(),
                        EngineOptions(threads=1), None, print)  # fmt: skip
    answers = [replace(made, known=known).at(aim[1:]) for aim in aims]
    assert [bool(each.obstacle_forces["plate"].any()) for each in answers] == [False, True]
    assert answers[0].estimate > 10 * answers[1].estimate
    path = SimpleNamespace(reached=True)
    worst = [training._worst(replace(made, known=known), [path] * count) for count in (2, 3)]
    assert np.array(worst) == pytest.approx(aims[:, 1:])
