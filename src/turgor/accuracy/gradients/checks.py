"""Refusals: states whose derivative is not exact, each with a sentence that says why and what to do."""

from turgor.core.materials.material import Material
from turgor.core.results.measures.measure import Measure
from turgor.core.solvers.solution import Solution, State
from turgor.foundation.errors import TurgorError


def check_state(solution: Solution, number: int) -> State:
    """Return a state of a path, if its derivatives can be computed.

    Parameters
    ----------
    solution : Solution
    number : int
        Of the state, from the end where it is negative.

    Returns
    -------
    State

    Raises
    ------
    TurgorError
        If there is no such state, or it depends on all that was before.
    """
    count = len(solution.states)
    if not -count <= number < count:
        raise TurgorError(f"state is {number}; the path has the states 0 to {count - 1}, or -1 for the last one.")
    state = solution.states[number]
    reason = depends_on_history(solution, state)
    if reason:
        raise TurgorError(f"the gradient is not computed: {reason}.")
    if number % count in {point.state for point in solution.limit_points}:
        raise limit_point(state)
    return state


def depends_on_history(solution: Solution, state: State) -> str:
    """Say why a state depends on more than its own equations; empty where it does not.

    Parameters
    ----------
    solution : Solution
    state : State

    Returns
    -------
    str
    """
    procedures = solution.procedure.parts(state.stage)
    now = procedures[-1]
    reason = next((each.depends_on_path for each in procedures if each.depends_on_path), "")
    if reason:
        return f"{reason}; take Static"
    if now.no_gradient:
        return str(now.no_gradient)
    if now.duration is not None and any(m.viscoelasticity for m in _rubbers(state)):
        return (
            "the rubber relaxes during the procedure's duration, and every state depends on all before it; without a "
            "duration the relaxed rubber has a gradient"
        )
    if any(m.stress_softening for m in _rubbers(state)):
        return (
            "the rubber softens, and every state depends on the largest stretch before it; leave stress_softening out"
        )
    if any(m.permanent_set for m in _rubbers(state)):
        return "the rubber keeps a set, and every state depends on the stress before it; leave permanent_set out"
    if any(load.channel is not None for load in state.model.loads):
        return "liquid flows through a channel, and every state depends on all before it; leave the channel out"
    if has_friction(state):
        return "there is friction, and every state depends on all before it; set friction to 0"
    if state.model.bonds:
        bond = state.model.bonds[0].name
        return f"the bond '{bond}' is damaged, and every state depends on all before it; leave it out"
    path_dependent = next((load.path_dependent for load in state.model.loads if load.path_dependent), "")
    if path_dependent:
        return f"{path_dependent}, and with it every state, depends on all states before it"
    if len(procedures) > 1 and any(each.requested is not None for each in procedures):
        return "pressures were found in one stage and act in another; take one stage, or state the pressures"
    return ""


def has_friction(state: State) -> bool:
    """Whether friction may act anywhere.

    Parameters
    ----------
    state : State

    Returns
    -------
    bool
    """
    contact = state.model.contact
    frictions = [obstacle.friction for obstacle in contact.obstacles]
    if contact.self_contact is not None:
        frictions.append(contact.self_contact.friction)
    return any(frictions)


def check_alone(measure: Measure) -> None:
    """Refuse a measure that is a sum along a path.

    Parameters
    ----------
    measure : Measure

    Raises
    ------
    TurgorError
    """
    if measure.along is not None:
        raise TurgorError(
            f"measure '{measure.name}' is a sum along the path, which a gradient at one state does not know; "
            "take measures of a state."
        )


def limit_point(state: State) -> TurgorError:
    """Make the error for a state at which the tangent is singular.

    Parameters
    ----------
    state : State

    Returns
    -------
    TurgorError
    """
    return TurgorError(
        f"the equilibrium at load factor {state.load_factor:.4g} could not be differentiated: the tangent is singular "
        "or nearly so there, as at a limit point, where measures change infinitely fast with the load; take a state "
        "away from it, or drive by VolumeControl."
    )


def _rubbers(state: State) -> list[Material]:
    return list(state.model.region_materials.values())
