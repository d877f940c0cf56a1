"""Arcs: three ways to a pose agree, several segments, the way back for one and for several."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.fast_models.formulas import Arc, arc_to, backbone, pose, poses, reach
from turgor.units import mm

ARCS = [
    Arc(curvature=kappa, plane=phi, length=length)
    for kappa in (0.0, 1e-9, 1e-4, 0.5, 8.0, 40.0, 62.0)
    for phi in (-np.pi, -1.2, 0.0, 0.7, 3.0)
    for length in (0.02, 0.1)
]


@pytest.mark.parametrize("method", ["denavit_hartenberg", "exponential"])
def test_three_ways_agree(method):
    for arc in ARCS:
        assert pose(arc, method) == pytest.approx(pose(arc), abs=1e-12)


def test_pose_is_a_rotation_and_the_end_of_a_circle():
    for arc in ARCS:
        frame = pose(arc)
        assert frame[:3, :3].T @ frame[:3, :3] == pytest.approx(np.eye(3), abs=1e-12)
        assert np.linalg.det(frame[:3, :3]) == pytest.approx(1.0, abs=1e-12)
        if arc.curvature < 0.1:
            continue
        center = np.array([0.0, np.cos(arc.plane), np.sin(arc.plane)]) / arc.curvature
        assert np.linalg.norm(frame[:3, 3] - center) == pytest.approx(1 / arc.curvature, rel=1e-12)
        assert frame[:3, 0] @ (frame[:3, 3] - center) == pytest.approx(0.0, abs=1e-12)  # tangent


def test_segments_of_one_curvature_are_one_segment():
    whole, half = Arc(curvature=9.0, plane=0.4, length=0.2), Arc(curvature=9.0, plane=0.4, length=0.1)
    for method in ("geometry", "denavit_hartenberg", "exponential"):
        assert poses([half, half], method)[-1] == pytest.approx(pose(whole), abs=1e-12)
    line = backbone([half, half], points=5)
    assert line.shape == (11, 3)
    assert line[-1] == pytest.approx(pose(whole)[:3, 3], abs=1e-12)
    steps = np.linalg.norm(np.diff(line, axis=0), axis=1)
    assert steps == pytest.approx(np.full(10, steps[0]), rel=1e-9)


def test_arc_to_a_position_is_exact():
    for arc in ARCS:
        if not 1e-3 < arc.angle < 2 * np.pi - 0.05:
            continue
        result = arc_to(pose(arc)[:3, 3])
        assert [result.curvature, result.length] == pytest.approx([arc.curvature, arc.length], rel=1e-9)
        assert np.cos(result.plane - arc.plane) == pytest.approx(1.0, abs=1e-12)
    straight = arc_to([0.1, 0, 0])
    assert (straight.curvature, straight.length) == (0.0, pytest.approx(0.1))
    with refused("(-100, 0, 0) mm", "base"):
        arc_to([-0.1, 0, 0])


@pytest.mark.parametrize("count", [1, 2, 3])
def test_several_segments_reach_what_segments_can_reach(count):
    rng = np.random.default_rng(count)
    for _ in range(4):
        arcs = [Arc(curvature=rng.uniform(3, 20), plane=rng.uniform(-3, 3), length=0.1) for _ in range(count)]
        tip = poses(arcs)[-1]
        look = tip[:3, 0] if count > 1 else None
        result = reach(tip[:3, 3], [0.1] * count, direction=look)
        end = poses(result.arcs)[-1]
        assert end[:3, 3] == pytest.approx(tip[:3, 3], abs=1e-7)
        assert max(arc.angle for arc in result.arcs) <= np.pi + 1e-6
        if look is not None:
            assert end[:3, 0] == pytest.approx(look, abs=1e-6)


def test_out_of_reach_is_said_and_the_nearest_is_returned():
    with refused("100 mm", "0 deg", "200 mm", "largest_angle"):
        reach([0.3, 0, 0], [0.1, 0.1])
    near = reach([0.3, 0, 0], [0.1, 0.1], throw=False)
    assert near.position_error == pytest.approx(0.1, rel=1e-3)
    with refused("lengths", "[0.1, -0.1]", "positive"):
        reach([0.1, 0, 0], [0.1, -0.1])


def test_lengths_of_three_chambers_and_back():
    part = tg.actuators.ThreeExtenders()
    for arc in (Arc(curvature=6.0, plane=0.9, length=0.05), Arc(curvature=0.0, plane=0.0, length=0.05)):
        lengths = tg.formulas.lengths_of_arc(part, arc)
        result = tg.formulas.arc_of_lengths(part, lengths)
        assert pose(result) == pytest.approx(pose(arc), abs=1e-12)
    # Webster and Jones: kappa from three lengths at the distance d from the middle
    l1, l2, l3, d = 52 * mm, 50 * mm, 47 * mm, part.side / np.sqrt(3)
    root = np.sqrt(l1**2 + l2**2 + l3**2 - l1 * l2 - l1 * l3 - l2 * l3)
    arc = tg.formulas.arc_of_lengths(part, [l1, l2, l3])
    assert arc.curvature == pytest.approx(2 * root / (d * (l1 + l2 + l3)), rel=1e-12)
    with refused("lengths", "0.05", "three chambers"):
        tg.formulas.arc_of_lengths(part, [l1, l2])
    with refused("ExtendingCylinder", "ThreeExtenders"):
        tg.formulas.arc_of_lengths(tg.actuators.ExtendingCylinder(), [l1, l2, l3])


def test_bad_arcs_are_refused():
    with refused("length", "-1 mm", "positive"):
        Arc(curvature=1.0, plane=0.0, length=-1 * mm)
    with refused("curvature", "nan", "finite"):
        Arc(curvature=float("nan"), plane=0.0, length=1.0)
    with refused("'geometri'", "'geometry'"):
        pose(ARCS[0], "geometri")
