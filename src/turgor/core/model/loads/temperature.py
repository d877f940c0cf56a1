"""Temperature: a body expands when it is warmed, and its stiffness may change."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from math import log1p
from typing import TYPE_CHECKING, Any

import numpy as np

from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.history_text import shares_text
from turgor.core.model.loads.load import Load
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity, number, shown
from turgor.foundation.given import name as name_of

#: 20 °C in kelvin, at which laws are usually measured, and 0 °C.
ROOM, FREEZING = 293.15, 273.15

Table = tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Temperature(Load):
    """Temperature of a body, from that at which it is free of stress and its law was measured.

    Parameters
    ----------
    body : str
        Body that is warmed or cooled, the same everywhere.
    temperature : float [K]
        What it becomes; ``"60 °C"`` is understood, too.
    rest : float [K]
        Where the body has the shape of the mesh and the stiffness of its law; 20 °C by default.
    expansion : float, optional [1/K]
        Linear thermal expansion; by default that of the material, which many of the library state.
    modulus : str or sequence of (float [K], float)
        ``"constant"``; ``"rubber"`` for a shear stiffness in proportion to the absolute temperature, as the entropy
        elasticity of a rubber network has it; or points (temperature, factor on the stiffness) with straight lines
        between them. The bulk modulus does not change.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`: the share of the way from ``rest`` to ``temperature``.

    Examples
    --------
    >>> warm = Temperature("body", "60 °C", expansion=3e-4, modulus="rubber")
    >>> round(warm.stiffness(1.0), 4)
    1.1364
    >>> warm.text()
    'Body body goes from 20 °C to 60 °C, expands by 0.0003 per kelvin and has a stiffness of 1.136 times its law.'
    """

    body: str
    temperature: float = field(metadata={"dimension": "temperature"})
    rest: float = field(default=ROOM, metadata={"dimension": "temperature"})
    expansion: float | None = field(default=None, metadata={"dimension": "expansion"})
    modulus: str | Table = field(default="constant", metadata={"dimension": "temperature", "points": True})
    history: History = RAMP

    job_key = "temperature"
    of_bodies = True

    if TYPE_CHECKING:

        def __init__(
            self, body: str, temperature: Quantity, rest: Quantity = ROOM, expansion: Quantity | None = None,
            modulus: str | Sequence[Sequence[float | str]] = "constant", history: History = RAMP,
        ) -> None: ...  # fmt: skip

    def __post_init__(self) -> None:
        subject = f"temperature of '{name_of(self.body, 'body that is warmed', 'body')}'"
        for key in ("temperature", "rest"):
            value = number(getattr(self, key), f"{subject}: {key}", "temperature")
            object.__setattr__(self, key, value)
            if not value > 0:
                raise TurgorError(f"{subject}: {key} is {value:g} K; it must be more than 0 K.")
        if self.expansion is not None:
            object.__setattr__(self, "expansion", number(self.expansion, f"{subject}: expansion", "expansion"))
        object.__setattr__(self, "modulus", _modulus(self.modulus, f"{subject}: modulus"))
        object.__setattr__(self, "history", checked(self.history, subject, starting=True))
        strain = self._expansion * (self.temperature - self.rest)
        if not -0.5 <= strain <= 1:
            raise TurgorError(
                f"{subject}: expansion is {self._expansion:g} 1/K, which makes a strain of {strain:.3g}; allowed is "
                "-0.5 to 1. Rubbers have 1e-4 to 4e-4 1/K."
            )
        self._check_range(subject)

    def of_materials(self, materials: Mapping[str, Any]) -> Load:
        """Return the temperature with the expansion of the body's material, where it states none itself.

        Raises
        ------
        TurgorError
            If neither states one, and nothing else changes with the temperature.
        """
        entry = materials.get(self.body)
        material = getattr(entry, "material", entry)
        if self.expansion is not None or material is None:
            return self
        if material.expansion is None and self.modulus == "constant":
            raise TurgorError(
                f"temperature of '{self.body}': its material '{material.name}' states no thermal expansion; state "
                "expansion, such as 3e-4 1/K, here or in the material, or a modulus that changes."
            )
        return self if material.expansion is None else replace(self, expansion=material.expansion)

    @property
    def _expansion(self) -> float:
        """The expansion, 0 as long as it is not known [1/K]."""
        return self.expansion or 0.0

    def _check_range(self, subject: str) -> None:
        if isinstance(self.modulus, str):
            return
        low, high = self.modulus[0][0], self.modulus[-1][0]
        for value in (self.rest, self.temperature):
            if not low <= value <= high:
                raise TurgorError(
                    f"{subject}: {value - FREEZING:.4g} °C lies outside the points of modulus, {low - FREEZING:.4g} to "
                    f"{high - FREEZING:.4g} °C; add points."
                )

    def at(self, load_factor: float) -> float:
        """Return the temperature at a load factor [K]."""
        return self.rest + self.share(load_factor) * (self.temperature - self.rest)

    def text(self) -> str:
        """Return the sentence of a report."""
        parts = [f"goes from {self.rest - FREEZING:.4g} °C to {self.temperature - FREEZING:.4g} °C"]
        parts += [f"expands by {self.expansion:g} per kelvin"] if self.expansion else []
        if self.modulus != "constant":
            parts.append(f"has a stiffness of {self._factor(self.temperature):.4g} times its law")
        head, last = ", ".join(parts[:-1]), parts[-1]
        sentence = f"{head} and {last}" if head else last
        return f"Body {self.body} {sentence}{shares_text(self.history)}."

    @property
    def growth(self) -> float | None:
        """The expansion; None where the stiffness changes, too."""
        return self._expansion * (self.temperature - self.rest) if self.modulus == "constant" else None

    def log_length(self, load_factor: float) -> float:
        """Return the same in all directions."""
        return log1p(self._expansion * (self.at(load_factor) - self.rest))

    def stiffness(self, load_factor: float) -> float:
        """Return the stiffness at the temperature over that at rest."""
        return self._factor(self.at(load_factor))

    def _factor(self, temperature: float) -> float:
        if self.modulus == "constant":
            return 1.0
        if isinstance(self.modulus, str):
            return temperature / self.rest
        places, factors = zip(*self.modulus, strict=True)
        return float(np.interp(temperature, places, factors) / np.interp(self.rest, places, factors))


def _modulus(given: Any, what: str) -> str | Table:
    if isinstance(given, str) and given in ("constant", "rubber"):
        return given
    needed = f"{what} is {shown(given)}; 'constant', 'rubber' or points (temperature, factor) are needed"
    if isinstance(given, str) or not isinstance(given, Iterable):
        raise TurgorError(f"{needed}.")
    points: list[tuple[float, float]] = []
    for pair in given:
        if isinstance(pair, str) or not isinstance(pair, Iterable) or len(both := list(pair)) != 2:
            raise TurgorError(f"{needed}.")
        points.append((number(both[0], what, "temperature"), number(both[1], what)))
    rising = all(a[0] < b[0] for a, b in pairwise(points))
    if len(points) < 2 or not rising or not all(factor > 0 for _, factor in points):
        raise TurgorError(f"{needed}: at least two, with rising temperatures and factors above 0.")
    return tuple(points)
