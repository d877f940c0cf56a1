"""GMRES against factors on the same tangents, at one size: iterations and CPU seconds, one thread.

Tangents and right sides are those of the first and of the last iteration of the first load step of three models: the
six-chamber fast PneuNet of `case.py` with paper and without, and the reference bender. Run:
python benchmarks/run.py iterative, or python benchmarks/core/iterative.py [mesh size in mm] [size of the bender].
It takes some minutes.
"""

import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import turgor as tg

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
from benchmarks.shared.case import bender_model, growth_model
from benchmarks.shared.tables import table
from turgor.core.engine.algebra.iterative.levels import levels_of
from turgor.core.engine.algebra.iterative.solver import IterativeSolver
from turgor.core.engine.algebra.linear import REFINED, ROUGH, linear_solver
from turgor.core.engine.algebra.pattern import Pattern
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import System

Equations = tuple[Pattern, np.ndarray, np.ndarray]
FINE = 1e-6


def recorded(model: tg.Model) -> tuple[System, list[Equations]]:
    """The system of a model, and the equations of the first and of the last iteration of a first step."""
    kept: list[Equations] = []
    systems: list[System] = []
    plain = Tangent.solve

    def solve(self: Tangent, right: np.ndarray, left: float = REFINED) -> np.ndarray:
        systems[:] = [self._system]
        if left == REFINED:  # an update, not an estimate
            kept[1:] = [(self._system.pattern, self._data, right.copy())]
            kept[:] = kept if len(kept) == 2 else kept * 2
        return plain(self, right, left)

    Tangent.solve = solve  # type: ignore[method-assign]
    try:
        options, step = EngineOptions(linear_solver="rslab", threads=1), tg.Static(first_step=0.05, max_step=0.05)
        tg.solve(model, step, options=options, stop=lambda state: "one step is enough", throw=False)
    finally:
        Tangent.solve = plain  # type: ignore[method-assign]
    return systems[0], kept


def timed(work: Callable[[], Any]) -> tuple[float, Any]:
    """CPU seconds, and the result."""
    start = time.process_time()
    out = work()
    return time.process_time() - start, out


def row(system: System, equations: Equations) -> tuple[str, ...]:
    """Factors and GMRES on the same equations."""
    pattern, data, right = equations
    direct = linear_solver("rslab", pattern, 1)
    direct.factor(data)  # analyzes
    factor, _ = timed(partial(direct.factor, data))
    solve, _ = timed(partial(direct.solve, right))
    precision = "double" if direct.double else "single"
    levels = levels_of(system)
    assert levels is not None
    solver = IterativeSolver(levels, pattern, 1, partial(linear_solver, "rslab", pattern, 1))
    solver.factor(data)  # finds the structures
    setup, _ = timed(partial(solver.factor, data))
    cells = [f"{pattern.size:,}", precision, f"{factor + solve:.2f}", f"{setup:.2f}"]
    for left in (ROUGH, FINE):
        before = solver.iterations
        spent, _ = timed(partial(solver.solve, right, left))
        cells.append(f"{solver.iterations - before}{'' if solver.iterative else ' (not solved)'}, {spent:.2f}")
    return tuple(cells)


def section(size: float = 1.15e-3, bender: str = "M") -> str:
    """A table of all models."""
    models = {
        "PneuNet with paper": growth_model(size),
        "PneuNet without": growth_model(size, paper=False),
        f"bender {bender}": bender_model(bender),
    }
    rows = []
    for name, model in models.items():
        system, both = recorded(model)
        for which, equations in zip(("first", "last"), both, strict=True):
            rows.append((name, which, *row(system, equations)))
    head = ("model", "iteration", "unknowns", "factors", "factors, s", "GMRES: set-up, s")
    text = (
        "The same equations solved by factors (rslab; single precision where that will do, one factorization and the "
        "solution) and by GMRES with two levels; those of the first and of the last iteration of a first step. One "
        "thread, CPU seconds; the analysis of the pattern is left out of both. Whole steps: `benchmarks/choices.md`."
    )
    return f"## Iterative solver\n\n{text}\n\n{table((*head, 'GMRES to 1e-3: iterations, s', 'to 1e-6'), rows)}\n"


if __name__ == "__main__":
    print(section(*([float(sys.argv[1]) * 1e-3] if sys.argv[1:] else []), *sys.argv[2:3]))
