"""Contact of a surface with a rigid body whose distance is a formula."""

import numpy as np
from numpy.typing import NDArray

from turgor.engine.contact import friction
from turgor.engine.contact.friction import Anchors
from turgor.engine.contact.pairs import tie_tangents
from turgor.engine.contact.part import Found, Look, Ties, dofs, groups, nodal
from turgor.engine.contact.search import points_of
from turgor.engine.contact.shapes import Formula, signed_distance
from turgor.engine.contact.surface import Surface
from turgor.model.obstacles import Obstacle

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


class ShapePart:
    """Contact of a surface with a plane, a sphere, a cylinder or a box.

    Parameters
    ----------
    name : str
    surface : Surface
    shape : Plane, Sphere, Cylinder or Box
        Scaled.
    obstacle : Obstacle or None
        What moves it; None for a mirror plane, which stays.
    unknown : int
        First of its three unknowns where a spring holds it, −1 otherwise.
    """

    def __init__(self, name: str, surface: Surface, shape: Formula, obstacle: Obstacle | None, unknown: int) -> None:
        self.name, self.surface, self.shape, self.obstacle, self.unknown = name, surface, shape, obstacle, unknown
        self.coefficient = 0.0 if obstacle is None else obstacle.friction
        self.share = 1.0
        self.boost = np.ones(len(surface.sides))
        self.anchors: Anchors | None = None

    @property
    def key_count(self) -> int:
        """Ties that are possible."""
        return len(self.surface.sides)

    def look(self, position: Array, place: Array, known: Found | None = None, how: Look = Look.FOLLOW) -> Found:
        """Measure the gap of every point."""
        s = self.surface
        x, normal, growth = points_of(position, s.sides, s.N, s.dN)
        gap, _, _ = signed_distance(self.shape, (x - place).reshape(-1, 3))
        zero = np.zeros(x.shape[:2], dtype=np.int64)
        at = np.zeros((*x.shape[:2], 2))
        return Found(x, normal, growth, zero, at, gap.reshape(x.shape[:2]), place)

    def _springs(self, points: Ints) -> Array:
        side = points[:, 0]
        return np.asarray(self.surface.spring[side] * self.boost[side])

    def _weights(self, points: Ints) -> Array:
        return np.asarray(self.surface.weights[points[:, 0], points[:, 1]])

    def _shares(self, points: Ints) -> Array:
        """Shape functions of a point, then minus one for the body (k, n + 1)."""
        return np.hstack([self.surface.N[points[:, 1]], -np.ones((len(points), 1))])

    def forces(self, position: Array, found: Found) -> Array:
        """Internal forces (n + 1, 3) on the nodes, and on the body last."""
        points = found.touching
        i, q = points.T
        pull = (self._springs(points) * self._weights(points) * found.gap[i, q])[:, None] * self._normals(found, points)
        out = self._summed(points, pull, len(position))
        if self.anchors is None:
            return out
        a = self.anchors
        traction, _ = friction.tractions(a, self._apart(found, a.points))
        return out + self._summed(a.points, self._weights(a.points)[:, None] * traction, len(position))

    def _summed(self, points: Ints, force: Array, count: int) -> Array:
        nodes = np.hstack([self.surface.sides[points[:, 0]], np.full((len(points), 1), count)])
        return nodal(nodes, self._shares(points)[:, :, None] * force[:, None, :], count + 1)

    def pressures(self, found: Found) -> Array:
        """Pressure (s, q) per reference area at the points."""
        out = np.zeros(found.gap.shape)
        points = found.touching
        out[points[:, 0], points[:, 1]] = self._springs(points) * -found.gap[points[:, 0], points[:, 1]]
        return out

    def energy(self, found: Found) -> float:
        """Energy stored in the penetration."""
        points = found.touching
        spring = self._springs(points) * self._weights(points)
        return float(0.5 * (spring * found.gap[points[:, 0], points[:, 1]] ** 2).sum())

    def stiffened(self, boost: Array, before: Found, found: Found) -> float:
        """Energy that raising the stiffness from a former ``boost`` (s,) put into what was and is penetrated.

        Exact where forces do their work by the trapezoidal rule: ½ (k₁ − k₀) g₀ g₁ at every point.
        """
        points = before.also(found)
        i, q = points.T
        gain = self._springs(points) * self._weights(points) * (1 - boost[i] / self.boost[i])
        return float(0.5 * (gain * before.gap[i, q] * found.gap[i, q]).sum())

    def rubbed(self, position: Array, found: Found) -> float:
        """Energy that friction has taken since the last state."""
        a = self.anchors
        return 0.0 if a is None else friction.taken(a, self._apart(found, a.points), self._weights(a.points))

    def _apart(self, found: Found, points: Ints) -> Array:
        return np.asarray(found.x[points[:, 0], points[:, 1]] - found.place)

    def _normals(self, found: Found, points: Ints) -> Array:
        """Normals (k, 3) out of the body."""
        return signed_distance(self.shape, self._apart(found, points))[1]

    def keys(self, found: Found) -> Ints:
        """Ties that the tangent needs beyond those of the cells: of sides with a sprung body."""
        if self.unknown < 0:
            return np.zeros(0, dtype=np.int64)
        sides = found.touching[:, 0]
        if self.anchors is not None:
            sides = np.concatenate([sides, self.anchors.points[:, 0]])
        return np.unique(sides)

    def ready_keys(self, found: Found) -> Ints:
        """Ties that the tangent may need: all sides."""
        return np.arange(len(self.surface.sides)) if self.unknown >= 0 else np.zeros(0, dtype=np.int64)

    def tied_unknowns(self, keys: Ints) -> Ints:
        """Unknowns of ties, in rows; −1 where the body does not move freely."""
        body = self.unknown + np.arange(3) if self.unknown >= 0 else np.full(3, -1)
        return np.hstack([dofs(self.surface.sides[keys]), np.tile(body, (len(keys), 1))])

    def tangents(self, position: Array, found: Found) -> list[Ties]:
        """Tangents of the points that touch, and of those that stick or slip."""
        points, out = found.touching, []
        gap, gradient, hessian = signed_distance(self.shape, self._apart(found, points))
        matrices = gradient[:, :, None] * gradient[:, None, :] + gap[:, None, None] * hessian
        matrices *= (self._springs(points) * self._weights(points))[:, None, None]
        if len(points):
            out.append(self._tied(points, matrices))
        if self.anchors is not None and len(self.anchors.points):
            a = self.anchors
            _, matrices = friction.tractions(a, self._apart(found, a.points))
            out.append(self._tied(a.points, matrices * self._weights(a.points)[:, None, None]))
        return out

    def _tied(self, points: Ints, matrices: Array) -> Ties:
        order, start, sides = groups(points[:, 0])
        local = tie_tangents(self._shares(points)[order], np.ascontiguousarray(matrices[order]), start)
        return Ties(self.tied_unknowns(sides), local)

    def limits(self, found: Found) -> Array:
        """Coulomb's limit (k,) of the tractions of the anchors, from the present pressures."""
        assert self.anchors is not None
        points = self.anchors.points
        depth = np.maximum(-found.gap[points[:, 0], points[:, 1]], 0.0)
        return np.asarray(self.coefficient * self._springs(points) * depth)

    def anchored(self, position: Array, found: Found) -> Anchors:
        """Anchors of the points that touch or soon may, with the tractions that they have."""
        points = np.argwhere(found.gap < friction.NEAR * self.surface.height[:, None])
        i, q = points.T
        normal = self._normals(found, points)
        traction = np.zeros((len(points), 3))
        if self.anchors is not None:
            now, _ = friction.tractions(self.anchors, self._apart(found, self.anchors.points))
            before = np.zeros((*found.gap.shape, 3))
            before[self.anchors.points[:, 0], self.anchors.points[:, 1]] = now
            traction = friction.turned(before[i, q], normal)
        limit = self.coefficient * self._springs(points) * np.maximum(-found.gap[i, q], 0.0)
        zero = np.zeros(len(points), dtype=np.int64)
        apart = self._apart(found, points)
        at = np.zeros((len(points), 2))
        return Anchors(points, zero, at, apart, normal, traction, limit, friction.elastic_slip(self.surface, points))

    def passed(self, position: Array, old: Found, new: Found) -> Array:
        """No point passes unseen: the gap is a formula."""
        return np.full(new.gap.shape, np.inf)
