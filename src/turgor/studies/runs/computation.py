"""Computation: a function of numbers, with its further arguments, from which runs are created."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from turgor.foundation.response import Response
from turgor.studies.runs.rounding import rounded
from turgor.studies.runs.run import Computed, Run


@dataclass(frozen=True, slots=True, kw_only=True)
class Computation:
    """A function that computes a response, with its further arguments.

    Parameters
    ----------
    function : callable
        Function of a module that takes numbers in SI units as keywords, or a design, and returns a `Response`.
    values : mapping
        Further arguments.
    nominal : mapping
        Arguments of the nominal run alone, such as one that requests the mesh error.
    gather : str
        Name of an argument that takes all numbers as one mapping; by default each is a keyword.
    design : object
        A dataclass, such as an actuator: the numbers are its fields, and the function is called with it alone.
    """

    function: Callable[..., Response | Computed]
    values: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))
    nominal: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))
    gather: str = ""
    design: Any = None

    def run(self, numbers: Mapping[str, float | int | str], *, nominal: bool = False, name: str = "") -> Run:
        """Return the run with numbers, by default named by them; whole numbers stay whole."""
        given = {name: rounded(value) if isinstance(value, float) else value for name, value in numbers.items()}
        shown = ", ".join(
            f"{name} {value:.5g}" if isinstance(value, float) else f"{name} {value}" for name, value in given.items()
        )
        keywords: dict[str, Any] = {self.gather: given} if self.gather else given
        more = self.nominal if nominal else {}
        return Run(
            name=name or shown, function=self.function, values={**self.values, **more, **keywords}, design=self.design
        )  # fmt: skip
