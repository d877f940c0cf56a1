"""Load control: follow the path of `Static`, with pseudo-transient continuation where no step succeeds."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from math import inf
from time import perf_counter

import numpy as np

from turgor.core.engine.system import Evaluation
from turgor.core.model.drive import kinks
from turgor.core.solvers.checks.distortion import distortion_text
from turgor.core.solvers.constraints.clock import Clock
from turgor.core.solvers.constraints.loads import load_control
from turgor.core.solvers.continuation.path_follower import follow, noted
from turgor.core.solvers.continuation.path_points import nothing, plain_point, settings_of
from turgor.core.solvers.continuation.path_run import Ending, Judgment, Point, Rescue, Run, StepMemory, Task, Turn
from turgor.core.solvers.continuation.predictor import BY_LOAD, gentle_share, predicted
from turgor.core.solvers.continuation.settings import LOAD_CONTROL
from turgor.core.solvers.continuation.step_acceptance import turns_aside, why_rejected
from turgor.core.solvers.continuation.step_control import StepControl, in_vain
from turgor.core.solvers.continuation.tangent_response import others_move, rate_at, response_in_step
from turgor.core.solvers.guide import Guide
from turgor.core.solvers.newton.line_search import evaluate
from turgor.core.solvers.newton.newton_values import NewtonResult, Start
from turgor.core.solvers.newton.pseudo_transient import pseudo_transient
from turgor.core.solvers.outcomes import Outcome, converged, stuck
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.step_options import StepOptions
from turgor.core.solvers.restart import unknowns_of
from turgor.core.solvers.solution import State, Status
from turgor.core.solvers.step_reasons import Cause, Reason


def follow_load(problem: Problem, procedure: StepOptions) -> Outcome:
    """Step from load factor 0 to 1; the path so far is in the lists of the problem whatever happens."""
    return follow(load_run(problem, procedure, patient=True))


def load_run(
    problem: Problem,
    procedure: StepOptions,
    patient: bool,
    stop: Callable[[State], str | None] | None = None,
    history: list[Point] | None = None,
) -> Run:
    """Make a run of load control from the start of a problem.

    Parameters
    ----------
    problem : Problem
    procedure : StepOptions
    patient : bool
        Whether pseudo-transient continuation may help where Newton's method finds nothing.
    stop : callable, optional
        Called instead of the listener of the problem.
    history : list of Point, optional
        Filled with the last points.
    """
    system, turns = problem.system, kinks(problem.system.model)
    guide = problem.guide
    if stop is not None:
        problem = replace(problem, listeners=replace(problem.listeners, stop=stop))
    task = Task(
        problem=problem,
        procedure=procedure,
        strategy=LoadStrategy(patient, guide),
        settings=replace(settings_of(procedure), recount=True),
        driven=nothing,
        finished=_full_load,
        kinks=turns,
    )
    now = problem.load_factor
    constraint = load_control(system, Clock(procedure.duration, now), problem.history)
    run = Run(
        task,
        constraint,
        StepControl.of(_stepped(procedure, guide), turns, system.model.sheets_wrinkle),
        history=[] if history is None else history,
    )
    rest = system.evaluate(unknowns_of(system, problem.start), now, history=problem.history)
    assert rest is not None
    run.history.append(plain_point(run, rest, (now, np.empty(0)), None))
    if not problem.goes_on:
        run.states.append(run.history[-1].state)
    goes_on = problem.record is not None and problem.record.goes_on  # its checkpoint has the rate
    # loads that grow in proportion: all say how the first ones do
    if guide is None and run.stepping.length >= LOAD_CONTROL.long_first_step and not turns and not goes_on:
        run.memory = StepMemory(rate=rate_at(system, problem.tangent, rest)[0])
    return run


def _full_load(before: Point, now: Point, run: Run) -> Ending | None:
    """All of the load acts."""
    if now.parameter < 1.0:
        return None
    return Ending(now.state, _reached)


def _reached(run: Run) -> Outcome:
    """Outcome of a run with the full load, and the load factor from which on no guide was used."""
    outcome = converged(run.task.system.model, run.states, run.steps)
    if run.memory.guided_until is None:
        return outcome
    until = run.memory.guided_until
    without = f" From load factor {until:.3g} on the guide predicted wrongly; steps went on without it."
    return replace(outcome, message=outcome.message + without)


def _stepped(procedure: StepOptions, guide: Guide | None) -> StepOptions:
    """A procedure whose first step is as long as all others, with a guide."""
    return procedure if guide is None else replace(procedure, first_step=procedure.max_step)


@dataclass(frozen=True, slots=True, eq=False)
class LoadStrategy:
    """Strategy of load control.

    Parameters
    ----------
    patient : bool
        Whether pseudo-transient continuation may help.
    guide : Guide or None
        The path of a similar model.
    """

    patient: bool
    guide: Guide | None = None

    def next_parameter(self, run: Run) -> float:
        """The parameter to try next: supports move nearly straight on the way, and walls meet gently at its end."""
        now = run.history[-1].parameter
        load = run.stepping.next_load(now)
        if self.guide is not None and self._guides(run, load):
            load = self.guide.next_load(now, load)
        while load - now > run.stepping.min_step and turns_aside(run.task.system, now, load):
            load = now + 0.5 * (load - now)
        if run.task.tangent.plain or self._guides(run, load):
            return load
        gently = now + gentle_share(run.task.system, run.history, load) * (load - now)
        return min(load, max(gently, now + run.stepping.min_step))

    def predict(self, run: Run, parameter: float) -> Start:
        """Extrapolate, compared by the relative residual."""
        last = run.history[-1]
        if run.task.tangent.plain:
            return Start(last.unknowns, last.stresses)
        guided = self._guided(run, parameter) if self._guides(run, parameter) else None
        if guided is not None:
            return Start(guided.unknowns, run.task.system.stresses(guided), evaluation=guided)
        start = predicted(run.constraint, run.task.tangent, run.history, parameter, BY_LOAD)
        at_rest = len(run.states) == 1 and run.task.tangent.has_factors_of(last.unknowns)
        return replace(start, fresh=not at_rest)

    def _guides(self, run: Run, load: float) -> bool:
        """Whether the guide reaches a load."""
        return self.guide is not None and run.memory.guided_until is None and self.guide.leads_to(load)

    def _guided(self, run: Run, parameter: float) -> Evaluation | None:
        """The last state moved on as the guide moves; None where that turns a cell inside out."""
        assert self.guide is not None
        last, prescribed = run.history[-1], run.task.system.prescribed
        unknowns = last.unknowns + self.guide.at(parameter) - self.guide.at(last.parameter)
        unknowns[prescribed] = last.unknowns[prescribed]
        return evaluate(run.constraint, run.task.tangent, (unknowns, last.scalars), parameter)

    def _rejected(self, run: Run, result: NewtonResult) -> StepMemory:
        """What the next attempt takes from one that did not converge; no guide after it has failed too often."""
        memory = replace(run.memory, lost_stability=run.memory.lost_stability or bool(result.unstable_modes))
        if self.guide is None or memory.guided_until is not None:
            return memory
        failed = memory.failed_guides + 1
        return replace(
            memory,
            failed_guides=failed,
            guided_until=run.history[-1].parameter if self.guide.misleads(failed) else None,
        )

    def judge(self, run: Run, result: NewtonResult, parameter: float) -> Judgment:
        """Reject a state that may lie on another path, unless the step cannot be shorter."""
        system, now, why, rate, change = run.task.system, run.history[-1].parameter, None, inf, None
        if result.converged and result.evaluation is not None:
            change = response_in_step(run.constraint, run.task.tangent, result.evaluation, now)
            if change is not None and not others_move(system, now, parameter):
                rate = float(np.linalg.norm(change[system.moving]))
            if run.stepping.failed(parameter - now) is not None:
                why = why_rejected(system, run.states, run.history, result, (run.memory.rate, rate))
        if not result.converged or result.evaluation is None or why is not None:
            return Judgment(None, result.reason or why, memory=self._rejected(run, result))
        point = plain_point(run, result.evaluation, (parameter, result.scalars), result.unstable_modes)
        memory = replace(run.memory, lost_stability=False, rate=rate)
        return Judgment(replace(point, change=change), result.reason, memory=memory)

    def rescue(self, run: Run) -> Rescue:
        """Try pseudo-transient continuation where no step succeeds; say how the run ends if that fails too."""
        model, memory = run.task.system.model, run.memory
        ending = stuck(model, run.states, run.steps, memory.lost_stability)
        if not self._may_relax(run, ending):
            return Rescue(None, ending, memory)
        point = _pseudo_transient(run, _reach(run))
        if point is not None:
            return Rescue(point, None, replace(memory, rate=inf))
        if in_vain(run.steps):
            ending = stuck(model, run.states, run.steps, memory.lost_stability)
        return Rescue(None, ending, memory)

    def _may_relax(self, run: Run, ending: Outcome) -> bool:
        """Whether pseudo-transient continuation may find what no step finds."""
        if in_vain(run.steps):
            return False
        if not self.patient and len(run.states) > 1:  # at rest a film is slack
            return False
        # where sheets wrinkle, the tangent may lose stability for a moment
        if ending.status is not Status.STEP_TOO_SMALL and not run.task.system.model.sheets_wrinkle:
            return False
        return not distortion_text(run.states[-1])  # where a cell has collapsed, nothing beyond it is of the body

    def accepted(self, run: Run, now: Point) -> StepControl:
        """Take long steps again after steps that were cut only to locate the loss of stability."""
        lost = now.state.unstable_modes and not run.states[-2].unstable_modes
        return run.stepping.resumed(run.task.procedure.first_step) if lost else run.stepping

    def turn(self, run: Run, now: Point) -> Turn:
        """Discard the former states, which do not predict the path beyond a kink."""
        stepping = run.stepping.turned(run.task.procedure.first_step)
        return Turn((run.history[-1],), run.constraint, stepping, replace(run.memory, rate=inf))


def _pseudo_transient(run: Run, load: float) -> tuple[Point, NewtonResult] | None:
    """Find the point at a load against viscous forces; None where that fails or the point is in doubt."""
    task, system, last = run.task, run.task.system, run.history[-1]
    began = perf_counter()
    run.constraint = run.constraint.begun(load)
    report = task.problem.listeners.reporter(len(run.steps) + 1, load)
    result = pseudo_transient(run.constraint, task.tangent, last.unknowns, load, task.settings, report)
    why = why_rejected(system, run.states, run.history, result) if result.converged else None
    slack = len(run.states) == 1 and system.model.sheets_wrinkle  # folds of a film at rest may be unstable
    folds = slack and why is not None and why.cause is Cause.STABILITY_LOST
    alone = not len(system.cells)  # a film without a solid snaps from fold to fold, and has one shape for each load
    accepted = result.converged and (why is None or folds or alone)
    how = Reason(Cause.PSEUDO_TRANSIENT) if accepted else result.reason or why
    noted(run, result, (load, perf_counter() - began), Judgment(last if accepted else None, how))
    if not accepted or result.evaluation is None:
        return None
    return plain_point(run, result.evaluation, (load, result.scalars), result.unstable_modes), result


def _reach(run: Run) -> float:
    """Load factor for pseudo-transient continuation: as far as the steps that were taken before they were cut."""
    factors = [point.parameter for point in run.history]
    taken = max((b - a for a, b in pairwise(factors)), default=LOAD_CONTROL.reach)
    now = factors[-1]
    return min(
        now + min(taken, LOAD_CONTROL.reach),
        *(target for target in run.stepping.targets if target > now),
    )
