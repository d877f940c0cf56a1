"""Rods vibrate and move as they should: natural frequencies, energy, order in time, damping.

Problem: a cantilever of length, bending stiffness and mass 1; released from a bent state in space, it swings for a time
of 2 (the first period is 1.8).
Exact: frequencies 1.8751² and 4.6941² (Euler and Bernoulli, no rotary inertia); the energy without damping; a free rod
keeps its momentum. Tolerance: frequencies 1e-4 with 16 elements, third order; energy 1e-3 with 100 steps and less with
more; second order in time.
"""

import numpy as np
import pytest
from rod_cases import rates, slender
from turgor.loads import Gravity
from turgor.rods import PlateForce, Rod, RodModel, RodSection, dynamic, natural_frequencies, static

EXACT = np.array([1.8751040687, 4.6940911330]) ** 2


def test_frequencies_of_a_cantilever(record_verification):
    def lowest(elements):
        rod = Rod(section=slender(mass_per_length=1.0), length=1.0, elements=elements)
        return 2 * np.pi * natural_frequencies(RodModel(rods=[rod]), count=4).frequencies[[0, 2]]

    results = [lowest(n) for n in (8, 16, 32)]
    record_verification("cantilever, 16 elements: circular frequencies", "exact", EXACT, results[1], "1e-4, 1e-3")
    assert results[1] == pytest.approx(EXACT, rel=1e-3)
    assert results[1][0] == pytest.approx(EXACT[0], rel=1e-4)
    orders = rates([abs(each[0] / EXACT[0] - 1) for each in results])
    record_verification("the same, 8 to 32 elements: orders of the first", "theory", 3.0, orders, "0.3")
    assert orders == pytest.approx([3.0] * 2, abs=0.3)


def test_weight_changes_the_frequency():
    """A hanging rod swings faster, a standing one slower, until it buckles at g = 7.8373 EI/(ρA L³)."""
    section = RodSection.from_moduli(EA=1e7, GA=1e7, EI=1.0, GJ=1.0, mass_per_length=1.0)
    results = {}
    for g in (-4.0, 4.0, 7.8, 7.9):
        model = RodModel(rods=[Rod(section=section, length=1.0)], loads=[Gravity((-1, 0, 0), g)])
        solution = static(model)
        results[g] = natural_frequencies(model, solution.states[-1], count=1).frequencies[0]
        assert solution.stable[-1] == (g < 7.8373)
    assert results[-4.0] > EXACT[0] / (2 * np.pi) > results[4.0] > results[7.8] > 0 > results[7.9]


def _swing(step, radius=1.0, **more):
    section = RodSection(stiffness=np.diag([1e4, 5e3, 5e3, 1.0, 1.0, 1.0]), mass_per_length=1.0, **more)
    rod = Rod(section=section, length=1.0, elements=6)
    start = static(RodModel(rods=[rod], loads=[PlateForce(force=(0, 2, 3))])).states[-1]
    return dynamic(RodModel(rods=[rod]), duration=1.0, step=step, start=start, spectral_radius=radius)


def test_energy(record_verification):
    drifts = []
    for step in (0.02, 0.01, 0.005):
        response = _swing(step).response()
        energy = response["strain_energy"] + response["kinetic_energy"]
        drifts.append(float(np.abs(energy / energy[0] - 1).max()))
        assert response["kinetic_energy"].max() > 0.5 * energy[0]
    record_verification("swing in space, 50, 100, 200 steps: change of energy", "exact", 0.0, drifts, "1e-3 at 100")
    assert drifts[1] < 1e-3
    assert drifts[0] > 1.5 * drifts[1] > 3 * drifts[2]


def test_order_in_time(record_verification):
    section = RodSection.from_moduli(EA=100.0, GA=50.0, EI=1.0, GJ=1.0, mass_per_length=1.0)
    load = PlateForce(force=(0, 2.0, 3.0), history="sin(pi * s) ** 2")
    model = RodModel(rods=[Rod(section=section, length=1.0, elements=4)], loads=[load])
    tips = [dynamic(model, duration=1.0, step=1 / steps).tip[-1] for steps in (25, 50, 100, 400)]
    errors = [float(np.linalg.norm(tip - tips[-1])) for tip in tips[:-1]]
    record_verification("pushed and let go, 25 to 100 steps: order in time", "theory", 2.0, rates(errors), "0.3")
    assert rates(errors) == pytest.approx([2.0] * 2, abs=0.3)


def test_damping_takes_energy():
    lively, damped = (_swing(0.01, damping_time=time) for time in (0.0, 0.05))
    totals = [run.response()["strain_energy"] + run.response()["kinetic_energy"] for run in (lively, damped)]
    assert totals[1][-1] < 0.7 * totals[0][-1]
    assert (np.diff(totals[1]) < 1e-4 * totals[1][0]).all()


def test_a_slow_load_follows_the_equilibria(record_verification):
    section = RodSection.from_moduli(EA=1e4, GA=5e3, EI=1.0, GJ=1.0, mass_per_length=1.0)
    model = RodModel(
        rods=[Rod(section=section, length=1.0, elements=8)],
        loads=[PlateForce(force=(0, 0, 3.0), history="(1 - cos(pi * s)) / 2")],
    )
    moving = dynamic(model, duration=40.0, step=0.4, spectral_radius=0.6).tip[-1]
    still = static(model).tip[-1]
    record_verification("load that grows over 20 periods: tip", "equilibrium", still, moving, "1e-2")
    assert moving == pytest.approx(still, abs=1e-2)
