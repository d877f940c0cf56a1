"""Volumes and amounts of gas as conditions of a reduced model give what pressures give."""

from dataclasses import replace

import numpy as np
import pytest
from reduced_cases import finger, reduced

import turgor as tg
from refused import refused
from turgor.core.engine.runtime import EngineOptions
from turgor.core.solvers.procedures.gas_mass import STANDARD_ATMOSPHERE
from turgor.reduced.states.controlled import Controlled, Volumes, at_gas, at_volumes


def at_rest() -> float:
    """Volume at rest [m³]."""
    return reduced().solve(0.0).volumes["cavity"]


@pytest.mark.parametrize("pressure", [1500.0, 9000.0])
def test_volume_of_a_pressure_gives_the_pressure_back(pressure):
    answer = reduced().solve(pressure)
    back = at_volumes(reduced(), {"cavity": answer.volumes["cavity"] - at_rest()})
    assert back.inputs[0] == pytest.approx(pressure, rel=1e-4)
    assert back.volumes["cavity"] == pytest.approx(answer.volumes["cavity"], rel=1e-6)


def test_injected_volume_and_gas_are_those_of_the_full_model():
    injected = 0.5 * (reduced().solve(9e3).volumes["cavity"] - at_rest())
    options, free = EngineOptions(threads=1), replace(finger(), loads=())
    full = tg.solve(free, tg.VolumeControl(volume=injected, first_step=0.25, max_step=0.25), options=options)
    answer = at_volumes(reduced(), {"cavity": injected})
    assert answer.inputs[0] == pytest.approx(full.states[-1].pressures["cavity"], rel=0.005)
    gas = at_gas(reduced(), {"cavity": 1.3})
    absolute = gas.inputs[0] + STANDARD_ATMOSPHERE
    assert absolute * gas.volumes["cavity"] == pytest.approx(1.3 * STANDARD_ATMOSPHERE * at_rest(), rel=1e-5)
    full = tg.solve(free, tg.GasMass(mass_ratio=1.3, first_step=0.25, max_step=0.25), options=options)
    assert gas.inputs[0] == pytest.approx(full.states[-1].pressures["cavity"], rel=0.005)


def test_tangent_with_conditions_is_the_derivative():
    e, random = reduced().equations, np.random.default_rng(1)
    more = {"cavities": np.array([0]), "places": np.array([1]), "widths": np.array([12e3])}
    controlled = Controlled(
        e.parts, e.cubics, e.pressures, e.forces, e.compliance, law=Volumes(np.array([3.0])), **more
    )
    y, inputs = np.append(reduced().trained[5], 0.4), np.array([1.0, 0.0])
    way, step = random.standard_normal(len(y)), 1e-6
    ends = [controlled.at(y + sign * step * way, inputs).residual for sign in (1, -1)]
    difference = (ends[0] - ends[1]) / (2 * step)
    assert controlled.at(y, inputs).tangent() @ way == pytest.approx(difference, abs=1e-6 * np.abs(difference).max())


def test_conditions_that_cannot_be_are_refused():
    with refused("cavty", "cavity"):
        at_volumes(reduced(), {"cavty": 1e-6})
    with refused("loads.pressure"):
        at_volumes(reduced(), {"cavity": 1e-7}, {"pressure": 1e3})
    with refused("-1000 mL", "cavity"):
        at_volumes(reduced(), {"cavity": -1e-3})
    with refused("cavity", "-1"):
        at_gas(reduced(), {"cavity": -1.0})
    with pytest.raises(tg.TurgorError):
        at_volumes(reduced(), {"cavity": 1e-4})
