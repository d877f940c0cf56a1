"""Mesh convergence: three meshes of a thick sphere extrapolate to the exact volume, within the error they estimate.

Problem: the neo-Hookean sphere of case V04 at the pressure of an inner stretch of 1.3, as a function that meshes and
solves; the enclosed volume on three structured meshes of one shape, each with 8 times the cells of the one before.
Exact: 4/3 π (1.3 A)³.
Tolerance: the extrapolated value is at least ten times nearer to the exact one than the finest mesh, the estimated
error covers the true one and is at most four times as large, and the observed order is within 0.7 of 4, which is the
order of quadratic elements for a quantity such as the volume that does work against the load.
"""

import numpy as np
import pytest

import exact
import meshes
import problems
import turgor as tg
from turgor.core.results.measures.standard_measures import cavity_volume
from turgor.job.convergence import convergence

INNER, OUTER = 5 * problems.MM, 7 * problems.MM
STRETCH = 1.3


def inflate(size: float) -> tg.Solution:
    """The sphere with cells as thick as ``size``."""
    through = round((OUTER - INNER) / size)
    pressure = exact.sphere_pressure(problems.NEO_HOOKE, STRETCH, INNER, OUTER)
    mesh = meshes.sphere_octant(INNER, OUTER, through, through)
    model = problems.one_material(mesh, problems.NEO_HOOKE, loads=[tg.Pressure("cavity", pressure)])
    return problems.solve(model, tg.Static(first_step=0.25, tolerance=1e-10))


def test_three_meshes_extrapolate_to_the_exact_volume(record_verification):
    study = convergence(inflate, (2 * problems.MM, 1 * problems.MM, 0.5 * problems.MM), measure="cavity_volume")
    result, volume = study.extrapolation, 4 / 3 * np.pi * (STRETCH * INNER) ** 3
    true_error = abs(study.values[-1] - volume)
    record_verification(
        claim="thick sphere, neo-Hookean, inner stretch 1.3: volume [mL] extrapolated from 1, 2, 4 elements through it",
        source="V04, exact",
        expected=volume * 1e6,
        got=result.value * 1e6,
        tolerance="a tenth of the error of the finest mesh",
    )
    assert study.cells[1] / study.cells[0] == study.cells[2] / study.cells[1] == 8
    assert study.effective_sizes == pytest.approx(study.sizes)  # structured: sizes are what was aimed at
    assert result.trust == "converging"
    assert result.order == pytest.approx(4, abs=0.7)
    assert abs(result.value - volume) < true_error / 10
    assert true_error < result.error < 4 * true_error
    assert study.measure is cavity_volume
