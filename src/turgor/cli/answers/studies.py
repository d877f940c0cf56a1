"""Results of ``turgor calibrate``, ``turgor uncertainty`` and ``turgor gradient`` for programs."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from turgor.accuracy.gradients.result import Gradient
    from turgor.studies.calibration.result import Calibration
    from turgor.studies.uncertainty.band import Uncertainty


@dataclass(frozen=True, slots=True, kw_only=True)
class CalibrationResult:
    """``turgor calibrate``: the fitted values, in SI units.

    Parameters
    ----------
    status : str
        ``"converged"``, ``"at_bound"`` or ``"not_converged"``.
    message, advice : str
        What happened, and what to do.
    solves, computed : int
        Number of runs, and of those that were not read from disk.
    derivatives : str
        How the derivatives were computed, and why.
    parameters : list of tables
        ``name``, ``unit``, ``value``, ``standard_error``, ``low`` and ``high`` of the 95 % interval, ``at_bound``,
        ``start``, ``bounds``, ``prior``.
    correlation : list of lists
        Of the errors, in the order of the parameters.
    undetermined, notes, failures : list of str
        What the curves do not determine, what the numbers assume, and runs that failed.
    fits, held_out : list of tables
        ``name``, ``x``, ``y``, ``rows``, ``spread`` (null where it was assumed), ``rms``, ``rms_start``,
        ``beyond``, ``notes``.
    files : list of str
        Files that were written.
    """

    status: str
    message: str
    advice: str
    solves: int
    computed: int
    derivatives: str
    parameters: list[dict[str, Any]]
    correlation: list[list[float | None]]
    undetermined: list[str]
    notes: list[str]
    failures: list[str]
    fits: list[dict[str, Any]]
    held_out: list[dict[str, Any]]
    files: Sequence[Path]


def calibration_result(calibration: "Calibration", files: Sequence[Path]) -> CalibrationResult:
    """Make the result of a calibration."""
    from turgor.studies.calibration.write import as_numbers

    return CalibrationResult(**as_numbers(calibration), files=files)


@dataclass(frozen=True, slots=True, kw_only=True)
class UncertaintyResult:
    """``turgor uncertainty``: the bands of the response.

    Parameters
    ----------
    sentences : list of str
        One for each column, at the end of the path.
    method : str
        How it was computed.
    runs : int
        Number of runs.
    columns : list of tables
        ``name``, ``unit`` and ``values`` in this unit; the drive comes first.
    shares : table
        Share of the variance that each input brings at the end of the path, by column and input.
    notes : list of str
        What was left out.
    records : list of tables
        ``label``, ``name``, ``doubts`` and ``problem`` of each record, and ``values`` in SI units at the end of the
        path, by column.
    record_sentences : list of str
        What the records say together.
    files : list of str
        Files that were written.
    """

    sentences: list[str]
    method: str
    runs: int
    columns: list[dict[str, Any]]
    shares: dict[str, dict[str, float]]
    notes: Sequence[str]
    records: list[dict[str, Any]]
    record_sentences: list[str]
    files: Sequence[Path]


def uncertainty_result(uncertainty: "Uncertainty", files: Sequence[Path]) -> UncertaintyResult:
    """Make the result of a propagation of uncertainty."""
    from turgor.cli.answers.results import columns_of

    return UncertaintyResult(
        sentences=uncertainty.sentences(),
        method=uncertainty.checked(),
        runs=uncertainty.runs,
        columns=columns_of(uncertainty.to_response()),
        shares={name: band.shares() for name, band in uncertainty.bands.items()},
        notes=uncertainty.notes,
        records=[
            {
                "label": each.label,
                "name": each.name,
                "doubts": list(each.doubts),
                "problem": each.problem,
                "values": {name: float(curve[-1]) for name, curve in each.curves.items()},
            }
            for each in uncertainty.cases
        ],
        record_sentences=uncertainty.case_sentences(),
        files=files,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class GradientResult:
    """``turgor gradient``: derivatives of measures, in SI units.

    Parameters
    ----------
    load_factor : float
        That of the state.
    measures : list of tables
        ``name``, ``unit`` in which it is shown, and ``value`` of each measure.
    numbers : list of tables
        ``key``, ``unit`` and ``value`` of each number.
    derivatives : list of lists
        Of each measure, by each number in their order.
    way : str
        ``"direct"`` or ``"adjoint"``.
    left : float
        Share of the change of the forces that the rates leave unbalanced.
    files : list of str
        Files that were written.
    """

    load_factor: float
    measures: list[dict[str, Any]]
    numbers: list[dict[str, Any]]
    derivatives: list[list[float]]
    way: str
    left: float
    files: Sequence[Path]


def gradient_result(gradient: "Gradient", file: Path | None) -> GradientResult:
    """Make the result of a gradient."""
    return GradientResult(
        load_factor=gradient.load_factor,
        measures=[{"name": each.name, "unit": each.unit, "value": float(each.values[0])} for each in gradient.measures],
        numbers=[
            {"key": key, "unit": each.unit, "value": float(each.values[0])}
            for key, each in zip(gradient.keys, gradient.numbers, strict=True)
        ],
        derivatives=gradient.values.tolist(),
        way=gradient.way,
        left=gradient.residual,
        files=[] if file is None else [file],
    )
