"""TendonTerm: the tensions of a cable that a motor pulls, with friction at its guides in both directions.

At a guide with the turn θ the tension before it is that after it times exp(φ) with |φ| ≤ μ θ (Euler and Eytelwein). A
cable that slides towards the motor has φ = μ θ, one that slides back −μ θ. Where it sticks, φ changes by μ over the
elastic slip for each length that slides: a return mapping as that of contact, with φ and the length that has slid at
the last state as internal variables.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.cables.cable_term import CableTerm, Laid, Pulled, by_length
from turgor.core.engine.cables.settings import CABLES
from turgor.core.engine.term import Configuration
from turgor.core.model.loads.tendon import Tendon

Array = NDArray[np.float64]


@dataclass(slots=True, eq=False)
class _Rates:
    """A number with its derivatives by the tension of the last piece and by the guides (g, 3)."""

    value: float
    by_tension: float
    by_guides: Array


@dataclass(frozen=True, slots=True, eq=False)
class _Along:
    """Tensions of the pieces from a tension of the last one, and what friction is at the guides between them."""

    tensions: list[_Rates]
    exponents: Array
    slid: Array


@dataclass(frozen=True, eq=False)
class TendonTerm(CableTerm):
    """A cable with a given tension at its motor, or a given length that the motor draws in.

    Parameters
    ----------
    load : Tendon
    pulling : tuple of Tendon
        All loads that pull at the cable; tensions and lengths add up, as one fades and another one grows in a stage.
    length, force : float [m], [N]
        Units.
    """

    load: Tendon
    pulling: tuple[Tendon, ...]
    length: float
    force: float

    @staticmethod
    def of(loads: Sequence[Tendon], laid: Laid, length: float, force: float) -> "TendonTerm":
        """The term in units of a length and a force."""
        return TendonTerm(load=loads[-1], laid=laid, pulling=tuple(loads), length=length, force=force)

    @property
    def memory_key(self) -> str:
        """Key of its internal variables; empty without friction."""
        return f"cable {self.load.place}" if self.load.friction else ""

    def unsymmetric(self, at: Configuration, size: int) -> sp.csc_matrix | None:
        """Skew part of the tangent, which friction makes."""
        if not self.load.friction:
            return None
        whole, unknowns = self.derivative(at), self.unknowns[0]
        places = (np.repeat(unknowns, len(unknowns)), np.tile(unknowns, len(unknowns)))
        return sp.csc_matrix((0.5 * (whole - whole.T).ravel(), places), shape=(size, size))

    def pulled(self, at: Configuration) -> Pulled:
        """Directions, lengths and tensions of the pieces, of the modeled part."""
        directions, lengths = self.way(at)
        along, last_by = self._solved(at, directions, lengths)
        tensions = np.array([each.value for each in along.tensions])
        by_guides = np.array([each.by_guides + each.by_tension * last_by for each in along.tensions])
        return Pulled(directions, lengths, tensions, by_guides)

    def remembered(self, at: Configuration) -> Array:
        """Exponents φ at the guides between the ends, and the lengths that have slid there [m], (2, g − 2)."""
        along, _ = self._solved(at, *self.way(at))
        return np.stack([along.exponents, along.slid * self.length])

    def _solved(self, at: Configuration, directions: Array, lengths: Array) -> tuple[_Along, Array]:
        """What is along the cable, and the derivative (g, 3) of the tension of its last piece by the guides."""
        stiffness = self.laid.part * (self.load.cable_stiffness or 0.0) * self.length / self.force
        if stiffness:
            return self._drawn(at, (directions, lengths), stiffness)
        rigid = self._along(at, (directions, lengths), 1.0, 0.0)  # tensions in proportion to the last one
        left = rigid.tensions[0]
        first = self.laid.part * sum(each.share(at.load_factor) * (each.tension or 0.0) for each in self.pulling)
        last = first / self.force / left.value
        along = self._along(at, (directions, lengths), last, 0.0)
        return along, -last * left.by_guides / left.value

    def _drawn(self, at: Configuration, way: tuple[Array, Array], stiffness: float) -> tuple[_Along, Array]:
        """As `_solved` where a length is drawn in: the stretch of the cable makes up for it."""
        from scipy.optimize import brentq  # of no use without such a cable

        directions, lengths = way
        pull = sum(each.share(at.load_factor) * (each.pull or 0.0) for each in self.pulling) / self.length
        drawn = float((lengths - self.rest_lengths).sum()) + pull
        compliance = 1 / stiffness
        if drawn <= 0:
            return self._along(at, way, 0.0, compliance), np.zeros((len(self.laid.rest), 3))
        weights = compliance * self.rest_lengths / self.rest_lengths.sum()

        def excess(last: float) -> float:
            along = self._along(at, way, last, compliance)
            return float(sum(w * each.value for w, each in zip(weights, along.tensions, strict=True))) - drawn

        most = drawn / weights[-1]
        last = float(brentq(excess, 0.0, most * (1 + 1e-9), xtol=1e-300, rtol=1e-14, maxiter=200))
        along = self._along(at, way, last, compliance)
        parts = list(zip(weights, along.tensions, strict=True))
        by_tension = sum(w * each.by_tension for w, each in parts)
        by_guides = sum(w * each.by_guides for w, each in parts) - by_length(directions)
        return along, np.asarray(-by_guides / by_tension)

    def _along(self, at: Configuration, way: tuple[Array, Array], last: float, compliance: float) -> _Along:
        """Go from the end to the motor, with the compliance of the whole cable."""
        (directions, lengths), rest = way, self.rest_lengths
        count, guides = len(lengths), len(lengths) + 1
        stored = at.bonds.get(self.memory_key)
        exponents, slid = np.zeros((2, count - 1)) if stored is None else stored * [[1.0], [1 / self.length]]
        after, total = np.zeros(count - 1), np.zeros(count - 1)
        tension, slip = _Rates(last, 1.0, np.zeros((guides, 3))), _Rates(0.0, 0.0, np.zeros((guides, 3)))
        tensions = [tension]
        for i in range(count - 1, 0, -1):
            weight = compliance * rest[i] / rest.sum()
            slip.value += rest[i] - lengths[i] + weight * tension.value
            slip.by_tension += weight * tension.by_tension
            slip.by_guides = slip.by_guides + weight * tension.by_guides
            slip.by_guides[i] += directions[i]
            slip.by_guides[i + 1] -= directions[i]
            rubbing = self._rubbing(i, way, slip, (exponents[i - 1], slid[i - 1]))
            after[i - 1], total[i - 1] = rubbing.value, slip.value
            grown = float(np.exp(rubbing.value))
            tension = _Rates(
                tension.value * grown,
                grown * (tension.by_tension + tension.value * rubbing.by_tension),
                grown * (tension.by_guides + tension.value * rubbing.by_guides),
            )
            tensions.insert(0, tension)
        return _Along(tensions, after, total)

    def _rubbing(self, i: int, way: tuple[Array, Array], slip: _Rates, before: tuple[float, float]) -> _Rates:
        """The exponent φ of guide i, from that and the length slid before the step."""
        friction = self.load.friction
        if not friction:
            return _Rates(0.0, 0.0, np.zeros_like(slip.by_guides))
        stiffness = friction / (CABLES.elastic_slip * float(self.rest_lengths.sum()))
        trial = before[0] + stiffness * (slip.value - before[1])
        turn, turn_by = _turn(i, *way)
        limit = friction * turn
        if abs(trial) < limit * (1 - CABLES.sliding):
            return _Rates(trial, stiffness * slip.by_tension, stiffness * slip.by_guides)
        sign = 1.0 if trial >= 0 else -1.0
        return _Rates(sign * limit, 0.0, sign * friction * turn_by)


def _turn(i: int, directions: Array, lengths: Array) -> tuple[float, Array]:
    """Angle by which a cable turns at guide i, and its derivative (g, 3) by the guides; flat where it is straight."""
    before, after = directions[i - 1], directions[i]
    cosine, sine = float(before @ after), float(np.linalg.norm(np.cross(before, after)))
    by_guides = np.zeros((len(directions) + 1, 3))
    if sine > CABLES.straight:
        by_before = -(after - cosine * before) / sine / lengths[i - 1]
        by_after = -(before - cosine * after) / sine / lengths[i]
        by_guides[i - 1] -= by_before
        by_guides[i] += by_before - by_after
        by_guides[i + 1] += by_after
    return float(np.arctan2(sine, cosine)), by_guides
