"""Claim 6.2-1: a coarse mesh converges easily but moves and balloons less."""

from turgor.guidelines.convergence.trials import SETUP, end, reached, solve, spent
from turgor.guidelines.guideline import Found, Guideline, Judgement, Setting, Study
from turgor.guidelines.judging import line_of, verdict_of
from turgor.guidelines.values import Value
from turgor.results.plots.study_figure import Panel
from turgor.study.runs import Run

#: Pressure [kPa], and sizes of cells [mm], the last one as reference.
PRESSURE = 40
SIZES = {"quick": {"hexahedra": (8, 6, 4, 3), "tetrahedra": (8, 6, 4)}, "full": {"hexahedra": (8, 6, 4, 3, 2), "tetrahedra": (8, 6, 4, 3)}}

#: Quantities that are compared.
QUANTITIES = ("bending_angle", "ballooning")

#: Difference from the finest mesh that is read as no difference.
SAME = 0.002


def runs(setting: Setting) -> tuple[Run, ...]:
    """Every size, in hexahedra and tetrahedra."""
    return tuple(
        Run(name=f"{cells}, {size} mm", function=solve, values={"size": float(size), "pressure": PRESSURE, "cells": cells})
        for cells, sizes in SIZES[setting].items()
        for size in sizes
    )


def _short(found: Found, name: str) -> dict[str, float]:
    """How much less each mesh moves than the finest one of its cells, relative."""
    out = {}
    for cells in ("hexahedra", "tetrahedra"):
        kind = {key: end(each, name).number for key, each in found.items() if key.startswith(cells)}
        finest = list(kind.values())[-1]
        out |= {key: value / finest - 1 for key, value in list(kind.items())[:-1]}
    return out


def judge(found: Found) -> Judgement:
    """Coarser meshes move less, and take no more iterations."""
    short = {name: _short(found, name) for name in QUANTITIES}
    coarsest = {name: [row[f"{cells}, 8 mm"] for cells in ("hexahedra", "tetrahedra")] for name, row in short.items()}
    less = [value < -SAME for row in coarsest.values() for value in row]
    iterations = {name: spent(each, "iterations") for name, each in found.items()}
    ended = [name for name, each in found.items() if reached(each) < 1]
    told = "; ".join(f"{name.replace('_', ' ')} " + ", ".join(f"{k} {v:+.2%}" for k, v in row.items()) for name, row in short.items())
    more = [name.replace("_", " ") for name, row in coarsest.items() if max(row) > SAME]
    conditions = f"Iterations: {', '.join(f'{name} {count:.0f}' for name, count in iterations.items())}. "
    conditions += f"Not all of the pressure was reached by {', '.join(ended)}." if ended else "All reach the pressure."
    if more:
        conditions += f" Against the rule, coarse cells of these mixed quadratic elements give more {' and '.join(more)}."
    return Judgement(verdict=verdict_of(less), found=f"against the finest mesh of the same cells: {told}", conditions=conditions)


def panels(found: Found) -> tuple[Panel, ...]:
    """Angle and iterations against the size."""
    out = []
    for name, label in (("bending_angle", "bending angle [deg]"), ("ballooning", "largest displacement [mm]")):
        lines = []
        for cells in ("hexahedra", "tetrahedra"):
            kind = {key: each for key, each in found.items() if key.startswith(cells)}
            sizes = [float(key.split()[1]) for key in kind]
            lines.append(line_of(sizes, [end(each, name) for each in kind.values()], cells))
        out.append(Panel(x="size of cells [mm]", y=label, lines=lines))
    costs = [Value(spent(each, "iterations")) for each in found.values()]
    return (*out, Panel(x="mesh", y="iterations", lines=[line_of(list(found), costs)]))


GUIDELINE = Guideline(
    key="6.2-1",
    rule="A coarse mesh converges more easily than a very fine one, but it moves less and misses strong ballooning.",
    sources=("Tawk and Alici 2020", "Xavier et al. 2021"),
    families=("semicircular_bender",),
    studies=(
        Study(
            title="Size of the cells",
            setup=SETUP + f", at {PRESSURE} kPa; quadratic hexahedra and tetrahedra with mean stresses.",
            expected="Coarser meshes bend and balloon less than the finest.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
