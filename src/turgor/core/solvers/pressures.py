"""Pressures of a state: what acts in each cavity, as numbers and in words."""

from turgor.core.model.drive import drive_text, pressures_at
from turgor.core.solvers.solution import State
from turgor.units import kPa


def pressures_of(state: State) -> dict[str, float]:
    """Return the gauge pressure on every pressed face and in every cavity of a state [Pa].

    Parameters
    ----------
    state : State

    Returns
    -------
    dict of str to float [Pa]
        Those of the state; zero in a cavity that nothing presses.
    """
    return {**pressures_at(state.model, state.load_factor), **state.pressures}


def stated_by_loads(state: State) -> bool:
    """Return whether loads of the model give the pressures of a state, so that its procedure found none of them.

    Parameters
    ----------
    state : State

    Returns
    -------
    bool
        True where nothing presses.
    """
    if not state.pressures:
        return True
    return bool(state.model.pressures) and state.pressures == pressures_at(state.model, state.load_factor)


def pressure_text(state: State, digits: int = 4) -> str:
    """Write the pressures of a state for a person: ``"20 kPa"``, or each with its face where there are several.

    Parameters
    ----------
    state : State
    digits : int
        Significant digits.

    Returns
    -------
    str
        Empty where no pressure acts.
    """
    if stated_by_loads(state):
        return drive_text(state.model, state.load_factor, digits)
    acting = pressures_of(state)
    if len(acting) == 1:
        return f"{next(iter(acting.values())) / kPa:.{digits}g} kPa"
    return ", ".join(f"{face} {pressure / kPa:.{digits}g} kPa" for face, pressure in acting.items())
