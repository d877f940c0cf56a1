"""propagate: carry the spread of inputs to the response of a function."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from inspect import signature
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.calibration.trial import curve_at
from turgor.errors import TurgorError, unknown
from turgor.laboratory.compare import first_branch
from turgor.response import Response
from turgor.results.drive import drive_of
from turgor.study.evaluations import Evaluations, rounded
from turgor.study.run_all import Ended
from turgor.study.runs import Computed, Run
from turgor.uncertainty.band import Band, Uncertainty
from turgor.uncertainty.spread import Alternatives, Input, Spread, check_inputs, nominal_values
from turgor.uncertainty.surface import (
    NORMAL_95,
    Point,
    Surface,
    check_points,
    design,
    fit_surface,
    range_of,
)

Array = NDArray[np.float64]

#: Methods: the surface, and whether pairs of inputs are varied together.
METHODS: Mapping[str, tuple[bool, bool]] = MappingProxyType(
    {"linear": (False, False), "quadratic": (True, False), "interactions": (True, True)}
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Computation:
    """A function that computes a response, with its further arguments.

    Parameters
    ----------
    function : callable
        Function of a module that takes numbers in SI units as keywords and returns a `Response`.
    values : mapping
        Further arguments.
    nominal : mapping
        Arguments of the nominal run alone, such as one that asks for the mesh error.
    gather : str
        Name of an argument that takes all numbers as one mapping; by default each is a keyword.
    """

    function: Callable[..., Response | Computed]
    values: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))
    nominal: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))
    gather: str = ""

    def run(self, numbers: Mapping[str, float], *, nominal: bool = False) -> Run:
        """Return the run with numbers."""
        given = {name: rounded(value) for name, value in numbers.items()}
        shown = ", ".join(f"{name} {value:.5g}" for name, value in given.items())
        keywords: dict[str, Any] = {self.gather: given} if self.gather else given
        more = self.nominal if nominal else {}
        return Run(name=shown, function=self.function, values={**self.values, **more, **keywords})


def propagate(
    computation: Computation | Callable[..., Response | Computed],
    inputs: Sequence[Input],
    *,
    method: str = "linear",
    x: str | None = None,
    evaluations: Evaluations | None = None,
) -> Uncertainty:
    """Carry the spread of inputs to the response of a function (propagation of uncertainty).

    Inputs are independent and normal. The linear method takes central differences at one standard deviation, with two
    runs for each input. The quadratic one takes them at √3 standard deviations and keeps the curvature, with as many
    runs; ``"interactions"`` adds a run for each pair of inputs. Sets of numbers (`Alternatives`) are computed one by
    one. A spread of what drives, such as the pressure, takes no run: the slope of the curve carries it. One run, or two
    for the quadratic methods, are held out and compared with the surface.

    Parameters
    ----------
    computation : Computation or callable
    inputs : sequence of Spread or Alternatives
    method : str
        ``"linear"``, ``"quadratic"`` or ``"interactions"``.
    x : str, optional
        What drives; by default the drive of the response.
    evaluations : Evaluations, optional
        Where runs are computed and kept; by default in this process, without files.

    Returns
    -------
    Uncertainty

    Raises
    ------
    TurgorError
        If an input is unknown or the nominal run fails.

    Examples
    --------
    >>> from turgor.response import Column
    >>> from turgor.source import Source
    >>> def spring(stiffness):
    ...     force = Column("force", "N", [0.0, 1.0, 2.0]), Column("stroke", "mm", [0.0, 1 / stiffness, 2 / stiffness])
    ...     return Response(columns=force, source=Source(text="a spring"))
    >>> propagate(spring, [Spread(name="stiffness", mean=100.0, deviation=5.0)], x="force").sentence("stroke")
    'stroke at 2 N: 20 mm ± 1 mm (stiffness)'
    """
    if method not in METHODS:
        raise unknown("method", method, METHODS)
    asked = computation if isinstance(computation, Computation) else Computation(function=computation)
    plan = _Plan.of(asked, inputs, method, evaluations or Evaluations())
    nominal = plan.nominal()
    drive = x or drive_of(nominal)
    plan.check_drives(nominal, drive)
    plan.compute()
    at = plan.shared_range(nominal, drive)
    names = [
        each.name
        for each in nominal.quantities
        if each.name not in (drive, "load_factor", "time", "stage") and np.isfinite(each.values).sum() > 1
    ]
    bands, residual = {}, {}
    for name in names:
        bands[name], residual[name] = _band(plan, nominal, name, drive, at)
    column = nominal.find(drive)
    return Uncertainty(
        drive=type(column)(drive, column.unit, at), bands=bands, method=plan.told(), runs=plan.count,
        residual=residual, notes=tuple(plan.notes),
    )  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class _Plan:
    """The runs of a propagation."""

    computation: Computation
    inputs: Sequence[Input]
    method: str
    values: dict[str, float]
    evaluations: Evaluations
    before: int
    notes: list[str] = field(default_factory=list)

    @classmethod
    def of(cls, asked: Computation, inputs: Sequence[Input], method: str, evaluations: Evaluations) -> "_Plan":
        takes = list(signature(asked.function).parameters)
        named = [each.name for each in inputs if isinstance(each, Spread)]
        drives = [name for name in named if name not in takes] if not asked.gather else named
        values = nominal_values(inputs, drives)
        if not asked.gather:
            check_inputs(list(values), [name for name in takes if name not in asked.values])
        kept = {name: value for name, value in values.items() if asked.gather or name in takes}
        return cls(
            computation=asked, inputs=inputs, method=method, values=kept, evaluations=evaluations,
            before=len(evaluations.ended),
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
        return [each for each in self.inputs if isinstance(each, Alternatives)]

    @property
    def quadratic(self) -> bool:
        return METHODS[self.method][0]

    @property
    def count(self) -> int:
        return len(self.evaluations.ended) - self.before

    def nominal(self) -> Response:
        (ended,) = self.evaluations.of([self.computation.run(self.values, nominal=True)])
        if ended.found is None:
            raise TurgorError(f"the nominal run failed ({ended.run.name}): {ended.problem}")
        return ended.found.response

    def check_drives(self, nominal: Response, drive: str) -> None:
        for each in self.drives:
            if each.name != drive:
                takes = [] if self.computation.gather else list(signature(self.computation.function).parameters)
                raise unknown("number with a spread", each.name, [drive, *takes])

    def points(self) -> list[Point]:
        count = len(self.spreads)
        if not count:
            return []
        quadratic, interactions = METHODS[self.method]
        return [
            *design(count, quadratic=quadratic, interactions=interactions)[1:],
            *check_points(count, quadratic=quadratic),
        ]

    def at(self, point: Point) -> Ended:
        """How the run at a point of the surface ended."""
        moved = {
            each.name: each.standard[0] + z * each.standard[1] for each, z in zip(self.spreads, point, strict=True)
        }
        nominal = not any(point)
        (ended,) = self.evaluations.of([self.computation.run({**self.values, **moved}, nominal=nominal)])
        return ended

    def of_set(self, numbers: Mapping[str, float]) -> Ended:
        values = {**self.values, **numbers}
        same = values == self.values
        (ended,) = self.evaluations.of([self.computation.run(values, nominal=same)])
        return ended

    def compute(self) -> None:
        """Compute all runs as one batch, and note those that failed."""
        runs = []
        for point in self.points():
            moved = {e.name: e.standard[0] + z * e.standard[1] for e, z in zip(self.spreads, point, strict=True)}
            runs.append(self.computation.run({**self.values, **moved}))
        for each in self.sets:
            runs += [self.computation.run({**self.values, **numbers}) for numbers in each.sets[1:]]
        for ended in self.evaluations.of(runs):
            if ended.found is None:
                self.notes.append(f"a run failed ({ended.run.name}): {ended.problem}")

    def every(self) -> list[Response]:
        ended = [self.at(point) for point in self.points()]
        ended += [self.of_set(numbers) for each in self.sets for numbers in each.sets]
        return [each.found.response for each in ended if each.found is not None and len(each.found.response) > 1]

    def shared_range(self, nominal: Response, drive: str) -> Array:
        """Values of the drive of the nominal run that all runs reach."""
        whole = np.unique(first_branch(nominal, drive)[0].column(drive))
        lows, highs = [whole[0]], [whole[-1]]
        for each in self.every():
            column = first_branch(each, drive)[0].column(drive)
            lows.append(np.nanmin(column))
            highs.append(np.nanmax(column))
        low, high = max(lows), min(highs)
        reach = 1e-6 * (whole[-1] - whole[0])
        if high < whole[-1] - reach:
            column = nominal.find(drive)
            end = type(column)(drive, column.unit, np.array([high])).in_unit[0]
            self.notes.append(f"The bands end at {end:.4g} {column.unit}: some run goes no further.")
        inside = whole[(whole > low + reach) & (whole < high - reach)]
        return np.concatenate([[low], inside, [high]])

    def told(self) -> str:
        """What was done, in a sentence."""
        kinds = {
            "linear": "Linear propagation with central differences at one standard deviation",
            "quadratic": "Quadratic response surface with points at √3 standard deviations",
            "interactions": "Quadratic response surface with interactions",
        }
        return f"{kinds[self.method]}: {self.count} runs."


def _band(plan: _Plan, nominal: Response, name: str, drive: str, at: Array) -> tuple[Band, float]:
    """Band of one column, and the largest residual of the surface over its standard deviation."""

    def curve(ended: Ended) -> Array | None:
        if ended.found is None or len(ended.found.response) < 2:
            return None
        return curve_at(ended.found.response, drive, name, at)

    quadratic, interactions = METHODS[plan.method]
    middle = curve_at(nominal, drive, name, at)
    count = len(plan.spreads)
    empty = Surface(middle=middle, first=np.zeros((0, len(at))), second=np.zeros((0, len(at))), mixed={})
    surface = (
        fit_surface(lambda point: curve(plan.at(point)), count, quadratic=quadratic, interactions=interactions)
        if count
        else empty
    )
    variance: dict[str, Array] = {}
    for each, part in zip(plan.spreads, surface.parts, strict=True):
        variance[each.label] = variance.get(each.label, 0.0) + part
    tables = []
    for group in plan.sets:
        values = [value for value in (curve(plan.of_set(numbers)) for numbers in group.sets) if value is not None]
        table = np.array(values) - middle
        part = table.var(axis=0, ddof=1) if len(table) > 1 else np.full(len(at), np.nan)
        variance[group.label] = variance.get(group.label, 0.0) + part
        tables.append(table)
    slope = np.gradient(middle, at)
    for each in plan.drives:
        variance[each.label] = variance.get(each.label, 0.0) + (slope * each.standard[1]) ** 2
    deviation = np.sqrt(sum(variance.values()) + surface.together)
    mean = middle + surface.second.sum(axis=0) + sum((table.mean(axis=0) for table in tables), np.zeros(len(at)))
    low, high = mean - NORMAL_95 * deviation, mean + NORMAL_95 * deviation
    if quadratic and np.isfinite(surface.first).all():
        sources = [np.outer(_normal_points(), slope * each.standard[1]) for each in plan.drives]
        low, high = range_of(surface, [*tables, *sources])
    mesh = nominal.mesh_error(name)
    band = Band(
        name=name, unit=nominal.find(name).unit, nominal=middle, mean=np.asarray(mean), deviation=deviation, low=low,
        high=high, parts={label: np.sqrt(part) for label, part in variance.items()},
        together=np.sqrt(surface.together),
        mesh=None if mesh is None else np.interp(at, *_sorted(nominal.column(drive), mesh)),
    )  # fmt: skip
    return band, _residual(plan, surface, curve, deviation)


def _residual(plan: _Plan, surface: Surface, curve: Callable[[Ended], Array | None], deviation: Array) -> float:
    largest = 0.0
    for point in check_points(len(plan.spreads), quadratic=plan.quadratic) if plan.spreads else ():
        value = curve(plan.at(point))
        if value is not None:
            largest = max(largest, float(np.max(np.abs(surface.at(np.array([point]))[0] - value))))
    top = float(np.nanmax(deviation)) if len(deviation) else 0.0
    return largest / top if top else 0.0


def _sorted(drive: Array, values: Array) -> tuple[Array, Array]:
    known = np.isfinite(values) & np.isfinite(drive)
    order = np.argsort(drive[known], kind="stable")
    return drive[known][order], values[known][order]


def _normal_points() -> Array:
    """Equally likely values of a standard normal variable."""
    from scipy.stats import norm

    return np.asarray(norm.ppf((np.arange(400) + 0.5) / 400))
