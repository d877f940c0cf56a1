"""A controller in a loop with an actuator that differs from its model."""

import numpy as np
import pytest
from reduced_cases import reduced

import turgor as tg
from refused import refused
from turgor.systems.control.controller import _lagged

PERIOD = 5e-3
AIR = tg.control.Air(delay=10e-3, lag=15e-3)


def slow(count):
    """Wanted places of the tip, slowly from rest to 7 kPa and waiting there."""
    rise = 0.5 * (1 - np.cos(np.pi * np.minimum(np.arange(count) / (0.6 * count), 1.0)))
    table = np.array([reduced().solve(float(pressure)).tip for pressure in np.linspace(0, 7e3, 15)])
    return np.column_stack([np.interp(7e3 * rise, np.linspace(0, 7e3, 15), column) for column in table.T])


def loop(plant, count=120, **given):
    controller = tg.control.Controller(reduced(), period=PERIOD, **given)
    return controller, tg.control.run_loop(controller, plant, slow(count))


def test_a_plant_like_the_model_is_followed_through_delay_and_lag_without_error():
    tuning = tg.control.Tuning(smoothness=1e-12)
    _, run = loop(tg.control.Plant(reduced=reduced(), air=AIR), air=AIR, tuning=tuning)
    assert run.distance[5:].max() < 1e-2 * np.ptp(run.target, axis=0).max()
    _, blind = loop(tg.control.Plant(reduced=reduced(), air=AIR), tuning=tuning)
    assert run.rms() < 0.1 * blind.rms()  # it is the model of the air that does this


def test_the_observer_removes_the_error_of_a_stiffer_plant():
    plant = tg.control.Plant(reduced=reduced(), air=AIR, stiffness=1.1)
    _, run = loop(plant, air=AIR)
    _, without = loop(plant, air=AIR, tuning=tg.control.Tuning(gain=0.0))
    assert run.distance[-1] < 0.02 * without.distance[-1]
    assert run.inputs[-1, 0] == pytest.approx(1.1 * 7e3, rel=5e-3)


def test_commands_fulfill_limits_of_pressure_and_rate():
    limits = tg.control.Limits(high=6e3, rate=60e3)
    controller, run = loop(tg.control.Plant(reduced=reduced(), noise=1e-3), limits=limits)
    assert run.inputs.max() <= 6e3 * (1 + 1e-9)
    assert np.abs(np.diff(run.inputs[:, 0])).max() <= 60e3 * PERIOD * (1 + 1e-9)
    assert np.abs(np.diff(run.inputs[:, 0])).max() > 0.99 * 60e3 * PERIOD  # noise this large drives it there
    assert controller.command == pytest.approx(run.inputs[-1])


def test_lagged_pressures_are_those_of_the_recursion():
    decay, inputs, pressure = 0.6, [3.0, -1.0, 2.0], 0.0
    expected = []
    for each in inputs:
        pressure = decay * pressure + (1 - decay) * each
        expected.append(pressure)
    assert _lagged(3, decay) @ inputs == pytest.approx(expected)


def test_what_makes_no_sense_is_refused():
    with refused("delay", "-1 s"):
        tg.control.Air(delay=-1.0)
    with refused("gain", "2", "0 to 1"):
        tg.control.Tuning(gain=2.0)
    with refused("horizon", 0, 1):
        tg.control.Tuning(horizon=0)
    with refused("period", "0 s"):
        tg.control.Controller(reduced(), period=0.0)
    with refused("(1, 2)", 3, "tip_x"):
        tg.control.Controller(reduced(), period=PERIOD).step([0.0, 0.0], [0.0, 0.0, 0.0])
    with refused("loads.pressure", "12 kPa"):
        plant = tg.control.Plant(reduced=reduced(), stiffness=0.001)
        controller = tg.control.Controller(reduced(), period=PERIOD)
        tg.control.run_loop(controller, plant, slow(40))
