"""Reasons: why a step was rejected, or how it was found in spite of a failure.

The solver compares causes, never text. The sentence is made from the cause and its number when a person reads it.
"""

from dataclasses import dataclass
from enum import Enum, auto


class Cause(Enum):
    """Cause of a rejected step, or a note on how an accepted one was found."""

    INVERTED_START = auto()
    INVERTED_CELL = auto()
    DEEP_PENETRATION = auto()
    SINGULAR_TANGENT = auto()
    TOO_MANY_ITERATIONS = auto()
    ROUND_OFF = auto()
    CONTACT_UNSETTLED = auto()
    INERTIA_CORRECTED = auto()
    INERTIA_CORRECTION_FAILED = auto()
    PSEUDO_TRANSIENT = auto()
    PSEUDO_TRANSIENT_FAILED = auto()
    STABILITY_LOST = auto()
    UNSTABLE = auto()
    LONG_MOVE = auto()
    BRANCH_JUMP = auto()
    SHARP_TURN = auto()
    OTHER_BRANCH = auto()
    TIME_ERROR = auto()
    ENERGY_ERROR = auto()
    REMESHED = auto()


#: What a person reads; ``{value}`` is the number of the reason and ``{detail}`` what it adds in words.
TEXTS = {
    Cause.INVERTED_START: "the start turns a cell inside out",
    Cause.INVERTED_CELL: "every update turns a cell inside out",
    Cause.DEEP_PENETRATION: "every update presses walls too deep",
    Cause.SINGULAR_TANGENT: "{detail}",
    Cause.TOO_MANY_ITERATIONS: "no convergence in {value:.0f} iterations{detail}",
    Cause.ROUND_OFF: "the residual stagnates at {value:.2g}, the round-off of the equations",
    Cause.CONTACT_UNSETTLED: "contact did not settle in {value:.0f} passes",
    Cause.INERTIA_CORRECTED: "found by inertia correction, where Newton's method failed",
    Cause.INERTIA_CORRECTION_FAILED: "inertia correction found no stable equilibrium",
    Cause.PSEUDO_TRANSIENT: "found by pseudo-transient continuation, where no step of Newton's method succeeded",
    Cause.PSEUDO_TRANSIENT_FAILED: "pseudo-transient continuation did not come to rest either",
    Cause.STABILITY_LOST: "stability was lost",
    Cause.UNSTABLE: "the equilibrium is unstable",
    Cause.LONG_MOVE: "it moved {value:.3g} times as much for the load as in the step before",
    Cause.BRANCH_JUMP: "the step may have jumped to another branch",
    Cause.SHARP_TURN: "the path turns too sharply for the arc",
    Cause.OTHER_BRANCH: "the arc leads back or to another branch",
    Cause.TIME_ERROR: "an error of {value:.1e} of the displacement",
    Cause.REMESHED: "cells cut, {detail}; equilibrium on them moved by {value:.2g} %",
    Cause.ENERGY_ERROR: "{value:.2g} % of the energy unaccounted for",
}


@dataclass(frozen=True, slots=True)
class Reason:
    """A cause with its number; ``str`` gives the sentence.

    Parameters
    ----------
    cause : Cause
    value : float
        The number that the sentence holds; 0 where it holds none.
    detail : str
        Words of the linear solver for a singular tangent; why iterations were given up, after a colon.

    Examples
    --------
    >>> str(Reason(Cause.TOO_MANY_ITERATIONS, 15))
    'no convergence in 15 iterations'
    """

    cause: Cause
    value: float = 0.0
    detail: str = ""

    def __str__(self) -> str:
        return TEXTS[self.cause].format(value=self.value, detail=self.detail)
