"""Settings of a search, and how it can end."""

from dataclasses import dataclass
from enum import Enum
from typing import Literal

from turgor.foundation.errors import TurgorError, unknown

Method = Literal["auto", "trust_region", "pareto", "evolution"]

METHODS = ("auto", "trust_region", "pareto", "evolution")


class Ending(Enum):
    """How an optimization ended."""

    CONVERGED = "converged"
    BUDGET = "budget_ended"
    INFEASIBLE = "infeasible"
    FAILED = "failed"


@dataclass(frozen=True, slots=True, kw_only=True)
class Search:
    """How an optimization searches.

    Parameters
    ----------
    method : str
        ``"trust_region"`` for one objective or for targets, ``"pareto"`` for several objectives, on surfaces through
        what was computed; ``"evolution"`` for several objectives of a function that takes no time (NSGA-II). ``"auto"``
        takes one of the first two.
    most_solves : int
        Runs after which the search ends with its best design, at least 2.
    precision : float [-]
        Steps below this share of the ranges do not count. Where a mesh changes with a dimension, so do values, by their
        mesh error: smaller steps than these errors are chance.
    starts : int
        Starts of the search in a trust region, which is local: the first is that of the call, the others are a Latin
        hypercube of the ranges. Each takes its part of ``most_solves``; the best design is returned, the others listed.
    seed : int
        Of what is random; the same seed gives the same runs.
    slopes : bool
        Whether the search in a trust region takes derivatives where responses have them (`turgor.studies.with_slopes`).
        Runs of a job compute theirs where that is exact.

    Raises
    ------
    TurgorError
        If a method is unknown or a number is out of range.
    """

    method: Method = "auto"
    most_solves: int = 25
    precision: float = 2e-3
    starts: int = 1
    seed: int = 0
    slopes: bool = True

    def __post_init__(self) -> None:
        if self.method not in METHODS:
            raise unknown("method", self.method, METHODS)
        if not isinstance(self.slopes, bool):
            raise TurgorError(f"slopes is {self.slopes!r}; allowed is true or false.")
        if self.most_solves < 2:
            raise TurgorError(f"most_solves is {self.most_solves}; allowed is 2 or more.")
        if not 1 <= self.starts <= self.most_solves // 2:
            raise TurgorError(
                f"starts is {self.starts}; allowed is 1 to {self.most_solves // 2}, half of most_solves, "
                f"{self.most_solves}."
            )
        if not 0 < self.precision < 0.1:
            raise TurgorError(f"precision is {self.precision:g}; allowed is between 0 and 0.1, a share of the ranges.")
