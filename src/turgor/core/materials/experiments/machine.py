"""Compliance of a testing machine: what load cell, frame and grips give way is not a stretch of the specimen."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from turgor.core.materials.experiments.columns import Column, find_columns
from turgor.core.materials.experiments.material_test import Array, Edit, MaterialTest
from turgor.core.materials.experiments.settings import MACHINE
from turgor.core.materials.experiments.table_text import Table, read_table
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.given import Quantity, number


@dataclass(frozen=True, slots=True, kw_only=True)
class Machine:
    """How far a testing machine gives way, in proportion to the force.

    Parameters
    ----------
    compliance : float [m/N]
        Extension of load cell, frame and grips for each newton.
    error : float [m/N]
        Its standard error, where a reference run gives it.
    forces : (float, float) or None [N]
        Forces of the reference run; None where the compliance is stated.
    source : str
        Where it comes from.

    Examples
    --------
    >>> Machine(compliance="0.02 mm/N").text
    '0.02 mm/N'
    """

    compliance: float
    error: float = 0.0
    forces: tuple[float, float] | None = None
    source: str = ""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            compliance: Quantity,
            error: float = 0.0,
            forces: tuple[float, float] | None = None,
            source: str = "",
        ) -> None: ...

    def __post_init__(self) -> None:
        value = number(self.compliance, "machine: compliance", "compliance")
        if not value > 0:
            raise TurgorError(f"machine: compliance is {value * 1e3:g} mm/N; it must be more than 0.")
        object.__setattr__(self, "compliance", value)

    @property
    def text(self) -> str:
        """The compliance in words, with its origin."""
        error = f" ± {self.error * 1e3:.1g}" if self.error else ""
        return f"{self.compliance * 1e3:.4g}{error} mm/N{self.source and ' ' + self.source}"


def read_machine(path: str | Path) -> Machine:
    r"""Read the compliance of a machine from a run with a stiff specimen in its grips, such as a piece of steel.

    The extension is fitted by a straight line over the force, above the part in which grips and couplings settle.

    Parameters
    ----------
    path : str or Path
        Table with a column of force and one of extension or length.

    Raises
    ------
    TurgorError
        If the extension is not in proportion to the force: the specimen was not stiff, or it slipped.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder) / "steel.csv"
    ...     rows = "".join(f"{force},{0.1 + 0.02 * force}\n" for force in range(0, 50, 5))
    ...     _ = file.write_text("force (N),extension (mm)\n" + rows)
    ...     round(read_machine(file).compliance * 1e3, 6)  # mm/N
    0.02
    """
    table = read_table(path)
    columns = {column.role: column for column in find_columns(table.names, {}, table.file)}
    force, extension = (_values(table, columns, roles) for roles in (("force",), ("extension", "length")))
    used = force > MACHINE.settled * force.max()
    if used.sum() < MACHINE.points:
        raise TurgorError(
            f"'{table.file}' has {int(used.sum())} points above {100 * MACHINE.settled:g} % of its largest force; a "
            f"reference run needs {MACHINE.points}, in tension with positive forces."
        )
    line = _Line.through(force[used], extension[used])
    if line.slope <= 0 or line.off > MACHINE.straight:
        raise TurgorError(
            f"'{table.file}': the extension is not in proportion to the force (off by {100 * line.off:.2g} % of its "
            f"range; allowed is {100 * MACHINE.straight:g} %). A reference run needs a stiff specimen, such as steel, "
            "that does not slip."
        )
    ends = float(force[used].min()), float(force.max())
    return Machine(compliance=line.slope, error=line.error, forces=ends, source=f"from '{table.file}'")


def stated_machine(text: str, folder: Path = Path()) -> Machine | None:
    """Return the machine of a statement: a number with its unit, or the file of a reference run; None for no text.

    Parameters
    ----------
    text : str
    folder : Path
        Where the name of a file begins.

    Examples
    --------
    >>> stated_machine("0.02 mm/N").text, stated_machine("")
    ('0.02 mm/N', None)
    """
    if not text:
        return None
    if (folder / text).is_file():
        return read_machine(folder / text)
    if not text[:1].isdigit() and text[:1] not in "+-.":
        raise TurgorError(
            f"compliance is '{text}'; write a number such as '0.02 mm/N', or the file of a pull on a stiff specimen; "
            "no file has this name."
        )
    return Machine(compliance=text)


def remove_compliance(test: MaterialTest, machine: Machine) -> MaterialTest:
    """Take away what the machine gave way from the stretch of a test; do so before slack is removed.

    Parameters
    ----------
    test : MaterialTest
        Read with the dimensions of its specimen, and with a stretch that comes from the crosshead.
    machine : Machine

    Raises
    ------
    TurgorError
        If the dimensions are not known, the stretch was measured on the specimen, or the machine would have given way
        by more than the whole extension.

    Examples
    --------
    >>> from turgor.core.materials.experiments.specimen import Specimen
    >>> strip = Specimen(length=20e-3, area=10e-6)
    >>> test = MaterialTest(mode="uniaxial", stretch=[1.0, 1.11], nominal_stress=[0.0, 1e5], name="a", specimen=strip)
    >>> remove_compliance(test, Machine(compliance="0.2 mm/N")).stretch.round(3)
    array([1. , 1.1])
    """
    if test.mode in ("biaxial", "simple_shear"):
        raise TurgorError(f"test '{test.name}' is {test.mode}; the compliance of a machine is removed from pulls only.")
    if test.specimen is None:
        raise TurgorError(
            f"test '{test.name}': its dimensions are not known, and the compliance of a machine is in mm/N.",
            python="Read it with specimen=Specimen(length=…, width=…, thickness=…).",
            command='State them, such as --specimen "33 mm, 6 mm, 3 mm".',
        )
    if test.crosshead is not None:
        raise TurgorError(
            f"test '{test.name}' has a strain that was measured on the specimen, besides the way of the crosshead; it "
            "needs no correction of the machine's compliance."
        )
    force = test.nominal_stress * test.specimen.section
    share = machine.compliance * force / test.specimen.length
    corrected = test.stretch - share
    top = int(np.argmax(np.abs(share)))
    if abs(share[top]) >= abs(test.stretch[top] - 1) or not (corrected > 0).all():
        way = abs(share[top]) * test.specimen.length * 1e3
        raise TurgorError(
            f"test '{test.name}': a compliance of {machine.text} makes {way:.3g} mm at {abs(force[top]):.3g} "
            "N, more than the whole extension; check its unit and the specimen."
        )
    return test.changed(Edit(text=_removed(test, machine, force, share)), {"stretch": corrected})


def _removed(test: MaterialTest, machine: Machine, force: Array, share: Array) -> str:
    """Sentence on what was taken away."""
    assert test.specimen is not None
    top = int(np.argmax(np.abs(share)))
    of = 100 * share[top] / (test.stretch[top] - 1)
    most = float(np.abs(force).max())
    text = (
        f"The machine gave way by {machine.text}: up to {abs(share[top]) * test.specimen.length * 1e3:.3g} mm at "
        f"{most:.3g} N, {of:.2g} % of the extension there, taken away."
    )
    if machine.forces is not None and not machine.forces[0] <= most <= machine.forces[1]:
        low, high = machine.forces
        text += f" The reference run goes from {low:.3g} to {high:.3g} N only."
    return text


def check_machine(tests: Sequence[MaterialTest]) -> tuple[Finding, ...]:
    """Compare the crosshead with a strain that was measured on the specimen: compliance, or slip (P14).

    Compliance goes in proportion to the force; what does not come back with the force is slip.

    Parameters
    ----------
    tests : sequence of MaterialTest
        As they were measured.
    """
    findings = []
    for test in tests:
        if test.crosshead is None or test.specimen is None:
            continue
        force = test.nominal_stress * test.specimen.section
        excess = (test.crosshead - test.stretch) * test.specimen.length
        way = float(np.ptp(test.crosshead)) * test.specimen.length
        if np.ptp(force) > 0 and np.ptp(excess) > MACHINE.excess * way:
            findings.append(_finding(test, force, excess))
    return tuple(findings)


def _finding(test: MaterialTest, force: Array, excess: Array) -> Finding:
    line = _Line.through(force, excess)
    most = 1e3 * np.ptp(excess)
    start = f"The crosshead of {test.name} went up to {most:.3g} mm further than the strain of the specimen says"
    if line.slope > 0 and line.off <= MACHINE.straight:
        return Finding(
            code="P14",
            severity=Severity.NOTE,
            message=f"{start}, in proportion to the force: the machine gives way by {line.slope * 1e3:.3g} mm/N. The "
            "stretch of this test is that of the specimen and needs no correction.",
            advice="Correct tests of this machine without such a strain: remove_compliance in Python, --compliance "
            f"'{line.slope * 1e3:.3g} mm/N' on the command line.",
        )
    step = int(np.argmax(np.abs(np.diff(excess - line.slope * force))))
    return Finding(
        code="P14",
        severity=Severity.WARNING,
        message=f"{start}, and not in proportion to the force (off by {100 * line.off:.2g} % of that; most at stretch "
        f"{test.stretch[step]:.3g}): the specimen slipped in its grips, or its wide ends stretched, too. A machine "
        "that gives way does so in proportion to the force.",
        advice="Use the strain of the specimen, as is done here; do not take a stretch from this crosshead.",
    )


@dataclass(frozen=True, slots=True)
class _Line:
    """Straight line over the force: its slope with the standard error, and how far points are off, over their range."""

    slope: float
    error: float
    off: float

    @staticmethod
    def through(force: Array, extension: Array) -> "_Line":
        A = np.stack([force, np.ones_like(force)], axis=1)
        best, *_ = np.linalg.lstsq(A, extension, rcond=None)
        rest = extension - A @ best
        variance = rest @ rest / max(len(force) - 2, 1) * np.linalg.pinv(A.T @ A)[0, 0]
        off = float(np.sqrt(np.mean(rest**2)) / max(np.ptp(extension), 1e-300))
        return _Line(float(best[0]), float(np.sqrt(variance)), off)


def _values(table: Table, columns: dict[str, Column], roles: tuple[str, ...]) -> Array:
    column = next((columns[role] for role in roles if role in columns), None)
    if column is None:
        raise TurgorError(
            f"'{table.file}' has no column of {' or '.join(roles)}; a reference run of the machine needs force and "
            "extension."
        )
    return table.column(column.index) * column.factor
