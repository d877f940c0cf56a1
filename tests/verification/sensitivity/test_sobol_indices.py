"""Sobol indices of functions whose indices are known in closed form.

Problem: the function of Ishigami and Homma (1990), sin x + 7 sin² y + 0.1 z⁴ sin x over (−π, π)³, and the g-function of
Sobol, Π (|4 xᵢ − 2| + aᵢ)/(1 + aᵢ) over (0, 1)⁴ with a = 0, 1, 4.5, 9.
Exact: Ishigami with a = 7, b = 0.1: V = a²/8 + b π⁴/5 + b² π⁸/18 + 1/2, V₁ = (1 + b π⁴/5)²/2, V₂ = a²/8,
V₁₃ = 8 b² π⁸/225; g: Vᵢ = 1/(3 (1 + aᵢ)²), V = Π (1 + Vᵢ) − 1, total Vᵢ Π_{j≠i} (1 + Vⱼ).
Tolerance: 0.02 for 4096 samples, whose intervals are about that wide.
"""

from math import pi

import numpy as np
import pytest

import surrogate_cases as cases
from turgor.studies.runs.factor import Factor
from turgor.studies.sensitivity.indices import screening, sobol_indices

#: Constants of the g-function.
A = np.array([0.0, 1.0, 4.5, 9.0])


def ishigami(points):
    x, y, z = points.T
    return np.sin(x) + 7 * np.sin(y) ** 2 + 0.1 * z**4 * np.sin(x)


def g_function(points):
    return np.prod((np.abs(4 * points - 2) + A) / (1 + A), axis=1)


def test_ishigami(record_verification):
    factors = [Factor(name=name, low=-pi, high=pi) for name in "xyz"]
    (result,) = sobol_indices(cases.Formula(ishigami, factors), samples=4096)
    a, b = 7.0, 0.1
    alone_x, alone_y, x_and_z = (1 + b * pi**4 / 5) ** 2 / 2, a**2 / 8, 8 * b**2 * pi**8 / 225
    variance = a**2 / 8 + b * pi**4 / 5 + b**2 * pi**8 / 18 + 1 / 2
    first = np.array([alone_x, alone_y, 0.0]) / variance
    total = np.array([alone_x + x_and_z, alone_y, x_and_z]) / variance
    record_verification(
        claim="Sobol indices of the Ishigami function: first x, y, z; total x, y, z",
        source="closed form, Ishigami and Homma 1990",
        expected=np.round([*first, *total], 4),
        got=np.round([*result.first, *result.total], 4),
        tolerance="0.02",
    )
    assert result.first == pytest.approx(first, abs=0.02)
    assert result.total == pytest.approx(total, abs=0.02)
    assert result.deviation == pytest.approx(np.sqrt(variance), rel=0.01)
    low, high = result.interval("total")
    assert (low <= total + 0.005).all()
    assert (total <= high + 0.005).all()


def test_g_function(record_verification):
    factors = [Factor(name=f"x{n}", low=0.0, high=1.0) for n in range(4)]
    (result,) = sobol_indices(cases.Formula(g_function, factors), samples=4096)
    parts = 1 / (3 * (1 + A) ** 2)
    variance = np.prod(1 + parts) - 1
    total = parts * np.prod(1 + parts) / (1 + parts) / variance
    record_verification(
        claim="Sobol indices of the g-function with a = 0, 1, 4.5, 9: total",
        source="closed form, Sobol 1993",
        expected=np.round(total, 4),
        got=np.round(result.total, 4),
        tolerance="0.02",
    )
    assert result.first == pytest.approx(parts / variance, abs=0.02)
    assert result.total == pytest.approx(total, abs=0.02)
    (screened,) = screening(cases.Formula(g_function, factors), trajectories=50)
    assert screened.ranking == result.ranking == ("x0", "x1", "x2", "x3")
