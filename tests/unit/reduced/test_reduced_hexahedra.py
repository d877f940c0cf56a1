"""Reduced models of hexahedra: penalized moments of the lost volume, middles that follow, axisymmetric meshes."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

import turgor as tg
from turgor.accuracy.gradients.model_keys import model_variation
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import System
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import swept_mesh
from turgor.reduced.reduce import Budget, reduce
from turgor.reduced.states.reduced import Reduced
from turgor.reduced.training.assembly import assemble, drive_of
from turgor.reduced.training.box import inputs_of
from turgor.reduced.training.build import bases
from turgor.reduced.training.trainer import Trainer
from turgor.units import MPa, kPa, mm

KEY = "loads.pressure"
RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.1 * MPa))
SOFT = replace(RUBBER, bulk_modulus=2 * MPa)
PAPER = tg.from_library("paper", record="hooke-polygerinos-2020")


def finger(follow: bool) -> tg.Model:
    """One chamber on a sheet; with middles that follow, of rubber that is compressible."""
    mesh = swept_mesh(tg.FastPneuNet(chambers=1, length=12 * mm).build(), Fineness(size=6 * mm))
    rubber = SOFT if follow else RUBBER
    materials = {"body": rubber, "base": rubber, "strain_limiting_layer": tg.Membrane(PAPER, thickness=0.1 * mm)}
    return tg.Model(
        replace(mesh, serendipity=follow), materials, [tg.Fixed("fixed")], [tg.Pressure("cavity", 10 * kPa)]
    )


def bellows() -> tg.Model:
    """Two folds about an axis, in rings of nodes that move alike."""
    mesh = tg.mesh(tg.actuators.BellowsOfRevolution(folds=2).build(), size=5 * mm, cells="axisymmetric")
    return tg.Model(mesh, {"body": RUBBER}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 5 * kPa)])


MODELS = {"27 nodes": lambda: finger(False), "20 nodes": lambda: finger(True), "axisymmetric": bellows}


@dataclass(frozen=True)
class Case:
    """A full model and its reduced one."""

    model: tg.Model
    reduced: Reduced


@pytest.fixture(scope="module", params=list(MODELS))
def case(request: pytest.FixtureRequest) -> Case:
    model = MODELS[request.param]()
    budget = Budget(held_out=1, steps=5, modes=6)
    box = {KEY: (0.0, model.pressures[0].pressure)}
    return Case(model, reduce(model, box, budget=budget, options=EngineOptions(threads=1)))


def test_held_out_states_agree(case: Case) -> None:
    errors = case.reduced.held_out
    assert len(errors.inputs) >= 5
    assert errors.worst < 0.003
    assert errors.volume.max() < 0.002
    assert case.reduced.counts["points"] < 0.02 * 27 * len(case.model.mesh.cells)


def test_measures_read_its_states(case: Case) -> None:
    answer = case.reduced.solve(0.7 * case.model.pressures[0].pressure)
    state = answer.state()
    assert tg.cavity_volume(state) == pytest.approx(answer.volumes["cavity"], rel=1e-6)
    assert tg.tip_displacement(state) == pytest.approx(np.linalg.norm(answer.tip), rel=1e-5)


def test_tangent_is_the_derivative(case: Case) -> None:
    equations, y, inputs = case.reduced.equations, case.reduced.trained[-1], case.reduced.trained_inputs[-1]
    way, step = np.random.default_rng(1).standard_normal(len(y)), 1e-6
    ends = [equations.at(y + sign * step * way, inputs).residual for sign in (1, -1)]
    difference = (ends[0] - ends[1]) / (2 * step)
    assert equations.at(y, inputs).tangent() @ way == pytest.approx(difference, abs=1e-6 * np.abs(difference).max())


def test_residual_without_sampling_is_the_projected_full_one(case: Case) -> None:
    """Away from equilibrium, where cells lose volume, which the penalty resists."""
    system, box = System(case.model), case.reduced.inputs
    variation = model_variation(case.model, list(box.keys))
    path = Trainer(variation.model, box, 2, EngineOptions(threads=1)).path(box.high, differentiated=False)
    basis, stresses = bases(system, [path], 2)
    whole = assemble(system, drive_of(system, variation.model, inputs_of(case.model, {KEY: (0.0, box.high[0])})),
                     basis, stresses)  # fmt: skip
    q = 0.7 * (basis.dual.T @ path.displacements[-1].ravel())
    s = 1.2 * (stresses.dual.T @ path.mean_stresses[-1])
    residual = whole.equations.at(np.concatenate([q, s]), np.array([1.0, box.high[0]])).residual
    moved = (basis.vectors @ q).reshape(-1, 3) * system.length
    at = system.evaluate(system.unknowns(moved, stresses.vectors @ s * system.stress_scale), 1.0)
    assert not at.contacts.touch
    split = 3 * system.node_count
    lost = at.residual[split : split + system.element.mean_count]
    projected = np.concatenate([basis.vectors.T @ system.by_node(at.residual).ravel(), stresses.vectors.T @ lost])
    assert np.abs(whole.exact.moments.at(np.concatenate([q, s])).forces()).max() > 1e-3 * np.abs(projected).max()
    assert residual == pytest.approx(projected, abs=1e-9 * np.abs(at.residual).sum())
