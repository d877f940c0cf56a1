"""Variation: a model as a function of numbers, and their values."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import isfinite
from types import MappingProxyType

from turgor.accuracy.gradients.settings import GRADIENTS
from turgor.core.model.model import Model
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import COLUMN_UNITS

_NONE: Mapping[str, float] = MappingProxyType({})


@dataclass(frozen=True, slots=True, eq=False)
class Variation:
    """A model as a function of numbers: dimensions, constants of materials, loads, whatever it is made of.

    Parameters
    ----------
    model : callable
        ``model(values) -> Model`` for values by name, in SI units: that of the state, of its stage where there are
        several. Nearby values must give meshes with the same cells; nodes may move. Tetrahedra that it generates of one
        CAD part (`turgor.mesh`) are not generated again: those of the state move along with the part.
    values : mapping of str to float [SI]
        Where derivatives are taken, by the names of the numbers.
    units : mapping of str to str
        Units in which they are shown, such as ``{"wall": "mm"}``; SI by default.
    scales : mapping of str to float [SI]
        Sizes of numbers whose value is zero or far from what a change is compared with; the value by default.
    procedure : callable, optional
        ``procedure(values) -> procedure`` that found the state, where it depends on the numbers, too.

    Raises
    ------
    TurgorError
        If there is no number, a value is not finite, a value of zero has no scale, or a unit is unknown.

    Examples
    --------
    >>> def model_of(values):
    ...     raise NotImplementedError
    >>> Variation(model_of, {"wall": 0.0})
    Traceback (most recent call last):
    turgor.TurgorError: 'wall' is 0, so no small step follows from it; give its size in scales.
    """

    model: Callable[[Mapping[str, float]], Model]
    values: Mapping[str, float]
    units: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    scales: Mapping[str, float] = field(default_factory=lambda: _NONE)
    procedure: Callable[[Mapping[str, float]], Procedure] | None = None

    def __post_init__(self) -> None:
        if not self.values:
            raise TurgorError("a gradient needs a number that it is taken by; name one or more.")
        for name in (*self.units, *self.scales):
            if name not in self.values:
                raise unknown("number", name, self.values)
        for name, unit in self.units.items():
            if unit not in COLUMN_UNITS:
                raise unknown(f"unit of '{name}'", unit, (each for each in COLUMN_UNITS if each))
        for name, value in self.values.items():
            if not isfinite(value):
                raise TurgorError(f"'{name}' is {value:g}; a finite number is needed.")
            if not self.size(name) > 0:
                raise TurgorError(f"'{name}' is {value:g}, so no small step follows from it; give its size in scales.")

    __repr__ = brief

    def size(self, name: str) -> float:
        """Return the size of a number [SI]."""
        return abs(self.scales.get(name, self.values[name]))

    def step(self, name: str) -> float:
        """Return the step of its differences [SI]."""
        return GRADIENTS.step * self.size(name)

    def moved(self, name: str, steps: int) -> dict[str, float]:
        """Return the values with one of them moved by a number of steps."""
        return {**self.values, name: self.values[name] + steps * self.step(name)}
