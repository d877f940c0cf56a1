"""Given: what a caller may give to a public class or function, and the sentence for anything else.

Numbers are in SI units; a text with a unit says the same. Where several things are taken, one of them needs no list.
"""

from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import isfinite
from numbers import Real
from types import UnionType
from typing import Any, TypeAlias

import numpy as np

from turgor.foundation.display import LONGEST_TEXT
from turgor.foundation.errors import TurgorError
from turgor.units import EXAMPLES, UNITS, parse_quantity

#: A number in SI units, or a text with a unit such as ``"60 kPa"``.
Quantity: TypeAlias = float | str

#: Three of them.
Quantities: TypeAlias = Sequence[Quantity]


def number(value: object, what: str, dimension: str = "", *, finite: bool = True) -> float:
    """Return a number that was given, as a float in SI units.

    Parameters
    ----------
    value : float or str
        A number, or a text with a unit where there is a dimension.
    what : str
        What it is, for the message.
    dimension : str
        One of the keys of `turgor.units.UNITS`; empty for a pure number.
    finite : bool
        Whether it must be finite.

    Raises
    ------
    TurgorError
        For anything else: an array, a complex number, a truth value, a text without a unit.

    Examples
    --------
    >>> number("5 kPa", "pressure on 'cavity'", "pressure"), number(2, "history")
    (5000.0, 2.0)
    >>> number([1, 2], "pressure on 'cavity'", "pressure")
    Traceback (most recent call last):
    turgor.TurgorError: pressure on 'cavity' is [1, 2]; a finite number in Pa is needed, or a text with its \
unit such as '60 kPa'.
    """
    if isinstance(value, str) and dimension:
        try:
            return parse_quantity(value, dimension)
        except TurgorError as error:
            raise TurgorError(f"{what}: {error}") from None
    plain: Any = value.item() if isinstance(value, np.ndarray) and value.ndim == 0 else value
    if isinstance(plain, bool) or not isinstance(plain, Real) or (finite and not isfinite(plain)):
        unit = f" in {next(iter(UNITS[dimension]))}" if dimension else ""
        text = f", or a text with its unit such as '{EXAMPLES[dimension]}'" if dimension in EXAMPLES else ""
        raise TurgorError(f"{what} is {shown(value)}; a {'finite ' if finite else ''}number{unit} is needed{text}.")
    return float(plain)


def vector(values: object, what: str, dimension: str = "") -> tuple[float, float, float]:
    """Return three numbers that were given, each as `number` takes them.

    Examples
    --------
    >>> vector((0, "2 N", 0), "force on 'tip'", "force")
    (0.0, 2.0, 0.0)
    """
    if isinstance(values, str) or not isinstance(values, Iterable) or len(parts := list(values)) != 3:
        raise TurgorError(f"{what} is {shown(values)}; three numbers are needed.")
    x, y, z = (number(value, what, dimension) for value in parts)
    return x, y, z


def name(value: object, what: str, example: str) -> str:
    """Return a name that was given.

    Examples
    --------
    >>> name(3, "face of a pressure", "cavity")
    Traceback (most recent call last):
    turgor.TurgorError: face of a pressure is 3; a name is needed, such as 'cavity'.
    """
    if not isinstance(value, str):
        raise TurgorError(f"{what} is {shown(value)}; a name is needed, such as '{example}'.")
    return value


def one(value: object, kind: type | UnionType | tuple[type, ...], what: str, needed: str) -> Any:
    """Return a value of a kind.

    Parameters
    ----------
    value : object
    kind : type
        What it has to be.
    what : str
        What it is, for the message.
    needed : str
        What is needed, the rest of the sentence.

    Examples
    --------
    >>> one(3, str, "model", "a Model is needed, as tg.Model(...) makes it")
    Traceback (most recent call last):
    turgor.TurgorError: model is 3; a Model is needed, as tg.Model(...) makes it.
    """
    if not isinstance(value, kind):
        raise TurgorError(f"{what} is {shown(value)}; {needed}.")
    return value


def several(value: object, kind: type | UnionType | tuple[type, ...], what: str, needed: str) -> tuple[Any, ...]:
    """Return several values of a kind; one alone stands for a list of one.

    Parameters
    ----------
    value : object or iterable of objects
    kind, what, needed
        As those of `one`.

    Examples
    --------
    >>> several(2, int, "counts", "numbers are needed")
    (2,)
    >>> several([2, "x"], int, "counts", "numbers are needed")
    Traceback (most recent call last):
    turgor.TurgorError: 'x' stands in counts; numbers are needed.
    """
    if isinstance(value, kind):
        return (value,)
    if isinstance(value, str) or not isinstance(value, Iterable):
        raise TurgorError(f"{what} is {shown(value)}; {needed}.")
    items = tuple(value)
    for each in items:
        if not isinstance(each, kind):
            raise TurgorError(f"{shown(each)} stands in {what}; {needed}.")
    return items


def shown(value: object) -> str:
    """Write what was given in a few letters.

    Examples
    --------
    >>> shown("x"), shown(np.ones(3)), shown(str), shown(TurgorError("no"))
    ("'x'", 'an array of shape (3,)', 'the class str', 'a TurgorError')
    """
    if isinstance(value, np.ndarray):
        return f"an array of shape {value.shape}"
    if isinstance(value, type):
        return f"the class {value.__name__}"
    if value is None or isinstance(value, str | bool | Real | complex | list | tuple | dict):
        text = repr(value)
        return text if len(text) <= LONGEST_TEXT else f"{text[:LONGEST_TEXT]}…"
    kind = type(value).__name__
    return f"{'an' if kind[0] in 'AEIOU' else 'a'} {kind}"


def checked_guides(through: Sequence[Quantities], subject: str) -> tuple[tuple[float, float, float], ...]:
    """Return points in SI units that a cable runs through.

    Raises
    ------
    TurgorError
        If there are fewer than two, or two neighbors coincide.
    """
    points = tuple(vector(point, f"{subject}: point {i + 1} of through", "length") for i, point in enumerate(through))
    if len(points) < 2:
        raise TurgorError(f"{subject}: through has {len(points)} points; at least two are needed.")
    for i, (one, two) in enumerate(pairwise(points)):
        if np.allclose(one, two, rtol=0, atol=1e-9):
            raise TurgorError(f"{subject}: points {i + 1} and {i + 2} of through coincide; leave one out.")
    return points
