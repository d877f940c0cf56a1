"""V17: a viscoelastic rubber relaxes as its Prony series says; loops, order in time.

Problem: finite linear viscoelasticity, g = (0.2, 0.1) at τ = (1, 10) s on the isochoric stress, instantaneous
neo-Hookean law with C10 = 0.12 MPa, sudden uniaxial stretch 1.5 held for ever.
Exact: nominal stress 0.253333 MPa × (1 − Σ gᵢ (1 − exp(−t/τᵢ))); after a ramp, the hereditary integral by quadrature.
Tolerance: 6e-8 MPa, the digits of `TABLE`: a held stress has no error in time. The ramp is of second order in the step.
"""

import numpy as np
import pytest
from scipy.integrate import quad

import turgor as tg
from turgor.core.materials.history.stress_history import stress_history
from turgor.core.materials.history.viscoelastic import Prony

MPA = 1e6
TIMES = (0, 0.5, 1, 2, 5, 10, 20, 50, 100, 1e9)
TABLE = (
    *(0.2533333, 0.2321620, 0.2188951, 0.2049315, 0.1930402),
    *(0.1866552, 0.1807618, 0.1775040, 0.1773345, 0.1773333),
)
C10 = 0.12 * MPA
SERIES = Prony(g=(0.2, 0.1), tau=(1.0, 10.0), moduli="instantaneous")
RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=C10), viscoelasticity=SERIES)


def test_relaxation_after_a_sudden_stretch(record_verification):
    result = stress_history(RUBBER, "uniaxial", TIMES, np.full(len(TIMES), 1.5)).nominal_stress / MPA
    record_verification(
        claim="nominal stress at 0, 0.5, 1, 2, 5, 10, 20, 50, 100 s and at last after a step to stretch 1.5 [MPa]",
        source="V17, exact",
        expected=TABLE,
        got=result,
        tolerance="6e-8 MPa",
    )
    assert result == pytest.approx(TABLE, abs=6e-8)


def test_constants_of_a_slow_test_give_the_same_rubber(record_verification):
    """The long-term law has 0.7 of the stiffness; told so, the answer is the same."""
    law = tg.laws.NeoHooke(C10=0.7 * C10)
    slow = tg.Material(name="rubber", law=law, viscoelasticity=Prony(g=(0.2, 0.1), tau=(1.0, 10.0), moduli="long_term"))
    result = stress_history(slow, "uniaxial", TIMES, np.full(len(TIMES), 1.5)).nominal_stress / MPA
    record_verification("the same by constants of a slow test [MPa]", "V17, exact", TABLE, result, "6e-8 MPa")
    assert result == pytest.approx(TABLE, abs=6e-8)


def loaded(steps):
    """Nominal stress at 4 s of a smooth loading and unloading in equal steps."""
    time = np.linspace(0.0, 4.0, steps + 1)
    return stress_history(RUBBER, "uniaxial", time, stretch_at(time)).nominal_stress[-1]


def stretch_at(time):
    return 1 + 0.8 * np.sin(time) ** 2


def exact_at_4():
    """The hereditary integral of both components of the stress, with P = λ S₁₁ − S₃₃/λ²."""

    def stress(time):  # the isochoric S of a neo-Hookean rubber in uniaxial tension: along, across
        a = stretch_at(time)
        return 2 * C10 * np.array([1 - (a**2 + 2 / a) / (3 * a**2), 1 - (a**2 + 2 / a) * a / 3])

    def slope(s, k, d=1e-5):
        return (stress(s + d)[k] - stress(s - d)[k]) / (2 * d)

    total = SERIES.relaxed * stress(4.0)
    for g, tau in zip(SERIES.g, SERIES.tau, strict=True):
        total += g * np.array(
            [quad(lambda s, k=k, tau=tau: np.exp((s - 4) / tau) * slope(s, k), 0, 4)[0] for k in (0, 1)]
        )
    a = stretch_at(4.0)
    return a * total[0] - total[1] / a**2


def test_integration_in_time_is_of_second_order(record_verification):
    exact = exact_at_4()
    errors = np.array([abs(loaded(steps) - exact) for steps in (20, 40, 80, 160)])
    orders = np.log2(errors[:-1] / errors[1:])
    record_verification(
        claim="order of the time integration of the internal stresses, 20 to 160 steps of a cycle",
        source="theory",
        expected=2.0,
        got=orders,
        tolerance="0.02",
    )
    assert orders == pytest.approx([2, 2, 2], abs=0.02)
    assert errors[-1] < 1e-4 * exact
