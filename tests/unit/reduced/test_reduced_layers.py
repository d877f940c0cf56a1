"""Fibers and sheets that bear tension only, of which a reduced model samples few pieces."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import System
from turgor.core.engine.term import Configuration
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.reduced.reduce import Budget, reduce
from turgor.reduced.states.newton import Balance, newton
from turgor.reduced.states.reduced import Reduced
from turgor.reduced.training.layers import layers_of

EXAMPLES = Path(__file__).parents[3] / "examples"
KEY = "loads.pressure"
CASES = {
    "hoops": ("actuators/fiber_reinforced_cylinder.toml", {"mesh.size": "8 mm", "actuator.length": "30 mm"}),
    "film": ("film.toml", {"mesh.size": "9 mm", "actuator.chambers": 1, "actuator.length": "20 mm"}),
}


@dataclass(frozen=True)
class Case:
    """A full model and its reduced one."""

    model: tg.Model
    reduced: Reduced


def model_of(name: str) -> tg.Model:
    """A tube in hoops of Kevlar, or a chamber closed by paper that wrinkles."""
    job, changes = CASES[name]
    return prepare(read_job(EXAMPLES / job, changes), lambda text: None)[0]


@pytest.fixture(scope="module", params=list(CASES))
def case(request: pytest.FixtureRequest) -> Case:
    model = model_of(request.param)
    box = {KEY: (0.0, model.pressures[0].pressure)}
    return Case(model, reduce(model, box, budget=Budget(held_out=1, steps=6), options=EngineOptions(threads=1)))


def test_held_out_states_agree(case: Case) -> None:
    errors = case.reduced.held_out
    assert len(errors.inputs) >= 6
    assert errors.worst < 0.003
    assert case.reduced.counts["pieces of layers"] < 60


def test_measures_read_its_states(case: Case) -> None:
    answer = case.reduced.solve(0.7 * case.model.pressures[0].pressure)
    state = answer.state()
    assert tg.cavity_volume(state) == pytest.approx(answer.volumes["cavity"], rel=1e-6)
    assert tg.tip_displacement(state) == pytest.approx(np.linalg.norm(answer.tip), rel=1e-4)


def test_all_pieces_give_the_projected_full_forces(case: Case) -> None:
    """Where threads are stretched or slack and sheets wrinkle: at displacements that are no equilibrium."""
    system, random = System(case.model), np.random.default_rng(4)
    vectors = 0.1 * np.stack([np.sin(system.points @ random.standard_normal((3, 3))).ravel() for _ in range(3)], axis=1)
    q, way, step = np.array([0.3, -0.2, 0.4]), random.standard_normal(3), 1e-6
    at = Configuration(system.points + (vectors @ q).reshape(-1, 3))
    (layer,) = layers_of(system, vectors)
    (term,) = [each for each in system.terms.all if hasattr(each, "pieces") or getattr(each, "field", None)]
    full = np.zeros_like(system.points)
    term.add_forces(full, at)
    there = layer.part.at(q)
    assert there.forces() == pytest.approx(vectors.T @ full.ravel(), rel=1e-9)
    assert there.forces(layer.starts).sum(axis=0) == pytest.approx(there.forces(), rel=1e-9)
    if hasattr(there, "stretch"):
        assert there.stretch.min() < 0.99
    ends = [layer.part.at(q + sign * step * way).forces() for sign in (1, -1)]
    slope = (ends[0] - ends[1]) / (2 * step)
    assert there.tangent(None) @ way == pytest.approx(slope, rel=2e-3)


def test_forces_are_derivatives_of_the_energy(case: Case) -> None:
    equations = case.reduced.equations
    random = np.random.default_rng(2)
    place = case.reduced.trained[-1].copy()
    r, aim = equations.sizes[0], case.reduced.trained_inputs[-1]
    way = random.standard_normal(r) * np.abs(place[:r]).max() * 0.01
    forces = sum(part.forces() for part in equations.at(place, aim).parts)

    def energy(share: float) -> float:
        at = equations.at(np.concatenate([place[:r] + share * way, place[r:]]), aim)
        return sum(part.energy() for part in at.parts)

    assert (energy(2e-4) - energy(-2e-4)) / 4e-4 == pytest.approx(forces @ way, rel=1e-5)


def test_stresses_linearized_spare_updates_next_to_stiff_threads(case: Case) -> None:
    reduced, place = case.reduced, 2
    found = newton(
        reduced.equations, reduced.trained[place], reduced.trained_inputs[-1], reduced.size
    )  # from a third of the pressure to all of it at once
    assert isinstance(found, Balance)
    r = reduced.equations.sizes[0]
    assert found.at.y[:r] == pytest.approx(reduced.trained[-1, :r], abs=0.01 * reduced.size)


def test_fibers_that_resist_bending_are_refused() -> None:
    model = model_of("hoops")
    threads = [replace(each, form="discrete", bending=True) for each in model.reinforcements]
    with refused("bending"):
        tg.reduce(replace(model, reinforcements=tuple(threads)), {KEY: (0.0, 1e3)})
