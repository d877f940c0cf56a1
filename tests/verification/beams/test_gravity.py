"""V14: a rubber strip bends far under its own weight; weight moves a long soft arm, and nothing does without it.

Problem (strip): length 60 mm, thickness 10 mm, plane strain, neo-Hookean C10 = 0.012662 MPa (Ecoflex 00-30), density
1070 kg/m³, g = 9.81 m/s² across, clamped at x = 0. Value: displacement of the end of the middle line.
Reference: converged high-order elements, (−3.321, −18.99) mm ± 0.003; the inextensible elastica is a few per cent off,
because the strip is short. Tolerance: 0.7 % with 36 × 6 hexahedra; 24 × 4 are 0.77 % off, 48 × 8 0.34 %.

Problem (arm): an arm of the same rubber, 80 mm long, 10 mm thick, with a blind bore under 2 kPa, lies horizontally. The
tip must hang by more than 10 % of the length, and come back to the weightless answer as g goes to zero.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON

MM = problems.MM
RUBBER = problems.rubber(tg.laws.NeoHooke(C10=0.012662 * problems.MPA), density=1070.0)
FIRST = ((0, 0), (0.3, 1), (1, 1))
THEN = ((0, 0), (0.3, 0), (1, 1))


def test_strip_under_its_weight(record_verification):
    mesh = meshes.box((60 * MM, 10 * MM, 2.5 * MM), (36, 6, 1), lambda X: X - [0, 5 * MM, 0], kind=HEXAHEDRON)
    supports = [tg.Fixed("x0"), *problems.PLANE_STRAIN]
    model = tg.Model(mesh, {"body": RUBBER}, supports, [tg.Gravity((0, -1, 0), 9.81)])
    state = problems.solve(model).states[-1]
    result = state.displacement[meshes.node_at(mesh, (60 * MM, 0, 0)), :2] / MM
    record_verification(
        claim="strip under its weight: displacement of the tip [mm]",
        source="V14, converged reference",
        expected=(-3.321, -18.99),
        got=result,
        tolerance="0.7 %",
    )
    assert result == pytest.approx([-3.321, -18.99], rel=7e-3)
    weight = 60e-3 * 10e-3 * 2.5e-3 * 1070 * 9.81
    assert problems.reaction(state, "x0")[1] == pytest.approx(weight, rel=1e-6)


def _arm(gravity, pressure_history=((0, 0), (1, 1)), gravity_history=((0, 0), (1, 1)), pressure=2e3):
    mesh = meshes.blind_tube()
    mesh = meshes.with_points(mesh, mesh.points * np.array([20, 10 / 3, 10 / 3]) * MM)
    loads = [tg.Pressure("cavity", pressure, pressure_history)]
    loads += [tg.Gravity((0, 0, -1), gravity, gravity_history)] if gravity else []
    model = tg.Model(mesh, {"body": RUBBER}, [tg.Fixed("x0")], loads)
    solution = problems.solve(model)
    return solution, meshes.node_at(mesh, (80 * MM, 5 * MM, 5 * MM))


def test_weight_moves_a_long_arm(record_verification):
    free, tip = _arm(0.0)
    hanging, _ = _arm(9.81)
    ordered, _ = _arm(9.81, THEN, FIRST)
    floating, _ = _arm(1e-4)
    moved = [s.states[-1].displacement[tip] - free.states[-1].displacement[tip] for s in (hanging, ordered, floating)]
    share = float(np.linalg.norm(moved[0])) / (80 * MM)
    record_verification(
        claim="horizontal arm of Ecoflex, L/D = 8, under 2 kPa: how far its weight moves the tip, over the length",
        source="V14, long arms sag",
        expected="> 0.1",
        got=share,
        tolerance="-",
    )
    assert share > 0.1
    assert moved[1] == pytest.approx(moved[0], rel=1e-4, abs=1e-8)  # weight first, then pressure: the same end
    empty, _ = _arm(9.81, pressure=0.0)
    alone = problems.state_at(ordered, 0.3).displacement[tip]
    assert alone == pytest.approx(empty.states[-1].displacement[tip], rel=1e-4, abs=1e-8)
    assert np.linalg.norm(alone - hanging.states[-1].displacement[tip]) > 1e-4 * 80 * MM
    assert np.linalg.norm(moved[2]) < 2e-5 * 80 * MM
