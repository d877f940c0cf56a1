"""Force closure margin and share of friction of a grasp."""

import numpy as np
import pytest
from scipy.optimize import minimize

from refused import refused
from turgor.core.results.measures.grasping.force_closure import force_closure_margin

AROUND = np.column_stack([np.cos(2 * np.pi * np.arange(3) / 3), np.sin(2 * np.pi * np.arange(3) / 3), np.zeros(3)])
BALL = np.vstack([np.eye(3), -np.eye(3)])


def _exact(friction: float) -> float:
    """Least support function of the wrenches of three fingers around a ball, with round cones, by minimization."""

    def support(direction: np.ndarray) -> float:
        unit = direction / np.linalg.norm(direction)
        speed = unit[:3] + np.cross(unit[3:], AROUND)
        inward = -(speed * AROUND).sum(axis=1)
        across = np.linalg.norm(speed + inward[:, None] * AROUND, axis=1)
        return float((inward + friction * across).max())

    starts = np.random.default_rng(1).normal(size=(12, 6))
    options = {"maxiter": 4000, "maxfev": 4000, "fatol": 1e-8, "xatol": 1e-6}
    return min(minimize(support, start, method="Nelder-Mead", options=options).fun for start in starts)


@pytest.mark.parametrize("friction", [0.3, 0.8])
def test_three_fingers_around_a_ball_have_the_margin_of_round_cones(friction: float) -> None:
    got = force_closure_margin(0.02 * AROUND, -AROUND, friction=friction)
    narrow = _exact(friction * np.cos(np.pi / 8))  # the largest round cone within a pyramid of eight edges
    assert 0.97 * narrow <= got <= 1.001 * _exact(friction)  # minimization may end above the least value


def test_two_opposed_points_do_not_resist_a_twist_and_two_patches_do() -> None:
    pair = np.array([[1.0, 0, 0], [-1.0, 0, 0]])
    assert force_closure_margin(pair, -pair, friction=0.9) == 0
    corners = np.array([[0, 1, 1], [0, -1, 1], [0, 1, -1], [0, -1, -1]]) * 0.2
    patches = (pair[:, None] + corners).reshape(-1, 3)
    assert force_closure_margin(patches, np.repeat(-pair, 4, axis=0), friction=0.9) > 0.05


def test_without_friction_or_with_all_points_on_one_side_there_is_no_closure() -> None:
    assert force_closure_margin(BALL, -BALL, friction=0.0) == 0
    side = BALL + np.array([0, 0, 5.0])
    assert force_closure_margin(side, np.tile([0, 0, -1.0], (6, 1)), friction=0.5) == 0


def test_size_and_turn_do_not_matter_and_many_points_are_no_more_than_all() -> None:
    turn = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0]
    first = force_closure_margin(BALL, -BALL, friction=0.5)
    assert force_closure_margin(7.0 * BALL + 1.0, -BALL, friction=0.5) == pytest.approx(first)
    turned = force_closure_margin(BALL @ turn.T, -BALL @ turn.T, friction=0.5)
    assert turned == pytest.approx(first, rel=0.1)  # edges of the pyramids turn otherwise
    many = np.random.default_rng(3).normal(size=(50, 3))
    many /= np.linalg.norm(many, axis=1, keepdims=True)
    assert 0.2 < force_closure_margin(many, -many, friction=0.5) < 1


def test_points_and_normals_must_fit() -> None:
    with refused("points", "normals", "(k, 3)"):
        force_closure_margin(BALL, -BALL[:2], friction=0.5)
    with refused("friction", "-1"):
        force_closure_margin(BALL, -BALL, friction=-1.0)
