"""PointsPart: penalty contact with Coulomb friction at the quadrature points of a surface.

Every point that has penetrated is pushed back with a force in proportion to its depth (the penalty). Friction acts on
its slip since the last converged state, by a return mapping (`turgor.core.engine.contact.friction`). What the points
may touch is left to the subclasses: sides of cells in `PairPart`, shapes with a formula in `ShapePart`.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import side_tables
from turgor.core.engine.contact import friction
from turgor.core.engine.contact.friction import FrictionHistory
from turgor.core.engine.contact.pairs import tie_tangents
from turgor.core.engine.contact.part import Gaps, Ties, groups, nodal
from turgor.core.engine.contact.settings import CONTACT_SEARCH, FRICTION
from turgor.core.engine.contact.surface import Surface
from turgor.core.meshing.cells import side_type

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Rubbing:
    """Unsymmetric part of the tangent, a matrix of rank one for each of k points: how a force follows another value.

    The value is the limit of friction, which changes with the pressure, or the share of a point that a rim leaves.

    Parameters
    ----------
    pulled : (k, m) int array
        Unknowns that are pulled, −1 for none.
    pull : (k, m) array
        Forces on them for a value of one.
    pressed : (k, l) int array
        Unknowns that change the value, −1 for none.
    change : (k, l) array
        How the value changes with each.
    """

    pulled: Ints
    pull: Array
    pressed: Ints
    change: Array


class PointsPart(ABC):
    """Contact of the quadrature points of a surface.

    Parameters
    ----------
    name : str
    surface : Surface
    coefficient : float
        Of friction.
    share : float
        Share of the stiffness that this part has: half where both surfaces are integrated on.

    Attributes
    ----------
    penalty_scale : (s,) array
        Factor on the penalty of each side; it grows where the penetration exceeds the tolerance.
    elastic_slip : float or None
        Scaled slip at which points that stick begin to slide, where it is stated.
    """

    def __init__(self, name: str, surface: Surface, coefficient: float, share: float) -> None:
        self.name, self.surface, self.coefficient, self.share = name, surface, coefficient, share
        self.penalty_scale = np.ones(len(surface.sides))
        self.elastic_slip: float | None = None

    @abstractmethod
    def tied_unknowns(self, keys: Ints) -> Ints:
        """Degrees of freedom that each tie couples, in rows; −1 where nothing moves freely."""

    @abstractmethod
    def _press(self, position: Array, gaps: Gaps) -> Array:
        """Forces of the pressure on the nodes."""

    @abstractmethod
    def _press_tangents(self, position: Array, gaps: Gaps) -> Ties:
        """Tangents of the points that press."""

    @abstractmethod
    def _springs(self, points: Ints, gaps: Gaps) -> Array:
        """Pressure per depth (k,) at points, of their whole area."""

    @abstractmethod
    def _nodes(self, points: Ints, partner: Ints, count: int) -> Ints:
        """Nodes of points and of what they touch, ``count`` of which are those of the mesh."""

    @abstractmethod
    def _shares(self, points: Ints, at: Array) -> Array:
        """Shape functions of points, then minus those of their places on what they touch."""

    @abstractmethod
    def _normals(self, position: Array, gaps: Gaps, points: Ints) -> Array:
        """Normals (k, 3) of what points touch, out of it."""

    @abstractmethod
    def _apart(self, position: Array, gaps: Gaps, a: FrictionHistory) -> Array:
        """Points minus the places on their partners (k, 3), as these were before they turned."""

    @abstractmethod
    def _key(self, side: Ints, partner: Ints) -> Ints:
        """Ties of sides with partners."""

    def _weights(self, points: Ints) -> Array:
        return np.asarray(self.surface.weights[points[:, 0], points[:, 1]])

    def _partners(self, gaps: Gaps, points: Ints) -> Ints:
        return np.maximum(gaps.partner[points[:, 0], points[:, 1]], 0)

    def forces(self, position: Array, gaps: Gaps) -> Array:
        """Internal forces on the nodes, those of a rigid body last."""
        out, a = self._press(position, gaps), self.bound(gaps)
        if a is None:
            return out
        traction, _ = friction.tractions(a, self._apart(position, gaps, a))
        pull = self._weights(a.points)[:, None] * gaps.pose.turned(traction)
        local = self._shares(a.points, a.at)[:, :, None] * pull[:, None, :]
        return out + nodal(self._nodes(a.points, a.partner, len(position)), local, len(out))

    def tangents(self, position: Array, gaps: Gaps) -> list[Ties]:
        """Tangents of the points that press, and of those that stick or slip at the limits that they have."""
        out = [self._press_tangents(position, gaps)] if gaps.inside.any() else []
        a = self.bound(gaps)
        if a is not None:
            _, matrices = friction.tractions(a, self._apart(position, gaps, a))
            matrices *= self._weights(a.points)[:, None, None]
            turned = gaps.pose.turned_tensors(matrices)
            out.append(self._tied(a.points, a.partner, self._shares(a.points, a.at), turned))
        return out

    def _tied(self, points: Ints, partner: Ints, shares: Array, matrices: Array) -> Ties:
        order, start, keys = groups(self._key(points[:, 0], partner))
        local = tie_tangents(shares[order], np.ascontiguousarray(matrices[order]), start)
        return Ties(self.tied_unknowns(keys), local)

    def rubbing(self, position: Array, gaps: Gaps) -> Rubbing | None:
        """Change of the limits of friction with the contact pressure; None without friction or with constant limits."""
        a = self.bound(gaps)
        if a is None or a.constant_limits:
            return None
        pull = gaps.pose.turned(friction.by_limit(a, self._apart(position, gaps, a)))
        pull = pull * self._weights(a.points)[:, None]
        chosen = gaps.inside[a.points[:, 0], a.points[:, 1]] & pull.any(axis=1)
        if not chosen.any():
            return None
        points, pull = a.points[chosen], pull[chosen]
        partner, change = self._partners(gaps, points), self._limit_change(position, gaps, points)
        return Rubbing(
            self.tied_unknowns(self._key(points[:, 0], a.partner[chosen])),
            (self._shares(points, a.at[chosen])[:, :, None] * pull[:, None, :]).reshape(len(points), -1),
            self.tied_unknowns(self._key(points[:, 0], partner)),
            change,
        )

    def fading(self, position: Array, gaps: Gaps) -> Rubbing | None:
        """Change of the pressure where a rim passes points; None where there is no rim."""
        return None

    def _limit_change(self, position: Array, gaps: Gaps, points: Ints) -> Array:
        """Derivatives (k, m) of the limits of friction by the nodes of points inside and of what they touch."""
        change = -self.coefficient * self._springs(points, gaps)[:, None] * self._normals(position, gaps, points)
        shares = self._shares(points, gaps.at[points[:, 0], points[:, 1]])
        return np.asarray((shares[:, :, None] * change[:, None, :]).reshape(len(points), -1))

    def pressures(self, gaps: Gaps) -> Array:
        """Pressure (s, q) per reference area at the points, that of both passes."""
        out = np.zeros(gaps.gap.shape)
        points = gaps.touching
        i, q = points.T
        out[i, q] = self._springs(points, gaps) / self.share * -gaps.gap[i, q]
        return out

    def energy(self, gaps: Gaps) -> float:
        """Energy stored in the penetration."""
        points = gaps.touching
        i, q = points.T
        spring = self._springs(points, gaps) * self._weights(points)
        return float(0.5 * (spring * gaps.gap[i, q] ** 2).sum())

    def stiffened(self, former: Array, before: Gaps, gaps: Gaps) -> float:
        """Energy that raising the penalty from the ``former`` scales (s,) put into what was and is penetrated.

        Consistent with work by the trapezoidal rule: ½ (k₁ − k₀) g₀ g₁ at every point.
        """
        points = before.also(gaps)
        i, q = points.T
        gain = self._springs(points, gaps) * self._weights(points) * (1 - former[i] / self.penalty_scale[i])
        return float(0.5 * (gain * before.gap[i, q] * gaps.gap[i, q]).sum())

    def rubbed(self, position: Array, gaps: Gaps) -> float:
        """Energy that friction has dissipated since the last state."""
        a = self.bound(gaps)
        return 0.0 if a is None else friction.taken(a, self._apart(position, gaps, a), self._weights(a.points))

    def bound(self, gaps: Gaps) -> FrictionHistory | None:
        """The friction history with the limits that hold; None where there are none."""
        a = gaps.friction
        if a is None or not len(a.points):
            return None
        return a if a.constant_limits else replace(a, limit=self._limits(gaps, a.points))

    def _limits(self, gaps: Gaps, points: Ints) -> Array:
        """Coulomb's limit (k,) of the tractions at points, from the present pressures."""
        gap = gaps.gap[points[:, 0], points[:, 1]]
        depth = np.where(np.isfinite(gap), np.maximum(-gap, 0.0), 0.0)
        return np.asarray(self.coefficient * self._springs(points, gaps) * depth)

    def settled(self, gaps: Gaps) -> tuple[FrictionHistory | None, bool]:
        """The friction history with the present limits, and whether any differs noticeably from that before."""
        a = gaps.friction
        if a is None or not len(a.points):
            return a, False
        limit = self._limits(gaps, a.points)
        largest = float(max(limit.max(), a.limit.max()))
        return replace(a, limit=limit), bool(np.abs(limit - a.limit).max() > FRICTION.settled * largest)

    def anchored(self, position: Array, gaps: Gaps) -> FrictionHistory:
        """Friction history of the points that touch or soon may, with the tractions that they have."""
        points = np.argwhere(gaps.gap < CONTACT_SEARCH.near * self.surface.height[:, None])
        i, q = points.T
        normal = gaps.pose.turned_back(self._normals(position, gaps, points))
        traction, a = np.zeros((len(points), 3)), self.bound(gaps)
        if a is not None:
            before = np.zeros((*gaps.gap.shape, 3))
            before[a.points[:, 0], a.points[:, 1]], _ = friction.tractions(a, self._apart(position, gaps, a))
            traction = friction.turned(before[i, q], normal)
        slip, none = friction.elastic_slip(self.surface, points, self.elastic_slip), np.zeros((len(points), 3))
        limit = self._limits(gaps, points)
        out = FrictionHistory(points, gaps.partner[i, q], gaps.at[i, q], none, normal, traction, limit, slip)
        return replace(out, apart=self._apart(position, gaps, out))


def nodal_pressure(part: PointsPart, gaps: Gaps, count: int) -> Array:
    """Scaled contact pressure per deformed area at ``count`` nodes, zero where nothing touches."""
    surface = part.surface
    nodes = surface.sides.shape[1]
    kind, r = side_type(nodes), side_tables(nodes)
    touches = gaps.inside.any(axis=1)  # the others would dilute the pressure at a sharp rim
    deformed = (gaps.growth * r.weights)[touches]
    force = part.pressures(gaps)[touches] * surface.weights[touches]
    corners = surface.sides[touches][:, : kind.corners].ravel()
    total = np.bincount(corners, (force @ r.M).ravel(), minlength=count)
    area = np.bincount(corners, (deformed @ r.M).ravel(), minlength=count)
    out = np.divide(total, area, out=np.zeros(count), where=area > 0)
    for i, (a, b) in enumerate(kind.edges):
        out[surface.sides[:, kind.corners + i]] = (out[surface.sides[:, a]] + out[surface.sides[:, b]]) / 2
    if nodes == 9:
        out[surface.sides[:, 8]] = out[surface.sides[:, :4]].mean(axis=1)
    return np.asarray(out)


def contact_area(part: PointsPart, gaps: Gaps) -> float:
    """Scaled contact area on the deformed surface."""
    nodes = part.surface.sides.shape[1]
    return float((gaps.growth * side_tables(nodes).weights)[gaps.inside].sum())
