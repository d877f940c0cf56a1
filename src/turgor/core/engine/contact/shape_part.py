"""Contact of a surface with a rigid body whose distance is a formula."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.contact.closest import points_of
from turgor.core.engine.contact.friction import FrictionHistory
from turgor.core.engine.contact.part import Gaps, SearchMode, Ties, dofs, nodal
from turgor.core.engine.contact.points_part import PointsPart
from turgor.core.engine.contact.surface import Surface
from turgor.core.model.obstacles import Obstacle, RigidShape
from turgor.core.model.obstacles.pose import Pose

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


class ShapePart(PointsPart):
    """Contact of a surface with a plane, a sphere, or another shape whose distance is a formula.

    Parameters
    ----------
    name : str
    surface : Surface
    shape : RigidShape
        Scaled.
    obstacle : Obstacle or None
        What moves it; None for a mirror plane, which stays.
    unknown : int
        First of its three unknowns where a spring holds it, −1 otherwise.
    """

    def __init__(self, name: str, surface: Surface, shape: RigidShape, obstacle: Obstacle | None, unknown: int) -> None:
        super().__init__(name, surface, 0.0 if obstacle is None else obstacle.friction, 1.0)
        self.shape, self.obstacle, self.unknown = shape, obstacle, unknown

    @property
    def _couples(self) -> bool:
        """Whether a tie couples unknowns that no cell couples."""
        return self.unknown >= 0 or not self.surface.coupled

    @property
    def key_count(self) -> int:
        """Ties that are possible."""
        return len(self.surface.sides)

    def look(self, position: Array, pose: Pose, known: Gaps | None = None, how: SearchMode = SearchMode.FOLLOW) -> Gaps:
        """Measure the gap of every point."""
        s = self.surface
        x, normal, growth = points_of(position, s.sides, s.N, s.dN)
        gap, _, _ = self.shape.signed_distance(pose.at_first(x).reshape(-1, 3))
        zero = np.zeros(x.shape[:2], dtype=np.int64)
        at = np.zeros((*x.shape[:2], 2))
        return Gaps(x, normal, growth, zero, at, gap.reshape(x.shape[:2]), pose, np.ones(x.shape[:2]))

    def _springs(self, points: Ints, gaps: Gaps) -> Array:
        side = points[:, 0]
        return np.asarray(self.surface.spring[side] * self.penalty_scale[side])

    def _nodes(self, points: Ints, partner: Ints, count: int) -> Ints:
        return np.hstack([self.surface.sides[points[:, 0]], np.full((len(points), 1), count)])

    def _shares(self, points: Ints, at: Array) -> Array:
        return np.hstack([self.surface.N[points[:, 1]], -np.ones((len(points), 1))])

    def _press(self, position: Array, gaps: Gaps) -> Array:
        points = gaps.touching
        i, q = points.T
        partner, at = gaps.partner[i, q], gaps.at[i, q]
        spring = self._springs(points, gaps) * self._weights(points)
        push = (spring * gaps.gap[i, q])[:, None] * self._normals(position, gaps, points)
        local = self._shares(points, at)[:, :, None] * push[:, None, :]
        return nodal(self._nodes(points, partner, len(position)), local, len(position) + 1)

    def _press_tangents(self, position: Array, gaps: Gaps) -> Ties:
        points = gaps.touching
        i, q = points.T
        gap, gradient, hessian = self.shape.signed_distance(gaps.pose.at_first(gaps.x[i, q]))
        matrices = gradient[:, :, None] * gradient[:, None, :] + gap[:, None, None] * hessian
        matrices = gaps.pose.turned_tensors(matrices)
        matrices *= (self._springs(points, gaps) * self._weights(points))[:, None, None]
        return self._tied(points, gaps.partner[i, q], self._shares(points, gaps.at[i, q]), matrices)

    def _apart(self, position: Array, gaps: Gaps, a: FrictionHistory) -> Array:
        return gaps.pose.at_first(gaps.x[a.points[:, 0], a.points[:, 1]])

    def _normals(self, position: Array, gaps: Gaps, points: Ints) -> Array:
        return gaps.pose.turned(self.shape.signed_distance(gaps.pose.at_first(gaps.x[points[:, 0], points[:, 1]]))[1])

    def _key(self, side: Ints, partner: Ints) -> Ints:
        return side

    def keys(self, gaps: Gaps) -> Ints:
        """Ties that the tangent needs beyond those of the cells: of sides with a sprung body or with their middles."""
        if not self._couples:
            return np.zeros(0, dtype=np.int64)
        sides = gaps.touching[:, 0]
        if gaps.friction is not None:
            sides = np.concatenate([sides, gaps.friction.points[:, 0]])
        return np.unique(sides)

    def ready_keys(self, gaps: Gaps) -> Ints:
        """Ties that the tangent may need: all sides."""
        return np.arange(len(self.surface.sides)) if self._couples else np.zeros(0, dtype=np.int64)

    def tied_unknowns(self, keys: Ints) -> Ints:
        """Unknowns of ties, in rows; −1 where the body does not move freely."""
        body = self.unknown + np.arange(3) if self.unknown >= 0 else np.full(3, -1)
        return np.hstack([dofs(self.surface.sides[keys]), np.tile(body, (len(keys), 1))])

    def passed(self, position: Array, old: Gaps, new: Gaps) -> Array:
        """No point passes unseen: the gap is a formula."""
        return np.full(new.gap.shape, np.inf)
