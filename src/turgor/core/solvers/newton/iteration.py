"""Newton iteration: the loop that Newton's method of every model shares, and the shortening of its updates.

Finite elements, states on a second mesh, sections and rods are cases of it. A case solves with its tangent,
how to go along an update, and when to end. It imports nothing, because rods load it and shall load quickly.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

X = TypeVar("X")
U = TypeVar("U")

#: Why an iteration ended that has found its solution.
CONVERGED = "converged"


class Stopped(Exception):
    """Newton's method cannot go on from an iterate; ``why`` says why, in the terms of its case."""

    def __init__(self, why: object) -> None:
        super().__init__(why)
        self.why = why


class Case(Protocol[X, U]):
    """Equations that Newton's method solves; an iterate X holds its unknowns and what was evaluated there."""

    def update(self, at: X) -> U:
        """Solve with the tangent of an iterate, with a border of further unknowns if there are some.

        Raises
        ------
        Stopped
            If the tangent is singular, or the update cannot be good.
        """

    def advanced(self, at: X, update: U) -> X:
        """The next iterate, along as much of an update as is allowed.

        Raises
        ------
        Stopped
            If no part of it is allowed.
        """

    def ended(self, at: X, iteration: int) -> object | None:
        """`CONVERGED`, or why the iteration is given up; None where it goes on."""


@dataclass(frozen=True, slots=True, eq=False)
class Ended(Generic[X]):
    """How an iteration ended.

    Parameters
    ----------
    at : X
        The last iterate.
    iterations : int
        Updates, the one that failed included.
    why : object or None
        `CONVERGED`, or why it was given up; None where all updates were used.
    stopped : Stopped or None
        What ended it in an update.
    """

    at: X
    iterations: int
    why: object | None
    stopped: Stopped | None = None

    @property
    def converged(self) -> bool:
        """Whether the last iterate is a solution."""
        return self.why is CONVERGED


def iterate(case: Case[X, U], start: X, most: int) -> Ended[X]:
    """Update an iterate until it is a solution.

    Parameters
    ----------
    case : Case
    start : X
    most : int
        Updates at most.

    Returns
    -------
    Ended

    Examples
    --------
    >>> class Root:  # x² = 2
    ...     def update(self, x): return (2 - x * x) / (2 * x)
    ...     def advanced(self, x, dx): return x + dx
    ...     def ended(self, x, iteration): return CONVERGED if abs(x * x - 2) < 1e-12 else None
    >>> found = iterate(Root(), 1.0, most=10)
    >>> round(found.at, 6), found.iterations, found.converged
    (1.414214, 5, True)
    """
    at, iteration = start, 0
    for iteration in range(1, most + 1):
        try:
            at = case.advanced(at, case.update(at))
        except Stopped as stopped:
            return Ended(at, iteration, stopped.why, stopped)
        why = case.ended(at, iteration)
        if why is not None:
            return Ended(at, iteration, why)
    return Ended(at, iteration, None)


def shortened(
    trial: Callable[[float], tuple[X | None, float]], shortest: float, shortest_found: float = 0.0
) -> tuple[X | None, float]:
    """Shorten an update until it is allowed.

    Parameters
    ----------
    trial : callable
        ``trial(length)`` returns the end of an update of this length, None where it cannot be evaluated, and the share
        of the length to try next; 1 where the length is allowed.
    shortest : float
        Shortest length that is tried.
    shortest_found : float
        The same once an end was evaluated.

    Returns
    -------
    (X or None, float)
        The end and the length: of the first that is allowed, else of the last that was evaluated.

    Examples
    --------
    >>> shortened(lambda length: (length, 1.0) if length < 0.3 else (None, 0.5), shortest=0.1)
    (0.25, 0.25)
    """
    best: tuple[X | None, float] = None, 0.0
    length = 1.0
    while length >= shortest:
        end, share = trial(length)
        if share == 1:
            return end, length
        if end is not None:
            best, shortest = (end, length), max(shortest, shortest_found)
        length *= share
    return best
