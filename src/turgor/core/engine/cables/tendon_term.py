"""TendonTerm: the tensions of a cable that a motor pulls, with what friction leaves along it."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.cables.cable_term import CableTerm, Laid, Pulled, by_length
from turgor.core.engine.term import Configuration
from turgor.core.model.history import share_at
from turgor.core.model.loads.tendon import Tendon

Array = NDArray[np.float64]

#: Sine of the turn at a guide below which friction is flat there: the direction of a turn of zero is not defined.
STRAIGHT = 1e-9


@dataclass(frozen=True, eq=False)
class TendonTerm(CableTerm):
    """A cable with a given tension at its motor, or a given length that the motor draws in.

    Parameters
    ----------
    load : Tendon
    tension : float
        Scaled tension at a share of one on the modeled part; 0 where the pull is given.
    stiffness, pull : float
        Scaled, of the modeled part; 0 where the tension is given.
    """

    load: Tendon
    tension: float
    stiffness: float
    pull: float

    @staticmethod
    def of(load: Tendon, laid: Laid, length: float, force: float) -> "TendonTerm":
        """The term in units of a length and a force."""
        return TendonTerm(
            load=load, laid=laid, tension=laid.part * (load.tension or 0.0) / force,
            stiffness=laid.part * (load.cable_stiffness or 0.0) * length / force, pull=(load.pull or 0.0) / length,
        )  # fmt: skip

    @property
    def memory_key(self) -> str:
        """No internal variables."""
        return ""

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
        left, left_by = self._left(directions, lengths)
        share, total_by = share_at(self.load.history, at.load_factor), by_length(directions)
        if self.load.tension is not None:
            first, first_by = share * self.tension, np.zeros_like(total_by)
        else:
            weights = self.rest_lengths / self.rest_lengths.sum()
            mean, mean_by = float(weights @ left), np.einsum("s,sgj->gj", weights, left_by)
            drawn = float((lengths - self.rest_lengths).sum()) + share * self.pull
            taut = drawn > 0
            first = self.stiffness * drawn / mean if taut else 0.0
            first_by = self.stiffness * total_by / mean - first * mean_by / mean if taut else np.zeros_like(total_by)
        by_guides = left[:, None, None] * first_by + first * left_by
        return Pulled(directions, lengths, first * left, by_guides)

    def _left(self, directions: Array, lengths: Array) -> tuple[Array, Array]:
        """Share (s,) of the motor's tension that is left in each piece, and its derivative (s, g, 3) by the guides."""
        count, friction = len(directions), self.load.friction
        left, left_by = np.ones(count), np.zeros((count, count + 1, 3))
        turned, turned_by = 0.0, np.zeros((count + 1, 3))
        for i in range(1, count if friction else 1):
            before, after = directions[i - 1], directions[i]
            cosine, sine = float(before @ after), float(np.linalg.norm(np.cross(before, after)))
            turned += float(np.arctan2(sine, cosine))
            if sine > STRAIGHT:
                by_before = -(after - cosine * before) / sine / lengths[i - 1]
                by_after = -(before - cosine * after) / sine / lengths[i]
                turned_by[i - 1] -= by_before
                turned_by[i] += by_before - by_after
                turned_by[i + 1] += by_after
            left[i] = np.exp(-friction * turned)
            left_by[i] = -friction * left[i] * turned_by
        return left, left_by
