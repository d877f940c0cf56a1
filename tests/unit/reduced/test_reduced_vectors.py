"""Forces and gravity as inputs: a key without its last number stands for all components that the model may have."""

from functools import cache

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.accuracy.gradients.model_keys import input_numbers, with_number
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import System
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import swept_mesh
from turgor.reduced.reduce import Budget, reduce
from turgor.reduced.states.reduced import Reduced
from turgor.reduced.training.box import inputs_of, with_all_cavities
from turgor.units import MPa, kPa, mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.02 * MPa), density=1100.0)


def finger() -> tg.Model:
    """Half of a chamber of soft rubber, which bends by its weight and by a force on its tip."""
    mesh = swept_mesh(tg.FastPneuNet(chambers=1, length=12 * mm).build(), Fineness(size=6 * mm))
    loads = [tg.Pressure("cavity", 1 * kPa), tg.Gravity(), tg.loads.Force("tip", (0, 0, 0.01))]
    return tg.Model(mesh, {"body": RUBBER, "base": RUBBER}, [tg.Fixed("fixed")], loads)


@cache
def reduced() -> Reduced:
    """Pressure, gravity in any direction of the mirror plane, force on the tip in the mirror plane."""
    box = {"loads.pressure": (0.0, 1e3), "loads.gravity.falling": (-9.81, 9.81), "loads.tip.vector": (-0.01, 0.01)}
    return reduce(finger(), box, budget=Budget(held_out=2, steps=3, paths=12), options=EngineOptions(threads=1))


def test_components_across_the_mirror_plane_are_no_inputs() -> None:
    ends = ("pressure", "gravity.falling.1", "gravity.falling.3", "tip.vector.1", "tip.vector.3")
    assert reduced().inputs.keys == tuple(f"loads.{end}" for end in ends)


def test_held_out_states_agree() -> None:
    assert len(reduced().held_out.inputs) == 8
    assert reduced().held_out.worst < 0.005


def test_answer_is_that_of_the_full_model_with_these_loads() -> None:
    answer = reduced().solve({"pressure": 600.0, "gravity.falling": (3.0, -8.0), "tip.vector": (0.002, 0.005)})
    loads = [
        tg.Pressure("cavity", 600.0), tg.Gravity((3, 0, -8), np.hypot(3, 8)), tg.loads.Force("tip", (0.002, 0, 0.005))
    ]  # fmt: skip
    full = finger()
    true = tg.solve(tg.Model(full.mesh, dict(full.materials), [tg.Fixed("fixed")], loads)).states[-1]
    largest = np.abs(true.displacement).max()
    assert answer.displacement == pytest.approx(true.displacement, abs=0.005 * largest)
    assert tg.tip_displacement(answer.state()) == pytest.approx(tg.tip_displacement(true), rel=0.005)


def test_gravity_keeps_its_direction_without_acceleration() -> None:
    model = finger()
    assert input_numbers(model)["loads.gravity.falling.3"] == pytest.approx(-9.80665)
    for key, value in (("falling.3", 0.0), ("falling.1", 2.0)):
        model = with_number(model, f"loads.gravity.{key}", value)
    assert model.loads[1].falling == (2.0, 0.0, 0.0)


def test_vectors_need_all_their_components() -> None:
    with refused("tip.vector", "3", "2"):
        reduced().solve({"pressure": 1.0, "gravity.falling": (0.0, -9.81), "tip.vector": (0.0, 0.0, 0.01)})


def test_walls_of_all_cavities_may_touch_at_all_inputs():
    """Which cavities are pressed together depends on the pressures; a reduced model has the same parts at all."""
    mesh = tg.mesh(tg.actuators.OmnidirectionalActuator().build(), size=12 * mm, cells="tetrahedra")
    loads = [tg.Pressure(name, 5 * kPa) for name in mesh.cavities]
    model = tg.Model(mesh, materials=dict.fromkeys(mesh.regions, RUBBER), supports=[tg.Fixed("fixed")], loads=loads)
    box = inputs_of(model, {f"loads.{name}.pressure": (0.0, 5e3) for name in mesh.cavities})
    of_all = with_all_cavities(model, box)
    assert model.contact.self_contact.cavities is None
    assert of_all.contact.self_contact.cavities == tuple(mesh.cavities)
    alone = with_number(of_all, box.keys[0], 0.0)
    assert len(System(alone).contact.parts) == len(System(of_all).contact.parts) == 3
    assert len(System(with_number(model, box.keys[0], 0.0)).contact.parts) == 1
