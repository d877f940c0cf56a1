"""``[calibrate]`` of a study file: experiments, what is compared, and the parameters among the factors."""

from collections.abc import Mapping, Sequence
from functools import partial
from math import isfinite, nan
from pathlib import Path
from typing import Any

from pydantic import Field

from turgor.accuracy.laboratory.chosen_rows import ChosenRows
from turgor.core.materials.experiments.machine import stated_machine
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import COLUMN_UNITS, Response
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Table, read_table
from turgor.studies.calibration.job_calibration import CalibrationPlan
from turgor.studies.calibration.parameter import Parameter
from turgor.studies.calibration.settings import CALIBRATION
from turgor.studies.runs.jobs.job_numbers import JobNumber, mean_and_deviation, read_number, shared_number
from turgor.studies.study_file.job_base import JobBase

#: The table of a calibration.
CALIBRATE = ("calibrate",)


class CalibrateTable(Table):
    """``[calibrate]``: the experiments that are fitted, and how they are compared.

    Keys
    ----
    experiments : list of str
        Tables of a laboratory.
    hold_out : list of str
        Experiments that are predicted, not fitted.
    y, x : str
        What is compared and what drives: ``NAME``, or ``NAME=NAME THERE``.
    rig : list of str
        Offsets or scales of measured columns to calibrate as well, such as ``"pressure_offset"``.
    units : table
        Units of columns whose header has none.
    spread : list of str
        Standard deviations of measured values, such as ``["1 deg"]``; one for each unit.
    loading : bool
        Whether rows in which the drive falls are left out.
    unloading : bool
        Whether rows in which the drive rises are left out.
    by : str
        Column that tells specimens or runs apart: their mean is fitted, with their spread as its weight.
    remove : list of str
        ``["drift"]`` takes away what has not come back at the end of a record.
    ranges : list of str
        Ranges of measured columns, such as ``["pressure=0..30 kPa"]``; rows outside are left out.
    compliance : str
        How far the rig gives way, such as ``"0.04 mm/N"``, or the file of a pull on a stiff specimen.
    most_solves : int
    """

    experiments: list[str] = Field(default_factory=list)
    hold_out: list[str] = Field(default_factory=list)
    y: str | None = None
    x: str | None = None
    rig: list[str] = Field(default_factory=list)
    units: dict[str, str] = Field(default_factory=dict)
    spread: list[str] = Field(default_factory=list)
    loading: bool = False
    unloading: bool = False
    by: str = ""
    remove: list[str] = Field(default_factory=list)
    ranges: list[str] = Field(default_factory=list)
    compliance: str = ""
    most_solves: int | None = None


def read_calibrate(
    given: Any, factors: Mapping[tuple[str, ...], Any], base: JobBase, folder: Path, problems: Problems
) -> CalibrationPlan | None:
    """Read ``[calibrate]``.

    Parameters
    ----------
    given : mapping
        The table.
    factors : mapping of tuple of str to value
        ``[factors]`` by the parts of their keys: each is a parameter.
    base : JobBase
    folder : Path
        Where relative paths begin.
    problems : Problems

    Returns
    -------
    CalibrationPlan or None
        None if there is any problem.
    """
    table: CalibrateTable | None = read_table(CalibrateTable, given, CALIBRATE, problems)
    free = [problems.attempt(("factors", *place), partial(parameter_of, ".".join(place), value, base.numbers))
            for place, value in factors.items()]  # fmt: skip
    if table is None:
        return None
    if not table.experiments:
        problems.add((*CALIBRATE, "experiments"), "nothing is fitted; name a table of a laboratory, or several.")
    lists = {key: [problems.attempt((*CALIBRATE, key), partial(_measured, folder, name, table)) for name in names]
             for key, names in (("experiments", table.experiments), ("hold_out", table.hold_out))}  # fmt: skip
    measured = [each for several in lists.values() for each in several if each is not None]
    spreads = problems.attempt((*CALIBRATE, "spread"), partial(_spreads, table.spread, measured))
    if problems.entries or spreads is None:
        return None
    count = len(table.experiments)
    return CalibrationPlan(
        free=tuple(each for each in free if each is not None), experiments=tuple(measured[:count]),
        hold_out=tuple(measured[count:]), spreads=tuple(spreads), rig=tuple(table.rig), y=table.y, x=table.x,
        most_solves=table.most_solves,
    )  # fmt: skip


def parameter_of(key: str, given: Any, numbers: Mapping[str, JobNumber]) -> Parameter:
    """Return the parameter of a factor: its start is the value of the job by default.

    Parameters
    ----------
    key : str
        Or several with commas between them.
    given : mapping
        ``start``, ``low``, ``high`` and ``prior``, with units; none is needed.
    numbers : mapping of str to JobNumber
        Of the job.

    Returns
    -------
    Parameter

    Raises
    ------
    TurgorError
        If the key is unknown, or a value cannot be read.
    """
    name, number = shared_number(numbers, key)
    if not isinstance(given, Mapping):
        raise TurgorError(f'{given!r} is not a parameter; write {{ start = "1 mm", low = "0.5 mm", high = "2 mm" }}.')
    if ("low" in given) != ("high" in given):
        raise TurgorError("a parameter has both ends, low and high, or neither.")
    values = {end: read_number(str(given[end]), number, end) for end in ("start", "low", "high") if end in given}
    prior = mean_and_deviation(str(given["prior"]), number, "prior") if "prior" in given else None
    step = CALIBRATION.meshed_step if name.startswith("actuator.") else CALIBRATION.step
    return Parameter(
        name=name, start=values.get("start", number.value), lower=values.get("low"), upper=values.get("high"),
        prior=prior, unit=number.unit, step=step,
    )  # fmt: skip


def _measured(folder: Path, name: str, table: CalibrateTable) -> Response:
    if table.loading and table.unloading:
        raise TurgorError("loading and unloading are both true, which leaves nothing; leave both out to fit both.")
    if "offset" in table.remove:
        raise TurgorError('an offset is fitted, not removed: name it in rig, such as "bending_angle_offset".')
    branch = "loading" if table.loading else "unloading" if table.unloading else "both"
    rows = ChosenRows(
        units=table.units, ranges=table.ranges, branch=branch, by=table.by, remove=table.remove,
        machine=stated_machine(table.compliance, folder),
    )  # fmt: skip
    return rows.read(folder / name, table.x, table.y)[0]


def _spreads(texts: Sequence[str], measured: Sequence[Response]) -> list[float | None]:
    """Read standard deviations; each is that of the experiments with a column in its unit."""
    spreads: list[float | None] = [None] * len(measured)
    for text in texts:
        number, _, unit = text.strip().partition(" ")
        fitting = [n for n, each in enumerate(measured) if any(unit and unit in c.units for c in each.columns)]
        try:
            value = float(number) * COLUMN_UNITS.get(unit, nan)
        except ValueError:
            value = nan
        if not (fitting and isfinite(value)):
            units = ", ".join(sorted({c.unit for each in measured for c in each.columns if c.unit}))
            raise TurgorError(f"'{text}' is no spread; write a number and a unit of the experiments ({units}).")
        for n in fitting:
            spreads[n] = value
    return spreads
