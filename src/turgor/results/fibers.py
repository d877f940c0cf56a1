"""Fibers in results: the stretch and tension of every piece, the largest tension, and the threads as lines."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.engine.fibers import Pieces
from turgor.engine.smeared import smeared_pieces
from turgor.engine.threads import Threads
from turgor.errors import TurgorError
from turgor.model.fibers import DISCRETE, Fibers
from turgor.results.fields import StateFields
from turgor.solvers.solution import State

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class FiberResult:
    """A winding in one state.

    Parameters
    ----------
    fibers : Fibers
        The winding.
    stretch : (k,) array
        Current over initial length of each piece: of each truss of a discrete thread, or at each integration point
        of the face for smeared fibers.
    tension : (k,) array [N]
        Tension of one thread there.
    threads : Threads or None
        The trusses in order along their threads; None for smeared fibers.
    """

    fibers: Fibers
    stretch: Array
    tension: Array
    threads: Threads | None

    @property
    def maximum_tension(self) -> float:
        """Largest tension of any thread [N]; of discrete threads that of a whole crossing of a side.

        Trusses that cut off corners of sides take up what the shapes of the sides do not follow, so that tensions of
        neighbors jump; their average over a crossing does not.
        """
        if self.threads is None:
            return float(self.tension.max())
        return float(along_thread(self.threads, self.tension).max())


def fiber_results(state: State | StateFields) -> tuple[FiberResult, ...]:
    """Read stretch and tension of every winding of the model off a state.

    Parameters
    ----------
    state : State or StateFields

    Returns
    -------
    tuple of FiberResult
        In the order of the model's reinforcements.
    """
    at = state if isinstance(state, StateFields) else StateFields(state)
    out = []
    for fibers in at.model.reinforcements:
        threads = at.facts.threads(fibers) if fibers.form == DISCRETE else None
        pieces = threads.pieces if threads else smeared_pieces(at.mesh, fibers)
        stretch = _stretch(pieces, at.points)
        share = np.where(stretch >= 1, 1.0, fibers.compression)
        out.append(FiberResult(fibers, stretch, share * fibers.stretching_stiffness * (stretch - 1), threads))
    return tuple(out)


def maximum_tension(at: StateFields) -> float:
    """Largest tension of any thread of the model [N]."""
    if not at.model.reinforcements:
        raise TurgorError("the model has no fibers.")
    return max(each.maximum_tension for each in fiber_results(at))


def along_thread(threads: Threads, values: Array) -> Array:
    """Averages (k,) of values of trusses over as much of their thread as one crossing of a side, weighted by length."""
    weights = threads.pieces.weights
    reach = float(np.percentile(weights, 90))  # half a crossing
    middle = np.cumsum(weights) - weights / 2
    gap = 10 * (middle[-1] + reach) * threads.thread  # no average reaches from one thread to the next
    place = middle + gap
    first = np.searchsorted(place, place - reach)
    last = np.searchsorted(place, place + reach, side="right")
    total = np.concatenate([[0.0], np.cumsum(weights * values)])
    length = np.concatenate([[0.0], np.cumsum(weights)])
    return np.asarray((total[last] - total[first]) / (length[last] - length[first]))


def drawn_threads(at: StateFields) -> list[Array]:
    """Threads of the whole actuator as polylines (k, 3) [m]; those of smeared fibers run as discrete ones would."""
    lines: list[Array] = []
    for fibers in at.model.reinforcements:
        try:
            lines += at.facts.threads(fibers).polylines(at.points)
        except TurgorError:
            if fibers.form == DISCRETE:
                raise
    for plane in at.facts.mirrors:
        images = [line.copy() for line in lines]
        for line in images:
            line[:, plane.axis] = 2 * plane.position - line[:, plane.axis]
        lines += images
    return lines


def _stretch(pieces: Pieces, points: Array) -> Array:
    tangent = np.einsum("ka,kai->ki", pieces.along, points[pieces.sides])
    return np.asarray(np.linalg.norm(tangent, axis=1))
