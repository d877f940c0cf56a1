"""Chosen rows: what of a measurement is compared or fitted, by ranges, branch and specimens."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from turgor.accuracy.laboratory.compliance import without_compliance
from turgor.accuracy.laboratory.headers import spelled_column
from turgor.accuracy.laboratory.read_experiment import read_experiment, read_experiments, specimen_column
from turgor.accuracy.laboratory.rest import remove_drift
from turgor.accuracy.laboratory.runs import average_runs, branches, loading, unloading, within_ranges
from turgor.core.materials.experiments.machine import Machine
from turgor.core.results.drive import drive_of
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Response

#: Parts of a cycle that can be chosen.
BRANCHES = ("both", "loading", "unloading")

#: What can be taken away from a measurement.
REMOVED = ("offset", "drift")


@dataclass(frozen=True, slots=True, kw_only=True)
class ChosenRows:
    """Which rows of a table of a laboratory count.

    Parameters
    ----------
    units : mapping of str to str
        Units of columns whose header has none.
    columns : mapping of str to str
        New names by header.
    ranges : sequence of str
        Ranges of measured columns; see `within_ranges`.
    branch : str
        One of `BRANCHES`.
    by : str
        Column that tells specimens or runs apart, or several with commas; they are averaged. Empty for one of them.
    remove : sequence of str
        Of `REMOVED`: an offset is known only in comparison with a computation, which takes it away; the drift is taken
        away here.
    machine : Machine or None
        The rig that gives way: its part of a measured displacement is taken away.
    """

    units: Mapping[str, str] = field(default_factory=dict)
    columns: Mapping[str, str] = field(default_factory=dict)
    ranges: Sequence[str] = ()
    branch: str = "both"
    by: str = ""
    remove: Sequence[str] = ()
    machine: Machine | None = None

    def __post_init__(self) -> None:
        if self.branch not in BRANCHES:
            raise unknown("branch", self.branch, BRANCHES)
        for each in self.remove:
            if each not in REMOVED:
                raise unknown("part of a measurement to remove", each, REMOVED)

    def read(self, file: Path, x: str | None, y: str | None) -> tuple[Response, dict[str, Response]]:
        """Read a table.

        Parameters
        ----------
        file : Path
        x, y : str or None
            What drives and what is compared, as `turgor.compare` takes them.

        Returns
        -------
        response : Response
            The chosen rows; of several specimens, their mean with its spread.
        specimens : dict of str to Response
            Chosen rows of each specimen; empty for one.
        """
        if not self.by:
            whole = read_experiment(file, units=self.units, columns=self.columns)
            column, count = specimen_column(file)
            if count > 1:
                raise TurgorError(
                    f"'{file.name}' holds {count} specimens, one below the other, by its column '{column}'.",
                    python=f"Read their mean with by='{column}'.",
                    command=f"Take their mean with --by '{column}'.",
                )
            return self.of(whole, x, y), {}
        names = [each.strip() for each in self.by.split(",")]
        whole_ones = read_experiments(file, names, units=self.units, columns=self.columns)
        if len(whole_ones) < 2:
            raise TurgorError(f"'{file.name}': the column '{self.by}' holds one value; leave it out, or name another.")
        specimens = {name: self.of(each, x, y) for name, each in whole_ones.items()}
        drive = driving(next(iter(specimens.values())), x)
        for name, each in specimens.items():
            if len(branches(each.column(drive))) > 1:
                way = "choose a branch, loading or unloading"
                if self.branch != "both":
                    way = f"it has several cycles; name their column too, such as by = '{self.by},cycle'"
                raise TurgorError(
                    f"'{file.name}': '{drive}' of {self.by} '{name}' goes up and down, so that a mean over all has no "
                    f"sense; {way}."
                )
        return average_runs(list(specimens.values()), drive), specimens

    def of(self, whole: Response, x: str | None = None, y: str | None = None) -> Response:
        """Return the chosen rows of a measurement."""
        drive = driving(whole, x)
        named = spelled_column((y or "").rpartition("=")[2].strip(), whole.names)
        if self.machine is not None:
            whole = without_compliance(whole, self.machine, (drive, named))
        if "drift" in self.remove:
            drifting = [named] if named else [name for name in whole.names if name not in (drive, "time")]
            for name in drifting:
                whole = remove_drift(whole, name, drive)
        chosen = within_ranges(whole, self.ranges)
        if self.branch == "both":
            return chosen
        return (loading if self.branch == "loading" else unloading)(chosen, drive)


def driving(response: Response, x: str | None) -> str:
    """Return the measured column that drives: what is stated, the pressure, or what drives as a rule.

    A record over time has a time, but its pressure is what rises and falls.

    Parameters
    ----------
    response : Response
    x : str or None
        ``NAME``, or ``NAME THERE=NAME``.
    """
    stated = spelled_column((x or "").rpartition("=")[2].strip(), response.names)
    if stated in response:
        return stated
    return "pressure" if "pressure" in response else drive_of(response)
