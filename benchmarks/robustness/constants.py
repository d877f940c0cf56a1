"""Chosen numbers of the solvers: which of them decide anything, at half and at double their value.

python benchmarks/robustness/constants.py [SECONDS]   writes constants.md from the cases that take at most so long

Every field of the settings in `turgor.core.solvers` is replaced by a probe: a number that also knows half and double
its value. A probe behaves like the number, so the cases run as they do without it. Where it is compared, or a result
of it, it notes whether half or double would decide otherwise. Where it leaves the reach of probes, as in arrays, counts
of loops and digits, it notes that it was used. One run therefore answers for all numbers. What no case decides is not
proven useless: set such a number to what removing it means, and run the cases before it goes.
"""

import operator
import sys
from collections import defaultdict
from collections.abc import Callable
from dataclasses import fields, is_dataclass
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
import turgor as tg
from benchmarks.robustness.robustness import written
from benchmarks.robustness.robustness_cases import CASES
from benchmarks.robustness.robustness_cases.case import MM, RUBBER, limited, one
from benchmarks.shared.tables import table

import meshes  # isort: skip  (found where robustness_cases.case says)

PAGE = Path(__file__).parent / "constants.md"
ROOMS = ("newton", "continuation", "continuation.scalar_control", "dynamics", "checks")

#: Checked for their type where a run begins, so no probe can stand for them; they scale the first and longest steps.
LEFT_OUT = ("BRANCH_SWITCH",)

#: Operations on a probe before it becomes a number again.
DEPTH = 3

NUMBERS = (int, float, np.floating, np.integer)
HEAD = ("settings", "field", "value", "cases that use it", "decided otherwise at half", "at double", "cases")

Marks = dict[str, dict[str, set[str]]]


class Notes:
    """What probes note, by their name: the cases in which it happened."""

    def __init__(self) -> None:
        self.marks: Marks = defaultdict(lambda: defaultdict(set))
        self.case = ""

    def add(self, names: frozenset[str], what: str) -> None:
        """Note something of the case that runs."""
        for name in names:
            self.marks[name][what].add(self.case)


class Probe:
    """A number that knows half and double its value."""

    __slots__ = ("depth", "double", "half", "names", "notes", "value")

    def __init__(self, values: tuple[Any, Any, Any], names: frozenset[str], notes: Notes, depth: int = 0) -> None:
        self.value, self.half, self.double = values
        self.names, self.notes, self.depth = names, notes, depth

    def plain(self) -> Any:
        """The number, and a note that it is used as such."""
        self.notes.add(self.names, "number")
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
        return Probe((-self.value, -self.half, -self.double), self.names, self.notes, self.depth)

    def __abs__(self) -> "Probe":
        return Probe((abs(self.value), abs(self.half), abs(self.double)), self.names, self.notes, self.depth)

    def __format__(self, spec: str) -> str:
        return format(self.value, spec)

    def __repr__(self) -> str:
        return repr(self.value)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        return np.array(self.plain(), dtype=dtype or float)

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **more: Any) -> Any:
        return getattr(ufunc, method)(*(each.plain() if isinstance(each, Probe) else each for each in inputs), **more)


def _three(one: Probe, other: Any, f: Callable[[Any, Any], Any]) -> tuple[tuple[Any, Any, Any], frozenset[str]] | None:
    """Results at the value, half and double, and whose they are; None where the other is no number."""
    if isinstance(other, Probe):
        pairs = ((one.value, other.value), (one.half, other.half), (one.double, other.double))
        return (f(*pairs[0]), f(*pairs[1]), f(*pairs[2])), one.names | other.names
    if isinstance(other, NUMBERS):
        return (f(one.value, other), f(one.half, other), f(one.double, other)), one.names
    return None


def _calculated(f: Callable[[Any, Any], Any], one: Probe, other: Any) -> Any:
    found = _three(one, other, f)
    if found is None or one.depth >= DEPTH:
        return f(one.plain(), other.plain() if isinstance(other, Probe) else other)
    one.notes.add(found[1], "used")
    return Probe(found[0], found[1], one.notes, one.depth + 1)


def _compared(f: Callable[[Any, Any], Any], one: Probe, other: Any) -> Any:
    found = _three(one, other, f)
    if found is None:
        return f(one.plain(), other)
    (value, half, double), names = found
    for what, noted in (("used", True), ("half", half != value), ("double", double != value)):
        if noted:
            one.notes.add(names, what)
    return value


def _method(how: Callable[..., Any], f: Callable[[Any, Any], Any]) -> Callable[[Probe, Any], Any]:
    return lambda one, other: how(f, one, other)


for _name in ("lt", "le", "gt", "ge", "eq", "ne"):
    setattr(Probe, f"__{_name}__", _method(_compared, getattr(operator, _name)))
for _name in ("add", "sub", "mul", "truediv", "pow"):
    _f = getattr(operator, _name)
    setattr(Probe, f"__{_name}__", _method(_calculated, _f))
    setattr(Probe, f"__r{_name}__", _method(_calculated, lambda a, b, f=_f: f(b, a)))


def settings() -> dict[str, Any]:
    """The settings of the solvers by room and name."""
    found = {}
    for room in ROOMS:
        module = import_module(f"turgor.core.solvers.{room}.settings")
        found |= {
            f"{room} {name}": each for name, each in vars(module).items() if is_dataclass(each) and name.isupper()
        }
    return found


def put(notes: Notes) -> dict[str, Any]:
    """Put probes into all settings; return their values by name."""
    values = {}
    for place, each in settings().items():
        for field in fields(each):
            value = getattr(each, field.name)
            if not isinstance(value, int | float) or place.split()[-1] in LEFT_OUT:
                continue
            half = max(1, round(value / 2)) if isinstance(value, int) else value / 2
            name = f"{place} {field.name}"
            values[name] = value
            object.__setattr__(each, field.name, Probe((value, half, 2 * value), frozenset({name}), notes))
    return values


def cases(seconds: float) -> list[tuple[str, Callable[[], tg.Model], Any]]:
    """Robustness cases that took at most so long, a bar that swings under its weight, and an arch in viscous air."""
    took = {name: float(line[6]) for name, line in written().items()}
    chosen = [(case.name, case.model, case.procedure) for case in CASES if took.get(case.name, 1e9) <= seconds]
    bar = partial(meshes.box, (40 * MM, 4 * MM, 4 * MM), (8, 1, 1))
    swinging = lambda: one(bar(), RUBBER, [tg.Gravity((0, 0, -1))], [tg.Fixed("x0")])  # noqa: E731
    arch = next(case.model for case in CASES if case.name == "arch, load control")
    return [*chosen, ("swinging bar", swinging, tg.Dynamic(duration=0.3)), ("viscous arch", arch, tg.Stabilized())]


def row(name: str, value: float, marks: dict[str, set[str]]) -> tuple[str, ...]:
    """One line of the table; of the cases that decide otherwise at most three are named."""
    used = marks["used"] | marks["number"]
    otherwise = sorted(marks["half"] | marks["double"])
    named = "; ".join(otherwise[:3]) + (" …" if len(otherwise) > 3 else "")
    count = [str(len(marks[what])) for what in ("half", "double")]
    if used and not otherwise and marks["number"]:
        named = "used as a number, such as a count or in arrays"
    return (*name.rsplit(" ", 1), f"{value:g}", str(len(used)), *count, named)


def main() -> None:
    """Run the cases and write the page."""
    notes, done = Notes(), 0
    chosen = cases(float(sys.argv[1]) if len(sys.argv) > 1 else 1.0)
    values = put(notes)
    for name, model, procedure in chosen:
        notes.case = name
        solution, seconds = limited(model(), procedure)
        done += 1
        print(f"{name}: {solution.status}, {solution.iterations} iterations, {seconds:.1f} CPU s", flush=True)
    lines = [row(name, value, notes.marks[name]) for name, value in values.items()]
    text = (__doc__ or "").split("\n\n")[2].replace("\n", " ")
    written_by = f"Written by `python benchmarks/robustness/constants.py` from {done} cases."
    page = f"# Chosen numbers of the solvers\n\n{written_by} {text}\n\n"
    PAGE.write_text(page + table(HEAD, lines) + "\n", "utf-8")


if __name__ == "__main__":
    main()
