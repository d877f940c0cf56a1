"""Outcomes of procedures that go past limit points: message and advice, and findings about these points."""

from collections.abc import Sequence

from turgor.core.solvers.checks.causes import cause_in, cause_text, turned_law, wrinkled_film
from turgor.core.solvers.checks.distortion import distortion_text
from turgor.core.solvers.continuation.path_run import Bifurcation, Run
from turgor.core.solvers.outcomes import Outcome, stuck
from turgor.core.solvers.pressures import pressure_text
from turgor.core.solvers.solution import LimitPoint, State, Status, Step
from turgor.core.solvers.step_reasons import Cause
from turgor.foundation.finding import Finding, Severity
from turgor.units import kPa

#: Limit points that a sentence names; the rest is in ``solution.limit_points``.
NAMED = 4

#: Advice where a path has branches.
BEND_IT = (
    "A real body takes the branch that its imperfections lead to: follow it with branch = 1 of arc_length, or give the "
    "mesh an imperfection."
)


def reached(run: Run, bifurcations: Sequence[Bifurcation] = ()) -> Outcome:
    """All that was requested was injected, pumped in or applied."""
    states = run.states
    message = (
        f"Reached {_where(run, states[-1])}{_effort(states, run.steps)}.{_turns(run.limits)}{_branches(bifurcations)}"
    )
    unstable = next((state for state in states if state.unstable_modes), None)
    if unstable is None or not unstable.driven:  # at given loads a falling branch is unstable, which was reported
        return Outcome(Status.CONVERGED, message, BEND_IT if bifurcations else "")
    return Outcome(
        Status.CONVERGED,
        f"{message} From {_where(run, unstable)} on the equilibrium is unstable even so "
        f"({unstable.unstable_modes} negative modes): a real actuator would leave it.",
        "Treat what follows with care: the actuator may buckle, bulge on one side or jump.",
    )


def followed(run: Run, why: str) -> Outcome:
    """The path was followed as far as requested, and the load factor did not reach 1 again."""
    bend_it = f" {BEND_IT}" if run.bifurcations else ""
    return Outcome(
        Status.FOLLOWED,
        f"Followed the path to {_where(run, run.states[-1])}{_effort(run.states, run.steps)}: {why}."
        f"{_turns(run.limits)}{_branches(run.bifurcations)}{distortion_text(run.states[-1])}",
        f"The full load is not on the path so far; follow it farther, or request less.{bend_it}",
    )


def lost_path(run: Run) -> Outcome:
    """No arc is short enough to go on along the same path."""
    last, step = run.states[-1], run.steps[-1]
    if step.cause is Cause.ROUND_OFF:
        return stuck(run.task.system.model, run.states, run.steps, False)
    why = cause_in(last)
    return Outcome(
        Status.TURNED_BACK if step.cause is Cause.OTHER_BRANCH else Status.STEP_TOO_SMALL,
        f"The path could not be followed beyond {_where(run, last)}{_effort(run.states, run.steps)}: "
        f"{step.reason}, down to steps of {step.increment:.2g}."
        f"{_turns(run.limits)}{_branches(run.bifurcations)}{cause_text(why) or distortion_text(last)}",
        "The path up to there stands. Look at the last state for a badly distorted cell or walls that met, and refine "
        "the mesh there; or try a smaller min_step."
        if why is None
        else f"The path up to there stands. {why.advice}",
    )


def turned_back(run: Run) -> Outcome:
    """The load fell, and the body went back the way it came."""
    top = max(run.states, key=lambda state: state.load_factor)
    why = turned_law(top) or wrinkled_film(top)
    return Outcome(
        Status.TURNED_BACK,
        f"The path turned at {_where(run, top)} and goes back the way it came, down to "
        f"{_where(run, run.states[-1])} so far"
        f"{_effort(run.states, run.steps)}: a few cells give way there, and the rest of the body is unloaded."
        f"{_branches(run.bifurcations)}{cause_text(why) or distortion_text(run.states[-1])}",
        "Take the path up to the turn; what comes after it depends on the mesh. Refine the mesh where cells are "
        "squeezed, and see up to which stretch the law is stable (first_instability)."
        if why is None
        else f"Take the path up to the turn. {why.advice}",
    )


def limit_point_findings(limits: Sequence[LimitPoint], severity: Severity) -> tuple[Finding, ...]:
    """Say where the pressure turned (L03): under that pressure the actuator would jump."""
    if not limits:
        return ()
    return (
        Finding(
            code="L03",
            severity=severity,
            message=f"The path goes through {len(limits)} limit point{'s' if len(limits) > 1 else ''}: "
            f"{', '.join(map(_turn, limits[:NAMED]))}{' …' if len(limits) > NAMED else ''}.",
            advice="A source of pressure would make the actuator jump at a maximum; states on a falling branch can be "
            "reached only with a given volume or amount of gas.",
        ),
    )


def unwatched_stability(iterative: bool, unknowns: int) -> tuple[Finding, ...]:
    """Say that unstable modes were not counted (L09), because nothing was factored.

    Parameters
    ----------
    iterative : bool
        Whether solutions were iterated to the end.
    unknowns : int

    Returns
    -------
    tuple of Finding
    """
    if not iterative:
        return ()
    return (
        Finding(
            code="L09",
            severity=Severity.NOTE,
            message=f"Stability was not watched: the {unknowns:,} unknowns were solved for by iteration, without the "
            "factors whose signs tell unstable states.",
            advice="Where the actuator may buckle or jump, watch that on a coarser mesh, or solve with a direct "
            "solver (in Python), which takes several times the memory.",
        ),
    )


def _turns(limits: Sequence[LimitPoint]) -> str:
    if not limits:
        return ""
    return f" Limit points: {', '.join(map(_turn, limits[:NAMED]))}{' …' if len(limits) > NAMED else ''}."


def _branches(bifurcations: Sequence[Bifurcation]) -> str:
    """Where another path branches off: a bifurcation, not a limit point."""
    if not bifurcations:
        return ""
    named = ", ".join(map(_branch, bifurcations[:NAMED]))
    many = len(bifurcations) > 1
    return (
        f" Bifurcation{'s' if many else ''}: {named}{' …' if len(bifurcations) > NAMED else ''}; "
        f"{'others leave' if many else 'another path leaves'} this one there."
    )


def _branch(bifurcation: Bifurcation) -> str:
    count = abs(bifurcation.modes)
    modes = f"{count} mode{'s' if count != 1 else ''} {'become' if count != 1 else 'becomes'}"
    pressures = pressure_text(bifurcation.state)
    factor = f"load factor {bifurcation.load_factor:.4g}"
    return (
        f"at {f'{pressures} ({factor})' if pressures else factor}, where {modes} "
        f"{'unstable' if bifurcation.modes > 0 else 'stable again'}"
    )


def _turn(limit: LimitPoint) -> str:
    where = f" in {limit.face}" if limit.face not in ("", "cavity") else ""
    if limit.pressure == limit.pressure:  # a number
        return f"{limit.kind} of {limit.pressure / kPa:.5g} kPa{where} (load factor {limit.load_factor:.4g})"
    return f"{limit.kind} of the load at load factor {limit.load_factor:.5g}"


def _where(run: Run, state: State) -> str:
    driven = run.task.procedure.driven_text(state.driven, run.states[0].driven)
    words = [each for each in (driven, pressure_text(state)) if each]
    return (
        f"{' at '.join(words)} (load factor {state.load_factor:.4g})"
        if words
        else f"load factor {state.load_factor:.4g}"
    )


def _effort(states: Sequence[State], steps: Sequence[Step]) -> str:
    iterations, cut = sum(step.iterations for step in steps), sum(not step.accepted for step in steps)
    return f" in {len(states) - 1} states and {iterations} iterations{f', {cut} steps cut back' if cut else ''}"
