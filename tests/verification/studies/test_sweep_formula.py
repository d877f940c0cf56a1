"""A sweep gives the values of the function that it computes, whatever its designs and wherever they run.

Problem: thick sphere (neo-Hookean) whose inner radius is 10 mm, over its wall and stiffness, at 60 kPa.
Exact: the stretch depends on P/C10 and on the wall over the radius alone: P = C10 (4/λ + 1/λ⁴ − 4/Λ − 1/Λ⁴), with Λ of
the outside from the volume, Λ³ B³ − λ³ A³ = B³ − A³. With P at each stretch known, the sweep must return this P.
Integral: the mean of a Latin hypercube of 256 samples of the linear function 3 + 2 x + y is known; the variance of its
mean is that within one slice, below 1/n³, so that 1e-3 is more than ten standard deviations.
Tolerance: values of runs have nine digits and the formula inverts the curve to 1e-8 or better; 1e-6 for both.
"""

import numpy as np
import pytest

import calibration_cases as cases
import turgor as tg
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies import Factor
from turgor.units import mm

INNER, PRESSURE = 10 * mm, 60e3


def exact_pressure(stretch, stiffness, wall):
    ratio = ((INNER + wall) / INNER) ** 3
    outside = ((ratio - 1 + stretch**3) / ratio) ** (1 / 3)
    return stiffness * (4 / outside + 1 / outside**4 - 4 / stretch - 1 / stretch**4)


def linear(x: float, y: float) -> Response:
    return Response(columns=(Column("sum", "", np.array([3 + 2 * x + y])),), source=Source(text="a plane"))


def test_a_sphere_over_wall_and_stiffness(record_verification, tmp_path):
    with tg.studies.saved_in(tmp_path, processes=2) as runs:
        study = tg.sweep(
            cases.thick_sphere, evaluations=runs, C10=[0.15e6, 0.2e6], wall=[5 * mm, 7 * mm, 9 * mm]
        )  # fmt: skip
    stiffness, wall = study.inputs.T
    got = exact_pressure(study.column("inner_stretch", at=("pressure", PRESSURE)), stiffness, wall)
    record_verification(
        claim="sweep of a thick sphere over wall and stiffness: the pressure that belongs to each stretch [kPa]",
        source="closed form, 60 kPa",
        expected=np.full(6, 60.0),
        got=np.round(got / 1e3, 3),
        tolerance="1e-6",
    )
    assert got == pytest.approx(PRESSURE, rel=1e-6)


def test_means_of_filled_ranges(record_verification):
    factors = [Factor(name="x", low=0.0, high=1.0), Factor(name="y", low=-1.0, high=1.0)]
    means = [
        float(np.mean(tg.sweep(linear, None, rule(factors, 256, seed=2)).column("sum")))
        for rule in (tg.studies.latin_hypercube, tg.studies.sobol)
    ]
    record_verification(
        claim="mean of a plane over a Latin hypercube and over Sobol points, 256 of each",
        source="exact: 4",
        expected=[4.0, 4.0],
        got=np.round(means, 5),
        tolerance="1e-3",
    )
    assert means == pytest.approx([4.0, 4.0], abs=1e-3)
