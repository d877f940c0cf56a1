"""The end does not depend on how many increments lead there (review 6.2-6 and appendix).

(1) A blind arm of Ecoflex 00-30, 80 mm long, that a pressure and its own weight bend; (2) a wall that bulges and
presses on a plate. Each takes 10, 40 and 100 even increments, and steps that adapt between 1e-5 and 0.05 of the load,
as the appendix of the review has them. test_targets_contact.py asserts that the default steps reach the end unattended;
tests/verification/dynamics/test_vibration.py, that a slow ramp is static.
Tolerance: 1e-6 of the largest displacement, what the tolerance of Newton's method leaves, with contact too.
"""

import numpy as np
import pytest

import contact_meshes
import meshes
import problems
import turgor as tg
from turgor.units import kPa, mm

WAYS = {
    "10": tg.Static(first_step=0.1, max_step=0.1),
    "40": tg.Static(first_step=0.025, max_step=0.025),
    "100": tg.Static(first_step=0.01, max_step=0.01),
    "adaptive": tg.Static(first_step=0.01, max_step=0.05, min_step=1e-5),
}


def _arm():
    mesh = meshes.blind_tube()
    mesh = meshes.with_points(mesh, mesh.points * np.array([20, 10 / 3, 10 / 3]) * mm)
    material = problems.rubber(tg.laws.NeoHooke(C10=12.662 * kPa), density=1070.0)
    loads = [tg.Pressure("cavity", 4 * kPa), tg.Gravity((0, 0, -1), 9.81)]
    return tg.Model(mesh, {"body": material}, [tg.Fixed("x0")], loads)


def _wall():
    mesh = contact_meshes.gap_cell(along=4)
    held = [tg.Fixed("y0", "y"), tg.Fixed("y1", "y"), tg.Fixed("rim"), tg.Fixed("seat", "z")]
    plate = tg.obstacles.Obstacle(name="plate", shape=tg.obstacles.Plane(point=(0, 0, 0), normal=(0, 0, -1)))
    contact = tg.Contact(self_contact=False, obstacles=[plate])
    materials = {"body": problems.rubber(problems.NEO_HOOKE)}
    return tg.Model(mesh, materials, held, [tg.Pressure("cavity_1", 12 * kPa)], contact=contact)


@pytest.mark.parametrize("what", ["arm under pressure and weight", "wall that touches"])
def test_any_number_of_increments(what, record_validation):
    model = _wall() if "wall" in what else _arm()
    solutions = {name: problems.solve(model, procedure) for name, procedure in WAYS.items()}
    ends = {name: solution.states[-1].displacement for name, solution in solutions.items()}
    finest = ends["100"]
    size = float(np.abs(finest).max())
    apart = [float(np.abs(end - finest).max()) / size for end in ends.values()]
    record_validation(
        claim=f"{what}, 10, 40, 100 increments and adaptive ones: largest distance between their ends, relative",
        source="review 6.2-6, appendix",
        expected=0.0,
        got=max(apart),
        tolerance="1e-6",
    )
    assert max(apart) < 1e-6
    accepted = {name: sum(step.accepted for step in solution.steps) for name, solution in solutions.items()}
    assert accepted["10"] < accepted["adaptive"] < accepted["40"] < accepted["100"]
    assert size > 0.4 * mm
    if "wall" in what:
        assert all(solution.states[-1].touches["plate"].area > 1 * mm**2 for solution in solutions.values())
