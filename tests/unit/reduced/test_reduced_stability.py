"""A body that may be in more than one place: an answer between these is flagged, one that lasts is not."""

from dataclasses import dataclass, replace

import numpy as np
from reduced_cases import PRESSURE, reduced

from turgor.reduced.states.reduced import Reduced

STIFFNESS, PLACE = 50.0, 1e-2


@dataclass(frozen=True)
class Snapping:
    """An energy k/4 (s² − a²)² of the last coordinate s: wells at ±a, a hill between."""

    def at(self, q):
        return SnappingAt(q)


@dataclass(frozen=True)
class SnappingAt:
    """It at some coordinates."""

    q: np.ndarray

    def forces(self):
        out, s = np.zeros(len(self.q)), self.q[-1]
        out[-1] = self.stiffness * s * (s**2 - PLACE**2)
        return out

    def tangent(self, geometric):
        out = np.zeros((len(self.q), len(self.q)))
        out[-1, -1] = self.stiffness * (3 * self.q[-1] ** 2 - PLACE**2)
        return out

    def linearized(self, update):
        return None

    @property
    def stiffness(self):
        return STIFFNESS / PLACE**2


def snapping() -> Reduced:
    """The finger with it: at rest it stands on the hill."""
    made = reduced()
    return replace(made, equations=replace(made.equations, parts=(*made.equations.parts, Snapping())))


def test_an_answer_on_a_hill_is_unstable_and_flagged():
    bistable = snapping()
    hill = bistable.solve(0.0)
    beside = hill.y.copy()
    beside[len(hill.q) - 1] = PLACE
    valley = bistable.solve(0.0, start=replace(hill, y=beside))
    assert abs(hill.q[-1]) < 1e-6
    assert valley.q[-1] > 0.5 * PLACE
    assert (hill.unstable_modes, valley.unstable_modes) == (1, 0)
    assert hill.doubtful
    assert hill.estimate < 0.005  # the estimate does not see it


def test_answers_of_a_finger_are_stable_and_states_of_a_motion_count_as_such():
    answer = reduced().solve(PRESSURE)
    assert answer.unstable_modes == 0
    pushed = snapping().solve(0.0)
    away = pushed.y.copy()
    away[0] += 0.5 * pushed.reduced.size
    assert replace(pushed, y=away).unstable_modes == 0
