"""V09: a round bar twisted through a reference point needs the exact torque, and a torque twists it as far.

Problem: the bar of V09, radius and length 10 mm, Mooney–Rivlin (0.10, 0.02 MPa). One end is fixed, the other tied
rigidly to a point that is turned about the axis by τL up to one radian and cannot move along it. Then the torques of
the table act on the point instead, as a moment with its axis fixed in space and as one that follows; the point may
tilt. Plane sections of the exact solution turn as rigid bodies, so the rigid face is no disturbance.
Exact: T = π τ A⁴ (C10 + C01), N = −½ π A⁴ τ² (C10 + 2 C01). Source: Rivlin 1948; table V09.
Tolerance: torque and angle 0.2 %, axial force 1 % (the table's demands).
"""

import numpy as np
import pytest
from turgor.loads import Moment
from turgor.supports import ReferencePoint, Rotation

import meshes
import problems
import turgor as tg
from problems import MM, MPA
from turgor.core.geometry.solids import RoundBar

LENGTH = 10 * MM
LAW = tg.laws.MooneyRivlin(C10=0.10 * MPA, C01=0.02 * MPA)
ANGLES = (0.2, 0.5, 1.0)
TORQUES, FORCES = (75.398224, 188.49556, 376.99112), (-0.87964594, -5.4977871, -21.991149)


@pytest.fixture(scope="module")
def bar():
    """The bar with its two ends apart."""
    mesh = tg.mesh(RoundBar(radius=10 * MM, length=LENGTH).build(), size=3 * MM)
    ends = mesh.face("ends")
    right = mesh.points[ends].mean(axis=1)[:, 0] > 0
    return meshes.with_faces(mesh, left=ends[~right], right=ends[right])


def _solved(bar, supports, loads=()):
    held = [tg.Fixed("left"), ReferencePoint("plate", "right"), *supports]
    solution = problems.solve(problems.one_material(bar, LAW, supports=held, loads=loads), tg.Static(at=ANGLES[:-1]))
    return [problems.state_at(solution, factor).points["plate"] for factor in ANGLES]


def test_a_prescribed_rotation_needs_the_torque(bar, record_verification):
    result = _solved(bar, [tg.Fixed("plate"), Rotation("plate", 1.0)])
    torque, force = [point.moment[0] / (1e-3) for point in result], [point.force[0] for point in result]
    what = "round bar twisted through a point to 0.2, 0.5, 1 rad"
    record_verification(f"{what}: torque [N mm]", "V09, exact", TORQUES, torque, "0.2 %")
    record_verification(f"{what}: axial force [N]", "V09, exact", FORCES, force, "1 %")
    assert torque == pytest.approx(TORQUES, rel=2e-3)
    assert force == pytest.approx(FORCES, rel=1e-2)


@pytest.mark.parametrize("follower", [False, True], ids=["fixed axis", "follower"])
def test_the_torque_twists_it_as_far(bar, follower, record_verification):
    history = [(0.0, 0.0), *((angle, torque / TORQUES[-1]) for angle, torque in zip(ANGLES, TORQUES, strict=True))]
    moment = Moment("plate", (TORQUES[-1] * 1e-3, 0.0, 0.0), history=history, follower=follower)
    result = _solved(bar, [tg.Fixed("plate")], [moment])
    angles = [float(np.arctan2(point.rotation[2, 1], point.rotation[1, 1])) for point in result]
    kind = "that follows" if follower else "with a fixed axis"
    record_verification(f"round bar twisted by a moment {kind}: angle [rad]", "V09, exact", ANGLES, angles, "0.2 %")
    assert angles == pytest.approx(ANGLES, rel=2e-3)
    assert [point.rotation[0, 0] for point in result] == pytest.approx([1.0] * 3, abs=1e-4)  # it did not tilt
