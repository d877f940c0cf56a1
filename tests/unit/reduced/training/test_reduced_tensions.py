"""Fibers that work in compression, of which a reduced model combines few modes of their tension."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import System
from turgor.core.engine.term import Configuration
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.reduced.parts.tensions import Tensions
from turgor.reduced.reduce import Budget, reduce
from turgor.reduced.settings import SAMPLING, TENSIONS
from turgor.reduced.training.layers import layers_of, windings
from turgor.reduced.training.modes import Modes
from turgor.reduced.training.tensions import swinging, tensions_of
from turgor.reduced.training.trainer import Path as FullPath

JOB = Path(__file__).parents[4] / "examples" / "actuators" / "fiber_reinforced_cylinder.toml"


def wound(compression: float) -> tg.Model:
    """A tube in hoops of Kevlar, which go slack or do not."""
    model = prepare(read_job(JOB, {"mesh.size": "8 mm", "actuator.length": "30 mm"}), lambda text: None)[0]
    return replace(model, reinforcements=tuple(replace(each, compression=compression) for each in model.reinforcements))


@pytest.fixture(scope="module")
def model() -> tg.Model:
    return wound(1.0)


def some_modes(system: System) -> tuple[np.ndarray, np.ndarray]:
    """Three smooth modes, and coordinates that stretch some pieces by percents and shorten others."""
    random = np.random.default_rng(4)
    shapes = [np.sin(system.points @ random.standard_normal((3, 3))).ravel() for _ in range(3)]
    return 0.1 * np.stack(shapes, axis=1), np.array([0.3, -0.2, 0.4])


def few(system: System, vectors: np.ndarray) -> Tensions:
    """Tensions of two states."""
    fields = [(vectors @ q).reshape(-1, 3) for q in np.array([[0.3, 0.1, 0.2], [-0.1, 0.3, 0.1]])]
    (tensions,) = tensions_of(system, fields, vectors)
    return tensions


def test_a_mode_for_each_piece_gives_the_forces_of_the_full_model(model: tg.Model) -> None:
    system = System(model)
    vectors, q = some_modes(system)
    tensions = few(system, vectors)
    (pieces,) = windings(system, slack=False)
    moved = np.einsum("ka,kaiR->kiR", pieces.along, np.concatenate(
        [system.points[:, :, None], vectors.reshape(len(system.points), 3, -1)], axis=2)[pieces.sides])  # fmt: skip
    every = np.einsum("k,kiR,kiS->kRS", pieces.weights, moved, moved)
    every[:, 0, 0] -= pieces.weights
    whole = replace(tensions, forms=every, modes=np.eye(len(pieces.weights)))
    (term,) = [each for each in system.terms.all if hasattr(each, "pieces")]
    position, full = system.points + (vectors @ q).reshape(-1, 3), np.zeros_like(system.points)
    term.add_forces(full, Configuration(position))
    there = whole.at(q)
    assert there is not None
    assert there.stretch.min() < 0.99
    assert there.forces() == pytest.approx(vectors.T @ full.ravel(), rel=1e-8)
    assert there.energy() == pytest.approx(term.energy(position), rel=1e-8)


def test_forces_and_tangent_are_derivatives(model: tg.Model) -> None:
    system = System(model)
    vectors, q = some_modes(system)
    tensions, way, step = few(system, vectors), np.array([0.2, 0.5, -0.3]), 1e-5
    there, ends = tensions.at(q), [tensions.at(q + sign * step * way) for sign in (1, -1)]
    assert there is not None
    assert there.forces() @ way == pytest.approx((ends[0].energy() - ends[1].energy()) / (2 * step), rel=1e-6)
    slope = (ends[0].forces() - ends[1].forces()) / (2 * step)
    assert there.tangent(None) @ way == pytest.approx(slope, rel=1e-6)
    change = ends[0].own - there.own
    assert there.linearized(step * way) - there.own == pytest.approx(change, rel=1e-3)


def test_modes_of_states_have_their_tensions(model: tg.Model) -> None:
    """At a state whose tension is one of the snapshots, few modes act as all pieces do, up to what the fibers miss."""
    system = System(model)
    vectors, _ = some_modes(system)
    q = np.array([0.3, 0.1, 0.2])
    tensions = few(system, vectors)
    (term,) = [each for each in system.terms.all if hasattr(each, "pieces")]
    full = np.zeros_like(system.points)
    term.add_forces(full, Configuration(system.points + (vectors @ q).reshape(-1, 3)))
    assert len(tensions.modes) == 2
    assert tensions.at(q).forces() == pytest.approx(vectors.T @ full.ravel(), rel=1e-8)


def test_no_tension_fits_what_is_turned_inside_out(model: tg.Model) -> None:
    system = System(model)
    tensions = few(system, some_modes(system)[0])
    far = replace(tensions, forms=-1e3 * np.abs(tensions.forms))
    assert far.at(np.array([1.0, 1.0, 1.0])) is None


def test_slack_fibers_are_sampled_and_others_are_not(model: tg.Model) -> None:
    vectors, _ = some_modes(System(model))
    assert not layers_of(System(model), vectors)
    slack = System(wound(0.0))
    assert len(layers_of(slack, vectors)) == 1
    assert not tensions_of(slack, [np.zeros_like(slack.points)], vectors)


def test_fibers_resist_swings_that_no_state_has(model: tg.Model) -> None:
    """With the responses to inertia among the snapshots, forces off the path are those of the full model."""
    system = System(model)
    vectors, _ = some_modes(system)
    size, product = len(vectors), vectors.T @ vectors
    basis = Modes(vectors, vectors @ np.linalg.inv(product), 0.0)
    still, swing = np.array([0.3, 0.1, 0.2]), np.array([-0.1, 0.3, 0.1])
    states = (vectors @ np.array([0.5 * still, still]).T).T.reshape(2, -1, 3)
    nothing = np.zeros((0, size))
    path = FullPath(inputs=np.ones((2, 2)), displacements=states, mean_stresses=nothing, derivatives=(nothing, nothing),
                    rest=np.zeros(2), obstacle_forces=np.zeros((2, 0, 3)), scales=(), reached=True, seconds=0.0,
                    inertial=((vectors @ swing)[None], nothing))  # fmt: skip
    (off,) = swinging(basis, [path])
    way = swing / np.linalg.norm(swing)
    assert basis.dual.T @ off.ravel() - still == pytest.approx(SAMPLING.swing * np.linalg.norm(still) * way)
    (term,) = [each for each in system.terms.all if hasattr(each, "pieces")]
    full = np.zeros_like(system.points)
    term.add_forces(full, Configuration(system.points + off))
    (tensions,) = tensions_of(system, [*states, off], vectors)
    assert tensions.at(basis.dual.T @ off.ravel()).forces() == pytest.approx(vectors.T @ full.ravel(), rel=1e-8)
    assert not list(swinging(basis, [replace(path, inertial=(nothing, nothing))]))


def test_held_out_states_agree(model: tg.Model) -> None:
    reduced = reduce(
        model, {"loads.pressure": (0.0, model.pressures[0].pressure)}, budget=Budget(held_out=1, steps=6),
        options=EngineOptions(threads=1),
    )  # fmt: skip
    assert reduced.held_out.worst < 0.003
    (part,) = [each for each in reduced.equations.parts if isinstance(each, Tensions)]
    assert len(part.modes) <= TENSIONS.modes
    assert "pieces of layers" not in reduced.counts


def test_fibers_are_evaluated_at_rest(model: tg.Model) -> None:
    """Round-off of the strains there is no reason to go on."""
    vectors, _ = some_modes(System(model))
    (tensions,) = tensions_of(System(model), [(vectors @ [0.3, 0.1, 0.2]).reshape(-1, 3)], vectors)
    assert np.abs(tensions.at(np.zeros(3)).forces()).max() < 1e-9 * tensions.stiffness.max()
