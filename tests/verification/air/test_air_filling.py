"""Networks of air and liquid against closed forms: filling, emptying, tubes, waves.

Problems: a rigid vessel of 18 mL fills from a constant supply through a restriction (ISO 6358, m = 0.5); an insulated
one empties through a choked nozzle, and fills from vacuum; gas flows through a laminar tube; a tube of 1 m passes a
step of pressure, and vibrates with a vessel at its end.
Exact: p = p₀ + C p_ref pₛ t/V until p = b pₛ, then p/pₛ = b + (1 − b) sin(C p_ref (t − t₁)/(V (1 − b)));
p/p₀ = (1 + (γ−1)/2 · t/τ)^(−2γ/(γ−1)); the temperature γ Tₛ; ṁ = π d⁴ (p₁² − p₂²)/(256 μ L R T); the delay L/c and
Helmholtz's frequency.
Tolerance: the first 1e-9 and the others 1e-6, for the equations are the same and only the integration differs; the
delay of a line of 80 segments 3 %, and Helmholtz's frequency 1 %, for its formula neglects the air in the tube.
"""

from dataclasses import replace

import numpy as np
import pytest

import turgor as tg
from turgor.units import mm

AMBIENT = 101_325.0
T = 293.15
R, GAMMA = tg.air.AIR.gas_constant, tg.air.AIR.heat_ratio


def vessel(supply, start=0.0, conductance=1e-9, **more):
    passage = tg.air.Restriction(conductance=conductance, critical_ratio=0.3)
    nodes = {"supply": tg.air.Supply(supply - AMBIENT), "tank": tg.air.Chamber(18e-6, start, **more)}
    return tg.air.Network(nodes=nodes, parts={"valve": tg.air.Connection("supply", "tank", passage)})


def test_isothermal_filling(record_verification):
    """Choked, then subsonic; up to 99.9 % of the supply, where flow becomes laminar."""
    supply, b, scale = 600e3, 0.3, 1e-9 * 100e3 / 18e-6
    t1 = (b * supply - AMBIENT) / (scale * supply)
    t2 = t1 + np.arcsin((0.999 - b) / (1 - b)) * (1 - b) / scale
    time = np.linspace(0.0, t2, 400)
    exact = np.where(
        time < t1,
        AMBIENT + scale * supply * time,
        supply * (b + (1 - b) * np.sin((time - t1) * scale / (1 - b))),
    )
    run = tg.air.simulate(vessel(supply), t2, times=time, tolerance=1e-12)
    error = np.abs(run.pressure("tank") + AMBIENT - exact).max() / supply
    record_verification("vessel fills, choked then subsonic: error of the pressure", "exact", 0.0, error, "1e-9")
    assert error < 1e-9
    assert run.balance() < 1e-9
    assert abs(tg.air.simulate(vessel(supply), t2, times=time).pressure("tank") + AMBIENT - exact).max() < 3e-5 * supply


def test_insulated_vessel_empties(record_verification):
    """Choked all the way to twice the pressure outside."""
    volume, start, area = 18e-6, 900e3, np.pi / 4 * (0.5 * mm) ** 2
    nozzle = tg.air.Orifice(diameter=0.5 * mm, discharge=1.0)
    choked = np.sqrt(GAMMA) * (2 / (GAMMA + 1)) ** ((GAMMA + 1) / (2 * (GAMMA - 1)))
    tau = volume / (area * choked * np.sqrt(R * T))
    g = GAMMA
    end = tau * 2 / (g - 1) * ((200e3 / start) ** (-(g - 1) / (2 * g)) - 1)
    time = np.linspace(0.0, end, 200)
    exact = start * (1 + (g - 1) / 2 * time / tau) ** (-2 * g / (g - 1))
    for process in ("adiabatic", "isentropic"):
        network = tg.air.Network(
            nodes={"tank": tg.air.Chamber(volume, start - AMBIENT, process=process)},
            parts={"hole": tg.air.Connection("tank", "ambient", nozzle)},
        )
        run = tg.air.simulate(network, end, times=time, tolerance=1e-10)
        error = np.abs((run.pressure("tank") + AMBIENT) / exact - 1).max()
        record_verification(f"insulated vessel empties, {process}: error of the pressure", "exact", 0.0, error, "1e-6")
        assert error < 1e-6
        cold = T * (exact / start) ** ((g - 1) / g)
        assert run.temperature("tank") == pytest.approx(cold, rel=1e-6)
    assert run.balance() < 1e-9


def test_evacuated_vessel_gets_hot(record_verification):
    """From vacuum it fills to γ times the temperature of the supply; with much heat exchange it stays cold."""
    low = 1e-4
    run = tg.air.simulate(vessel(AMBIENT, low - AMBIENT, process="adiabatic"), 2.0, tolerance=1e-10)
    hot = run.temperature("tank")[-1]
    record_verification("insulated vessel fills from vacuum: temperature [K]", "exact", GAMMA * T, hot, "1e-6")
    assert hot == pytest.approx(GAMMA * T, rel=1e-6)
    cooled = tg.air.simulate(vessel(600e3, process="adiabatic", heat=1e4), 0.3)
    slow = tg.air.simulate(vessel(600e3), 0.3)
    assert cooled.pressure("tank") == pytest.approx(slow.pressure("tank"), abs=200.0)


def test_laminar_tube(record_verification):
    d, length, mu, high, low = 0.5 * mm, 1.0, tg.air.AIR.viscosity, 110e3, 101_325.0
    exact = np.pi * d**4 * (high**2 - low**2) / (256 * mu * length * R * T)
    network = tg.air.Network(
        nodes={"supply": tg.air.Supply(high - AMBIENT), "tank": tg.air.Chamber(1e-3)},
        parts={"tube": tg.air.Connection("supply", "tank", tg.air.Tubing(diameter=d, length=length))},
    )
    flow = tg.air.simulate(network, 1.0).flow("tube")[0]
    record_verification("laminar tube: mass flow [kg/s]", "exact", exact, flow, "1e-6")
    assert flow == pytest.approx(exact, rel=1e-6)
    water = tg.air.Tubing(diameter=d, length=length).law(tg.air.WATER)(high, low, T)
    density = tg.air.WATER.density((high + low) / 2, T)
    assert water == pytest.approx(density * np.pi * d**4 * (high - low) / (128 * 1.002e-3 * length), rel=1e-9)


def test_turbulent_tube():
    """Blasius' friction: the pressure that it takes belongs to the flow."""
    tube = tg.air.Tubing(diameter=4 * mm, length=5.0)
    high, low = 150e3, 130e3
    flow = tube.law(tg.air.WATER)(high, low, T)
    density = tg.air.WATER.density((high + low) / 2, T)
    assert 4 * flow / (np.pi * 4 * mm * 1.002e-3) > 3000
    assert tube.pressure_loss(tg.air.WATER, flow, density) == pytest.approx(high - low, rel=1e-9)


def line(volume, segments, step=200.0, fluid=tg.air.AIR):
    push = tg.air.Signal((0.0, 1e-3), (0.0, step))
    return tg.air.Network(
        nodes={"supply": tg.air.Supply(push), "end": tg.air.Chamber(volume, process="isentropic")},
        parts={"line": tg.air.LongLine("supply", "end", 4 * mm, 1.0, segments)},
        fluid=fluid,
    )


def test_delay_of_a_line(record_verification):
    """A small step arrives after L/c: when half of its doubled height at the closed end is there."""
    time = np.linspace(0.0, 6e-3, 601)
    pressure = tg.air.simulate(line(1e-9, 80), 6e-3, times=time).pressure("end")
    exact = 1.0 / tg.air.speed_of_sound(tg.air.AIR, T)
    delay = float(np.interp(0.5 * pressure.max(), pressure[: pressure.argmax()], time[: pressure.argmax()])) - 1e-3
    record_verification("line of 1 m: delay [s]", "exact", exact, delay, "3 %")
    assert delay == pytest.approx(exact, rel=0.03)


def test_helmholtz(record_verification):
    """Tube of 4 mm with a vessel of 1 L at its end, without friction: half a period after the step it is fullest."""
    thin = replace(tg.air.AIR, viscosity=1e-9)
    area = np.pi / 4 * (4 * mm) ** 2
    exact = tg.air.speed_of_sound(thin, T) / (2 * np.pi) * np.sqrt(area / (1e-3 * 1.0))
    time = np.linspace(0.0, 0.8 / exact, 1001)
    pressure = tg.air.simulate(line(1e-3, 6, 1.0, thin), time[-1], times=time).pressure("end")
    frequency = 0.5 / (time[pressure.argmax()] - 1e-3)
    record_verification("tube and vessel: frequency [Hz]", "exact, no air in the tube", exact, frequency, "1 %")
    assert frequency == pytest.approx(exact, rel=0.01)
