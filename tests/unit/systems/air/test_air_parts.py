"""Parts of networks: what valves, regulators, pumps and leaks let through."""

from dataclasses import replace

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.systems.air.equations import Equations
from turgor.systems.air.signals import switched
from turgor.units import kPa, mL, mm

AMBIENT = 101_325.0
C = tg.air.Restriction(conductance=0.5e-8)


def network(fluid=tg.air.AIR, supply=200 * kPa, volume=50 * mL, start=0.0, **parts):
    nodes = {"supply": tg.air.Supply(supply), "tank": tg.air.Chamber(volume, start)}
    return tg.air.Network(nodes=nodes, parts=parts, fluid=fluid)


def end_of(net, until=2.0, name="tank"):
    return float(tg.air.simulate(net, until, times=[until]).pressure(name)[-1])


def test_delays_shift_edges_and_swallow_short_pulses():
    command = tg.air.Signal((0.0, 0.1, 0.3, 0.305), (0.0, 1.0, 0.0, 1.0))
    times, states = switched(lambda t: command.at(t) > 0.5, command.breaks(1.0), 0.01, 0.02)
    assert times == [0.0, 0.11]
    assert states == [False, True]
    net = network(valve=tg.air.OnOffValve("supply", "tank", C, command, on_delay=0.01))
    run = tg.air.simulate(net, 0.2, times=[0.0, 0.1, 0.109, 0.111, 0.2])
    assert (run.pressure("tank") > 10.0).tolist() == [False, False, False, True, True]


def test_pulses_let_through_their_share():
    """Choked: half of the pulses is half of the flow."""
    whole = network(supply=600 * kPa, volume=1.0, valve=tg.air.Connection("supply", "tank", C))
    pulses = network(supply=600 * kPa, volume=1.0, valve=tg.air.OnOffValve("supply", "tank", C, tg.air.Pwm(50.0, 0.5)))
    first, second = (tg.air.simulate(net, 1.0).received("tank")[-1] for net in (whole, pulses))
    assert second == pytest.approx(first / 2, rel=1e-4)
    assert len(Equations(pulses, 1.0).breaks) == 99


def test_three_way_valve_fills_holds_and_vents():
    command = tg.air.Signal((0.0, 0.5, 1.0), (1.0, 0.0, -1.0))
    for more in ({}, {"proportional": True, "time_constant": 0.01}):
        net = network(valve=tg.air.ThreeWayValve("supply", "tank", C, command, **more))
        run = tg.air.simulate(net, 2.5, times=[0.0, 0.5, 0.6, 0.99, 2.5])
        p = run.pressure("tank")
        assert p[1] > 100 * kPa
        assert p[3] == pytest.approx(p[2], rel=0.02)
        assert p[4] == pytest.approx(0.0, abs=200.0)
        assert run.balance() < 1e-9


def test_a_proportional_valve_opens_in_part():
    command = tg.air.Signal((0.0,), (0.6,))
    valve = tg.air.ProportionalValve("supply", "tank", C, command, dead_band=0.2)
    net = network(supply=600 * kPa, volume=1.0, valve=valve)
    run = tg.air.simulate(net, 0.1)
    assert run.flow("valve")[0] == pytest.approx(0.5 * C.law(tg.air.AIR)(701_325.0, AMBIENT, 293.15), rel=1e-6)


def test_a_check_valve_stops_flow_back():
    check = tg.air.CheckValve("supply", "tank", C, cracking=5 * kPa, full=10 * kPa)
    assert end_of(network(check=check)) == pytest.approx(195 * kPa, rel=1e-3)
    assert end_of(network(start=300 * kPa, check=check)) == pytest.approx(300 * kPa)
    with refused("cracking", "2000", "1000"):
        tg.air.CheckValve("supply", "tank", C, cracking=2000.0, full=1000.0)


@pytest.mark.parametrize("order", [0, 1, 2])
def test_a_regulator_reaches_its_pressure(order):
    steps = tg.air.Signal((0.0, 1.0), (80 * kPa, 40 * kPa))
    regulator = tg.air.Regulator(
        "supply", "tank", C, steps, band=2 * kPa, exhaust="ambient", order=order, frequency=300
    )
    run = tg.air.simulate(network(reg=regulator), 3.0, times=[0.0, 0.99, 3.0])
    p = run.pressure("tank")
    assert p[1] == pytest.approx(80 * kPa, rel=0.02)
    assert p[2] == pytest.approx(41 * kPa, rel=0.02)


def test_a_regulator_without_exhaust_does_not_relieve():
    regulator = tg.air.Regulator("supply", "tank", C, 40 * kPa)
    assert end_of(network(start=100 * kPa, reg=regulator)) == pytest.approx(100 * kPa)


def test_a_pump_reaches_the_end_of_its_curve():
    pump = tg.air.Pump("ambient", "tank", rise=(0.0, 30e3), volume_flow=(2e-5, 0.0))
    nodes = {"tank": tg.air.Chamber(10 * mL)}
    assert end_of(tg.air.Network(nodes=nodes, parts={"pump": pump}), 5.0) == pytest.approx(30e3, rel=1e-3)
    with refused("volume_flow", "1e-05"):
        replace(pump, volume_flow=(2e-5, 1e-5))


def test_a_leak_has_the_flow_that_was_measured():
    law = tg.air.leak("tank", 1e-6, 50 * kPa).passage.law(tg.air.AIR)
    assert law(150e3, 100e3, 293.15) == pytest.approx(1e-6 * tg.air.AIR.reference_density)
    assert end_of(network(start=50 * kPa, leak=tg.air.leak("tank", 1e-6, 50 * kPa), on=_closed()), 100.0) < 10 * kPa


def _closed():
    return tg.air.OnOffValve("supply", "tank", C, tg.air.Signal((0.0, 99.0), (0.0, 1.0)), on_delay=2.0)


def test_other_gases_flow_by_their_speed():
    air, helium = (tg.air.FLUIDS[name] for name in ("air", "helium"))
    rates = [C.law(gas)(500e3, 100e3, 293.15) / gas.reference_density for gas in (air, helium)]
    assert rates[1] / rates[0] == pytest.approx(np.sqrt(2077.1 / 287.05) * 0.7262 / 0.6847, rel=1e-3)
    with refused("conductance", "water"):
        C.law(tg.air.WATER)


def test_water_fills_through_an_orifice_and_a_tube():
    """√(2 ρ Δp) is the speed of a jet."""
    flow = tg.air.Orifice(diameter=1 * mm, discharge=0.6).law(tg.air.WATER)(200e3, 100e3, 293.15)
    assert flow == pytest.approx(0.6 * np.pi / 4 * 1e-6 * np.sqrt(2 * 998.2 * 100e3), rel=1e-4)


def test_coupled_chambers_press_each_other():
    p = np.linspace(-5e3, 60e3, 14)
    first, second = np.meshgrid(p, p, indexing="ij")
    volumes = np.stack([10e-6 + 2e-10 * first - 5e-11 * second, 10e-6 + 2e-10 * second - 5e-11 * first], axis=-1)
    table = tg.air.Coupled([p, p], volumes)
    nodes = {
        "supply": tg.air.Supply(40e3),
        "a": tg.air.Chamber(table.chamber(0)),
        "b": tg.air.Chamber(table.chamber(1)),
    }
    parts = {"valve": tg.air.Connection("supply", "a", C), "leak": tg.air.leak("b", 1e-12, 50e3)}
    run = tg.air.simulate(tg.air.Network(nodes=nodes, parts=parts), 0.5)
    pb = run.pressure("b")[-1]
    assert run.pressure("a")[-1] == pytest.approx(40e3, rel=1e-3)
    assert (AMBIENT + pb) * (10e-6 + 2e-10 * pb - 5e-11 * 40e3) == pytest.approx(AMBIENT * 10e-6, rel=1e-4)
    assert run.volume("a")[-1] == pytest.approx(10e-6 + 2e-10 * 40e3 - 5e-11 * pb, rel=1e-4)
    assert run.balance() < 1e-9
    with refused("chamber 2", "0 to 1"):
        table.chamber(2)


def test_the_jacobian_is_that_of_the_rates():
    """Every kind of store and own state; differences over all of the rates are the reference."""
    p = np.linspace(-5e3, 60e3, 5)
    first, second = np.meshgrid(p, p, indexing="ij")
    table = tg.air.Coupled([p, p], np.stack([1e-5 + 2e-10 * first - 5e-11 * second, 1e-5 + 2e-10 * second], axis=-1))
    nodes = {
        "supply": tg.air.Supply(40e3),
        "hot": tg.air.Chamber(tg.air.VolumeCurve([0.0, 60e3], [1e-5, 2e-5]), 5e3, process="adiabatic", heat=0.1),
        "a": tg.air.Chamber(table.chamber(0), 9e3), "b": tg.air.Chamber(table.chamber(1), 2e3, process=1.2),
    }  # fmt: skip
    parts = {
        "reg": tg.air.Regulator("supply", "hot", C, 30e3, order=2, exhaust="ambient"),
        "line": tg.air.LongLine("hot", "a", 2 * mm, 1.0, 2),
        "tube": tg.air.Connection("a", "b", tg.air.Tubing(diameter=1 * mm, length=1.0)),
    }
    equations = Equations(tg.air.Network(nodes=nodes, parts=parts), 1.0)
    y = equations.first + 1e-3 * equations.scales * np.linspace(-1.0, 1.0, equations.size)
    expected = np.zeros((equations.size, equations.size))
    for k, step in enumerate(1e-6 * equations.scales):
        high, low = (np.array(equations.rates(0.0, y + sign * step * np.eye(len(y))[k])) for sign in (1, -1))
        expected[:, k] = (high - low) / (2 * step)
    unit = np.outer(1 / equations.scales, equations.scales)
    assert equations.jacobian(0.0, y) * unit == pytest.approx(expected * unit, rel=1e-3, abs=1e-3)
