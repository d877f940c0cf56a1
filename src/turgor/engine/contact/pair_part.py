"""Contact of a surface with curved sides: with itself, or with a rigid body of triangles."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.engine.contact import friction, pairs
from turgor.engine.contact.friction import Anchors
from turgor.engine.contact.part import Found, Look, Ties, dofs, groups, nodal
from turgor.engine.contact.search import Grid, centers_of, find_partners, follow_partners, points_of
from turgor.engine.contact.surface import Surface
from turgor.model.obstacles import Obstacle

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: A foot point may cross so many sides between two searches.
WALK = 4

#: Where all is searched anew, a partner is given up for one that is nearer by this share of the cell behind it.
NEARER = 1e-3

#: Ties are kept ready for points nearer than this share of the cell behind them.
READY = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class Rigid:
    """Nodes that move together, behind those of the mesh: the triangles of an obstacle.

    Parameters
    ----------
    obstacle : Obstacle
    points : (m, 3) array
        Scaled positions at first.
    unknown : int
        First of its three unknowns where a spring holds it, −1 otherwise.
    """

    obstacle: Obstacle
    points: Array
    unknown: int


@dataclass(frozen=True, slots=True, eq=False)
class Partners:
    """Sides that may be touched.

    Parameters
    ----------
    sides : (t, m) int array
        Nodes of the mesh, or behind them those of the rigid body.
    corners : int
    overhang : (t, e) array
    depth : (t,) array
        Depth to which a point counts as inside.
    strangers : (start, list)
        For each side of the surface the partner sides that it never touches.
    around : (start, list)
        For each partner side those that share a node with it.
    reach : float
        How far apart two sides still see each other.
    rigid : Rigid or None
    """

    sides: Ints
    corners: int
    overhang: Array
    depth: Array
    strangers: tuple[Ints, Ints]
    around: tuple[Ints, Ints]
    reach: float
    rigid: Rigid | None = None


class PairPart:
    """Contact of a surface with sides.

    Parameters
    ----------
    name : str
    surface : Surface
        Its points are integrated on.
    partners : Partners
    coefficient : float
        Of friction.
    share : float
        Share of the stiffness that this part has: half where both surfaces are integrated on.
    """

    def __init__(self, name: str, surface: Surface, partners: Partners, coefficient: float, share: float) -> None:
        self.name, self.surface, self.partners = name, surface, partners
        self.coefficient, self.share = coefficient, share
        self.boost = np.ones(len(surface.sides))
        self.anchors: Anchors | None = None

    @property
    def rigid(self) -> Rigid | None:
        """The rigid body that is touched, if it is one."""
        return self.partners.rigid

    @property
    def obstacle(self) -> Obstacle | None:
        """The obstacle that is touched; None where the actuator meets itself."""
        return None if self.rigid is None else self.rigid.obstacle

    @property
    def unknown(self) -> int:
        """First unknown of the obstacle where a spring holds it, −1 otherwise."""
        return -1 if self.rigid is None else self.rigid.unknown

    @property
    def key_count(self) -> int:
        """Ties that are possible."""
        return len(self.surface.sides) * len(self.partners.sides)

    def _all(self, position: Array, place: Array) -> Array:
        return position if self.rigid is None else np.vstack([position, self.rigid.points + place])

    def look(self, position: Array, place: Array, known: Found | None = None, how: Look = Look.FOLLOW) -> Found:
        """Find what every point is near to, anew where nothing is known."""
        s, p = self.surface, self.partners
        x, normal, growth = points_of(position, s.sides, s.N, s.dN)
        every = self._all(position, place)
        if known is None:
            return Found(x, normal, growth, *self._search(x, normal, position, every), place)
        walk = 0 if how is Look.KEEP else WALK
        partner, at, gap = follow_partners(
            x, normal, every, p.sides, known.partner, known.at, p.around, p.overhang, walk
        )
        if how is Look.ANEW:
            others, places, gaps = self._search(x, normal, position, every)
            nearer = np.abs(gaps) < np.abs(gap) - NEARER * s.height[:, None]
            change = ~np.isfinite(gap) | ~np.isfinite(gaps) | nearer
            partner, gap = np.where(change, others, partner), np.where(change, gaps, gap)
            at = np.where(change[:, :, None], places, at)
        return Found(x, normal, growth, partner, at, gap, place)

    def _search(self, x: Array, normal: Array, position: Array, every: Array) -> tuple[Ints, Array, Array]:
        """Search the whole surface: partner, place and gap of every point."""
        s, p = self.surface, self.partners
        others = centers_of(every, p.sides, p.corners)
        own = others if p.sides is s.sides else centers_of(position, s.sides, s.corners)
        grid = Grid.of(others[0], p.reach + float(own[1].max() + others[1].max()))
        cubes = (grid.low, grid.edge, grid.counts, grid.start, grid.order)
        allowed = (p.overhang, p.depth)
        return find_partners(x, normal, every, p.sides, (own, others), cubes, allowed, p.reach, p.strangers)

    def _springs(self, points: Ints, partner: Ints) -> Array:
        """Pressure per depth (k,) at points: what the softer of both sides has, times the boost of the point's own."""
        side = points[:, 0]
        spring = self.surface.spring[side]
        if self.rigid is None:
            spring = np.minimum(spring, self.surface.spring[partner])
        return np.asarray(self.share * spring * self.boost[side])

    def _weights(self, points: Ints) -> Array:
        return np.asarray(self.surface.weights[points[:, 0], points[:, 1]])

    def _nodes(self, points: Ints, partner: Ints) -> Ints:
        return np.hstack([self.surface.sides[points[:, 0]], self.partners.sides[partner]])

    def forces(self, position: Array, found: Found) -> Array:
        """Internal forces (n, 3) on the nodes, those of a rigid body last."""
        every = self._all(position, found.place)
        points = found.touching
        i, q = points.T
        partner, at = found.partner[i, q], found.at[i, q]
        spring = self._springs(points, partner) * self._weights(points)
        local = pairs.press_forces(
            every, self.surface.sides, self.partners.sides, self.surface.N, points, partner, at, spring
        )
        out = nodal(self._nodes(points, partner), local, len(every))
        if self.anchors is None:
            return out
        a = self.anchors
        traction, _ = friction.tractions(a, self._apart(every, a.points, a.partner, a.at))
        local = (self._weights(a.points)[:, None] * self._shares(a))[:, :, None] * traction[:, None, :]
        return out + nodal(self._nodes(a.points, a.partner), local, len(every))

    def pressures(self, found: Found) -> Array:
        """Pressure (s, q) per reference area at the points, that of both passes."""
        out = np.zeros(found.gap.shape)
        points = found.touching
        i, q = points.T
        out[i, q] = self._springs(points, found.partner[i, q]) / self.share * -found.gap[i, q]
        return out

    def energy(self, found: Found) -> float:
        """Energy stored in the penetration."""
        points = found.touching
        spring = self._springs(points, found.partner[points[:, 0], points[:, 1]]) * self._weights(points)
        return float(0.5 * (spring * found.gap[points[:, 0], points[:, 1]] ** 2).sum())

    def stiffened(self, boost: Array, before: Found, found: Found) -> float:
        """Energy that raising the stiffness from a former ``boost`` (s,) put into what was and is penetrated.

        Exact where forces do their work by the trapezoidal rule: ½ (k₁ − k₀) g₀ g₁ at every point.
        """
        points = before.also(found)
        i, q = points.T
        gain = self._springs(points, found.partner[i, q]) * self._weights(points) * (1 - boost[i] / self.boost[i])
        return float(0.5 * (gain * before.gap[i, q] * found.gap[i, q]).sum())

    def rubbed(self, position: Array, found: Found) -> float:
        """Energy that friction has taken since the last state."""
        if self.anchors is None:
            return 0.0
        a = self.anchors
        apart = self._apart(self._all(position, found.place), a.points, a.partner, a.at)
        return friction.taken(a, apart, self._weights(a.points))

    def _apart(self, every: Array, points: Ints, partner: Ints, at: Array) -> Array:
        """Points minus places on their partners (k, 3)."""
        weights = self._signed(points, at)
        return np.einsum("ka,kai->ki", weights, every[self._nodes(points, partner)])

    def _signed(self, points: Ints, at: Array) -> Array:
        """Shape functions of the point, then minus those of its place on the partner (k, n1 + n2)."""
        there = pairs.shares_at(self.partners.sides.shape[1], np.ascontiguousarray(at))
        return np.hstack([self.surface.N[points[:, 1]], -there])

    def _shares(self, a: Anchors) -> Array:
        return self._signed(a.points, a.at)

    def keys(self, found: Found) -> Ints:
        """Ties that the tangent needs."""
        points = found.touching
        out = self._key(points[:, 0], found.partner[points[:, 0], points[:, 1]])
        if self.anchors is not None:
            out = np.concatenate([out, self._key(self.anchors.points[:, 0], self.anchors.partner)])
        return np.unique(out)

    def ready_keys(self, found: Found) -> Ints:
        """Ties that the tangent may need soon: of points that are near, with the sides around their partners."""
        near = np.argwhere(found.gap < READY * self.surface.height[:, None])
        side, partner = near[:, 0], found.partner[near[:, 0], near[:, 1]]
        start, around = self.partners.around
        count = start[partner + 1] - start[partner]
        rows = np.repeat(side, count)
        place = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count) + np.repeat(start[partner], count)
        return np.union1d(self.keys(found), self._key(rows, around[place]))

    def _key(self, side: Ints, partner: Ints) -> Ints:
        return np.asarray(side * len(self.partners.sides) + partner)

    def tied_unknowns(self, keys: Ints) -> Ints:
        """Unknowns of ties, in rows; −1 where a node is fixed."""
        side, partner = np.divmod(keys, len(self.partners.sides))
        first = dofs(self.surface.sides[side])
        if self.rigid is None:
            return np.hstack([first, dofs(self.partners.sides[partner])])
        body = self.rigid.unknown + np.arange(3) if self.rigid.unknown >= 0 else np.full(3, -1)
        return np.hstack([first, np.tile(body, (len(keys), self.partners.sides.shape[1]))])

    def tangents(self, position: Array, found: Found) -> list[Ties]:
        """Tangents of the points that touch, and of those that stick or slip."""
        every = self._all(position, found.place)
        points = found.touching
        out = []
        if len(points):
            partner = found.partner[points[:, 0], points[:, 1]]
            order, start, keys = groups(self._key(points[:, 0], partner))
            points, partner = np.ascontiguousarray(points[order]), np.ascontiguousarray(partner[order])
            spring = self._springs(points, partner) * self._weights(points)
            sides = (self.surface.sides, self.partners.sides)
            at = np.ascontiguousarray(found.at[points[:, 0], points[:, 1]])
            local = pairs.press_tangents(every, *sides, self.surface.N, points, partner, at, spring, start)
            out.append(Ties(self.tied_unknowns(keys), local))
        if self.anchors is not None and len(self.anchors.points):
            a = self.anchors
            _, matrices = friction.tractions(a, self._apart(every, a.points, a.partner, a.at))
            matrices *= self._weights(a.points)[:, None, None]
            order, start, keys = groups(self._key(a.points[:, 0], a.partner))
            local = pairs.tie_tangents(self._shares(a)[order], np.ascontiguousarray(matrices[order]), start)
            out.append(Ties(self.tied_unknowns(keys), local))
        return out

    def limits(self, found: Found) -> Array:
        """Coulomb's limit (k,) of the tractions of the anchors, from the present pressures."""
        assert self.anchors is not None
        points = self.anchors.points
        depth = np.maximum(-found.gap[points[:, 0], points[:, 1]], 0.0)
        spring = self._springs(points, np.maximum(found.partner[points[:, 0], points[:, 1]], 0))
        return np.asarray(self.coefficient * spring * np.where(np.isfinite(depth), depth, 0.0))

    def anchored(self, position: Array, found: Found) -> Anchors:
        """Anchors of the points that touch or soon may, with the tractions that they have."""
        every = self._all(position, found.place)
        points = np.argwhere(found.gap < friction.NEAR * self.surface.height[:, None])
        i, q = points.T
        partner, at = found.partner[i, q], found.at[i, q]
        normal = pairs.normals_at(every, self.partners.sides, partner, at)
        traction = np.zeros((len(points), 3))
        if self.anchors is not None:
            a = self.anchors
            now, _ = friction.tractions(a, self._apart(every, a.points, a.partner, a.at))
            before = np.zeros((*found.gap.shape, 3))
            before[a.points[:, 0], a.points[:, 1]] = now
            traction = friction.turned(before[i, q], normal)
        limit = self.coefficient * self._springs(points, partner) * np.maximum(-found.gap[i, q], 0.0)
        apart = self._apart(every, points, partner, at)
        return Anchors(points, partner, at, apart, normal, traction, limit, friction.elastic_slip(self.surface, points))

    def passed(self, position: Array, old: Found, new: Found) -> Array:
        """Signed gap (s, q) of points to the sides that were before them, where they have passed through unseen."""
        every = self._all(position, new.place)
        p = self.partners
        open_before = np.where((old.gap >= 0) & (new.gap >= 0) & (new.partner != old.partner), old.partner, -1)
        _, at, gap = follow_partners(new.x, new.normal, every, p.sides, open_before, old.at, p.around, p.overhang, 0)
        inside = (at.min(axis=2) > -0.1) & (at.max(axis=2) < 1.1)
        if self.partners.corners == 3:
            inside &= at.sum(axis=2) < 1.1
        deep = gap < -self.partners.depth[np.maximum(open_before, 0)]
        return np.where((open_before >= 0) & inside & deep, gap, np.inf)
