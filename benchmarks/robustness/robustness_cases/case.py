"""What a case of the collection is, how it is run, and how its end is judged."""

import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf
from pathlib import Path
from typing import Any

import turgor as tg
from turgor.core.solvers.solve import solve

#: The structured meshes and exact answers of the verification tests serve here too.
SHARED = Path(__file__).parents[3] / "tests" / "verification"
if str(SHARED) not in sys.path:
    sys.path.append(str(SHARED))

MM, KPA = 1e-3, 1e3
OPTIONS = tg.EngineOptions(linear_solver="rslab", threads=1)
RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12e6), density=1100.0)

#: CPU seconds that a case may take unless it says otherwise; then it is interrupted.
LIMIT = 30.0

REACHED, DIAGNOSED, GAVE_UP, WRONG = "converged", "stopped, correct diagnosis", "gave up", "wrong"
#: At the load asked for, but on a branch that is unstable, as the message says; the check finds another one.
UNSTABLE = "unstable, as it says"
#: At the load asked for, but the check did not come to an end in its time.
UNCHECKED = "unchecked"


@dataclass(frozen=True, slots=True)
class Found:
    """What a check found: whether it agrees, None where it could not tell, and what it compared."""

    agrees: bool | None
    text: str


Check = Callable[[tg.Solution], Found]


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One case: the question, what is hard about it, how it must end, and an independent check of the end.

    ``stops`` says that the load cannot be reached under this procedure, and a limit point must be reported; None that
    a stop there and a jump that is said are both right.
    """

    name: str
    hard: str
    model: Callable[[], tg.Model]
    check: Check
    procedure: Any = field(default_factory=tg.Static)
    stops: bool | None = False
    limit: float = LIMIT


@dataclass(frozen=True, slots=True, kw_only=True)
class Verdict:
    """How a case ended."""

    name: str
    hard: str
    end: str
    status: str
    unknowns: int
    steps: int
    iterations: int
    seconds: float
    text: str


def one(mesh: tg.Mesh, law: Any, loads=(), supports=(), bulk_modulus: float = inf, **more: Any) -> tg.Model:
    """A model of a single material everywhere."""
    material = law if isinstance(law, tg.Material) else tg.Material(name="rubber", law=law, bulk_modulus=bulk_modulus)
    return tg.Model(mesh, dict.fromkeys(mesh.regions, material), supports, loads, **more)


def limited(
    model: tg.Model, procedure: Any, limit: float = LIMIT, options: tg.EngineOptions = OPTIONS
) -> tuple[tg.Solution, float]:
    """Solve, interrupted where the CPU time is used up; the path and the CPU seconds."""
    start = time.process_time()

    def watch(iteration: object, state: object) -> None:
        if time.process_time() - start > limit:
            raise KeyboardInterrupt

    solution = solve(model, procedure, progress=watch, options=options, throw=False)
    return solution, time.process_time() - start


def run(case: Case) -> Verdict:
    """Run a case and judge its end; an exception is a wrong end."""
    facts = {"name": case.name, "hard": case.hard}
    try:
        model = case.model()
        solution, seconds = limited(model, case.procedure, case.limit)
        end, text = judge(case, solution)
    except Exception as error:  # whatever it is, the other cases must run
        text = f"{type(error).__name__}: {error}"
        return Verdict(**facts, end=WRONG, status="error", unknowns=0, steps=0, iterations=0, seconds=0.0, text=text)
    return Verdict(
        **facts,
        end=end,
        status=str(solution.status),
        unknowns=model.mesh.unknown_count,
        steps=len(solution.steps),
        iterations=solution.iterations,
        seconds=seconds,
        text=text,
    )


def judge(case: Case, solution: tg.Solution) -> tuple[str, str]:
    """The end of a run, and why it is taken for this."""
    if case.stops or (case.stops is None and solution.status is tg.Status.LIMIT_POINT):
        if solution.status is tg.Status.STEP_TOO_SMALL:
            return GAVE_UP, solution.message
        if solution.complete and solution.states[-1].unstable_modes and "unstable" in solution.message:
            return (
                UNSTABLE,
                solution.message,
            )  # without an imperfection it stays on the branch that buckles, and says so
        if solution.status is not tg.Status.LIMIT_POINT:
            return WRONG, f"a limit point should have been reported, not: {solution.message}"
        result = case.check(solution)
        said = "Stability was lost before" in solution.message
        return (DIAGNOSED if result.agrees else UNSTABLE if said else WRONG), result.text
    if solution.complete:
        result = case.check(solution)
        said = solution.states[-1].unstable_modes and "unstable" in solution.message
        if result.agrees is None:
            return UNCHECKED, result.text
        return (REACHED if result.agrees else UNSTABLE if said else WRONG), result.text
    if solution.status is tg.Status.INTERRUPTED:
        return GAVE_UP, f"not done after {case.limit:g} CPU s: {solution.message}"
    if solution.status is tg.Status.LIMIT_POINT:
        return WRONG, f"no limit point is there, but it said: {solution.message}"
    return GAVE_UP, solution.message
