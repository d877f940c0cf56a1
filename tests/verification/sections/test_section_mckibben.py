"""V19: the section of a soft tube in a stiff double winding pulls like the ideal McKibben muscle.

Problem: tube of outer radius 10 mm with a wall of 1 mm, wound with both hands at θ₀ from the axis, 100 kPa on closed
ends; held at its length, at 0.9 and at 0.8 of it.
Ideal: F = π r₀² P [a (1 − ε)² − b], a = 3/tan²θ₀, b = 1/sin²θ₀.
Source: virtual work of inextensible fibers (Schulte; Chou and Hannaford).
Limit: the law leaves out the wall and the give of the fibers. Both are halved together and the two answers extended
linearly to none.
Tolerance: 0.1 % of the blocked force, what the extension leaves.
"""

import numpy as np
import pytest

import problems
import slices
import turgor as tg
from turgor.units import deg, kPa, mm

RADIUS, WALL, PRESSURE = 10 * mm, 1 * mm, 100 * kPa
UNIT = np.pi * RADIUS**2 * PRESSURE
ANGLES = (20, 25, 30)
STRETCHES = np.array([1.0, 0.9, 0.8])
#: Shear modulus of the wall [Pa] and stiffness of each hand [N/m]; each half as far from the ideal as the one before.
SOFTENED = ((20e3, 1e7), (10e3, 2e7))


def pulls(angle, shear_modulus, stiffness):
    """Forces that hold the muscle at its length, at 0.9 and at 0.8 of it, over π r₀² P."""
    tube = tg.actuators.ContractingTube(inner_radius=RADIUS - WALL, wall=WALL)
    threads = slices.family(stiffness, (90 - angle) * deg, hand="both", axis=(1.0, 0.0, 0.0), compression=1.0)
    rubber = problems.rubber(tg.laws.NeoHooke(C10=shear_modulus / 2))
    section = tg.Section(tube, {"body": rubber}, reinforcements=[threads])
    response = section.solve(
        PRESSURE * np.array([0.25, 0.5, 1, 1, 1]), prescribed={"stretch": [1.0, 1.0, 1.0, *STRETCHES[1:]]}
    ).response
    return response["axial_force"][2:] / UNIT


@pytest.mark.parametrize("angle", ANGLES)
def test_ideal_muscle(record_verification, angle):
    far, near = (pulls(angle, *soft) for soft in SOFTENED)
    law = 3 / np.tan(angle * deg) ** 2 * STRETCHES**2 - 1 / np.sin(angle * deg) ** 2
    record_verification(
        claim=f"section of a McKibben muscle, {angle}°: F/(πr₀²P) blocked, at ε = 0.1 and at ε = 0.2",
        source="V19, exact",
        expected=law,
        got=2 * near - far,
        tolerance="0.1 % of the blocked force",
    )
    assert 2 * near - far == pytest.approx(law, abs=1e-3 * law[0])
    assert (abs(near - law) < 0.6 * abs(far - law)).all()  # and that is how the limit is approached
