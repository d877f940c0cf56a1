"""propagate: the spread of inputs propagated to the response of a function."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from turgor.core.results.drive import drive_of
from turgor.foundation.errors import unknown
from turgor.foundation.response import Column, Response
from turgor.studies.calibration.curve import PathCurve
from turgor.studies.runs.computation import Computation
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.executors.run_outcome import Ended
from turgor.studies.runs.run import Computed
from turgor.studies.runs.settings import HALF_WIDTH
from turgor.studies.uncertainty.band import Band, Uncertainty
from turgor.studies.uncertainty.cases import Case
from turgor.studies.uncertainty.plan import METHODS, Plan
from turgor.studies.uncertainty.spread import Input
from turgor.studies.uncertainty.surface import Surface, check_points, fit_surface, range_of

Array = NDArray[np.float64]

#: Columns that have no band.
WITHOUT = ("load_factor", "time", "stage")

Curve = Callable[[Ended], Array | None]


def propagate(
    computation: Computation | Callable[..., Response | Computed],
    inputs: Sequence[Input],
    *,
    method: str = "linear",
    x: str | None = None,
    evaluations: Evaluations | None = None,
) -> Uncertainty:
    """Propagate the spread of inputs to the response of a function.

    Inputs are independent and normal. The linear method takes central differences at one standard deviation, with two
    runs for each input. The quadratic one takes them at √3 standard deviations and includes the curvature, with as many
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
        Where runs are computed and saved; by default in this process, without files.

    Returns
    -------
    Uncertainty

    Raises
    ------
    TurgorError
        If an input is unknown or the nominal run fails.

    Examples
    --------
    >>> from turgor.foundation.response import Column
    >>> from turgor.foundation.source import Source
    >>> from turgor.studies.uncertainty.spread import Spread
    >>> def spring(stiffness):
    ...     force = Column("force", "N", [0.0, 1.0, 2.0]), Column("stroke", "mm", [0.0, 1 / stiffness, 2 / stiffness])
    ...     return Response(columns=force, source=Source(text="a spring"))
    >>> propagate(spring, [Spread(name="stiffness", mean=100.0, deviation=5.0)], x="force").sentence("stroke")
    'stroke at 2 N: 20 mm ± 1 mm (stiffness)'
    """
    if method not in METHODS:
        raise unknown("method", method, METHODS)
    requested = computation if isinstance(computation, Computation) else Computation(function=computation)
    plan = Plan.of(requested, inputs, method, evaluations or Evaluations())
    nominal = plan.nominal()
    drive = x or drive_of(nominal)
    plan.check_drives(drive)
    plan.compute()
    at = plan.shared_range(nominal, drive)
    names = [
        each.name
        for each in nominal.quantities
        if each.name not in (drive, *WITHOUT) and np.isfinite(each.values).sum() > 1
    ]
    bands, residual = {}, {}
    for name in names:
        bands[name], residual[name] = _band(plan, nominal, name, drive, at)
    column = nominal.find(drive)
    return Uncertainty(
        drive=Column(drive, column.unit, at), bands=bands, method=plan.description(), runs=plan.count,
        residual=residual, notes=tuple(plan.notes), cases=_cases(plan, nominal, drive, at, names),
    )  # fmt: skip


def _cases(plan: Plan, nominal: Response, drive: str, at: Array, names: Sequence[str]) -> tuple[Case, ...]:
    """How the run of each set with a name ended."""
    cases = []
    for group in plan.sets:
        doubts = group.doubts or ((),) * len(group.names)
        for name, codes, numbers in zip(group.names, doubts, group.sets, strict=bool(group.names)):
            ended = plan.of_set(numbers)
            problem = plan.problem_of(ended, nominal, drive)
            computed = ended.result
            curves = (
                {}
                if problem or computed is None
                else {y: PathCurve.of(computed.response, drive, y).at(at) for y in names}
            )
            cases.append(Case(label=group.label, name=name, doubts=codes, problem=problem, curves=curves))
    return tuple(cases)


def _band(plan: Plan, nominal: Response, name: str, drive: str, at: Array) -> tuple[Band, float]:
    """Band of one column, and the largest residual of the surface over its standard deviation."""

    def curve(ended: Ended) -> Array | None:
        if ended.result is None or len(ended.result.response) < 2:
            return None
        return PathCurve.of(ended.result.response, drive, name).at(at)

    middle = PathCurve.of(nominal, drive, name).at(at)
    surface, tables = _surface(plan, curve, middle), _tables(plan, curve, middle, drive)
    slope = np.gradient(middle, at)
    variance = _variance(plan, surface, tables, slope)
    deviation = np.sqrt(sum(variance.values()) + surface.together)
    mean = middle + surface.second.sum(axis=0) + sum((table.mean(axis=0) for table in tables), np.zeros(len(at)))
    low, high = mean - HALF_WIDTH * deviation, mean + HALF_WIDTH * deviation
    if plan.quadratic and np.isfinite(surface.first).all():
        gauges = [np.outer(_normal_points(), slope * each.standard[1]) for each in plan.drives]
        low, high = range_of(surface, [*tables, *gauges])
    mesh = nominal.mesh_error(name)
    band = Band(
        name=name, unit=nominal.find(name).unit, nominal=middle, mean=np.asarray(mean), deviation=deviation, low=low,
        high=high, parts={label: np.sqrt(part) for label, part in variance.items()},
        together=np.sqrt(surface.together),
        mesh=None if mesh is None else np.interp(at, *_sorted(nominal.column(drive), mesh)),
    )  # fmt: skip
    return band, _residual(plan, surface, curve, deviation)


def _surface(plan: Plan, curve: Curve, middle: Array) -> Surface:
    """Surface of the numbers that are varied; constant where there are none."""
    count = len(plan.spreads)
    if not count:
        none = np.zeros((0, len(middle)))
        return Surface(middle=middle, first=none, second=none, mixed={})
    quadratic, interactions = METHODS[plan.method]
    return fit_surface(lambda point: curve(plan.at(point)), count, quadratic=quadratic, interactions=interactions)


def _tables(plan: Plan, curve: Curve, middle: Array, drive: str) -> list[Array]:
    """Differences of the sets of each group from the nominal curve."""
    tables = []
    nominal = plan.nominal()
    for group in plan.sets:
        sets = plan.valid_sets(group, nominal, drive)
        values = [value for value in (curve(plan.of_set(numbers)) for numbers in sets) if value is not None]
        tables.append(np.array(values) - middle)
    return tables


def _variance(plan: Plan, surface: Surface, tables: Sequence[Array], slope: Array) -> dict[str, Array]:
    """Variance that each input brings, by label."""
    parts = [(each.label, part) for each, part in zip(plan.spreads, surface.parts, strict=True)]
    for group, table in zip(plan.sets, tables, strict=True):
        known = len(table) > 1
        parts.append((group.label, table.var(axis=0, ddof=1) if known else np.full(len(slope), np.nan)))
    parts += [(each.label, (slope * each.standard[1]) ** 2) for each in plan.drives]
    variance: dict[str, Array] = {}
    for label, part in parts:
        variance[label] = variance.get(label, np.zeros(len(slope))) + part
    return variance


def _residual(plan: Plan, surface: Surface, curve: Curve, deviation: Array) -> float:
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
    return np.asarray(norm.ppf((np.arange(400) + 0.5) / 400))
