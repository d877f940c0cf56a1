"""Pressures of a state: what acts in each cavity, as numbers and in words."""

from turgor.model.drive import drive_text, pressures_at
from turgor.solvers.solution import State
from turgor.units import kPa


def pressures_of(state: State) -> dict[str, float]:
    """Return the gauge pressure on every pressed face and in every cavity of a state [Pa].

    Parameters
    ----------
    state : State

    Returns
    -------
    dict of str to float [Pa]
        Those that the procedure found, and those that the loads state at the load factor.
    """
    return {**pressures_at(state.model, state.load_factor), **state.pressures}


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
    if not state.pressures:
        return drive_text(state.model, state.load_factor, digits)
    acting = pressures_of(state)
    if len(acting) == 1:
        return f"{next(iter(acting.values())) / kPa:.{digits}g} kPa"
    return ", ".join(f"{face} {pressure / kPa:.{digits}g} kPa" for face, pressure in acting.items())
