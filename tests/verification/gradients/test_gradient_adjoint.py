"""The adjoint and the direct derivative are one derivative, found in two ways.

Problem: half of a short fast PneuNet under pressure, at given pressure and at given volume, of hexahedra and of
tetrahedra; its bending angle, volume and tip displacement by constants of two rubbers, two dimensions and the load. The
adjoint takes one solution for each measure and closed derivatives of the measures, the direct way one for each number
and differences of the measures.
Exact: equality. Tolerance: 1e-6, what differences of the measures leave.
"""

import numpy as np
import pytest

import problems
import turgor as tg
from turgor.accuracy.gradients import measure_derivatives as derived
from turgor.units import kPa, mm

MEASURES = ("bending_angle", "cavity_volume", "tip_displacement", "tip_displacement_z")
VALUES = {"C10": 0.11e6, "stiff": 0.3e6, "wall": 2 * mm, "height": 15 * mm, "drive": 1.0}


def model_of(values, given_volume, cells):
    finger = tg.FastPneuNet(chambers=1, length=20 * mm, wall=values["wall"], height=values["height"])
    mesh = tg.mesh(finger.build(), size=8 * mm, cells=cells)
    rubbers = {"body": problems.rubber(tg.Yeoh(C10=values["C10"], C20=0.02e6)),
               "base": problems.rubber(tg.laws.NeoHooke(C10=values["stiff"]))}  # fmt: skip
    loads = [] if given_volume else [tg.Pressure("cavity", 10 * kPa * values["drive"])]
    return tg.Model(mesh, rubbers, [tg.Fixed("fixed")], loads)


@pytest.mark.parametrize(("given_volume", "cells"), [(False, "hexahedra"), (True, "hexahedra"), (False, "tetrahedra")])
def test_adjoint_is_the_direct_derivative(given_volume, cells, monkeypatch, record_verification):
    def procedure(values):
        return tg.VolumeControl(volume=0.2e-6 * values["drive"], first_step=1.0) if given_volume else tg.Static()

    variation = tg.studies.Variation(lambda values: model_of(values, given_volume, cells), VALUES, procedure=procedure)
    solution = problems.solve(model_of(VALUES, given_volume, cells), procedure(VALUES))
    adjoint = tg.gradient(solution, MEASURES, variation, options=problems.OPTIONS)
    monkeypatch.setattr(derived, "has_adjoint", lambda base, measures: False)
    direct = tg.gradient(solution, MEASURES, variation, options=problems.OPTIONS)
    assert (adjoint.way, adjoint.solves, direct.way) == ("adjoint", len(MEASURES), "direct")
    sizes = np.array(list(VALUES.values()))  # of the changes that count
    scale = np.abs(direct.values * sizes).max(axis=1, keepdims=True)
    apart = float((np.abs(adjoint.values - direct.values) * sizes / scale).max())
    record_verification(
        claim="derivatives by the adjoint and direct ones: largest relative difference",
        source=f"{cells}, a given {'volume' if given_volume else 'pressure'}",
        expected=0.0,
        got=apart,
        tolerance="1e-6",
    )
    assert apart < 1e-6
