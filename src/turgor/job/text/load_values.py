"""Values of loads in a job file: histories, and vectors with a unit."""

from functools import partial
from typing import Annotated, Any, Protocol

from pydantic import BeforeValidator

from turgor.core.model.history import RAMP, History, over_time
from turgor.foundation.errors import TurgorError
from turgor.job.text.quantities import Says, shown
from turgor.units import EXAMPLES, parse_quantity

Vector = tuple[float, float, float]

#: What ``history`` and ``history_over_time`` mean, in the reference of job files.
SHARES = (
    "Share of the load over the load factor: points [load factor, share] with straight lines between them, or an "
    'expression in s, or "constant" for a load that is there from the start. By default it rises with the load factor.'
)
OVER_TIME = "The same over time in seconds, where the procedure has a duration."


def _history(value: object) -> object:
    """Points or an expression of a history; `turgor.core.model.loads` checks them."""
    if not isinstance(value, str | list):
        raise TurgorError(f"{shown(value)} is not a list in square brackets, nor an expression in quotes.")
    return value


Points = Annotated[
    Any, BeforeValidator(_history), Says("list of points or expression in quotes", "[[0, 0], [0.5, 1], [1, 0]]")
]


class Timed(Protocol):
    """A table with a history."""

    @property
    def history(self) -> Any:
        """Over the load factor."""

    @property
    def history_over_time(self) -> Any:
        """Over the time."""


def history_of(table: Timed, what: str, duration: float | None, usual: History = RAMP) -> Any:
    """Return the history of a table, over the load factor or, with a duration, over the time; ``usual`` by default."""
    if table.history_over_time is None:
        return usual if table.history is None else table.history
    if table.history is not None:
        raise TurgorError(f"{what}: history and history_over_time are both given; one says it.")
    if duration is None:
        raise TurgorError(f"{what}: history_over_time needs a procedure with a duration; give history instead.")
    return over_time(table.history_over_time, duration)


def history_values(history: History, usual: History = RAMP) -> dict[str, Any]:
    """Write a history as a key of a table, without the default.

    Examples
    --------
    >>> history_values(((0, 0), (1, 0.5))), history_values(RAMP)
    ({'history': [[0, 0], [1, 0.5]]}, {})
    """
    if history == usual:
        return {}
    return {"history": history if isinstance(history, str) else [list(point) for point in history]}


def three(dimension: str, example: str = "") -> BeforeValidator:
    """Return what reads three quantities along x, y and z, from a list in which a zero needs no unit.

    Parameters
    ----------
    dimension : str
        One of `turgor.units.UNITS`.
    example : str
        In TOML.
    """
    form = says_three(dimension, example)
    return BeforeValidator(partial(_three, dimension=dimension, words=form.words, example=form.example))


def says_three(dimension: str, example: str = "") -> Says:
    """Return the words for three quantities; arguments as of `three`.

    Examples
    --------
    >>> says_three("force per length").words, says_three("moment").example
    ('three forces per length', '[0, 0, "20 N mm"]')
    """
    head, per, tail = dimension.partition(" per ")
    words = f"three {head}{'es' if head.endswith('s') else 's'}{per}{tail}"
    return Says(words, example or f'[0, 0, "{EXAMPLES[dimension]}"]', dimension)


def _three(value: object, dimension: str, words: str, example: str) -> Vector:
    if not isinstance(value, list) or len(value) != 3:
        such = example.replace('"', "'")
        raise TurgorError(f"{shown(value)} is not {words} along x, y and z, such as {such}.")
    x, y, z = (0.0 if part == 0 and not isinstance(part, bool) else parse_quantity(part, dimension) for part in value)
    return x, y, z
