"""V04: derivatives of the pressure in a thick sphere at a given volume are those of the exact curve.

Problem: the neo-Hookean sphere of V04 (inner radius 10 mm, outer 15 mm), filled with a given volume; its pressure by
C10, by the injected volume and by both radii; on a regular mesh, and on tetrahedra that follow their CAD shape.
Exact: P = ∫ Ŵ′(λ) / (λ³ − 1) dλ with λ³ = 1 + V / V₀ at the inner wall, differentiated; P is proportional to C10, and
to no length if the volume grows with the cube of the radii.
Source: Green and Zerna. Tolerance: 0.2 % for radii and volume, the distance of the curve itself (`test_sphere`); what
follows from proportions holds on any mesh, 1e-6, the square of the steps with a margin.
"""

import numpy as np
import pytest

import exact
import problems
import turgor as tg
from gradient_cases import ball, ball_in_tetrahedra
from turgor.units import mm

VALUES = {"C10": 0.12e6, "inner": 10 * mm, "outer": 15 * mm, "injected": 3e-6}


def exact_pressure(values):
    stretch = (1 + values["injected"] / (4 / 3 * np.pi * values["inner"] ** 3)) ** (1 / 3)
    law = tg.laws.NeoHooke(C10=values["C10"])
    return exact.sphere_pressure(law, stretch, values["inner"], values["outer"])


MODELS = {
    "a regular mesh": lambda values: ball(values, around=2, through=3),
    "a generated mesh": ball_in_tetrahedra,
}


@pytest.mark.parametrize("mesh", MODELS)
def test_pressure_at_a_given_volume(mesh, record_verification):
    def procedure(values):
        return tg.VolumeControl(volume=values["injected"])

    variation = tg.studies.Variation(MODELS[mesh], VALUES, procedure=procedure)
    solution = problems.solve(variation.model(VALUES), procedure(VALUES))
    gradient = tg.gradient(solution, "pressure", variation, options=problems.OPTIONS)
    result = gradient.by("pressure")
    slopes = {}
    for name, value in VALUES.items():
        ends = [exact_pressure({**VALUES, name: value * (1 + way * 1e-4)}) for way in (1, -1)]
        slopes[name] = (ends[0] - ends[1]) / (2e-4 * value)
    record_verification(
        claim=f"thick sphere, {mesh}, at a given volume: derivative of its pressure by {', '.join(VALUES)} [SI]",
        source="V04, exact",
        expected=list(slopes.values()),
        got=list(result.values()),
        tolerance="0.2 %",
    )
    assert result == pytest.approx(slopes, rel=2e-3)
    pressure = gradient.value("pressure")
    assert result["C10"] * VALUES["C10"] == pytest.approx(pressure, rel=1e-6)
    lengths = result["inner"] * VALUES["inner"] + result["outer"] * VALUES["outer"] + 3 * result["injected"] * 3e-6
    assert lengths == pytest.approx(0, abs=1e-6 * pressure)
