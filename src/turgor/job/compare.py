"""Compare a run with an experiment: the comparison is saved in the folder of the run, and its report shows it."""

import tomllib
from codecs import BOM_UTF8 as BOM
from dataclasses import dataclass, field, replace
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from turgor.accuracy.laboratory.chosen_rows import ChosenRows
from turgor.accuracy.laboratory.compare import Comparison, compare
from turgor.accuracy.laboratory.comparison_plot import comparison_figure
from turgor.accuracy.laboratory.rest import less
from turgor.accuracy.laboratory.runs import SPREAD
from turgor.core.results.files.response_csv import read_response
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.job.output.folder import COMPARISONS, LOCK, RESPONSE
from turgor.views.plots.figures import svg_of, write_figure
from turgor.views.viewer.curves import Measured

#: Name of the first column of the response of a run, which no table of a laboratory has.
OF_A_RUN = b"load_factor,"


@dataclass(frozen=True, slots=True, kw_only=True)
class ComparisonOptions:
    """How an experiment is read and compared.

    Parameters
    ----------
    y, x : str or None
        Columns, as `turgor.compare` takes them.
    rows : ChosenRows
        What of the experiment is compared.
    """

    y: str | None = None
    x: str | None = None
    rows: ChosenRows = field(default_factory=ChosenRows)


def compare_folder(
    run: str | Path, experiment: str | Path, options: ComparisonOptions | None = None
) -> tuple[Comparison, list[Path]]:
    """Compare the response of a run with a table from a laboratory, and write the comparison into its folder.

    Parameters
    ----------
    run : str or Path
        Folder of a run, or a CSV file that holds a response; for a file, nothing is written.
    experiment : str or Path
        See `turgor.experiments.read_experiment`; or the folder of another run, or its response.
    options : ComparisonOptions, optional

    Returns
    -------
    comparison : Comparison
    files : list of Path
        The experiment as it was compared, the compared rows, and the picture.

    Raises
    ------
    TurgorError
        If the folder holds no response, or the two cannot be compared.
    """
    run, options = Path(run), options or ComparisonOptions()
    file = run / RESPONSE if run.is_dir() else run
    if run.is_dir() and not file.exists():
        raise TurgorError(f"'{run}' holds no {RESPONSE}, so it is no folder of a run; run the job first.")
    computed = read_response(file, Source(text=run.name.removesuffix("-results") or run.name))
    measured, specimens = _measured(Path(experiment), options)
    comparison = compare(computed, measured, options.y, x=options.x)
    if "offset" in options.rows.remove:
        comparison = _without_offset(comparison, options)
    if specimens:
        lines = tuple(_of_specimen(name, each, comparison) for name, each in specimens.items())
        comparison = replace(comparison, notes=(*comparison.notes, *lines))
    other = Path(experiment)
    if is_run(other):
        comparison = replace(comparison, other="other run's")
    name = other.resolve().parent.name if other.name == RESPONSE else other.stem
    return comparison, _write(run / COMPARISONS, name, comparison) if run.is_dir() else []


def _without_offset(comparison: Comparison, options: ComparisonOptions) -> Comparison:
    """Compare again, without the offset at rest."""
    if not isfinite(comparison.offset):
        raise TurgorError(
            f"the offset of '{comparison.measured_y}' in {comparison.measured.source} is not known: the record "
            f"does not begin at its lowest '{comparison.measured_x}', or nothing was computed there."
        )
    measured = less(comparison.measured, comparison.measured_y, comparison.offset)
    again = compare(comparison.computed, measured, options.y, x=options.x)
    amount = Column(comparison.y, comparison.computed.find(comparison.y).unit, np.array([comparison.offset]))
    return replace(
        again, notes=(*again.notes, f"The offset at rest, {amount.in_unit[0]:.3g} {amount.unit}, is removed.")
    )


def _of_specimen(name: str, specimen: Response, mean: Comparison) -> str:
    """How far a run is from one of several specimens."""
    one = compare(mean.computed, specimen, f"{mean.y}={mean.measured_y}", x=f"{mean.x}={mean.measured_x}")
    return f"{name}: {one.summary()}"


def _measured(experiment: Path, options: ComparisonOptions) -> tuple[Response, dict[str, Response]]:
    """Read what a run is compared with: the table of a laboratory, or the response of another run."""
    if experiment.is_dir() and not (experiment / RESPONSE).is_file():
        raise TurgorError(f"'{experiment}' holds no {RESPONSE}; the folder of a run or a table is needed.")
    file = experiment / RESPONSE if (experiment / RESPONSE).is_file() else experiment
    if is_run(experiment):
        run = read_response(file, Source(text=file.resolve().parent.name.removesuffix("-results")))
        return options.rows.of(run, options.x, options.y), {}
    return options.rows.read(file, options.x, options.y)


def is_run(experiment: Path) -> bool:
    """Return whether a path is the folder of a run or its response, not the table of a laboratory."""
    file = experiment / RESPONSE if (experiment / RESPONSE).is_file() else experiment
    return file.is_file() and file.read_bytes().removeprefix(BOM)[: len(OF_A_RUN)] == OF_A_RUN


def stated_values(run: Path) -> dict[str, Any]:
    """Return the content of the lock file of a run, named by its folder or its response; empty where there is none."""
    file = (run.parent if run.name == RESPONSE else run) / LOCK
    return tomllib.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}


def comparisons_of(folder: Path, computed: Response) -> list[tuple[str, Comparison]]:
    """Return the comparisons that were made with a run, with their names, against its present response.

    Parameters
    ----------
    folder : Path
        Of the run.
    computed : Response
        Its response.
    """
    comparisons = []
    for file in sorted((folder / COMPARISONS).glob("*_measured.csv")):
        measured = read_response(file, Source(text=file.name.removesuffix("_measured.csv")))
        x, y = measured.names[:2]
        if x in computed and y in computed:  # the run may have been measured again with less
            comparisons.append((measured.source.text, compare(computed, measured, y, x=x)))
    return comparisons


def comparison_sections(folder: Path, computed: Response) -> tuple[tuple[str, str, str], ...]:
    """Return title, text and picture (SVG) of each comparison, for the report of a run; see `comparisons_of`."""
    return tuple(
        (f"Against {name}", _words(comparison), svg_of(comparison_figure(comparison)))
        for name, comparison in comparisons_of(folder, computed)
    )


def measured_points(folder: Path, computed: Response) -> tuple[Measured, ...]:
    """Return the measured points of each comparison, for the curves next to the viewer; see `comparisons_of`."""
    return tuple(
        Measured(
            name=name, x=each.x, y=each.y,
            across=each.measured.column(each.measured_x), upward=each.measured.column(each.measured_y),
        )
        for name, each in comparisons_of(folder, computed)
    )  # fmt: skip


def _words(comparison: Comparison) -> str:
    """Differences and notes in sentences, with the signs of a printed page."""
    return " ".join([_sentence(comparison.summary()), *comparison.notes]).replace(" deg", "°")


def _write(folder: Path, name: str, comparison: Comparison) -> list[Path]:
    folder.mkdir(exist_ok=True)
    files = [folder / f"{name}_measured.csv", folder / f"{name}_compared.csv", folder / f"{name}.png"]
    x, y = comparison.computed.find(comparison.x), comparison.computed.find(comparison.y)
    columns = [
        Column(comparison.x, x.unit, comparison.measured.column(comparison.measured_x)),
        Column(comparison.y, y.unit, comparison.measured.column(comparison.measured_y)),
    ]
    spread = comparison.measured_y + SPREAD
    if spread in comparison.measured:
        columns.append(Column(comparison.y + SPREAD, y.unit, comparison.measured.column(spread)))
    Response(columns=tuple(columns), source=comparison.measured.source).to_csv(files[0])
    comparison.to_response().to_csv(files[1])
    write_figure(files[2], comparison_figure(comparison), dpi=160)
    return files


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:]
