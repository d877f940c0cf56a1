"""Fibers in results: the stretch and tension of every piece, the largest tension, and the threads as lines."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.fibers.fiber_trusses import FiberTrusses
from turgor.core.engine.fibers.smeared import smeared_pieces
from turgor.core.engine.fibers.tension import piece_tension, smooth_tension, tangents
from turgor.core.engine.fibers.thread_rest import ThreadRest
from turgor.core.model.fibers import DISCRETE, Fibers
from turgor.core.results.fields.cables import cables_with_tension
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.solvers.solution import State
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class FiberResult:
    """A winding in one state.

    Parameters
    ----------
    fibers : Fibers
        The winding.
    stretch : (k,) array
        Current length over that without stress, of each piece by itself: of each truss of a discrete thread, or at each
        integration point of the face for smeared fibers.
    tension : (k,) array [N]
        Tension of one thread there, averaged over the sides of cells around it, see `smooth_tension`.
    positions : (k, 3) array [m]
        Where the middle of each piece is now.
    weights : (k,) array
        Reference length of each truss [m]; for smeared fibers the reference area of each point [m²].
    threads : FiberTrusses or None
        The trusses in order along their threads; None for smeared fibers.
    """

    fibers: Fibers
    stretch: Array
    tension: Array
    positions: Array
    weights: Array
    threads: FiberTrusses | None

    __repr__ = brief

    @property
    def maximum_tension(self) -> float:
        """Largest tension of any thread [N]."""
        return float(self.tension.max())


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
        rest = ThreadRest.of(at.model.states_of(fibers.name), at.state.load_factor)
        stretch = np.linalg.norm(tangents(pieces, at.points), axis=1) / rest.length
        out.append(
            FiberResult(
                fibers=fibers,
                stretch=stretch,
                tension=smooth_tension(pieces, piece_tension(fibers, stretch, rest)),
                positions=np.einsum("ka,kai->ki", pieces.middle, at.points[pieces.sides]),
                weights=pieces.weights,
                threads=threads,
            )
        )
    return tuple(out)


def maximum_tension(at: StateFields) -> float:
    """Largest tension of any thread of the model [N]."""
    if not at.model.reinforcements:
        raise TurgorError("the model has no fibers.")
    return max(each.maximum_tension for each in fiber_results(at))


def threads_with_tension(at: StateFields) -> list[tuple[Array, Array]]:
    """Threads and cables of the whole actuator, (k, 3) [m] each, with the tension at their points, (k,) [N]."""
    cables = [(image.of(line), tension) for image in at.facts.images for line, tension in cables_with_tension(at)]
    lines = drawn_threads(at)
    if not lines:
        return cables
    from scipy.spatial import cKDTree  # slow to load, and few models have threads

    fibers = fiber_results(at)
    places = np.concatenate([image.of(each.positions) for image in at.facts.images for each in fibers])
    tension = np.tile(np.concatenate([each.tension for each in fibers]), len(at.facts.images))
    nearest = cKDTree(places)
    return cables + [(line, tension[nearest.query(line)[1]]) for line in lines]


def drawn_threads(at: StateFields) -> list[Array]:
    """Threads of the whole actuator as polylines (k, 3) [m]; those of smeared fibers run as discrete ones would."""
    lines: list[Array] = []
    for fibers in at.model.reinforcements:
        try:
            lines += at.facts.threads(fibers).polylines(at.points)
        except TurgorError:
            if fibers.form == DISCRETE:
                raise
    return [image.of(line) for image in at.facts.images for line in lines]
