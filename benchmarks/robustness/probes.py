"""A number that knows half and double its value, and notes whether they would decide otherwise."""

import numbers
import operator
from collections import defaultdict
from collections.abc import Callable
from typing import Any

import numpy as np

#: Operations on a probe before it becomes a number again.
DEPTH = 3

NUMBERS = (int, float, np.floating, np.integer)

Marks = dict[str, dict[str, set[str]]]


class Notes:
    """What probes note, by their name: the cases in which it happened."""

    def __init__(self) -> None:
        self.marks: Marks = defaultdict(lambda: defaultdict(set))
        self.case = "import"

    def add(self, names: frozenset[str], what: str) -> None:
        """Note something of the case that runs."""
        for name in names:
            self.marks[name][what].add(self.case)


NOTES = Notes()


class Probe:
    """A number that knows half and double its value."""

    __slots__ = ("depth", "double", "half", "names", "value")

    def __init__(self, values: tuple[Any, Any, Any], names: frozenset[str], depth: int = 0) -> None:
        self.value, self.half, self.double = values
        self.names, self.depth = names, depth

    def plain(self) -> Any:
        """The number, and a note that it is used as such."""
        NOTES.add(self.names, "number")
        return self.value

    def __float__(self) -> float:
        return float(self.plain())

    def __int__(self) -> int:
        return int(self.plain())

    def __index__(self) -> int:
        return operator.index(self.plain())

    def __bool__(self) -> bool:
        return bool(self.value)

    def __hash__(self) -> int:
        return hash(self.plain())

    def __round__(self, digits: int | None = None) -> Any:
        return round(self.plain(), digits)

    def __neg__(self) -> "Probe":
        return probe((-self.value, -self.half, -self.double), self.names, self.depth)

    def __abs__(self) -> "Probe":
        return probe((abs(self.value), abs(self.half), abs(self.double)), self.names, self.depth)

    def __format__(self, spec: str) -> str:
        return format(self.value, spec)

    def __repr__(self) -> str:
        return repr(self.value)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self.value), (self.value,)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        return np.array(self.plain(), dtype=dtype)

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **more: Any) -> Any:
        if method == "__call__" and len(inputs) == 2 and not more:
            one, other = inputs
            if all(isinstance(each, (Probe, *NUMBERS)) for each in inputs):
                return _calculated(ufunc, one, other)
            if ufunc in COMPARISONS:
                return _compared(ufunc, one, other)
        return getattr(ufunc, method)(*(plain(each) for each in inputs), **more)


class Count(Probe):
    """A probe that is an integer."""

    __slots__ = ()


numbers.Real.register(Probe)
numbers.Integral.register(Count)
COMPARISONS = (np.less, np.less_equal, np.greater, np.greater_equal, np.equal, np.not_equal)


def plain(each: Any) -> Any:
    """A number in place of a probe; everything else as it is."""
    return each.plain() if isinstance(each, Probe) else each


def _three(f: Callable[[Any, Any], Any], one: Any, other: Any) -> tuple[tuple[Any, Any, Any], frozenset[str]]:
    """Results at the value, half and double, and the names of the numbers in them."""
    values = [(each.value, each.half, each.double) if isinstance(each, Probe) else (each,) * 3 for each in (one, other)]
    names = [each.names for each in (one, other) if isinstance(each, Probe)]
    (a, b, c), (x, y, z) = values
    return (f(a, x), f(b, y), f(c, z)), frozenset().union(*names)


def probe(values: tuple[Any, Any, Any], names: frozenset[str], depth: int = 0) -> Probe:
    """A probe of the kind of its value."""
    return (Count if isinstance(values[0], int | np.integer) else Probe)(values, names, depth)


def _calculated(f: Callable[[Any, Any], Any], one: Any, other: Any) -> Any:
    depth = max(each.depth for each in (one, other) if isinstance(each, Probe))
    if not all(isinstance(each, (Probe, *NUMBERS)) for each in (one, other)) or depth >= DEPTH:
        return f(plain(one), plain(other))
    values, names = _three(f, one, other)
    if isinstance(values[0], bool | np.bool_):
        return _compared(f, one, other)
    NOTES.add(names, "used")
    return probe(values, names, depth + 1)


def _compared(f: Callable[[Any, Any], Any], one: Any, other: Any) -> Any:
    if not all(isinstance(each, (Probe, np.ndarray, *NUMBERS)) for each in (one, other)):
        return f(plain(one), plain(other))
    (value, half, double), names = _three(f, one, other)
    for what, noted in (("used", True), ("half", np.any(half != value)), ("double", np.any(double != value))):
        if noted:
            NOTES.add(names, what)
    return value


def _method(how: Callable[..., Any], f: Callable[[Any, Any], Any]) -> Callable[[Probe, Any], Any]:
    return lambda one, other: how(f, one, other)


for _name in ("lt", "le", "gt", "ge", "eq", "ne"):
    setattr(Probe, f"__{_name}__", _method(_compared, getattr(operator, _name)))
for _name in ("add", "sub", "mul", "truediv", "floordiv", "mod", "pow"):
    _f = getattr(operator, _name)
    setattr(Probe, f"__{_name}__", _method(_calculated, _f))
    setattr(Probe, f"__r{_name}__", _method(_calculated, lambda a, b, f=_f: f(b, a)))
