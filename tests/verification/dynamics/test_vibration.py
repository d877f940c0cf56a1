"""V15: damped and undamped free vibration, the order of the time integration, energies; slow ramps are static.

Problems and references: (1) the strip of V15 plucked in its first mode, Rayleigh damping α = 1/s and β = 1 ms: the
logarithmic decrement is 2πζ/√(1−ζ²) with ζ = α/(2ω) + βω/2, 0.19895 for the 4.8345 Hz of `test_frequencies`; (2) the
same without damping for 20 cycles; (3) the strip driven far by a smooth weight: errors at the end against steps an
eighth as long; (4) the same weight put on slowly, within 20 periods: the static path.
Tolerance: (1) decrement 1 %, (2) drift of the energy 0.1 %, (3) order 2 within 0.1, (4) 1 % of the path, kinetic energy
1 % of the strain energy. Coarse meshes: the statements hold for each mesh's own frequency.
"""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import problems
import turgor as tg
import vibrations
from turgor.core.model.history import share_at
from turgor.core.solvers.dynamics.modes import natural_frequencies
from turgor.core.solvers.energies import imbalance
from turgor.core.solvers.procedures.dynamic import Dynamic

SMOOTH = "s**2 * (3 - 2*s)"


def test_decrement(record_verification):
    model = vibrations.strip()
    frequency, procedure = vibrations.plucked(
        model, 0.5e-3, 2.3, 60, mass_damping=1.0, stiffness_damping=1e-3, spectral_radius=0.9
    )
    solution = problems.solve(model, procedure)
    times = [state.time for state in solution.states]
    curve = CubicSpline(times, [state.displacement[vibrations.tip(model), 1] for state in solution.states])
    turns = curve.derivative().roots(extrapolate=False)
    peaks = np.abs(curve(turns[turns > 0]))
    result = 2 * float(np.log(peaks[0] / peaks[-1])) / (len(peaks) - 1)
    omega = 2 * np.pi * frequency
    damping = 1.0 / (2 * omega) + 1e-3 * omega / 2
    expected = 2 * np.pi * damping / np.sqrt(1 - damping**2)
    record_verification(
        claim="plucked strip with Rayleigh damping: logarithmic decrement",
        source="V15, exact",
        expected=expected,
        got=result,
        tolerance="1 %",
    )
    assert len(peaks) == 5
    assert result == pytest.approx(expected, rel=0.01)
    assert result == pytest.approx(0.19895, rel=0.01)
    assert imbalance(solution.states) < 1e-3
    assert solution.states[-1].energies.dissipated > 0.4 * solution.states[0].energies.kinetic


@pytest.mark.parametrize("radius", [1.0, 0.9])
def test_energy_over_twenty_cycles(radius, record_verification):
    model = vibrations.strip((4, 1, 1))
    _, procedure = vibrations.plucked(model, 0.5e-3, 20, 40, spectral_radius=radius)
    states = problems.solve(model, procedure).states
    energies = np.array([state.energies.kinetic + state.energies.strain for state in states])
    drift = float(np.abs(energies / energies[0] - 1).max())
    record_verification(
        claim=f"plucked strip without damping, spectral radius {radius:g}: drift of the energy over 20 cycles",
        source="V15, exact",
        expected=0.0,
        got=drift,
        tolerance="0.1 %",
    )
    assert drift < 1e-3
    assert imbalance(states) < 1e-3


def _fall(model, duration, **more):
    return problems.solve(model, Dynamic(duration=duration, tolerance=1e-7, **more))


@pytest.mark.parametrize("radius", [1.0, 0.8])
def test_order(radius, record_verification):
    """A weight that grows within one period moves the tip by a seventh of the length, with some damping."""
    model = vibrations.strip((3, 1, 1), [tg.Gravity((0, -1, 0), 40.0, SMOOTH)])
    period = 1 / 4.83
    ends = []
    for steps in (20, 40, 320):
        step = period / steps
        more = {"adaptive": False, "spectral_radius": radius, "stiffness_damping": 2e-3, "keep": 1000}
        ends.append(_fall(model, period, first_step=step, max_step=step, **more).states[-1])

    def order(of):
        errors = [np.abs(of(end) - of(ends[-1])).max() for end in ends[:-1]]
        return float(np.log2(errors[0] / errors[1]))

    results = [order(lambda s: s.displacement), order(lambda s: s.velocity), order(lambda s: s.mean_stress)]
    record_verification(
        claim=f"order of the time integration, spectral radius {radius:g}: displacement, velocity, mean stress",
        source="V15, theory",
        expected=[2.0, 2.0, 2.0],
        got=results,
        tolerance="0.1 for the displacement, 0.3",
    )
    assert np.abs(ends[-1].displacement).max() > vibrations.LENGTH / 10
    assert results[0] == pytest.approx(2.0, abs=0.1)
    assert results[1:] == pytest.approx([2.0, 2.0], abs=0.3)


def test_slow_ramp_is_static(record_verification):
    model = vibrations.strip((6, 1, 1), [tg.Gravity((0, -1, 0), 60.0, SMOOTH)])
    period = 1 / float(natural_frequencies(model, count=1, options=problems.OPTIONS).frequencies[0])
    solution = problems.solve(model, Dynamic(duration=20 * period, stiffness_damping=5e-3))
    still = problems.solve(vibrations.strip((6, 1, 1), [tg.Gravity((0, -1, 0), 60.0)]), tg.Static(max_step=0.05))
    tip = vibrations.tip(model)
    path = CubicSpline([s.load_factor for s in still.states], [s.displacement[tip] for s in still.states])
    end = float(np.linalg.norm(still.states[-1].displacement[tip]))
    apart = max(
        float(np.linalg.norm(s.displacement[tip] - path(share_at(SMOOTH, s.load_factor)))) for s in solution.states
    )
    moving = max(s.energies.kinetic for s in solution.states) / solution.states[-1].energies.strain
    record_verification(
        claim="weight put on within 20 periods: distance from the static path, kinetic over strain energy",
        source="V15, static path",
        expected=[0.0, 0.0],
        got=[apart / end, moving],
        tolerance="1 %, 1 %",
    )
    assert end > vibrations.LENGTH / 10
    assert apart < 0.01 * end
    assert moving < 0.01
    assert imbalance(solution.states) < 0.01
