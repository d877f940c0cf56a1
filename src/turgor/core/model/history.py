"""Histories: which share of a load acts along the path, as points with straight lines between them or as an expression.

An expression is arithmetic in the load factor ``s`` with a few functions. It is read as a syntax tree in which nothing
but these is allowed, so that text from a job file cannot run anything else.
"""

import ast
import math
import operator
from bisect import bisect_right
from collections.abc import Callable, Iterable, Mapping
from copy import copy
from functools import lru_cache
from itertools import pairwise
from operator import itemgetter
from typing import Any

import numpy as np

from turgor.foundation.errors import TurgorError, near_match, unknown
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import plain_number

#: Points (load factor, share), or an expression of the load factor ``s``.
History = tuple[tuple[float, float], ...] | str

#: The history of a load that grows in proportion to the load factor.
RAMP: History = ((0.0, 0.0), (1.0, 1.0))

#: That of a load that is there from the start, and stays.
CONSTANT: History = ((0.0, 1.0), (1.0, 1.0))

#: Load factors at which an expression is looked at before it is used.
SAMPLES = 1001


FUNCTIONS: Mapping[str, Callable[..., float]] = {
    "sin": math.sin, "cos": math.cos, "tan": math.tan, "tanh": math.tanh, "exp": math.exp, "sqrt": math.sqrt,
    "abs": abs, "min": min, "max": max,
}  # fmt: skip

_OPERATORS: Mapping[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}


def checked(history: Any, what: str, largest: float = 1.0, *, starting: bool = False) -> History:
    """Return a history with its numbers as floats.

    Parameters
    ----------
    history : sequence of (float, float), or str
        Points (load factor, share) from (0, 0) to a load factor of 1, or an expression of ``s``.
    what : str
        Whose history it is, for the message.
    largest : float
        Largest share, in either direction.
    starting : bool
        Whether it may begin with a share, or be the word ``"constant"``: the load is there from the start.

    Raises
    ------
    TurgorError
        If it is no such history.

    Examples
    --------
    >>> checked([(0, 0), (1, 0.5)], "pressure")
    ((0.0, 0.0), (1.0, 0.5))
    >>> checked("sin(pi * s / 2)", "pressure")
    'sin(pi * s / 2)'
    >>> checked("sin(w * s)", "pressure")
    Traceback (most recent call last):
    turgor.TurgorError: pressure: history is 'sin(w * s)'; points (load factor, share) are needed, such as \
[[0, 0], [0.5, 1], [1, 0.5]], or an expression of the load factor s: unknown name 'w'. Known: pi, s.
    """
    subject = f"{what}: history is {history!r}"
    if starting and history == "constant":
        return CONSTANT
    if isinstance(history, str):
        return _checked_expression(history, subject, largest, starting)
    points = _points(history, subject, "load factor")
    if starting and points[0][0] != 0:
        raise TurgorError(f"{subject}; its first point must be at load factor 0.")
    if points[0] != (0.0, 0.0) and not starting:
        raise TurgorError(f"{subject}; it must begin with (0, 0), because the actuator starts without load.")
    if points[-1][0] != 1 or not all(a < b for (a, _), (b, _) in pairwise(points)):
        raise TurgorError(f"{subject}; the load factors must rise from 0 to 1.")
    if not all(-largest <= share <= largest for _, share in points):
        raise TurgorError(f"{subject}; shares of the load lie between {-largest:g} and {largest:g}.")
    return points


def share_at(history: History, load_factor: float) -> float:
    """Return the share of a load that acts at a load factor.

    Examples
    --------
    >>> share_at(((0, 0), (0.5, 1), (1, 0)), 0.75), share_at("s**2", 0.5)
    (0.5, 0.25)
    """
    if isinstance(history, str):
        share = _compiled(history)(load_factor)
        return share if abs(share) > ROUND_OFF.zero else 0.0
    if is_straight(history):  # also beyond: paths through limit points may overshoot 0 and 1
        (_, first), (_, last) = history
        return float(first + load_factor * (last - first))
    after = bisect_right(history, load_factor, key=itemgetter(0))  # measured histories have thousands of points
    if after in (0, len(history)):
        return float(history[min(after, len(history) - 1)][1])
    (begin, first), (end, last) = history[after - 1 : after + 1]
    return float((last - first) / (end - begin) * (load_factor - begin) + first)


def starts(history: History) -> bool:
    """Whether a load acts at load factor 0 already.

    Examples
    --------
    >>> starts(RAMP), starts(CONSTANT), starts("cos(s)")
    (False, True, True)
    """
    return abs(share_at(history, 0.0)) > 1e-9


def is_straight(history: History) -> bool:
    """Whether a share changes evenly with the load factor.

    Examples
    --------
    >>> is_straight(RAMP), is_straight(((0, 1), (1, 1))), is_straight(((0, 0), (0.5, 1), (1, 0))), is_straight("s")
    (True, True, False, False)
    """
    return not isinstance(history, str) and len(history) == 2


def turns_of(history: History) -> tuple[float, ...]:
    """Return the load factors between 0 and 1 at which a history has a point; an expression has none.

    Examples
    --------
    >>> turns_of(((0, 0), (0.5, 1), (1, 0)))
    (0.5,)
    """
    return () if isinstance(history, str) else tuple(factor for factor, _ in history if 0 < factor < 1)


def peak_of(history: History) -> float:
    """Return the load factor at which the share is largest in size.

    Examples
    --------
    >>> peak_of(((0, 0), (0.5, 1), (1, 0))), peak_of("sin(pi * s)")
    (0.5, 0.5)
    """
    if isinstance(history, str):
        shares = [abs(share_at(history, s)) for s in np.linspace(0.0, 1.0, SAMPLES)]
        return int(np.argmax(shares)) / (SAMPLES - 1)
    return max(history, key=lambda point: abs(point[1]))[0]


def points_of(history: History, count: int = 201) -> tuple[tuple[float, float], ...]:
    """Return the points of a history, of an expression that many of its values.

    Examples
    --------
    >>> points_of("s**2", 3)
    ((0.0, 0.0), (0.5, 0.25), (1.0, 1.0))
    """
    if isinstance(history, str):
        return tuple((float(s), share_at(history, s)) for s in np.linspace(0.0, 1.0, count))
    return history


def fading(share: float, new: History | None) -> History:
    """Return the history of a load that acts with a share at first, and stays or gives way to a new load.

    Parameters
    ----------
    share : float
    new : History or None
        That of the new load; None where the share stays.

    Examples
    --------
    >>> fading(0.5, None), fading(0.5, RAMP)
    (((0.0, 0.5), (1.0, 0.5)), ((0.0, 0.5), (1.0, 0.0)))
    """
    if new is None:
        return ((0.0, share), (1.0, share))
    if isinstance(new, str):
        return f"({share!r}) * (1 - ({new}))"
    return tuple((factor, share * (1 - replaced)) for factor, replaced in new)


def with_history(value: Any, history: History) -> Any:
    """Return a copy of a load or a support with a history that need not begin at zero, which users cannot state."""
    out = copy(value)
    object.__setattr__(out, "history", history)
    return out


def over_time(history: Iterable[tuple[float, float]] | str, duration: float) -> History:
    """Turn a history over time into one over the load factor, which in a dynamic run is time over duration.

    Parameters
    ----------
    history : sequence of (float, float), or str
        Points (time [s], share) from time 0 to the duration, or an expression of the time ``t`` in seconds.
    duration : float [s]
        The duration of the run.

    Returns
    -------
    tuple of (float, float), or str
        What a load takes as its history.

    Raises
    ------
    TurgorError
        If the duration is not positive, or it is neither points nor an expression.

    Examples
    --------
    >>> over_time([(0, 0), (0.1, 1), (2, 1)], 2.0)
    ((0.0, 0.0), (0.05, 1.0), (1.0, 1.0))
    >>> over_time("sin(2 * pi * t)", 0.5)
    'sin(2 * pi * (0.5 * s))'
    """
    if not 0 < duration < math.inf:
        raise TurgorError(f"duration is {duration:g} s; it must be more than 0.")
    if not isinstance(history, str):
        points = _points(history, f"history over time is {history!r}", "time in seconds")
        return tuple((time / duration, share) for time, share in points)
    tree = _parsed(history, f"history is {history!r}")

    class Scaled(ast.NodeTransformer):
        def visit_Name(self, node: ast.Name) -> ast.expr:
            if node.id == "t":
                return ast.parse(f"({duration!r} * s)", mode="eval").body
            return node

    try:
        return ast.unparse(Scaled().visit(tree))
    except RecursionError:
        raise TurgorError(f"history is {history!r}; this expression is too long.") from None


def _points(history: Any, subject: str, first: str) -> tuple[tuple[float, float], ...]:
    """Pairs of finite numbers, the first of each being a load factor or a time."""
    try:
        points = tuple((plain_number(at), plain_number(share)) for at, share in history)
    except (TypeError, ValueError):
        points = ()
    if not points or not all(math.isfinite(number) for point in points for number in point):
        raise TurgorError(f"{subject}; points ({first}, share) are needed, such as [[0, 0], [0.5, 1], [1, 0.5]].")
    return points


def _checked_expression(text: str, subject: str, largest: float, starting: bool) -> str:
    kinds = "points (load factor, share) are needed, such as [[0, 0], [0.5, 1], [1, 0.5]], or an expression of the load"
    try:
        value = _compiled(text)
        shares = [value(s) for s in np.linspace(0.0, 1.0, SAMPLES)]
    except TurgorError as error:
        hint = near_match(text, ("constant",)) if starting else ""
        raise TurgorError(f"{subject}{hint.rstrip('?')}; {kinds} factor s: {error}") from None
    except RecursionError:
        raise TurgorError(f"{subject[:200]}; this expression is too long.") from None
    except (ArithmeticError, ValueError, TypeError) as error:
        raise TurgorError(f"{subject}; it has no value everywhere between s = 0 and 1: {error}.") from None
    if not (starting or abs(shares[0]) <= 1e-9):
        raise TurgorError(f"{subject}; it must be 0 at s = 0, because the actuator starts without load.")
    if not all(abs(share) <= largest * (1 + 1e-9) for share in shares):
        raise TurgorError(f"{subject}; shares of the load lie between {-largest:g} and {largest:g}.")
    return text


def _parsed(text: str, subject: str) -> ast.Expression:
    try:
        return ast.parse(text.strip(), mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):  # the last two: brackets in thousands of brackets
        raise TurgorError(f"{subject}; this is no expression.") from None


@lru_cache(maxsize=64)
def _compiled(text: str) -> Callable[[float], float]:
    """The function of ``s`` that an expression stands for."""
    inner = _function(_parsed(text, f"'{text}'").body)
    return lambda s: float(inner(float(s)))


def _function(node: ast.expr) -> Callable[[float], float]:
    match node:
        case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
            constant = float(number)
            return lambda s: constant
        case ast.Name(id="s"):
            return lambda s: s
        case ast.Name(id="pi"):
            return lambda s: math.pi
        case ast.Name(id=name):
            raise unknown("name", name, ("s", "pi"))
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            inner = _function(operand)
            return lambda s: -inner(s)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
            act, a, b = _OPERATORS[type(op)], _function(left), _function(right)
            return lambda s: act(a(s), b(s))
        case ast.Call(func=ast.Name(id=name), args=args, keywords=[]):
            if name not in FUNCTIONS:
                raise unknown("function", name, FUNCTIONS)
            call, inputs = FUNCTIONS[name], [_function(each) for each in args]
            return lambda s: call(*(each(s) for each in inputs))
    raise TurgorError(
        f"'{ast.unparse(node)}' is neither a number, s, pi, + - * / **, nor one of {', '.join(FUNCTIONS)}."
    )
