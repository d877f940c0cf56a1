"""Rules that a design must satisfy before it is computed, such as a smallest wall."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF
from turgor.studies.runs.factor import Value

Margin: TypeAlias = Callable[[Mapping[str, Value]], float]


@dataclass(frozen=True, slots=True)
class Rule:
    """A condition on the values of the factors alone.

    Parameters
    ----------
    name : str
        What it requires, in words, such as ``"gap of at least 1 mm"``.
    margin : callable
        Function of the values of the factors by name [SI]. It returns the margin of the rule, negative where it
        is broken; where it raises a `TurgorError`, such as one of an actuator that cannot be built, the rule is broken.

    Examples
    --------
    >>> thin = Rule("walls of at most half a gap", lambda values: values["gap"] / 2 - values["wall"])
    >>> thin.broken({"gap": 2e-3, "wall": 0.5e-3}), thin.broken({"gap": 2e-3, "wall": 1.5e-3})
    ('', 'walls of at most half a gap')
    """

    name: str
    margin: Margin

    def of(self, values: Mapping[str, Value]) -> float:
        """Return the margin; minus infinity where the function raises a `TurgorError`."""
        try:
            return float(self.margin(values))
        except TurgorError:
            return -float("inf")

    def broken(self, values: Mapping[str, Value]) -> str:
        """Return why the rule is broken; empty where it is satisfied."""
        try:
            margin = float(self.margin(values))
        except TurgorError as error:
            return f"{self.name}: {error}"
        return "" if margin >= -ROUND_OFF.same else self.name
