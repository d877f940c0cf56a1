"""Results of ``turgor sweep`` for programs."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from turgor.studies.runs.designs import Designs
    from turgor.studies.runs.study import Study


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepResult:
    """``turgor sweep``: the table of the study.

    Parameters
    ----------
    rule : str
        How the designs were chosen.
    designs : int
        Number of designs.
    kept : int
        Those that had been computed before.
    failed : int
        Those without a response.
    columns : table of lists
        Cells by header with unit, as in the CSV file; null where a row has none.
    problems : list of str
        Rows that failed or ended early.
    sentences : list of str
        What mesh errors hide.
    files : list of str
        Files that were written.
    """

    rule: str
    designs: int
    kept: int = 0
    failed: int = 0
    columns: Mapping[str, Sequence[Any]]
    problems: Sequence[str] = ()
    sentences: Sequence[str] = ()
    files: Sequence[Path] = ()


def sweep_result(
    study: "Study", table: Mapping[str, Sequence[Any]], sentences: Sequence[str], files: Sequence[Path]
) -> SweepResult:
    """Make the result of a sweep."""
    columns = {
        name: [None if isinstance(cell, float) and math.isnan(cell) else cell for cell in cells]
        for name, cells in table.items()
    }
    return SweepResult(
        rule=str(study.source), designs=len(study), kept=sum(row.ended.again for row in study.rows),
        failed=sum(row.response is None for row in study.rows), columns=columns, problems=study.problems,
        sentences=sentences, files=files,
    )  # fmt: skip


def designs_result(designs: "Designs") -> SweepResult:
    """Make the result of a sweep that was not computed: its designs."""
    from turgor.studies.runs.designs import design_table

    return SweepResult(rule=designs.rule, designs=len(designs), columns=design_table(designs.factors, designs.values))
