"""Files of an optimization: candidates as a table, the best job, figures and text."""

import csv
from math import isfinite
from pathlib import Path

from turgor.core.solvers.load import load
from turgor.core.solvers.solution import State
from turgor.foundation.response import COLUMN_UNITS
from turgor.foundation.store.atomic_files import whole
from turgor.studies.optimization.figure import before_and_after, ends_of, optimization_figure
from turgor.studies.optimization.result import Optimization
from turgor.studies.runs.jobs.job_function import JobFunction
from turgor.studies.runs.jobs.job_runs import last_state_of
from turgor.units import unit_value
from turgor.views.plots.figures import write_figure

#: Files of the results.
TABLE, BEST, FIGURE, TEXT = "optimization.csv", "best.toml", "optimization.png", "optimization.txt"
BEFORE_AND_AFTER = "before-and-after.png"


def write_optimization(
    optimization: Optimization, folder: str | Path, base: JobFunction | None = None
) -> tuple[Path, ...]:
    """Write candidates as a table, the figure, the text, and for a job the best one, with pictures before and after.

    Parameters
    ----------
    optimization : Optimization
    folder : str or Path
        Created if there is none.
    base : JobFunction, optional
        The job whose numbers were searched.

    Returns
    -------
    tuple of Path
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    files = [folder / TABLE, folder / TEXT]
    write_candidates(optimization, files[0])
    with whole(files[1]) as part:
        part.write_text(optimization.summary() + "\n", encoding="utf-8")
    if optimization.best is None:
        return tuple(files)
    files.append(folder / FIGURE)
    write_figure(files[-1], optimization_figure(optimization))
    if base is not None:
        files.append(folder / BEST)
        base.write(optimization.values, files[-1], f"Optimized:\n{optimization.summary()}")
    drawn = before_and_after(optimization, () if base is None else _last_states(optimization, base))
    if drawn is not None:
        files.append(folder / BEFORE_AND_AFTER)
        write_figure(files[-1], drawn)
    return tuple(files)


def _last_states(optimization: Optimization, base: JobFunction) -> tuple[State, ...]:
    """The last states of the start and of the best design; none where a run saved none."""
    where = base.values
    rows = (optimization.study.rows[number] for number in ends_of(optimization))
    files = [last_state_of(str(where["job"]), str(where["digest"]), row.values) for row in rows]
    return tuple(load(file).states[-1] for file in files) if all(file.is_file() for file in files) else ()


def write_candidates(optimization: Optimization, file: Path) -> None:
    """Write a line for each run: values of the factors, what each goal reads, whether the limits are satisfied."""
    rows = []
    heads = optimization.reads(optimization.best or 0)
    for number, row in enumerate(optimization.study.rows):
        line: dict[str, object] = {"run": number + 1}
        for each in optimization.study.factors:
            value = float(row.values[each.name]) / unit_value(each.unit)
            line[f"{each.name} ({each.unit})" if each.unit else each.name] = f"{value:.9g}"
        for goal, head in zip(optimization.goals, heads, strict=True):
            value = goal.reading(row).value
            text = f"{value / COLUMN_UNITS.get(head.unit, 1.0):.9g}" if isfinite(value) else ""
            line[f"{head.name} ({head.unit})" if head.unit else head.name] = text
        line["kept"] = int(optimization.scores[number].feasible)
        line["front"] = int(number in optimization.pareto)
        line |= {"status": row.status, "problem": row.problem, "cpu_seconds": f"{row.seconds:.3g}"}
        rows.append(line)
    with whole(file) as part, part.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
