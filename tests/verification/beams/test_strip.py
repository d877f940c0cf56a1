"""V13: a clamped strip under follower pressure on one side curls up as converged reference solutions do.

Problem: length 50 mm, thickness 5 mm, plane strain, incompressible neo-Hookean C10 = 0.12 MPa, clamped at x = 0,
pressure on the bottom face only, up to 1.5 kPa. The loaded face is open, so the pressure has no potential and its
tangent is not symmetric. Value: displacement of the end of the middle line.
Reference: converged high-order elements, uncertain by 0.03 mm (singular clamped corners).
Tolerance: 1 % of the displacement's length with 4 × 40 cells. A dead load gives a different curve: it leaves the end at
positive height for ever, far outside the tolerance, which is tested too.
"""

import numpy as np

import meshes
import problems
import turgor as tg

MM, MPA = problems.MM, problems.MPA
LENGTH, THICKNESS = 50 * MM, 5 * MM
PRESSURES = (2e-4, 5e-4, 1.0e-3, 1.5e-3)  # MPa
TIP = ((-2.727, 15.315), (-15.72, 33.70), (-46.14, 42.57), (-66.29, 31.82))  # mm


def _strip(load):
    mesh = meshes.box((LENGTH, THICKNESS, THICKNESS / 4), (40, 4, 1), lambda X: X - [0, THICKNESS / 2, 0])
    supports = [tg.Fixed("x0"), *problems.PLANE_STRAIN]
    model = problems.one_material(mesh, problems.NEO_HOOKE, supports=supports, loads=[load])
    factors = tuple(p / PRESSURES[-1] for p in PRESSURES)
    solution = problems.solve(model, tg.Static(first_step=factors[0] / 2, at=factors, tolerance=1e-7))
    tip = meshes.node_at(mesh, (LENGTH, 0, 0))
    return np.array([problems.state_at(solution, f).displacement[tip, :2] / MM for f in factors])


def test_tip_under_follower_pressure(record_verification):
    result = _strip(tg.Pressure("y0", PRESSURES[-1] * MPA))
    record_verification(
        claim="strip under follower pressure of 0.2, 0.5, 1, 1.5 kPa: displacement of the tip (x, y) [mm]",
        source="V13, converged reference",
        expected=TIP,
        got=result,
        tolerance="1 % of its length",
    )
    for got, expected in zip(result, TIP, strict=True):
        assert np.linalg.norm(got - expected) < 0.01 * np.linalg.norm(expected)


def test_dead_load_is_something_else():
    result = _strip(tg.Traction("y0", (0.0, PRESSURES[-1] * MPA, 0.0)))
    assert np.linalg.norm(result[-1] - TIP[-1]) > 0.2 * np.linalg.norm(TIP[-1])


def test_tangent_is_not_symmetric():
    """The open face's tangent has a skew part, so solving with its symmetric part alone would be another method."""
    from turgor.core.engine.system import System

    mesh = meshes.box((LENGTH, THICKNESS, THICKNESS), (4, 1, 1))
    model = problems.one_material(mesh, problems.NEO_HOOKE, supports=[tg.Fixed("x0")], loads=[tg.Pressure("y0", 1e3)])
    system = System(model)
    tangent = system.tangent(np.zeros(system.size), 1.0)
    assert abs(tangent - tangent.T).max() > 1e-6 * abs(tangent).max()
