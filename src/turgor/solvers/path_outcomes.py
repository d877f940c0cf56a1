"""Outcomes of procedures that go past limit points: message and advice, and findings about these points."""

from collections.abc import Sequence

from turgor.finding import Finding, Severity
from turgor.solvers.outcome import Outcome
from turgor.solvers.path_procedures import Auto
from turgor.solvers.pressures import pressure_text
from turgor.solvers.solution import LimitPoint, Procedure, State, Status, Step
from turgor.units import kPa, mL

#: Limit points that a sentence names; the rest is in ``solution.limit_points``.
NAMED = 4


def reached(states: Sequence[State], steps: Sequence[Step], limits: Sequence[LimitPoint]) -> Outcome:
    """All that was asked for was injected, pumped in or applied."""
    message = f"Reached {_where(states[-1])}{_effort(states, steps)}.{_turns(limits)}"
    unstable = next((state for state in states if state.unstable_modes), None)
    if unstable is None or not unstable.driven:  # at given loads a falling branch is unstable, which was said
        return Outcome(Status.CONVERGED, message)
    return Outcome(
        Status.CONVERGED,
        f"{message} From {_where(unstable)} on the equilibrium is unstable even so "
        f"({unstable.unstable_modes} negative modes): a real actuator would leave it.",
        "Treat what follows with care: the actuator may buckle, bulge on one side or jump.",
    )


def followed(states: Sequence[State], steps: Sequence[Step], limits: Sequence[LimitPoint], why: str) -> Outcome:
    """The path was followed as far as asked, and the load factor did not come back to 1."""
    return Outcome(
        Status.FOLLOWED,
        f"Followed the path to {_where(states[-1])}{_effort(states, steps)}: {why}.{_turns(limits)}",
        "The full load is not on the path so far; follow it farther, or ask for less.",
    )


def limit_point_findings(limits: Sequence[LimitPoint], procedure: Procedure) -> tuple[Finding, ...]:
    """Say where the pressure turned (L03): under that pressure the actuator would jump."""
    if not limits:
        return ()
    severity = Severity.WARNING if isinstance(procedure, Auto) else Severity.NOTE
    return (
        Finding(
            code="L03",
            severity=severity,
            message=f"The path goes through {len(limits)} limit point{'s' if len(limits) > 1 else ''}: "
            f"{', '.join(map(_turn, limits[:NAMED]))}{' …' if len(limits) > NAMED else ''}.",
            advice="A source of pressure would make the actuator jump at a maximum; states on a falling branch can be "
            "held only by a volume or an amount of gas that is given.",
        ),
    )


def _turns(limits: Sequence[LimitPoint]) -> str:
    if not limits:
        return ""
    return f" Limit points: {', '.join(map(_turn, limits[:NAMED]))}{' …' if len(limits) > NAMED else ''}."


def _turn(limit: LimitPoint) -> str:
    where = f" in {limit.face}" if limit.face not in ("", "cavity") else ""
    if limit.pressure == limit.pressure:  # a number
        return f"{limit.kind} of {limit.pressure / kPa:.5g} kPa{where} (load factor {limit.load_factor:.4g})"
    return f"{limit.kind} of the load at load factor {limit.load_factor:.5g}"


def _where(state: State) -> str:
    driven = state.driven
    said = []
    if "injected_volume" in driven:
        said.append(f"an injected volume of {driven['injected_volume'] / mL:.4g} mL")
    elif "gas_mass_ratio" in driven:
        said.append(f"{driven['gas_mass_ratio']:.4g} times the gas")
    pressures = pressure_text(state)
    said += [pressures] if pressures else []
    return (
        f"{' at '.join(said)} (load factor {state.load_factor:.4g})" if said else f"load factor {state.load_factor:.4g}"
    )


def _effort(states: Sequence[State], steps: Sequence[Step]) -> str:
    iterations, cut = sum(step.iterations for step in steps), sum(not step.accepted for step in steps)
    return f" in {len(states) - 1} states and {iterations} iterations{f', {cut} steps cut back' if cut else ''}"
