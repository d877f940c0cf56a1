"""Result of ``turgor optimize`` for programs."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from turgor.studies.optimization.result import Optimization
    from turgor.studies.optimization.row_values import Read


@dataclass(frozen=True, slots=True, kw_only=True)
class OptimizationResult:
    """``turgor optimize``: the best design and all candidates, in SI units.

    Parameters
    ----------
    status : str
        ``"converged"``, ``"budget_ended"``, ``"infeasible"`` or ``"failed"``.
    message, advice : str
        What happened, and what to do.
    notes : list of str
        What the runs say of themselves, such as why they have no slopes.
    solves : int
        Number of runs.
    factors : list of tables
        ``name``, ``unit``, ``low``, ``high``, ``start`` and ``value``, null where no run gave a response.
    goals : list of tables
        ``name``, ``requested``, ``value``, ``mesh_error`` (null where none was estimated) and ``start``.
    best : int or null
        Row of the best design, from 0.
    descents : list of tables
        ``start``, ``best`` (rows from 0; null where no run gave a response) and ``status`` of each start.
    front : list of int
        Rows that no other one beats in all objectives; empty for one objective.
    rows : list of tables
        ``values`` by factor, ``goals`` (what each reads, null where it does not reach), ``kept``, ``status``,
        ``problem``.
    files : list of str
        Files that were written.
    """

    status: str
    message: str
    advice: str
    notes: Sequence[str]
    solves: int
    factors: list[dict[str, Any]]
    goals: list[dict[str, Any]]
    best: int | None
    descents: list[dict[str, Any]]
    front: list[int]
    rows: list[dict[str, Any]]
    files: Sequence[Path]


def optimization_result(optimization: "Optimization", files: Sequence[Path]) -> OptimizationResult:
    """Make the result of an optimization."""
    start = optimization.study.rows[optimization.start]
    ends = [(each.name, each.unit, *each.bounds) for each in optimization.study.factors]
    reads = optimization.reads(optimization.best or 0)
    begun = optimization.reads(optimization.start)
    return OptimizationResult(
        status=optimization.ending.value,
        message=optimization.message,
        advice=optimization.advice,
        notes=list(optimization.notes),
        solves=optimization.solves,
        factors=[
            {
                "name": name, "unit": unit, "low": low, "high": high, "start": start.values[name],
                "value": optimization.values.get(name),
            }
            for name, unit, low, high in ends
        ],
        goals=[
            {
                "name": read.name, "requested": read.request,
                "value": _known(read.value),
                "mesh_error": _known(read.mesh_error), "start": _known(before.value),
            }
            for read, before in zip(reads, begun, strict=True)
        ],
        best=optimization.best,
        descents=[
            {"start": each.start, "best": each.best, "status": each.ending.value} for each in optimization.descents
        ],
        front=list(optimization.pareto),
        rows=[_row(optimization, number) for number in range(len(optimization.study))],
        files=files,
    )  # fmt: skip


def _row(optimization: "Optimization", number: int) -> dict[str, Any]:
    row = optimization.study.rows[number]
    reads: Sequence[Read] = optimization.reads(number)
    return {
        "values": dict(row.values),
        "goals": [_known(each.value) for each in reads],
        "kept": optimization.scores[number].feasible,
        "status": row.status,
        "problem": row.problem,
    }


def _known(value: float) -> float | None:
    return value if isfinite(value) else None
