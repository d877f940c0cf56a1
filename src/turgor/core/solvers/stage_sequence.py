"""Stage sequence: solve the stages of a sequence one after the other and make one solution of them."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cables.cables import by_cable
from turgor.core.model.continued_model import continued, movable, with_loads
from turgor.core.model.drive import pressures_at
from turgor.core.model.loads import Load, pressures_among
from turgor.core.model.loads.channel import closed_cavities
from turgor.core.model.model import Model
from turgor.core.solvers.listeners import Listeners
from turgor.core.solvers.pressures import pressures_of
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.procedures.stages import Stage
from turgor.core.solvers.restart import Restart
from turgor.core.solvers.solution import Iteration, Solution, State, Status, Timing
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding

T = TypeVar("T")

#: Findings that hold in all later stages; one of each is enough.
LASTING = ("B02",)

#: Solves one procedure from rest or from a restart, and returns the restart of the next one.
Follow = Callable[[Model, Procedure, Listeners, Restart | None], tuple[Solution, Restart]]


def solve_stages(model: Model, procedure: Procedure, listeners: Listeners, follow: Follow) -> Solution:
    """Solve the stages of a sequence until one of them stops early."""
    solutions: list[Solution] = []
    restart: Restart | None = None
    first = _movable(model, procedure)
    for stage in procedure.stages:
        try:
            last = None if restart is None else _End.of(restart.state)
            question = _question(first, stage, last)
            solution, restart = follow(question, stage.procedure, _within(stage, listeners), restart)
        except TurgorError as error:
            raise TurgorError(f"stage '{stage.name}': {error}") from None
        solutions.append(solution)
        if not solution.complete:
            break
    return together(model, procedure, solutions)


def questions(model: Model, procedure: Procedure) -> tuple[Model, ...]:
    """Return the model of each stage as far as it is known before any is solved; the model itself without stages.

    Parameters
    ----------
    model : Model
    procedure : Procedure

    Returns
    -------
    tuple of Model
        Pressures that a stage seeks are missing in later ones.

    Raises
    ------
    TurgorError
        If a stage changes what the model does not have, seeks a pressure that it states, or contradicts a cable.
    """
    if not procedure.stages:
        return (model,)
    models: list[Model] = []
    first, last = _movable(model, procedure), None
    for stage in procedure.stages:
        try:
            question = _question(first, stage, last)
            stage.procedure.controlled(question)
            by_cable(question)
        except TurgorError as error:
            raise TurgorError(f"stage '{stage.name}': {error}") from None
        models.append(question)
        last = _End(question, 1.0, pressures_at(question, 1.0), np.zeros_like(model.mesh.points))
    return tuple(models)


@dataclass(frozen=True, slots=True)
class _End:
    """How a stage ended: its model, its load factor, the pressures, and the displacement (n, 3) [m]."""

    model: Model
    load_factor: float
    pressures: dict[str, float]
    displacement: NDArray[np.float64]

    @staticmethod
    def of(state: State) -> "_End":
        return _End(state.model, state.load_factor, pressures_of(state), state.displacement)


def _movable(model: Model, procedure: Procedure) -> Model:
    """The model in which faces that later stages move have a displacement of zero at first."""
    return movable(model, [each for stage in procedure.stages for each in stage.displacements])


def _question(model: Model, stage: Stage, last: _End | None) -> Model:
    """The model of a stage."""
    if last is None:
        return with_loads(model, stage.loads, stage.displacements, stage.moves)
    pressures = dict(last.pressures)
    stated = {load.face for load in pressures_among(stage.loads)}
    closed = closed_cavities([*_but_pressures(last.model.loads), *stage.loads])
    for name in (*stage.procedure.filled(last.model), *closed):
        if name not in stated:
            pressures.pop(name, None)  # it is unknown from here on
    acting = (last.load_factor, pressures)
    loads = [load.begun(last.displacement) for load in stage.loads]
    return continued(last.model, acting, loads, stage.displacements, stage.moves)


def _but_pressures(loads: Sequence[Load]) -> list[Load]:
    return [load for load in loads if load not in pressures_among(loads)]


def _within(stage: Stage, listeners: Listeners) -> Listeners:
    """Report the stage to the listeners, too."""
    progress, stop = listeners.progress, listeners.stop

    def tell(iteration: Iteration, state: State | None) -> None:
        if progress is not None:
            progress(iteration, None if state is None else replace(state, stage=stage.name))

    def ask(state: State) -> str | None:
        return None if stop is None else stop(replace(state, stage=stage.name))

    return Listeners(tell, ask, stage=stage.name)


def together(model: Model, procedure: Procedure, solutions: Sequence[Solution]) -> Solution:
    """Make one solution of those of the stages; the first state of each but the first is the last of the former.

    Parameters
    ----------
    model : Model
    procedure : Stages
    solutions : sequence of Solution
        Of the first stages.

    Returns
    -------
    Solution
    """
    states: list[State] = []
    limits = []
    for stage, solution in zip(procedure.stages, solutions, strict=False):
        skipped = 1 if states else 0
        limits += [replace(limit, state=limit.state + len(states) - skipped) for limit in solution.limit_points]
        passed = max((state.time for state in states if state.time is not None), default=0.0)
        states += [_placed(state, stage, passed) for state in solution.states[skipped:]]
    faces = dict.fromkeys(face for state in states for face in pressures_of(state))
    acting = [{**dict.fromkeys(faces, 0.0), **pressures_of(state)} for state in states]
    return Solution(
        model=model,
        procedure=procedure,
        states=tuple(replace(state, pressures=each) for state, each in zip(states, acting, strict=True)),
        status=_status(solutions),
        message=" ".join(f"{s.name}: {each.message}" for s, each in zip(procedure.stages, solutions, strict=False)),
        advice=" ".join(_once(each.advice for each in solutions if each.advice)),
        steps=tuple(
            replace(step, stage=stage.name)
            for stage, each in zip(procedure.stages, solutions, strict=False)
            for step in each.steps
        ),
        findings=_findings(procedure, solutions),
        timing=Timing.together([each.timing for each in solutions]),
        limit_points=tuple(limits),
    )


def _findings(procedure: Procedure, solutions: Sequence[Solution]) -> tuple[Finding, ...]:
    """Findings of each stage, with its name; a repeated finding is left out."""
    named: dict[tuple[str, str], Finding] = {}
    for stage, solution in zip(procedure.stages, solutions, strict=False):
        for each in solution.findings:
            what = each.code if each.code in LASTING else each.message
            named.setdefault((each.code, what), replace(each, message=f"Stage '{stage.name}': {each.message}"))
    return tuple(named.values())


def _placed(state: State, stage: Stage, passed: float) -> State:
    """A state with its stage, and its time counted from the first stage that has one."""
    return replace(state, stage=stage.name, time=None if state.time is None else passed + state.time)


def _status(solutions: Sequence[Solution]) -> Status:
    if not solutions[-1].complete or all(each.converged for each in solutions):
        return solutions[-1].status
    return Status.FOLLOWED


def _once(values: Iterable[T]) -> list[T]:
    return list(dict.fromkeys(values))
