"""V26: a run that was ended from outside goes on from its last state and ends as a run that was not ended.

Problem: small bodies under every procedure, with contact and friction, rubber that relaxes and softens, limit points
and branches, stages, inertia. Each run is cut off at moments drawn by chance, within a step or after it, and resumed
from what is on disk. Exact: the run that was not cut off. Tolerance: 1e-9 of the largest displacement in every state;
the attempted steps and their numbers of iterations are the same.
"""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import contact_cases
import meshes
import problems
import turgor as tg
from problems import MM
from turgor.core.meshing.cells import HEXAHEDRON

KPA, ML = 1e3, 1e-6
OPTIONS = tg.EngineOptions(linear_solver="rslab", threads=1)
SLOW = tg.laws.Prony(g=(0.3, 0.2), tau=(0.1, 1.0), moduli="instantaneous")
FLOWING = tg.laws.BergstromBoyce(stiffness=1.0, rate=1.0, stress=1e5, exponent=3.0)
SETTING = tg.laws.PermanentSet(stress=2e6, exponent=1.5)
SOFT = tg.laws.Mullins(r=1.4, m=20e3)
NEO_HOOKE = tg.laws.NeoHooke(C10=0.12e6)
MOONEY_RIVLIN = tg.laws.MooneyRivlin(C10=0.1e6, C01=0.02e6)
DOWN = ((0, (0, 0, 0)), (1, (1.5 * MM, 0, -1.5 * MM)))

Case = tuple[tg.Model, object]


class Killed(BaseException):
    """Ends a run as a signal would: nothing catches it."""


def rubber(**changes) -> tg.Material:
    return replace(problems.rubber(NEO_HOOKE, density=1100.0), **changes)


def rubbed(**changes) -> tg.Model:
    """A block under a plane that comes down and aside, with friction."""
    plane = tg.obstacles.Plane(point=(0, 0, 5.2 * MM), normal=(0, 0, -1))
    plate = tg.obstacles.Obstacle(name="plate", shape=plane, path=DOWN, friction=0.4)
    contact = tg.Contact(self_contact=False, obstacles=[plate])
    return tg.Model(contact_cases.block((2, 2, 2)), {"body": rubber(**changes)}, [tg.Fixed("z0")], [], contact=contact)


def sphere(pressure: float, law=NEO_HOOKE) -> tg.Model:
    load = tg.Pressure("cavity", pressure * KPA)
    return tg.Model(meshes.sphere_octant(10 * MM, 15 * MM, 1, 2), {"body": rubber(law=law)}, [], [load])


def filled(loads=()) -> tg.Model:
    """A sphere that meets a plane."""
    plane = tg.obstacles.Plane(point=(0, 0, 12.2 * MM), normal=(0, 0, -1))
    plate = tg.obstacles.Obstacle(name="plate", shape=plane, path=((0, (0, 0, 0)), (1, (0, 0, -2 * MM))))
    contact = tg.Contact(self_contact=False, obstacles=[plate])
    mesh = meshes.sphere_octant(10 * MM, 12 * MM, 2, 1, kind=HEXAHEDRON)
    return tg.Model(mesh, {"body": rubber()}, [], loads, contact=contact)


def column() -> tg.Model:
    """A thin cantilever under twice Euler's load."""
    euler = np.pi**2 * 0.72e6 * 1e-12 / 12 / 0.04
    mesh = meshes.box((0.1, 1e-3, 1e-3), (6, 1, 1), kind=meshes.HEXAHEDRON)
    return tg.Model(mesh, {"body": rubber()}, [tg.Fixed("x0")], [tg.Traction("x1", (-2e6 * euler, 0.0, 0.0))])


def arch() -> tg.Model:
    """A flat arch that snaps."""
    return problems.arch(rubber(bulk_modulus=0.3e6, stress_softening=SOFT), 7.5e3)


def bar() -> tg.Model:
    """A bar with two cavities, one above the other."""
    return tg.Model(meshes.two_cavities(), {"body": rubber(viscoelasticity=SLOW)}, [tg.Fixed("x0")], [])


def falling() -> tg.Model:
    """A block that slides on a floor and is pushed."""
    floor = tg.obstacles.Plane(point=(0, 0, 0), normal=(0, 0, 1))
    plate = tg.obstacles.Plane(point=(-0.5 * MM, 0, 0), normal=(1, 0, 0))
    path = ((0, (0, 0, 0)), (0.3, (0, 0, 0)), (1, (1.5 * MM, 0, 0)))
    obstacles = [
        tg.obstacles.Obstacle(name="floor", shape=floor, friction=0.4),
        tg.obstacles.Obstacle(name="plate", shape=plate, path=path),
    ]
    weight = tg.Gravity((0, 0, -1), history=((0, 0), (0.3, 1), (1, 1)))
    contact = tg.Contact(self_contact=False, obstacles=obstacles)
    return tg.Model(contact_cases.block((2, 2, 2)), {"body": rubber(bulk_modulus=5e6)}, [], [weight], contact=contact)


def staged() -> Case:
    """Pressure, injection, sealed gas beside a plate, and a free motion."""
    steps = {"first_step": 0.25, "max_step": 0.5}
    mesh = meshes.hollow_box(3)
    mesh = meshes.with_points(mesh, mesh.points * 30 * MM)
    plane = tg.obstacles.Plane(point=(0, 0, 31 * MM), normal=(0, 0, -1))
    plate = tg.obstacles.Obstacle(name="plate", shape=plane, path=((0, (0, 0, 0)), (1, (0, 0, -3 * MM))), friction=0.3)
    contact = tg.Contact(self_contact=False, obstacles=[plate])
    material = rubber(stress_softening=SOFT)
    model = tg.Model(mesh, {"body": material}, [tg.Fixed("z0")], [tg.Pressure("cavity", 20 * KPA)], contact=contact)
    stages = (
        tg.Stage("press", tg.Static(**steps)),
        tg.Stage("fill", tg.VolumeControl(volume=1 * ML, **steps)),
        tg.Stage("seal", tg.GasMass(mass_ratio=1.1, **steps), moves={"plate": (0, 0, 0)}),
        tg.Stage(
            "push", tg.Static(**steps), displacements=[tg.Displacement("z0", tg.supports.Shift((1 * MM, 0.0, 0.0)))]
        ),
        tg.Stage("let go", tg.Dynamic(duration=0.01, first_step=1e-3, max_step=5e-3, accuracy=2e-2)),
    )
    return model, tg.Stages(stages)


CASES: dict[str, Callable[[], Case]] = {
    "rubber that relaxes": lambda: (
        replace(sphere(60), materials={"body": rubber(viscoelasticity=SLOW)}),
        tg.Static(duration=1.0, max_step=0.2),
    ),
    "rubber that flows and keeps a set": lambda: (
        replace(sphere(60), materials={"body": rubber(viscoelasticity=FLOWING, permanent_set=SETTING)}),
        tg.Static(duration=1.0, max_step=0.25),
    ),
    "friction and softening": lambda: (rubbed(stress_softening=SOFT), tg.Static(first_step=0.1, max_step=0.2)),
    "volumes": lambda: (bar(), tg.VolumeControl(volume={"cavity_1": 0.1 * ML, "cavity_2": -0.08 * ML}, max_step=0.2)),
    "gas and contact": lambda: (filled(), tg.GasMass(mass_ratio=1.8, max_step=0.25)),
    "arc length": lambda: (sphere(130), tg.ArcLength(max_stretch=3.0)),
    "auto by volume": lambda: (sphere(130), tg.Auto(max_stretch=3.0)),
    "auto past two limit points": lambda: (sphere(170, MOONEY_RIVLIN), tg.Auto(first_step=0.5, max_step=0.5)),
    "auto by arcs": lambda: (column(), tg.Auto(first_step=0.4)),
    "auto from rest": lambda: (arch(), tg.Auto(first_step=2e-3, max_step=2e-3, max_iterations=40, max_steps=15)),
    "stabilized": lambda: (falling(), tg.Stabilized()),
    "inertia and friction": lambda: (
        rubbed(viscoelasticity=SLOW),
        tg.Dynamic(duration=0.008, first_step=5e-4, max_step=2e-3, accuracy=2e-2, stiffness_damping=1e-4),
    ),
    "inertia with kept factors": lambda: (
        sphere(5),
        tg.Dynamic(duration=0.02, first_step=1e-3, adaptive=False, keep=3, mass_damping=5.0),
    ),
    "stages": staged,
}


class Cut:
    """Counts what a solve reports, and ends it at one of its calls."""

    def __init__(self, at: int | None = None) -> None:
        self.count, self.at = 0, at

    def __call__(self, iteration: object, state: object) -> None:
        self.count += 1
        if self.count == self.at:
            raise Killed


def largest_difference(one: tg.Solution, other: tg.Solution) -> float:
    """Between the states of two solutions, over the largest displacement."""
    assert len(one.states) == len(other.states)
    scale = max(np.abs(state.displacement).max() for state in other.states)
    pairs = zip(one.states, other.states, strict=True)
    return max(float(np.abs(a.displacement - b.displacement).max() / scale) for a, b in pairs)


#: Cases that take long, or differ from others in the start alone.
LONG = ("inertia and friction", "volumes", "arc length", "auto past two limit points")

QUICK = [(name, 2) for name in CASES if name not in LONG]


@pytest.mark.parametrize(
    ("name", "count"), [*QUICK, *(pytest.param(name, 8, marks=pytest.mark.slow) for name in CASES)]
)
def test_a_run_that_was_cut_off_ends_as_the_whole_one(name, count, tmp_path, record_verification):
    model, procedure = CASES[name]()
    calls = Cut()
    whole = tg.solve(model, procedure, options=OPTIONS, progress=calls, throw=False)
    chance = np.random.default_rng(sum(map(ord, name)) + count)
    moments = sorted(set(chance.integers(1, calls.count + 1, count).tolist()))
    worst = 0.0
    for moment in moments:
        folder = tmp_path / str(moment)
        with pytest.raises(Killed):
            tg.solve(model, procedure, options=OPTIONS, progress=Cut(moment), folder=folder, throw=False)
        again = tg.resume(folder, throw=False)
        assert (again.status, again.message) == (whole.status, whole.message)
        taken = [[(step.iterations, step.accepted, step.cause) for step in each.steps] for each in (again, whole)]
        assert taken[0] == taken[1]
        worst = max(worst, largest_difference(again, whole))
        assert largest_difference(tg.load(folder), whole) < 1e-9
    claim = f"{name}: cut off at {len(moments)} moments and resumed, largest difference of all states"
    record_verification(claim, "the run that was not cut off", 0.0, worst, "1e-9 of the displacement")
    assert worst < 1e-9


def test_what_is_on_disk_is_the_path_so_far(tmp_path: Path) -> None:
    model, procedure = CASES["gas and contact"]()
    whole = tg.solve(model, procedure, options=OPTIONS)
    with pytest.raises(Killed):
        tg.solve(model, procedure, options=OPTIONS, folder=tmp_path / "run", progress=Cut(12))
    result = tg.load(tmp_path / "run")
    assert result.status is tg.Status.INTERRUPTED and "--resume" in result.advice
    assert 1 < len(result.states) < len(whole.states)
    for state, expected in zip(result.states, whole.states, strict=False):
        assert np.array_equal(state.displacement, expected.displacement)
        assert state.model is result.model and state.pressures == expected.pressures
