"""Twist: what of the tip's rotation turns it about its own normal, whatever it bends besides."""

import numpy as np
import pytest
import results_cases as cases

from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures import standard_measures as standard
from turgor.core.results.measures.measures import measure
from turgor.core.results.measures.rotations import face_rotation
from turgor.units import deg


def twisted(angle):
    """Turn every section about the x axis through the middle of the body, in proportion to x."""
    middle = np.array([0.0, 0.0, cases.HEIGHT / 2])

    def place(points):
        turn = angle * points[:, 0] / cases.LENGTH
        (x, y, z), c, s = (points - middle).T, np.cos(turn), np.sin(turn)
        return np.stack([x, c * y - s * z, s * y + c * z], axis=1) + middle

    return place


@pytest.mark.parametrize("bend", [0, 40, 120])
@pytest.mark.parametrize("twist", [-70, 0, 25, 150])
def test_twist_before_bending_is_found_again(twist, bend):
    twisting, bending = twisted(twist * deg), cases.bent(bend * deg)
    state = cases.state(cases.model(cases.body()), lambda X: bending(twisting(X)))
    assert standard.twist_angle(state) / deg == pytest.approx(twist, abs=0.05)


def test_twist_ignores_a_turn_of_the_whole_actuator():
    c, s = np.cos(50 * deg), np.sin(50 * deg)
    turn = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    twisting = twisted(20 * deg)
    state = cases.state(cases.model(cases.body()), lambda X: twisting(X) @ turn.T)
    assert standard.twist_angle(state) / deg == pytest.approx(20, abs=1e-6)
    assert face_rotation(StateFields(state), "fixed") == pytest.approx(turn)


def test_twist_continues_past_half_a_turn():
    model = cases.model(cases.body())
    path = [cases.state(model, twisted(a * deg), a / 400) for a in (0, 100, 200, 300, 400)]
    response = measure(cases.solution(path), standard.twist_angle)
    assert response.column("twist_angle") / deg == pytest.approx([0, 100, 200, 300, 400], abs=0.01)


def test_a_half_cannot_twist():
    state = cases.state(cases.model(cases.body(half=True)), lambda X: X + 0.1 * X[:, [2, 0, 1]])
    assert standard.twist_angle(state) == 0.0


def test_displacement_across():
    state = cases.state(cases.model(cases.body()), lambda X: X + np.outer(X[:, 0], [0.0, 0.1, 0.0]))
    assert standard.tip_displacement_y(state) == pytest.approx(0.1 * cases.LENGTH)
