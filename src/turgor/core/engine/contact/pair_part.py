"""Contact of a surface with curved sides: with itself, or with a rigid body of triangles."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import side_tables
from turgor.core.engine.contact import pairs
from turgor.core.engine.contact.closest import centers_of, points_of
from turgor.core.engine.contact.friction import FrictionHistory
from turgor.core.engine.contact.part import Gaps, SearchMode, Ties, dofs, groups, nodal
from turgor.core.engine.contact.points_part import PointsPart, Rubbing
from turgor.core.engine.contact.search import Grid, find_partners, follow_partners
from turgor.core.engine.contact.settings import CONTACT_SEARCH
from turgor.core.engine.contact.surface import Rims, Surface
from turgor.core.model.obstacles import Obstacle
from turgor.core.model.obstacles.pose import Pose

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


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
        How far a foot point may lie beyond each edge.
    depth : (t,) array
        Depth to which a point counts as inside.
    strangers : (start, list)
        For each side of the surface the partner sides that it never touches; for one of two sides that are not open,
        those that it may touch.
    around : (start, list)
        For each partner side those that share a node with it.
    reach : float
        How far apart two sides still see each other.
    rigid : Rigid or None
    rims : Rims, optional
        Sharp edges that fade the points that they pass; None for films, and without friction.
    open : (t,) bool array, optional
        Sides that touch all other open ones but strangers: all of solids, those of films that look out of a cavity.
    """

    sides: Ints
    corners: int
    overhang: Array
    depth: Array
    strangers: tuple[Ints, Ints]
    around: tuple[Ints, Ints]
    reach: float
    rigid: Rigid | None = None
    rims: Rims | None = None
    open: NDArray[np.bool_] | None = None


class PairPart(PointsPart):
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
        super().__init__(name, surface, coefficient, share)
        self.partners = partners
        self._beyond, lengths = partners.overhang, np.sqrt(surface.weights.sum(axis=1))[:, None]
        if partners.rigid is None:
            self._band = CONTACT_SEARCH.inner_rim * np.broadcast_to(lengths, surface.weights.shape)
            if partners.rims is not None:  # what is nearer to its own rim presses
                own = np.repeat(np.arange(len(surface.sides)), surface.weights.shape[1])
                places = np.tile(side_tables(surface.sides.shape[1]).points, (len(surface.sides), 1))
                within, _ = partners.rims.within(own, places)
                self._band = np.minimum(self._band, within.reshape(surface.weights.shape))
        else:
            self._band = CONTACT_SEARCH.rim * np.broadcast_to(lengths, surface.weights.shape)
        if partners.rigid is not None and partners.rims is not None:  # points have a partner until its rim has passed
            self._beyond = np.maximum(self._beyond, partners.rims.beyond(float(self._band.max(initial=0.0))))

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

    def _all(self, position: Array, pose: Pose) -> Array:
        return position if self.rigid is None else np.vstack([position, pose.moved(self.rigid.points)])

    def look(self, position: Array, pose: Pose, known: Gaps | None = None, how: SearchMode = SearchMode.FOLLOW) -> Gaps:
        """Find the partner of every point, by a global search where none is known."""
        s, p = self.surface, self.partners
        x, normal, growth = points_of(position, s.sides, s.N, s.dN)
        every = self._all(position, pose)
        if known is None:
            nearest = self._search(x, normal, position, every)
            return Gaps(x, normal, growth, *nearest, pose, self._covered(*nearest))
        walk = 0 if how is SearchMode.KEEP else CONTACT_SEARCH.walk
        partner, at, gap = follow_partners(
            (x, normal), every, p.sides, known.partner, known.at, p.around, self._beyond, walk
        )
        if how is SearchMode.GLOBAL:
            others, places, gaps = self._search(x, normal, position, every)
            nearer = np.abs(gaps) < np.abs(gap) - CONTACT_SEARCH.nearer * s.height[:, None]
            change = ~np.isfinite(gap) | ~np.isfinite(gaps) | nearer
            partner, gap = np.where(change, others, partner), np.where(change, gaps, gap)
            at = np.where(change[:, :, None], places, at)
        return Gaps(x, normal, growth, partner, at, gap, pose, self._covered(partner, at, gap))

    def _covered(self, partner: Ints, at: Array, gap: Array) -> Array:
        """Share (s, q) of points that their partners cover: less than 1 where a sharp rim passes them."""
        out = np.ones(gap.shape)
        near = np.argwhere(gap < 0)
        if self.partners.rims is not None and len(near):
            i, q = near.T
            out[i, q], _ = self.partners.rims.covered(partner[i, q], at[i, q], self._band[i, q], self.rigid is not None)
        return out

    def _fading(self, position: Array, points: Ints, gaps: Gaps) -> Array:
        """Derivatives (k, m) of the shares of points that are covered, by the nodes of both sides."""
        i, q = points.T
        partner, at, sides = self._partners(gaps, points), gaps.at[i, q], (self.surface.sides, self.partners.sides)
        if self.partners.rims is None:
            return np.zeros((len(points), 3 * (sides[0].shape[1] + sides[1].shape[1])))
        _, change = self.partners.rims.covered(partner, at, self._band[i, q], self.rigid is not None)
        points = np.ascontiguousarray(points)
        feet = pairs.foot_changes(self._all(position, gaps.pose), sides, self.surface.N, points, partner, at)
        return np.asarray(np.einsum("km,kmj->kj", change, feet))

    def _search(self, x: Array, normal: Array, position: Array, every: Array) -> tuple[Ints, Array, Array]:
        """Search the whole surface: partner, place and gap of every point."""
        s, p = self.surface, self.partners
        others = centers_of(every, p.sides, p.corners)
        own = others if p.sides is s.sides else centers_of(position, s.sides, s.corners)
        grid = Grid.of(others[0], p.reach + float(own[1].max() + others[1].max()))
        cubes = (grid.low, grid.edge, grid.counts, grid.start, grid.order)
        allowed = (self._beyond, p.depth)
        opened = [np.ones(len(sides), dtype=np.bool_) if p.open is None else p.open for sides in (s.sides, p.sides)]
        apart = (opened[0], opened[1], p.strangers[0], p.strangers[1])
        return find_partners((x, normal), every, p.sides, (own, others), cubes, allowed, p.reach, apart)

    def _springs(self, points: Ints, gaps: Gaps) -> Array:
        return self._whole(points, gaps) * gaps.covered[points[:, 0], points[:, 1]]

    def _whole(self, points: Ints, gaps: Gaps) -> Array:
        """Pressure per depth (k,) of covered points: of the softer side, times the penalty scale of the point's own."""
        side, partner = points[:, 0], self._partners(gaps, points)
        spring = self.surface.spring[side]
        if self.rigid is None:
            spring = np.minimum(spring, self.surface.spring[partner])
        return np.asarray(self.share * spring * self.penalty_scale[side])

    def _nodes(self, points: Ints, partner: Ints, count: int) -> Ints:
        return np.hstack([self.surface.sides[points[:, 0]], self.partners.sides[partner]])

    def _press(self, position: Array, gaps: Gaps) -> Array:
        every = self._all(position, gaps.pose)
        points = np.ascontiguousarray(gaps.touching)
        if not len(points):
            return np.zeros_like(every)
        i, q = points.T
        partner, at = gaps.partner[i, q], gaps.at[i, q]
        spring = self._springs(points, gaps) * self._weights(points)
        local = pairs.press_forces(
            every, (self.surface.sides, self.partners.sides), self.surface.N, points, partner, at, spring
        )
        return nodal(self._nodes(points, partner, len(position)), local, len(every))

    def _press_tangents(self, position: Array, gaps: Gaps) -> Ties:
        points = gaps.touching
        partner = gaps.partner[points[:, 0], points[:, 1]]
        order, start, keys = groups(self._key(points[:, 0], partner))
        points, partner = np.ascontiguousarray(points[order]), np.ascontiguousarray(partner[order])
        spring = self._springs(points, gaps) * self._weights(points)
        sides = (self.surface.sides, self.partners.sides)
        at = np.ascontiguousarray(gaps.at[points[:, 0], points[:, 1]])
        every = self._all(position, gaps.pose)
        local = pairs.press_tangents(every, sides, self.surface.N, points, partner, at, spring, start)
        return Ties(self.tied_unknowns(keys), local)

    def fading(self, position: Array, gaps: Gaps) -> Rubbing | None:
        """How the pressure changes as a rim passes points: a matrix of rank one for each of them."""
        gradient = self._fading(position, gaps.touching, gaps)
        chosen = gradient.any(axis=1)
        if not chosen.any():
            return None
        points, gradient = gaps.touching[chosen], gradient[chosen]
        i, q = points.T
        force = (self._whole(points, gaps) * gaps.gap[i, q] * self._weights(points))[:, None]
        force = force * self._normals(position, gaps, points)
        unknowns = self.tied_unknowns(self._key(i, gaps.partner[i, q]))
        pull = (self._shares(points, gaps.at[i, q])[:, :, None] * force[:, None, :]).reshape(len(points), -1)
        return Rubbing(unknowns, pull, unknowns, gradient)

    def _limit_change(self, position: Array, gaps: Gaps, points: Ints) -> Array:
        out = super()._limit_change(position, gaps, points)
        pressure = self._whole(points, gaps) * -gaps.gap[points[:, 0], points[:, 1]]
        return out + self.coefficient * pressure[:, None] * self._fading(position, points, gaps)

    def _apart(self, position: Array, gaps: Gaps, a: FrictionHistory) -> Array:
        places = self._all(position, gaps.pose)[self._nodes(a.points, a.partner, len(position))]
        return gaps.pose.turned_back(np.einsum("ka,kai->ki", self._shares(a.points, a.at), places))

    def _shares(self, points: Ints, at: Array) -> Array:
        there = pairs.shares_at(self.partners.sides.shape[1], np.ascontiguousarray(at))
        return np.hstack([self.surface.N[points[:, 1]], -there])

    def _normals(self, position: Array, gaps: Gaps, points: Ints) -> Array:
        every, at = self._all(position, gaps.pose), gaps.at[points[:, 0], points[:, 1]]
        return pairs.normals_at(every, self.partners.sides, self._partners(gaps, points), at)

    def keys(self, gaps: Gaps) -> Ints:
        """Ties that the tangent needs."""
        points = gaps.touching
        out = self._key(points[:, 0], gaps.partner[points[:, 0], points[:, 1]])
        if gaps.friction is not None:
            out = np.concatenate([out, self._key(gaps.friction.points[:, 0], gaps.friction.partner)])
        return np.unique(out)

    def ready_keys(self, gaps: Gaps) -> Ints:
        """Ties that the tangent may need soon: of points that are near, with the sides around their partners."""
        near = np.argwhere(gaps.gap < CONTACT_SEARCH.near * self.surface.height[:, None])
        side, partner = near[:, 0], gaps.partner[near[:, 0], near[:, 1]]
        start, around = self.partners.around
        count = start[partner + 1] - start[partner]
        rows = np.repeat(side, count)
        place = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count) + np.repeat(start[partner], count)
        return np.union1d(self.keys(gaps), self._key(rows, around[place]))

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

    def passed(self, position: Array, old: Gaps, new: Gaps) -> Array:
        """Signed gap (s, q) of points to the sides that were before them, where they have passed through unseen."""
        every = self._all(position, new.pose)
        p = self.partners
        open_before = np.where((old.gap >= 0) & (new.gap >= 0) & (new.partner != old.partner), old.partner, -1)
        _, at, gap = follow_partners((new.x, new.normal), every, p.sides, open_before, old.at, p.around, p.overhang, 0)
        inside = (at.min(axis=2) > -0.1) & (at.max(axis=2) < 1.1)
        if self.partners.corners == 3:
            inside &= at.sum(axis=2) < 1.1
        deep = gap < -self.partners.depth[np.maximum(open_before, 0)]
        return np.where((open_before >= 0) & inside & deep, gap, np.inf)
