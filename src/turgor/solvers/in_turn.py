"""In turn: solve the stages of a sequence one after the other and make one solution of them."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import fields, replace
from typing import Any, TypeVar

from turgor.errors import TurgorError
from turgor.model.continuing import continued, with_loads
from turgor.model.loads import Pressure
from turgor.model.model import Model
from turgor.solvers.carried import Carried
from turgor.solvers.dynamic_run import Listeners
from turgor.solvers.path_procedures import GasMass, VolumeControl
from turgor.solvers.paths import asked_cavities
from turgor.solvers.pressures import pressures_of
from turgor.solvers.solution import Iteration, Solution, State, Status, Timing
from turgor.solvers.stages import OneProcedure, Stage, Stages

T = TypeVar("T")

#: Solves one procedure from rest or from what was carried, and says what to carry on.
Follow = Callable[[Model, OneProcedure, Listeners, Carried | None], tuple[Solution, Carried]]


def in_turn(model: Model, procedure: Stages, listeners: Listeners, follow: Follow) -> Solution:
    """Solve the stages of a sequence until one of them stops early."""
    found: list[Solution] = []
    carried: Carried | None = None
    for stage in procedure.stages:
        try:
            question = _question(model, stage, carried)
            solution, carried = follow(question, stage.procedure, _within(stage, listeners), carried)
        except TurgorError as error:
            raise TurgorError(f"stage '{stage.name}': {error}") from None
        found.append(solution)
        if not solution.complete:
            break
    return _together(model, procedure, found)


def _question(model: Model, stage: Stage, carried: Carried | None) -> Model:
    """The model of a stage."""
    if carried is None:
        return with_loads(model, stage.loads, stage.displacements, stage.moves)
    last = carried.state
    pressures = pressures_of(last)
    if isinstance(stage.procedure, VolumeControl | GasMass):
        stated = {load.face for load in stage.loads if isinstance(load, Pressure)}
        for name in asked_cavities(last.model, stage.procedure):
            if name not in stated:
                pressures.pop(name, None)  # it is sought from here on
    return continued(last.model, (last.load_factor, pressures), stage.loads, stage.displacements, stage.moves)


def _within(stage: Stage, listeners: Listeners) -> Listeners:
    """Tell listeners the stage too."""
    progress, stop = listeners.progress, listeners.stop

    def tell(iteration: Iteration, state: State | None) -> None:
        if progress is not None:
            progress(iteration, None if state is None else replace(state, stage=stage.name))

    def ask(state: State) -> str | None:
        return None if stop is None else stop(replace(state, stage=stage.name))

    return Listeners(tell, ask)


def _together(model: Model, procedure: Stages, found: Sequence[Solution]) -> Solution:
    """One solution of those of the stages; the first state of each but the first is the last of the former."""
    states: list[State] = []
    limits = []
    for stage, solution in zip(procedure.stages, found, strict=False):
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
        status=_status(found),
        message=" ".join(f"{s.name}: {each.message}" for s, each in zip(procedure.stages, found, strict=False)),
        advice=" ".join(_once(each.advice for each in found if each.advice)),
        steps=tuple(step for each in found for step in each.steps),
        findings=tuple(_once(finding for each in found for finding in each.findings)),
        timing=_sum([each.timing for each in found]),
        limit_points=tuple(limits),
    )


def _placed(state: State, stage: Stage, passed: float) -> State:
    """A state with its stage, and its time counted from the first stage that knows one."""
    return replace(state, stage=stage.name, time=None if state.time is None else passed + state.time)


def _status(found: Sequence[Solution]) -> Status:
    if not found[-1].complete or all(each.converged for each in found):
        return found[-1].status
    return Status.FOLLOWED


def _once(values: Iterable[T]) -> list[T]:
    return list(dict.fromkeys(values))


def _sum(timings: Sequence[Timing]) -> Timing:
    values: dict[str, Any] = {}
    for field in fields(Timing):
        each = [getattr(timing, field.name) for timing in timings]
        values[field.name] = each[-1] if isinstance(each[-1], str) else sum(each)
    return Timing(**values)
