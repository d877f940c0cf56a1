"""Gradients by every kind of number and under every procedure are derivatives of what a solve finds.

Problem: small models, one for each kind (`gradient_cases`): constants of materials, bulk modulus, density, pressures
(on an open surface, whose tangent is not symmetric), tractions, sheets, windings, dimensions, contact without friction,
given volumes and amounts of gas, rubber that has relaxed, an axisymmetric mesh, and dimensions of tetrahedra in bodies
with plane and curved faces and fillets, which are carried along in the solves as well.
Exact: central differences of solves with a tolerance of 1e-11, and Taylor's theorem: what a measure differs from its
tangent falls with the square of the change. A wrong derivative gives rate 1.
Tolerance: 1e-5, relative to the derivative; rate 1.9 or more where the measure is not linear in the number.
"""

import numpy as np
import pytest

import problems
import turgor as tg
from gradient_cases import CASES

#: Step of the differences, as a share of the value.
STEP = 3e-4

#: Remainders below this share of the change are round-off: the measure is linear in the number.
LINEAR = 1e-6


def differences(case, solution):
    """Derivatives of the measures by each number, from two solves each."""
    results = []
    for name, value in case.values.items():
        ends = [case.measured({**case.values, name: value * (1 + way * STEP)}, solution) for way in (1, -1)]
        results.append((ends[0] - ends[1]) / (2 * STEP * value))
    return np.array(results).T


def remainder_rates(case, solution, slopes):
    """Rates at which remainders of Taylor's theorem fall, for each number and measure; 2 where there are none."""
    here, rates = case.measured(case.values, solution), []
    for column, (name, value) in enumerate(case.values.items()):
        left, change = [], []
        for share in case.changes:
            there = case.measured({**case.values, name: value * (1 + share)}, solution)
            change.append(np.abs(share * value * slopes[:, column]))
            left.append(np.abs(there - here - share * value * slopes[:, column]))
        rates.append(np.where(left[0] < LINEAR * change[0], 2.0, np.log2(left[0] / left[1])))
    return np.array(rates)


@pytest.mark.parametrize("kind", CASES)
def test_gradients_are_derivatives_of_solves(kind, record_verification):
    case = CASES[kind]
    solution = case.solve(case.values)
    gradient = tg.gradient(solution, case.measures, case.variation, options=problems.OPTIONS)
    exact = differences(case, solution)
    rates = remainder_rates(case, solution, gradient.values)
    measures, numbers = ", ".join(each.name for each in gradient.measures), ", ".join(gradient.keys)
    record_verification(
        claim=f"{kind}: {measures} by {numbers}; largest relative error, smallest rate of a remainder",
        source="differences of solves, Taylor's theorem",
        expected=[0.0, 2.0],
        got=[float(np.abs(gradient.values / exact - 1).max()), float(rates.min())],
        tolerance="1e-5, 1.9 or more",
    )
    assert gradient.values == pytest.approx(exact, rel=1e-5)
    assert rates.min() > 1.9
