"""Plan: the runs that a propagation of uncertainty needs."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from inspect import signature
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.laboratory.compare import first_branch
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Column, Response
from turgor.studies.runs.computation import Computation
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.executors.run_outcome import Ended
from turgor.studies.uncertainty.spread import Alternatives, Input, Spread, check_inputs, nominal_values
from turgor.studies.uncertainty.surface import Point, check_points, design

Array = NDArray[np.float64]

#: Methods: the surface, and whether pairs of inputs are varied together.
METHODS: Mapping[str, tuple[bool, bool]] = MappingProxyType(
    {"linear": (False, False), "quadratic": (True, False), "interactions": (True, True)}
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """The runs of a propagation.

    Parameters
    ----------
    computation : Computation
    inputs : sequence of Spread or Alternatives
    method : str
        Key of `METHODS`.
    values : dict of str to float or str [SI]
        Nominal numbers of the function.
    evaluations : Evaluations
    before : int
        Number of runs that the evaluations had before.
    notes : list of str
        What to tell; grows.
    """

    computation: Computation
    inputs: Sequence[Input]
    method: str
    values: dict[str, float | str]
    evaluations: Evaluations
    before: int
    notes: list[str] = field(default_factory=list)

    @classmethod
    def of(cls, computation: Computation, inputs: Sequence[Input], method: str, evaluations: Evaluations) -> "Plan":
        """Make the plan of a computation, after checks of its inputs."""
        takes = list(signature(computation.function).parameters)
        named = [each.name for each in inputs if isinstance(each, Spread)]
        drives = [name for name in named if name not in takes] if not computation.gather else named
        values = nominal_values(inputs, drives)
        if not computation.gather:
            check_inputs(list(values), [name for name in takes if name not in computation.values])
        taken = {name: value for name, value in values.items() if computation.gather or name in takes}
        return cls(
            computation=computation, inputs=inputs, method=method, values=taken, evaluations=evaluations,
            before=len(evaluations.ended),
            notes=[each.note for each in inputs if isinstance(each, Alternatives) and each.note],
        )  # fmt: skip

    @property
    def spreads(self) -> list[Spread]:
        """Spreads of numbers of the function."""
        return [each for each in self.inputs if isinstance(each, Spread) and each.name in self.values]

    @property
    def drives(self) -> list[Spread]:
        """Spreads of columns that drive."""
        return [each for each in self.inputs if isinstance(each, Spread) and each.name not in self.values]

    @property
    def sets(self) -> list[Alternatives]:
        """Whole sets of numbers."""
        return [each for each in self.inputs if isinstance(each, Alternatives)]

    @property
    def quadratic(self) -> bool:
        """Whether the propagation has curvature."""
        return METHODS[self.method][0]

    @property
    def count(self) -> int:
        """Number of runs that were requested."""
        return len(self.evaluations.ended) - self.before

    def nominal(self) -> Response:
        """Compute the nominal response; an error if its run fails."""
        (ended,) = self.evaluations.of([self.computation.run(self.values, nominal=True)])
        if ended.result is None:
            raise TurgorError(f"the nominal run failed ({ended.run.name}): {ended.problem}")
        return ended.result.response

    def check_drives(self, drive: str) -> None:
        """Raise an error if a spread without a mean is not that of the drive."""
        for each in self.drives:
            if each.name != drive:
                takes = [] if self.computation.gather else list(signature(self.computation.function).parameters)
                raise unknown("number with a spread", each.name, [drive, *takes])

    def points(self) -> list[Point]:
        """Return the points of the surface besides the middle, and those held out."""
        count = len(self.spreads)
        if not count:
            return []
        quadratic, interactions = METHODS[self.method]
        return [
            *design(count, quadratic=quadratic, interactions=interactions)[1:],
            *check_points(count, quadratic=quadratic),
        ]

    def at(self, point: Point) -> Ended:
        """Return how the run at a point of the surface ended."""
        moved = {
            each.name: each.standard[0] + z * each.standard[1] for each, z in zip(self.spreads, point, strict=True)
        }
        nominal = not any(point)
        (ended,) = self.evaluations.of([self.computation.run({**self.values, **moved}, nominal=nominal)])
        return ended

    def of_set(self, numbers: Mapping[str, float | str]) -> Ended:
        """Return how the run with a set of numbers ended."""
        values = {**self.values, **numbers}
        same = values == self.values
        (ended,) = self.evaluations.of([self.computation.run(values, nominal=same)])
        return ended

    def compute(self) -> None:
        """Compute all runs as one batch, and note those that failed."""
        runs = []
        reported = {
            self.computation.run({**self.values, **numbers}).key
            for each in self.sets
            if each.names
            for numbers in each.sets
        }
        for point in self.points():
            moved = {e.name: e.standard[0] + z * e.standard[1] for e, z in zip(self.spreads, point, strict=True)}
            runs.append(self.computation.run({**self.values, **moved}))
        for each in self.sets:
            runs += [self.computation.run({**self.values, **numbers}) for numbers in each.sets[1:]]
        for ended in self.evaluations.of(runs):
            if ended.result is None and ended.run.key not in reported:
                self.notes.append(f"a run failed ({ended.run.name}): {ended.problem}")

    def problem_of(self, ended: Ended, nominal: Response, drive: str) -> str:
        """Return why the run of a set with a name is not part of the bands; empty where it is."""
        if ended.result is None:
            return ended.problem.removeprefix("changes: ")
        end, top = (float(np.nanmax(each.column(drive))) for each in (ended.result.response, nominal))
        if len(ended.result.response) > 1 and end > top - 1e-6 * abs(top):
            return ""
        column = nominal.find(drive)
        reached, whole = Column(drive, column.unit, np.array([end, top])).in_unit
        text = f"ends at {reached:.4g} {column.unit} of {whole:.4g} {column.unit}".rstrip()
        return f"{text}. {ended.result.response.message}".strip()

    def valid_sets(self, group: Alternatives, nominal: Response, drive: str) -> list[Mapping[str, float | str]]:
        """Return the sets of a group that are part of the bands: of sets with names, those without a problem."""
        return [
            numbers
            for numbers in group.sets
            if not group.names or not self.problem_of(self.of_set(numbers), nominal, drive)
        ]

    def every(self, nominal: Response, drive: str) -> list[Response]:
        """Return all responses that are part of the bands."""
        ended = [self.at(point) for point in self.points()]
        ended += [self.of_set(numbers) for each in self.sets for numbers in self.valid_sets(each, nominal, drive)]
        return [each.result.response for each in ended if each.result is not None and len(each.result.response) > 1]

    def shared_range(self, nominal: Response, drive: str) -> Array:
        """Return the values of the drive of the nominal run that all runs reach."""
        whole = np.unique(first_branch(nominal, drive)[0].column(drive))
        lows, highs = [whole[0]], [whole[-1]]
        for each in self.every(nominal, drive):
            column = first_branch(each, drive)[0].column(drive)
            lows.append(np.nanmin(column))
            highs.append(np.nanmax(column))
        low, high = max(lows), min(highs)
        reach = 1e-6 * (whole[-1] - whole[0])
        if high < whole[-1] - reach:
            unit = nominal.find(drive).unit
            end = Column(drive, unit, np.array([high])).in_unit[0]
            self.notes.append(f"The bands end at {end:.4g} {unit}: some run goes no further.")
        inside = whole[(whole > low + reach) & (whole < high - reach)]
        return np.concatenate([[low], inside, [high]])

    def description(self) -> str:
        """Return the method in a sentence."""
        kinds = {
            "linear": "Linear propagation with central differences at one standard deviation",
            "quadratic": "Quadratic response surface with points at √3 standard deviations",
            "interactions": "Quadratic response surface with interactions",
        }
        return f"{kinds[self.method]}: {self.count} runs."
