"""A block that friction holds slips elastically, by as much as is stated, and a finding says when that matters.

Problem: a stiff block whose top is pressed down by 0.5 µm onto a rigid plane, then pulled sideways by T, less than µ
times what presses it; a spring far too weak to hold it keeps it from being free. Exact: every point that sticks is tied
with µ p / s over its area, so the block slips by s T / (µ P), whatever the distribution of the pressure p of the force
P; s is half a percent of a side of its cells unless it is stated. Source: the regularized law. Tolerance: 3 %, because
the block is not rigid.
"""

import numpy as np
import pytest

import contact_cases
import problems
import turgor as tg
from turgor.core.model.contact import Contact
from turgor.core.model.obstacles import Obstacle, Plane
from turgor.units import MPa, kPa, mm, um

FRICTION, PULL, AREA = 0.5, 70 * kPa, (10 * mm) ** 2
USUAL = 0.005 * 5 * mm


def _down(points, load_factor):
    return np.tile([0.0, 0.0, -0.5 * um * min(1.0, 2 * load_factor)], (len(points), 1))


def _pulled(**given):
    ground = Obstacle(name="ground", shape=Plane(point=(0, 0, 0), normal=(0, 0, 1)), friction=FRICTION, **given)
    mesh = contact_cases.block((2, 2, 1), (10, 10, 5))
    stiff = problems.rubber(tg.laws.NeoHooke(C10=500 * MPa), bulk_modulus=2000 / 3 * MPa)  # ν = 0
    weak = tg.supports.ReferencePoint("handle", "z1", coupling="averaging", spring=(1.0, 0.0, 0.0))
    supports = [weak, tg.Displacement("z1", _down, "z"), tg.Fixed("y0", "y")]
    pull = tg.Traction("z1", (PULL, 0.0, 0.0), history=[(0, 0), (0.5, 0), (1, 1)])
    model = tg.Model(mesh, {"body": stiff}, supports, [pull], contact=Contact(obstacles=[ground]))
    return problems.solve(model, tg.Static(first_step=0.25))


@pytest.mark.parametrize("stated", [None, 5 * um])
def test_a_block_slips_elastically_by_what_is_stated(stated, record_verification):
    solution = _pulled(**({} if stated is None else {"elastic_slip": stated}))
    state = solution.states[-1]
    got = float(state.displacement[state.model.mesh.face_nodes("z0"), 0].mean())
    pressed = float(contact_cases.push(state.touches["ground"])[2])
    expected = (stated or USUAL) * PULL * AREA / (FRICTION * pressed)
    record_verification(
        claim=f"block held by friction, {'usual elastic slip' if stated is None else 'of 5 µm'}: how far it slips [µm]",
        source="regularized Coulomb's law, exact",
        expected=expected / um,
        got=got / um,
        tolerance="3 %",
    )
    assert FRICTION * pressed > PULL * AREA
    assert got == pytest.approx(expected, rel=0.03)
    assert [each.code for each in solution.findings if each.code == "B26"] == ["B26"]


def test_a_small_slip_is_not_reported():
    """It hardly counts beside the 0.5 µm by which the block is pressed together."""
    solution = _pulled(elastic_slip=0.01 * um)
    assert not [each for each in solution.findings if each.code == "B26"]
