"""learn: compute the designs that a surrogate requests, until it is good enough or the budget ends."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from scipy.stats import qmc

from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Response
from turgor.foundation.source import Source
from turgor.studies.runs.computation import Computation
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.factor import Factor
from turgor.studies.runs.run import Computed
from turgor.studies.runs.study import Row, Study
from turgor.studies.surrogates.coding import Coding, check_levels
from turgor.studies.surrogates.fit import surrogate
from turgor.studies.surrogates.next_design import next_design
from turgor.studies.surrogates.settings import SURROGATE
from turgor.studies.surrogates.surrogate import Surrogate

#: Value of each factor.
Design = Mapping[str, float | int | str]


@dataclass(frozen=True, slots=True, kw_only=True)
class Goal:
    """The required accuracy of a surrogate, and its budget.

    Parameters
    ----------
    measures : tuple of str
        What it predicts.
    error : float
        Root mean square error in held-out rows over the range, of the worst measure.
    runs : int
        Most runs.
    batch : int
        Runs that are requested at once, such as the number of processes.
    at : (str, float), optional
        Column and value [SI] at which measures are read; by default the last state.
    along : str
        Column that becomes an input, such as ``"pressure"``.

    Raises
    ------
    TurgorError
        If a number is out of range.
    """

    measures: tuple[str, ...]
    error: float = 0.02
    runs: int = 60
    batch: int = 4
    at: tuple[str, float] | None = None
    along: str = ""

    def __post_init__(self) -> None:
        if not self.measures:
            raise TurgorError("the goal names no measure.")
        if not self.error > 0:
            raise TurgorError(f"error is {self.error:g}; allowed is above 0.")
        if self.runs < SURROGATE.rows or self.batch < 1:
            raise TurgorError(
                f"runs is {self.runs} and batch is {self.batch}; allowed are {SURROGATE.rows} and 1 or more."
            )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Learned:
    """A surrogate with the study that it requested.

    Parameters
    ----------
    surrogate : Surrogate
    study : Study
    errors : tuple of (int, float)
        Number of runs, and held-out error over the range of the worst measure, after each batch.
    reached : bool
        Whether the error of the goal was reached.
    """

    surrogate: Surrogate
    study: Study
    errors: tuple[tuple[int, float], ...]
    reached: bool

    def sentence(self) -> str:
        """Return the reached accuracy in a sentence."""
        count, error = self.errors[-1]
        how = "reached" if self.reached else "not reached; the budget ended"
        return f"{count} runs, held-out error {100 * error:.2g} % of the range: {how}."


def learn(
    function: Computation | Callable[..., Response | Computed],
    factors: Sequence[Factor],
    goal: Goal,
    *,
    evaluations: Evaluations | None = None,
    progress: Callable[[Learned], None] | None = None,
) -> Learned:
    """Fit a surrogate to few runs, each chosen where the surrogate knows least.

    The first runs are 2k + 2 Sobol points of k factors, each level of a choice counted as one. Then a surrogate is
    fitted, used for the next designs (`next_design`), and fitted again. The designs depend on the runs alone, so that
    a call that was killed goes on where it was, if ``evaluations`` save their runs in a folder.

    Parameters
    ----------
    function : Computation or callable
        Takes the factors as keywords and returns a `Response`.
    factors : sequence of Factor
    goal : Goal
    evaluations : Evaluations, optional
        Where runs are computed and saved; by default in this process, without files.
    progress : callable, optional
        Called with what is known after each batch.

    Returns
    -------
    Learned

    Raises
    ------
    TurgorError
        If a choice has more than ten levels, or too few of the first runs end.
    """
    computation = function if isinstance(function, Computation) else Computation(function=function)
    where = evaluations or Evaluations()
    check_levels(factors)
    count = min(max(2 * Coding(factors=tuple(factors)).width + 2, SURROGATE.rows), goal.runs)
    points = qmc.Sobol(len(factors), seed=0).random(1 << (count - 1).bit_length())[:count]
    designs: list[Design] = [
        {each.name: each.at(float(u)) for each, u in zip(factors, point, strict=True)} for point in points
    ]
    rows: list[Row] = []
    errors: list[tuple[int, float]] = []
    while True:
        rows += _rows(computation, designs, where)
        study = Study(factors=tuple(factors), rows=tuple(rows), source=Source(text="runs that a surrogate requested"))
        fitted = surrogate(study, goal.measures, at=goal.at, along=goal.along)
        errors.append((len(rows), max(each.share for each in fitted.held_out)))
        reached = errors[-1][1] <= goal.error
        learned = Learned(surrogate=fitted, study=study, errors=tuple(errors), reached=reached)
        if progress is not None:
            progress(learned)
        batch = min(goal.batch, goal.runs - len(rows))
        if reached or batch <= 0:
            return learned
        failed = [row.values for row in rows if row.response is None]
        designs = list(next_design(fitted, batch, avoid=failed, seed=len(rows)))


def _rows(computation: Computation, designs: Sequence[Design], evaluations: Evaluations) -> list[Row]:
    ended = evaluations.of([computation.run(each) for each in designs])
    return [Row(values=one, ended=other) for one, other in zip(designs, ended, strict=True)]
