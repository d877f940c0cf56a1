"""A reduced model of rubber that relaxes and softens follows a history of pressure as the full model does."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from reduced_cases import KEY, box, finger, trained

import turgor as tg
from turgor.accuracy.gradients.model_keys import model_variation
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import System
from turgor.core.model.model import Model
from turgor.reduced.parts.points import Points
from turgor.reduced.states.reduced import Reduced
from turgor.reduced.training.trainer import Trainer

POINTS, PRESSURE = [(0.0, 0.0), (2.0, 1.0), (4.0, 1.0), (7.0, 0.3), (10.0, 0.6)], 9e3


@cache
def lossy() -> Model:
    """The finger of a rubber that relaxes and softens."""
    model = finger()
    series = tg.laws.Prony(g=(0.2, 0.1), tau=(0.5, 4.0), moduli="long_term")
    more = {"viscoelasticity": series, "stress_softening": tg.laws.Mullins(r=2.0, m=2e3)}
    materials = {name: replace(material, **more) for name, material in model.region_materials.items()}
    supports = [each for each in model.supports if not each.mirror]
    return tg.Model(
        model.mesh, supports=supports, materials=dict(model.materials) | materials, loads=model.loads,
        contact=model.contact,
    )  # fmt: skip


@cache
def reduced_lossy() -> Reduced:
    """Its reduced model, in twelve modes of one slow path, and one sudden load and unloading."""
    trainer = Trainer(model_variation(lossy(), [KEY]).model, box(), 8, EngineOptions(threads=1))
    return trained(lossy(), System(lossy()), trainer.path(np.array([12e3])), 12)


def test_history_of_pressure_is_that_of_the_full_model():
    loads = [replace(load, pressure=PRESSURE, history=tg.over_time(POINTS, 10.0)) for load in lossy().loads]
    procedure = tg.Static(duration=10.0, first_step=0.05, max_step=0.05)
    full = tg.solve(replace(lossy(), loads=loads), procedure, options=EngineOptions(threads=1)).states
    times = np.array([state.time for state in full])
    pressures = np.interp(times, *zip(*((time, share * PRESSURE) for time, share in POINTS), strict=True))
    followed = reduced_lossy().follow(times, {"pressure": pressures})
    largest = max(np.abs(state.displacement).max() for state in full)
    errors = [
        np.abs(answer.displacement - state.displacement).max() / largest
        for answer, state in zip(followed.answers, full, strict=True)
    ]
    assert max(errors) < 0.02
    slow = reduced_lossy().solve(0.6 * PRESSURE)
    assert np.abs(slow.displacement - full[-1].displacement).max() / largest > 0.03  # the history matters


def test_tangent_with_internal_variables_is_the_derivative():
    points = next(part for part in reduced_lossy().equations.parts if isinstance(part, Points))
    r = points.gradients.shape[2]
    q, way, step = reduced_lossy().trained[5, :r], np.random.default_rng(2).standard_normal(r), 1e-6
    later = points.stepped(0.3).at(q).remembered().stepped(0.7)
    there = 0.8 * q
    ends = [later.at(there + sign * step * way).forces() for sign in (1, -1)]
    difference = (ends[0] - ends[1]) / (2 * step)
    assert later.at(there).tangent(None) @ way == pytest.approx(difference, abs=1e-5 * np.abs(difference).max())
    assert np.abs(later.at(there).forces() - points.at(there).forces()).max() > 1e-3 * np.abs(difference).max()


def test_file_has_no_internal_variables_and_answers_the_same(tmp_path):
    again = tg.load(reduced_lossy().save(tmp_path / "lossy"))
    times, pressures = [0.0, 1.0, 2.0], {"pressure": [0.0, 6e3, 2e3]}
    tips = [each.follow(times, pressures).tip for each in (reduced_lossy(), again)]
    assert tips[0] == pytest.approx(tips[1], abs=3e-6 * np.abs(tips[1]).max())  # modes of 16 bits
