"""Histories in words."""

from turgor.core.model.history import CONSTANT, RAMP, History


def history_text(history: History) -> str:
    """Return a history in words.

    Examples
    --------
    >>> history_text(((0, 0), (0.5, 1), (1, 0.2)))
    '0 at 0, 1 at 0.5, 0.2 at 1'
    """
    return history if isinstance(history, str) else ", ".join(f"{share:g} at {factor:g}" for factor, share in history)


def shares_text(history: History) -> str:
    """Return how a load gets to its last value, as the end of a sentence; empty if it just grows.

    Examples
    --------
    >>> shares_text("constant"), shares_text(CONSTANT)
    (', its share over the load factor: constant', ', from the start')
    """
    if history == CONSTANT:
        return ", from the start"
    return "" if history == RAMP else f", its share over the load factor: {history_text(history)}"
