"""A short finger, a bellows before a plate, and their reduced models, which several tests share."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np

import turgor as tg
from turgor.accuracy.gradients.model_keys import model_variation
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import System
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Obstacle, Plane
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.reduced.reduce import Budget, Training, reduce
from turgor.reduced.states.inputs import Inputs
from turgor.reduced.states.reduced import Reduced
from turgor.reduced.training.assembly import Drive, drive_of
from turgor.reduced.training.build import Built, build
from turgor.reduced.training.masses import masses_of
from turgor.reduced.training.trainer import Path as FullPath
from turgor.reduced.training.trainer import Trainer
from turgor.units import MPa, kPa, mm

JOB = Path(__file__).parents[2] / "examples" / "fast_pneunet.toml"
CHANGES = {"mesh.size": "8 mm", "actuator.chambers": 2, "actuator.length": "22 mm"}
KEY, PRESSURE = "loads.pressure", 12e3
PLACE = "obstacles.plate.point.1"
ELASTOMER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.1 * MPa))
LENGTH = 28 * mm


@cache
def finger() -> Model:
    """Two chambers with a shell below, whose walls meet."""
    return prepare(read_job(JOB, CHANGES), lambda text: None)[0]


def box() -> Inputs:
    """The pressure."""
    return Inputs((KEY,), np.array([0.0]), np.array([PRESSURE]), ("kPa",))


@cache
def path() -> FullPath:
    """Eight full solves."""
    return Trainer(model_variation(finger(), [KEY]).model, box(), 8, EngineOptions(threads=1)).path(
        np.array([PRESSURE])
    )


@cache
def system() -> System:
    """The full equations."""
    return System(finger())


@cache
def drive() -> Drive:
    """How the pressure follows from the input."""
    return drive_of(system(), model_variation(finger(), [KEY]).model, box())


@cache
def built() -> Built:
    """Equations in six modes, before and after sampling."""
    return build(system(), drive(), [path()], 6, 0.005)


@cache
def other_path() -> FullPath:
    """Full solves at pressures between those of `path`."""
    trainer = Trainer(model_variation(finger(), [KEY]).model, box(), 9, EngineOptions(threads=1))
    return trainer.path(np.array([0.97 * PRESSURE]), differentiated=False)


@cache
def reduced_of(modes: int) -> Reduced:
    """A reduced model in some modes of one path."""
    return _of_path(path(), modes)


@cache
def moving() -> Reduced:
    """A reduced model with modes for motion."""
    trainer = Trainer(model_variation(finger(), [KEY]).model, box(), 8, EngineOptions(threads=1), motion=True)
    made = _of_path(trainer.path(np.array([PRESSURE])), 8)
    return replace(made, masses=masses_of(system(), made.modes.astype(np.float64)))


def _of_path(path: FullPath, modes: int) -> Reduced:
    return trained(finger(), system(), path, modes)


def trained(model: Model, equations: System, path: FullPath, modes: int) -> Reduced:
    """A reduced model of one path of a model."""
    at = model_variation(model, [KEY]).model
    training = Training(model, at, box(), Budget(), EngineOptions(threads=1), None, print)
    made = build(equations, drive_of(equations, at, box()), [path], modes, 0.005)
    return training.reduced(equations, made, [path])


@cache
def reduced() -> Reduced:
    """A reduced model of the finger."""
    budget = Budget(held_out=1, steps=8, modes=8)
    return reduce(finger(), {KEY: (0.0, PRESSURE)}, budget=budget, options=EngineOptions(threads=1))


def bellows(plate: Obstacle) -> tg.Model:
    """A bellows before a plate."""
    mesh = tg.mesh(tg.actuators.BellowsOfRevolution(folds=2).build(), size=5 * mm, cells="axisymmetric")
    load = tg.Pressure("cavity", 5 * kPa)
    return tg.Model(mesh, {"body": ELASTOMER}, [tg.Fixed("fixed")], [load], contact=tg.Contact(obstacles=[plate]))


def plate(**changes: object) -> Obstacle:
    """The plate, 4 mm away."""
    return replace(
        Obstacle(name="plate", shape=Plane(point=(LENGTH + 4 * mm, 0, 0), normal=(-1, 0, 0))), **changes
    )  # fmt: skip


@cache
def pressing() -> Reduced:
    """A bellows that presses a plate at some distance, or does not reach it."""
    box = {KEY: (0.0, 5 * kPa), PLACE: (LENGTH + 1 * mm, LENGTH + 6 * mm)}
    budget = Budget(held_out=1, steps=5, paths=4)
    return reduce(bellows(plate()), box, budget=budget, options=EngineOptions(threads=1))
