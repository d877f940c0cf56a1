"""V08: a moment on an averaging point bends a straight bar to a circle, without disturbing its end.

Problem: a square bar of incompressible rubber between two averaging points, on coarse tetrahedra; one point is held and
kept from turning, a small moment acts on the other. The tractions of both are linear over the section, as the stress of
pure bending is, so that quadratic cells hold the exact solution of the linear theory.
Exact: the end turns by M L / (E I), and the point's mean displacement is that of a parabola.
Source: theory of beams, exact here; E = 6 C10, I = a⁴/12. Tolerance: 1e-6, the share of what is not linear.

With a hinge about an axis at 45° in the section, the part of the moment about this axis bends the bar, and the hinge
takes the rest. A prescribed twist that leaves the tilt free leaves the bending as it is, of 1e-3 of an angle squared.

A rigid face that may only move along x is what `PlaneSection` and `Fixed` in y and z make of it: the same equations, so
the same displacements to round-off. And half of a bar between mirror planes carries half of force, moment and springs.
"""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as Turn
from turgor.loads import Force, Hanging, Moment
from turgor.supports import Hinge, PlaneSection, ReferencePoint, Rotation

import problems
import rig
import turgor as tg

YOUNG = 6 * problems.NEO_HOOKE.C10
INERTIA = rig.SIDE**4 / 12


def test_a_moment_bends_a_bar_to_a_circle(record_verification):
    points = [ReferencePoint("left", "x0", coupling="averaging"), ReferencePoint("right", "x1", coupling="averaging")]
    moment = 1e-3 * YOUNG * INERTIA / rig.LENGTH
    model = tg.Model(
        rig.bar(), {"body": problems.rubber(problems.NEO_HOOKE)}, [*points, tg.Fixed("left"), Rotation("left")],
        [Moment("right", (0.0, moment, 0.0))],
    )  # fmt: skip
    state = problems.solve(model, tg.Static(tolerance=1e-9)).states[-1]
    angle = float(np.arcsin(state.points["right"].rotation[0, 2]))
    record_verification("bar bent by a moment: angle of its end [mrad]", "V08, beam", 1.0, 1e3 * angle, "1e-6")
    assert angle == pytest.approx(1e-3, rel=1e-6)
    assert state.points["left"].moment == pytest.approx([0.0, -moment, 0.0], abs=1e-6 * moment)
    # the tip of a parabola, less what the section of the other end dishes on average, which is the same at both
    assert state.points["right"].displacement[2] == pytest.approx(-0.5e-3 * rig.LENGTH, rel=1e-5)


def _bent(*supports):
    points = [ReferencePoint("left", "x0", coupling="averaging"), ReferencePoint("right", "x1", coupling="averaging")]
    moment = np.array([0.0, 1e-3 * YOUNG * INERTIA / rig.LENGTH, 0.0])
    model = tg.Model(
        rig.bar(), {"body": problems.rubber(problems.NEO_HOOKE)},
        [*points, tg.Fixed("left"), Rotation("left"), *supports], [Moment("right", moment)],
    )  # fmt: skip
    right = problems.solve(model, tg.Static(tolerance=1e-9)).states[-1].points["right"]
    return Turn.from_matrix(right.rotation).as_rotvec(), right.moment / moment[1]


def test_a_hinge_takes_the_moment_across_its_axis(record_verification):
    rotation, reaction = _bent(Hinge("right", (0.0, 2.0, 2.0)))
    angle = float(np.linalg.norm(rotation))
    record_verification("bar with a skew hinge: angle of its end [mrad]", "V08, beam", 0.5**0.5, 1e3 * angle, "1e-6")
    assert rotation == pytest.approx([0.0, 0.5e-3, 0.5e-3], abs=1e-9)
    assert reaction == pytest.approx([0.0, -0.5, 0.5], abs=2e-6)


def test_a_driven_twist_leaves_the_bending():
    rotation, reaction = _bent(Rotation("right", 2e-3, tilts=True))
    assert rotation == pytest.approx([2e-3, 1e-3, 0.0], abs=3e-6)  # the bent axis is not that of the twist
    assert reaction[0] > 0.1
    assert reaction[1:] == pytest.approx([0.0, 0.0], abs=2e-3)
    kept, held = _bent(Rotation("right", 2e-3))
    assert kept == pytest.approx([2e-3, 0.0, 0.0], abs=1e-12)
    assert held[1] == pytest.approx(-1.0, abs=1e-5)
    twice = _bent(Rotation("right", 4e-3, tilts=True))[1]
    assert twice[0] == pytest.approx(2 * reaction[0], rel=1e-5)


def test_a_twist_goes_through_many_turns_with_a_tilt():
    """More than half a turn about a skew axis: the twist is what was asked for, whatever the tilt."""
    axis = np.array([3.0, 1.0, 0.0]) / 10**0.5
    point = ReferencePoint("plate", "x1")
    model = rig.rig(point, [Rotation("plate", 3.5, tuple(axis), tilts=True)], mesh=rig.bar(counts=(4, 1, 1)))
    last = problems.solve(model, tg.Static(first_step=0.1)).states[-1].points["plate"]
    x, y, z, w = Turn.from_matrix(last.rotation).as_quat()
    twist = 2 * np.arctan2(axis @ [x, y, z], w)
    assert np.cos(twist - 3.5) == pytest.approx(1.0, abs=1e-8)
    tilted = np.arccos(axis @ last.rotation @ axis)
    assert tilted > 0.05


def test_a_guided_rigid_face_is_a_plane_section():
    mesh, force = rig.bar(), Force("x1", (30.0, 0.0, 0.0))
    known = rig.rig(PlaneSection("x1"), [tg.Fixed("x1", "yz")], [force], mesh)
    guided = [tg.Fixed("plate", "yz"), Rotation("plate")]
    tied = rig.rig(ReferencePoint("plate", "x1"), guided, [Force("plate", force.vector)], mesh)
    a, b = (problems.solve(model, tg.Static(tolerance=1e-9)).states[-1] for model in (known, tied))
    assert b.points["plate"].displacement[0] > 0.5 * rig.LENGTH
    assert b.displacement == pytest.approx(a.displacement, abs=1e-12)


@pytest.mark.parametrize("coupling", ["rigid", "averaging"])
def test_half_a_bar_carries_half(coupling):
    loads = [Moment("plate", (0.0, 5e-3, 0.0)), Force("plate", (0.2, 0.0, -0.3)), Hanging("plate", 0.01)]
    point = ReferencePoint("plate", "x1", coupling=coupling, spring=(20.0, 30.0, 40.0), rotational_spring=0.01)
    whole, half = (
        problems.solve(
            rig.rig(point, loads=loads, mesh=rig.bar(rig.HEXAHEDRON, half=cut)), tg.Static(tolerance=1e-8)
        ).states[-1].points["plate"]
        for cut in (False, True)
    )  # fmt: skip
    assert abs(whole.displacement[2]) > 2e-3
    assert half.displacement == pytest.approx(whole.displacement, abs=1e-9)
    assert half.rotation == pytest.approx(whole.rotation, abs=1e-7)
    assert half.force == pytest.approx(whole.force, abs=1e-7)
    assert half.moment == pytest.approx(whole.moment, abs=1e-9)
    assert np.linalg.norm(half.moment) > 1e-3
