"""Tables of a run: response, lock file, steps and log. Unlike pictures they load no heavy library."""

import csv
from collections.abc import Callable
from pathlib import Path

from turgor.core.solvers.solution import Solution
from turgor.foundation.store.atomic_files import whole, write_whole
from turgor.job.output.folder import LOCK, LOG, RESPONSE, STEPS, clear_drawn
from turgor.job.output.lock import lock_text
from turgor.job.output.manifest import list_files
from turgor.job.output.outcome import RunOutcome
from turgor.views.report.describe_procedure import ending

STEP_COLUMNS = ("load_factor", "increment", "iterations", "residual", "accepted", "seconds", "reason")


def write_tables(
    outcome: RunOutcome, notify: Callable[[str], None], current: frozenset[str] = frozenset()
) -> tuple[Path, ...]:
    """Write the response, the lock file, the steps and the log alone, in place of the results of an earlier run.

    ``current`` are those of `turgor.job.output.folder.RESULTS` that are not removed.
    """
    folder = outcome.folder
    notify("writing the response")
    list_files(folder, (RESPONSE, LOCK, STEPS, LOG))
    outcome.response.to_csv(folder / RESPONSE)
    write_whole(folder / LOCK, lock_text(outcome.job, outcome.written_by))
    write_steps(folder / STEPS, outcome.solution)
    write_whole(folder / LOG, log_text(outcome))
    clear_drawn(folder, current)
    return folder / RESPONSE, folder / LOCK, folder / STEPS, folder / LOG


def write_steps(file: Path, solution: Solution) -> None:
    """Write every attempted step as a line of CSV."""
    columns = ("stage", *STEP_COLUMNS) if solution.procedure.stages else STEP_COLUMNS
    with whole(file) as part, part.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(f"{name}_s" if name == "seconds" else name for name in columns)
        for step in solution.steps:
            writer.writerow(getattr(step, name) for name in columns)


def log_text(outcome: RunOutcome) -> str:
    """Write the log of a run: versions, notices, the end with its advice, findings, and times."""
    solution, timing = outcome.solution, outcome.solution.timing
    programs = ", ".join(f"{name} {value}" for name, value in outcome.written_by.items())
    accepted = sum(step.accepted for step in solution.steps)
    cut = len(solution.steps) - accepted
    spent = timing.parts() | {"total": timing.total}
    return "\n".join(
        [
            f"job {outcome.job.name}",
            f"with {programs}",
            *outcome.notices,
            f"{ending(solution.status)}: {solution.message} {solution.advice}".rstrip(),
            f"{accepted} steps accepted, {cut} cut back, {solution.iterations} iterations",
            f"wall time: {', '.join(f'{name} {seconds:.2f} s' for name, seconds in spent.items())}",
            *map(str, outcome.findings),
            "",
        ]
    )
