"""Error times CPU seconds: the element of now against that of the version before."""

from collections.abc import Mapping, Sequence
from typing import Any

from tables import table
from truth_cases.case import STEPS, Case

Store = Mapping[str, Any]
#: Error and CPU seconds by step.
Ladder = Mapping[str, tuple[float, float]]
TEXT = """## What an error costs, against the version before

*At equal error* takes a mesh of now, of tetrahedra or hexahedra, with the least CPU seconds among those whose headline
error is no larger than that of some mesh before, and divides the seconds of that mesh before by its own; the largest
such quotient counts. Where the version before reaches the error of the default mesh on none of its meshes, its finest
one stands in, and the quotient is a lower bound (≥). *Same mesh* is the time of tetrahedra of the default size now over
that before."""


def compared(cases: Sequence[Case], values: Store, runs: Store) -> str:
    """Table of the cases: error and time of the default mesh before and now, and what the same error costs."""
    lines = []
    for case in cases:
        truth = values[case.name]["value"][case.measures[0].name]
        now, before = (ladder(case, runs, truth, formulation) for formulation in ("mixed", "continuous"))
        if "default" not in now or "default" not in before:
            continue
        others = ladder(case, runs, truth, "mixed", "hexahedra")
        (old, old_time), (new, new_time) = before["default"], now["default"]
        cost = f"{old_time:.1f} → {new_time:.1f}"
        lines.append(
            (case.title, f"{old:.2%}", f"{new:.2%}", cost, f"{new_time / old_time:.2f}", gain(now, others, before))
        )
    head = ("case", "error before", "error now", "CPU s at the default mesh", "same mesh", "at equal error")
    return f"{TEXT}\n\n{table(head, lines)}"


def ladder(
    case: Case, runs: Store, truth: float, formulation: str, kind: str = "tetrahedra"
) -> dict[str, tuple[float, float]]:
    """Size of the headline error and CPU seconds of cells of a kind and formulation, by step."""
    found = {}
    for step in STEPS:
        row = runs.get("|".join((case.name, kind, step, formulation)), {})
        if "values" in row:
            error = abs(row["values"][case.measures[0].name] / truth - 1)
            found[step] = (error, row["meshing"] + row["solving"])
    return found


def gain(now: Ladder, others: Ladder, before: Ladder) -> str:
    """How many times less CPU the same error takes, on meshes of now with tetrahedra or with other cells."""
    quotients = []
    for error, time in before.values():
        enough = [cost for off, cost in (*now.values(), *others.values()) if off <= error]
        if enough:
            quotients.append(time / min(enough))
    error, time = min(now["default"], others.get("default", now["default"]))
    finest = max(cost for _, cost in before.values())
    if len(before) > 1 and min(off for off, _ in before.values()) > error and finest / time > max(quotients, default=0):
        return f"≥ {finest / time:.1f}"
    return f"{max(quotients):.1f}" if quotients else "less than 1"
