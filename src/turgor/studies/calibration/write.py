"""Files of a calibration: numbers as JSON and CSV, curves as CSV, and the picture."""

import csv
import json
import re
from math import isfinite
from pathlib import Path
from typing import Any

from turgor.foundation.store.atomic_files import whole
from turgor.studies.calibration.figure import calibration_figure
from turgor.studies.calibration.parameter import Parameter
from turgor.studies.calibration.result import Calibration, Fitted
from turgor.units import unit_value
from turgor.views.plots.figures import write_figure


def write_calibration(calibration: Calibration, folder: str | Path) -> tuple[Path, ...]:
    """Write a calibration into a folder.

    Parameters
    ----------
    calibration : Calibration
    folder : str or Path
        Created if there is none.

    Returns
    -------
    tuple of Path
        ``calibration.json``, ``calibration.csv`` (a row for each parameter), ``calibration.png``, and
        ``curve-N-NAME.csv`` for each trial: measured, start, fitted.
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    document, table, picture = (folder / f"calibration.{end}" for end in ("json", "csv", "png"))
    with whole(document) as part:
        part.write_text(json.dumps(as_numbers(calibration), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    rows = [_row(calibration, each) for each in calibration.parameters]
    with whole(table) as part, part.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    write_figure(picture, calibration_figure(calibration))
    files = [document, table, picture]
    for number, each in enumerate((*calibration.fits, *calibration.held_out), start=1):
        name = re.sub(r"[^\w.-]+", "-", Path(each.data.trial.name).stem)
        files.append(folder / f"curve-{number}-{name}.csv")
        each.to_response().to_csv(files[-1])
    return tuple(files)


def as_numbers(calibration: Calibration) -> dict[str, Any]:
    """Return a calibration as tables of numbers in SI units and texts, as JSON takes them.

    Parameters
    ----------
    calibration : Calibration

    Returns
    -------
    dict
    """
    intervals = calibration.intervals
    return {
        "status": str(calibration.status),
        "message": calibration.message,
        "advice": calibration.advice,
        "solves": calibration.solves,
        "computed": calibration.computed,
        "derivatives": calibration.derivatives,
        "parameters": [
            {
                "name": each.name,
                "unit": each.unit,
                "value": calibration.values[each.name],
                "standard_error": _finite(calibration.errors[each.name]),
                "low": _finite(intervals[each.name][0]),
                "high": _finite(intervals[each.name][1]),
                "at_bound": each.name in calibration.estimate.at_bound,
                "start": each.start,
                "bounds": list(each.bounds),
                "prior": list(each.prior) if each.prior else None,
            }
            for each in calibration.parameters
        ],
        "correlation": [[_finite(value) for value in row] for row in calibration.correlation.tolist()],
        "undetermined": list(calibration.undetermined),
        "notes": list(calibration.estimate.notes),
        "failures": list(calibration.failures),
        "fits": [_fit(each) for each in calibration.fits],
        "held_out": [_fit(each) for each in calibration.held_out],
    }


def _fit(each: Fitted) -> dict[str, Any]:
    return {
        "name": each.data.trial.name, "x": each.data.x, "y": each.data.y, "rows": len(each.data.value),
        "spread": None if each.data.assumed else float(each.data.spread.mean()),
        "rms": each.rms, "rms_start": each.rms_start, "beyond": each.beyond, "notes": list(each.data.notes),
    }  # fmt: skip


def _row(calibration: Calibration, each: Parameter) -> dict[str, str]:
    low, high = calibration.intervals[each.name]
    numbers = {
        "value": calibration.values[each.name], "standard_error": calibration.errors[each.name], "low": low,
        "high": high, "start": each.start, "lower": each.bounds[0], "upper": each.bounds[1],
    }  # fmt: skip
    factor = unit_value(each.unit)
    shown = {name: f"{value / factor:.6g}" if isfinite(value) else "" for name, value in numbers.items()}
    return {"parameter": each.name, "unit": each.unit, **shown}


def _finite(value: float) -> float | None:
    return value if isfinite(value) else None
