"""What an error costs: CPU seconds of the element of now against that of the version before, at the same error."""

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

from benchmarks.shared.tables import table
from benchmarks.truth.truth_cases.case import STEPS, Case

Store = Mapping[str, Any]
#: Errors and CPU seconds of meshes.
Costs = Sequence[tuple[float, float]]
#: Smaller errors count as this one: the reference values are known no better.
AGREED = 0.003
#: How many times less CPU is asked at equal error; elsewhere, no case may be slower by more than `SLOWER`.
ASKED = {"fast_pneunet_stiff_base": 5.0, "held_cylinder": 2.0, "wound_cylinder": 2.0, "wound_bender": 2.0}
SLOWER = 1.1
TEXT = """## What an error costs, against the version before

Every row is a mesh that was solved with the element of the version before and, where stored, with that of now. *Same
mesh* is the time now over that before; more than 1.10 is a miss. *At its error* are the CPU seconds that the same kind
of cells takes now for the headline error of the version before, and *times less* is how many times less that is.
Between two meshes of now, error and time are interpolated on logarithmic scales. Where the coarsest mesh of now is
already better, its time counts, and ≥ says so; such a bound is no miss. Where no mesh of now with these cells is as
good, < divides by the time of the best one.

Asked are 5 times less on the fast PneuNet on a stiff base, 2 times less on bodies with a skin, and elsewhere no case
slower by more than 10 %, which is 0.91. An error below 0.3 % counts as 0.3 %, because the references are known no
better. **Bold** is a miss. Some errors before are small because two errors cancel: a mean stress that cannot jump makes
bodies with stiff parts too soft, coarse cells make them too stiff (slow PneuNet, joint)."""


def compared(cases: Sequence[Case], values: Store, runs: Store) -> str:
    """Table of the cases: error and time of every mesh before and now, and what the same error costs."""
    lines = []
    for case in cases:
        title = case.title
        for kind in case.kinds:
            before, now = (costs(case, values, runs, kind, which) for which in ("continuous", "mixed"))
            for step in before if now else ():
                lines.append((title, kind, step, *numbers(case, before[step], now.get(step), list(now.values()))))
                title = ""
    head = ("case", "cells", "size", "error before", "CPU s", "error now", "CPU s", "same mesh")
    return f"{TEXT}\n\n{table((*head, 'at its error', 'times less'), lines)}\n\n{verdict(lines)}"


def verdict(lines: Sequence[Sequence[str]]) -> str:
    """How many rows of the table are misses, read from their last columns."""
    same = [line[-3] for line in lines if line[-3] != "–"]
    slower, dearer = (sum(text.startswith("**") for text in texts) for texts in (same, [line[-1] for line in lines]))
    return (
        f"On the same mesh, {slower} of {len(same)} rows are slower by more than 10 %. "
        f"At equal error, {dearer} of {len(lines)} rows miss the limit."
    )


def numbers(case: Case, before: tuple[float, float], now: tuple[float, float] | None, all_now: Costs) -> list[str]:
    """Columns of a mesh from its errors and times; now has none of some meshes before."""
    ratio = now[1] / before[1] if now else 0.0
    sign, cost = cost_of(max(before[0], AGREED), [(max(error, AGREED), time) for error, time in all_now])
    less = before[1] / cost
    missed = sign != "≥" and less < ASKED.get(case.name, 1 / SLOWER)
    return [
        *(text for mesh in (before, now) for text in ((f"{mesh[0]:.2%}", f"{mesh[1]:.1f}") if mesh else ("–", "–"))),
        bold(f"{ratio:.2f}", ratio > SLOWER) if now else "–",
        f"{cost:.1f}" if sign != "<" else "–",
        bold(f"{sign}{less:.1f}" if less >= 1 else f"{sign}{less:.2f}", missed),
    ]


def bold(text: str, miss: bool) -> str:
    """A number, bold where it is a miss."""
    return f"**{text}**" if miss else text


def costs(case: Case, values: Store, runs: Store, kind: str, formulation: str) -> dict[str, tuple[float, float]]:
    """Size of the headline error and CPU seconds of cells of a kind and formulation, by step."""
    result, headline = {}, case.measures[0].name
    for step in STEPS:
        row = runs.get("|".join((case.name, kind, step, formulation)), {})
        if "values" in row:
            error = abs(row["values"][headline] / values[case.name]["value"][headline] - 1)
            result[step] = (error, row["meshing"] + row["solving"])
    return result


def cost_of(error: float, meshes: Costs) -> tuple[str, float]:
    """CPU seconds for an error, interpolated between meshes, with "≥" or "<" where these do not reach around it.

    Examples
    --------
    >>> cost_of(0.02, [(0.04, 1.0), (0.01, 4.0)])
    ('', 2.0)
    >>> cost_of(0.08, [(0.04, 1.0), (0.01, 4.0)]), cost_of(0.005, [(0.04, 1.0), (0.01, 4.0)])
    (('≥', 1.0), ('<', 4.0))
    """
    front: list[tuple[float, float]] = []
    for result in sorted(meshes, key=lambda mesh: (mesh[1], mesh[0])):
        if not front or result[0] < front[-1][0]:
            front.append(result)
    if front[0][0] <= error:
        return "" if front[0][0] == error else "≥", front[0][1]
    for (large, cheap), (small, dear) in pairwise(front):
        if small <= error:
            share = math.log(large / error) / math.log(large / small)
            return "", cheap * (dear / cheap) ** share
    return "<", front[-1][1]
