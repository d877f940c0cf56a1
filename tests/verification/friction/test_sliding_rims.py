"""A sharp rim slides over a block, and a block over another body, in long steps.

Problem 1: a plate of triangles, pressed 0.1 mm into a block of 10 mm, moves 20 mm sideways with µ = 0.5, and its rim
passes the whole block. Exact: tangential over normal force is µ while it slides, and zero force at the end. Tolerance:
1 %. Iterations: 29 seen, 2,980 while points lost their contact suddenly as the rim passed them; at most 90.

Problem 2: a block slides 20 mm under another one, longer than itself, with µ = 0.2 and with µ = 0.5 and 50 kPa, where
it stopped at 7 mm. Both have sharp edges, and cells of 3.3 and 4 mm. Tolerance of the mean: 2 %, as the edge
that leads digs in, and the surface there is no longer level; of all states: 7 %. Iterations: 241 and 502 seen
(285 and none while points of the longer block came in over the rim with all of their pressure), at most 400 and 600.
"""

import numpy as np
import pytest

import contact_cases
import contact_meshes
import problems
import turgor as tg
from problems import MM
from turgor.core.model.contact import Contact
from turgor.core.model.obstacles import Obstacle, SelfContact

ALONG, DOWN, PRESSED, LOST = 20 * MM, 0.1 * MM, 0.2, 0.01
STEPS = tg.Static(at=(PRESSED,))


def _ratios(solution, face):
    """Tangential over normal force of the states that slide and still press."""
    forces = [problems.reaction(state, face) for state in solution.states if state.load_factor > PRESSED]
    return [float(np.hypot(*force[:2]) / force[2]) for force in forces if force[2] > LOST]


def test_rim_of_triangles_slides_off_a_block(record_verification):
    friction = 0.5
    path = ((0, (0, 0, 0)), (PRESSED, (0, 0, -DOWN)), (1, (ALONG, 0, -DOWN)))
    plate = Obstacle(name="plate", shape=contact_cases.slab(40, 3), friction=friction, path=path)
    solution = problems.solve(contact_cases.standing(contact_cases.block((3, 3, 1), (10, 10, 3)), plate), STEPS)
    ratios = _ratios(solution, "z0")
    record_verification(
        claim="plate of triangles whose rim slides off a block, µ = 0.5: tangential over normal force, least and most",
        source="Coulomb's law, exact",
        expected=friction,
        got=[min(ratios), max(ratios)],
        tolerance="1 %",
    )
    assert len(ratios) >= 3
    assert ratios == pytest.approx([friction] * len(ratios), rel=0.01)
    assert abs(problems.reaction(solution.states[-1], "z0")[2]) < 1e-6
    assert solution.iterations < 90


@pytest.mark.slow  # 30 s
@pytest.mark.parametrize(("friction", "mean", "each", "most"), [(0.2, 0.02, 0.07, 400), (0.5, 0.02, 0.07, 600)])
def test_block_slides_on_a_longer_one(friction, mean, each, most, record_verification):
    lower = contact_cases.block((3, 3, 1), (10, 10, 3))
    upper = contact_meshes.moved(contact_cases.block((10, 4, 1), (40, 16, 3)), (-27 * MM, -3 * MM, 3 * MM))
    down = tg.supports.Shift((0, 0, -2 * DOWN), [(0, 0), (PRESSED, 1), (1, 1)])
    along = tg.supports.Shift((ALONG, 0, 0), [(0, 0), (PRESSED, 0), (1, 1)])
    moves = [tg.Displacement("upper_z1", down, "yz"), tg.Displacement("upper_z1", along, "x")]
    mesh = contact_meshes.together({"lower": lower, "upper": upper})
    materials, contact = {"body": problems.rubber(problems.NEO_HOOKE)}, Contact(SelfContact(friction=friction))
    solution = problems.solve(tg.Model(mesh, materials, [tg.Fixed("lower_z0"), *moves], [], contact=contact), STEPS)
    ratios = _ratios(solution, "lower_z0")
    record_verification(
        claim=f"block that slides 20 mm under a longer one, µ = {friction}: mean tangential over normal force",
        source="Coulomb's law, exact",
        expected=friction,
        got=float(np.mean(ratios)),
        tolerance=f"{100 * mean:.0f} %",
    )
    assert np.mean(ratios) == pytest.approx(friction, rel=mean)
    assert ratios == pytest.approx([friction] * len(ratios), rel=each)
    assert solution.iterations < most
