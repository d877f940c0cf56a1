"""A channel with resistance between two cavities of a bar: fluidic lag.

Problems: (1) one cavity is supplied with a constant pressure p₁, the other one fills through the channel; (2) both are
closed, one at a pressure, and equalize; (3) the supply goes up and down, with a valve that opens late; (4) the first
problem with inertia; (5) a pump injects into one cavity evenly.
Exact, for small pressures with volumes V = V₀ + C p: (1) p₂ = p₁ (1 − exp(−t/(R C₂₂))); (2) the difference decays with
the rate eᵀ C⁻¹ e/R, e = (1, −1), and no liquid is lost; (3) nothing flows before the valve opens; (4) as (1), when the
bar is stiff and light; (5) C p' = (Q, 0) + e (p₂ − p₁)/R by a matrix exponential, and no liquid is lost. C is that of
the same mesh, from two states at given pressures.
Tolerance: second order in the step, and 2e-3 at 32 steps. What the volumes are not linear in the pressure is 1e-4.
"""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

import meshes
import problems
import turgor as tg
from refused import refused
from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.core.solvers.checks.early_findings import check_before_solve
from turgor.core.solvers.procedures.dynamic import Dynamic

NAMES, PRESSURE, TIME = ("cavity_1", "cavity_2"), 20.0, 0.5
OPEN = [tg.Pressure(name, PRESSURE, history="constant") for name in NAMES]


def bar(*loads, density=None):
    material = problems.rubber(problems.NEO_HOOKE, density=density)
    return tg.Model(meshes.two_cavities(), {"body": material}, [tg.Fixed("x0")], loads)


@pytest.fixture(scope="module")
def compliance():
    """Derivatives of the volumes by the pressures [m³/Pa]."""
    columns = []
    for name in NAMES:
        state = problems.solve(bar(tg.Pressure(name, PRESSURE))).states[-1]
        columns.append((volumes(state) - volumes(state, 0.0)) / PRESSURE)
    return np.array(columns).T


def volumes(state, share=1.0):
    mesh = state.model.mesh
    return np.array([cavity_volume(mesh, name, share * state.displacement) for name in NAMES])


def channel(resistance, **more):
    return tg.loads.Channel(between=NAMES, resistance=resistance, **more)


def steps(count, **more):
    return tg.Static(duration=TIME, first_step=1 / count, max_step=1 / count, tolerance=1e-9, **more)


def test_a_cavity_fills_through_a_channel(compliance, record_verification):
    resistance = TIME / 2 / compliance[1, 1]  # two time constants
    model, exact = bar(OPEN[0], channel(resistance)), PRESSURE * (1 - np.exp(-2))
    errors = []
    for count in (16, 32):
        solution = problems.solve(model, steps(count))
        errors.append(solution.states[-1].pressures["cavity_2"] / exact - 1)
    order = np.log2(errors[0] / errors[1])
    record_verification(
        "pressure of a cavity that fills through a channel over that of two linear chambers; order in the step",
        "exact", [1, 2], [1 + errors[1], order], "2e-3, 0.3",
    )  # fmt: skip
    assert errors[1] == pytest.approx(0, abs=2e-3)
    assert order == pytest.approx(2, abs=0.3)
    assert solution.states[-1].time == pytest.approx(TIME)


def test_two_closed_cavities_equalize(compliance, record_verification):
    e = np.array([1.0, -1.0])
    resistance = TIME / 1.5 * e @ np.linalg.solve(compliance, e)
    stages = tg.Stages(
        [
            tg.Stage("fill", tg.Static(), loads=[tg.Pressure("cavity_1", PRESSURE)]),
            tg.Stage("equalize", steps(16), loads=[channel(resistance)]),
        ]
    )
    states = problems.solve(bar(), stages).states
    last = states[-1]
    got = (last.pressures["cavity_1"] - last.pressures["cavity_2"]) / PRESSURE
    record_verification(
        "two closed cavities with a channel: share of the difference of their pressures left", "exact",
        np.exp(-1.5), got, "3e-3",
    )  # fmt: skip
    assert got == pytest.approx(np.exp(-1.5), rel=3e-3)
    start = next(state for state in states if state.load_factor == 1)
    assert volumes(last).sum() == pytest.approx(volumes(start).sum(), rel=1e-9)
    assert volumes(last)[0] < volumes(start)[0]


def test_a_valve_opens_late(compliance):
    resistance = TIME / 8 / compliance[1, 1]
    valve = channel(resistance, history=[(0.0, 0.0), (0.5, 0.0), (0.6, 1.0), (1.0, 1.0)])
    supply = replace(OPEN[0], history=[(0.0, 0.0), (0.1, 1.0), (1.0, 1.0)])
    states = problems.solve(bar(supply, valve), steps(20)).states
    shut = [state for state in states if state.load_factor <= 0.5]
    rest = volumes(states[0], 0.0)[1]
    assert [volumes(state)[1] / rest for state in shut] == pytest.approx([1.0] * len(shut), abs=1e-9)
    assert shut[-1].pressures["cavity_2"] == pytest.approx(-PRESSURE * compliance[1, 0] / compliance[1, 1], rel=1e-3)
    assert 0.5 * PRESSURE < states[-1].pressures["cavity_2"] < PRESSURE


def test_a_cavity_fills_in_motion(compliance, record_verification):
    resistance = TIME / 2 / compliance[1, 1]
    procedure = Dynamic(
        duration=TIME, first_step=TIME / 16, max_step=TIME / 16, adaptive=False, tolerance=1e-9, spectral_radius=0.0
    )
    solution = problems.solve(bar(OPEN[0], channel(resistance), density=1e-2), procedure)
    got, exact = solution.states[-1].pressures["cavity_2"] / PRESSURE, 1 - np.exp(-2)
    record_verification("the same with inertia", "exact", exact, got, "2e-3")
    assert got == pytest.approx(exact, rel=2e-3)


@pytest.mark.parametrize(("constants", "said"), [(1.0, False), (8.0, True), (400.0, False)])
def test_steps_that_are_long_for_a_channel_are_reported(compliance, constants, said):
    """Four steps over so many time constants: R dV/dp stands in the finding."""
    resistance = TIME / constants / compliance[1, 1]
    findings = problems.solve(bar(OPEN[0], channel(resistance)), steps(4)).findings
    long = [each.message for each in findings if each.code == "L15"]
    assert bool(long) is said
    if said:
        assert "Steps of 0.125 s" in long[0]
        assert f"= {TIME / constants:.2g}" in long[0]


def test_a_pump_fills_both_cavities(compliance, record_verification):
    e, flow = np.array([1.0, -1.0]), 2 * PRESSURE * compliance[0, 0] / TIME
    rates = np.linalg.inv(compliance)
    resistance = TIME / 2 * e @ rates @ e
    grown = np.block(
        [[-rates @ np.outer(e, e) / resistance, (rates @ [[flow], [0]])], [np.zeros((1, 3))]]
    )  # of the pressures and 1
    exact = (expm(grown * TIME) @ [0, 0, 1])[:2]
    pump = tg.VolumeControl(
        volume={"cavity_1": flow * TIME}, duration=TIME, first_step=1 / 16, max_step=1 / 16, tolerance=1e-9
    )
    states = problems.solve(bar(channel(resistance)), pump).states
    got = np.array([states[-1].pressures[name] for name in NAMES]) / exact
    record_verification("pressures of two cavities into one of which a pump injects", "exact", [1, 1], got, "3e-3")
    assert got == pytest.approx([1, 1], abs=3e-3)
    assert (volumes(states[-1]) - volumes(states[0], 0.0)).sum() == pytest.approx(flow * TIME, rel=1e-6)


def test_what_moves_nothing_is_refused():
    with refused("cavity_1 and cavity_2", "moves nothing", "pressure load"):
        check_before_solve(bar(*OPEN, channel(1e9)), steps(4))
    for procedure in (tg.Static(), tg.VolumeControl(volume={"cavity_1": 1e-8}), tg.ArcLength()):
        with refused("cavity_1 and cavity_2", "needs time", "procedure.duration", "dynamic"):
            check_before_solve(bar(channel(1e9)), procedure)
    with refused("cavity_3", "cavity_1"):
        bar(tg.loads.Channel(between=("cavity_1", "cavity_3"), resistance=1e9))
    with refused("between is", "two cavities"):
        tg.loads.Channel(between=("cavity_1", "cavity_1"), resistance=1e9)
    with refused("between is", "two cavities"):
        tg.loads.Channel(between=(1, 2), resistance=1e9)
    with refused("resistance is -1", "above 0"):
        tg.loads.Channel(between=NAMES, resistance=-1)
