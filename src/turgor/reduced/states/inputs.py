"""Inputs: the numbers of a model that a reduced model takes, their ranges, and how loads follow from them."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import COLUMN_UNITS

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Inputs:
    """Inputs of a reduced model.

    Parameters
    ----------
    keys : tuple of str
        Keys of the model's numbers, as in `turgor.gradient`: ``"loads.pressure"``, ``"loads.tip.force.3"``.
    low, high : (n,) arrays [SI]
        Range that was trained.
    units : tuple of str
        Units in which they are shown; empty for SI.
    """

    keys: tuple[str, ...]
    low: Array
    high: Array
    units: tuple[str, ...]

    def vector(self, values: Mapping[str, float | Sequence[float]]) -> Array:
        """Values by key as a vector (n,) in order; a key may be its end, such as ``"pressure"``.

        A key without its last number stands for all its components, in order: ``"tip.vector"`` with three numbers.

        Raises
        ------
        TurgorError
            If a key is unknown or missing, or a value lies outside of the trained range.
        """
        out = np.full(len(self.keys), np.nan)
        for name, value in values.items():
            places = self.components(name)
            if np.size(value) != len(places):
                raise TurgorError(f"the input '{name}' has {np.size(value)} values; {len(places)} are needed.")
            out[places] = value
        for key, value, low, high in zip(self.keys, out, self.low, self.high, strict=True):
            if np.isnan(value):
                place = self.keys.index(key)
                bounds = f"{self.shown(place, low)} and {self.shown(place, high)}"
                raise TurgorError(f"the input '{key}' has no value; one between {bounds} is needed.")
        self.check(out)
        self._check_lengths(out)
        return out

    @property
    def vectors(self) -> list[list[int]]:
        """Places of the components of each vector of any direction: all have one range, the same on both sides of zero.

        Such a vector is trained up to a length, that of the range. At the corners of the box of its components it would
        be up to 1.7 times as long.
        """
        names: dict[str, list[int]] = {}
        for place, key in enumerate(self.keys):
            if re.search(r"\.[123]$", key):
                names.setdefault(key[:-2], []).append(place)
        return [
            places
            for places in names.values()
            if len(places) > 1 and (self.low[places] == -self.high[places[0]]).all() and np.ptp(self.high[places]) == 0
        ]

    def at_shares(self, shares: Array) -> Array:
        """Values (..., n) at shares of the ranges; vectors of any direction stay within their length."""
        values = self.low + np.asarray(shares, dtype=np.float64) * (self.high - self.low)
        for places in self.vectors:
            parts = values[..., places]
            length = np.linalg.norm(parts, axis=-1, keepdims=True)
            largest = np.abs(parts).max(axis=-1, keepdims=True)
            values[..., places] = parts * np.divide(largest, length, out=np.ones_like(length), where=length > 0)
        return values

    def _check_lengths(self, values: Array) -> None:
        """Refuse vectors of any direction that are longer than what was trained."""
        for places in self.vectors:
            length, most = float(np.linalg.norm(values[places])), float(self.high[places[0]])
            if length > most * (1 + 1e-9):
                raise TurgorError(
                    f"the input '{self.keys[places[0]][:-2]}' has the length {self.shown(places[0], length)}, outside "
                    f"of the trained range up to {self.shown(places[0], most)}."
                )

    @property
    def places(self) -> NDArray[np.bool_]:
        """Which inputs are places of obstacles; these stay along a training path, where loads rise."""
        return np.array([key.startswith("obstacles.") for key in self.keys])

    def on_path(self, values: Array, factor: float) -> Array:
        """Share of the loads that are no inputs, and inputs (1 + n,) of a path to values (n,), at a load factor."""
        return np.concatenate([[factor], np.where(self.places, 1.0, factor) * values])

    def components(self, name: str) -> list[int]:
        """Places of the components of a vector by its key or the end of its key, or of one input."""
        single = [re.sub(r"\.[123]$", "", key) for key in self.keys]
        vectors = [key for key in set(single) - set(self.keys) if key == name or key.endswith(f".{name}")]
        if len(vectors) != 1:
            return [self.place(name)]
        return [place for place, key in enumerate(single) if key == vectors[0]]

    def place(self, name: str) -> int:
        """Place of an input by its key or the end of its key."""
        ends = [place for place, key in enumerate(self.keys) if key == name or key.endswith(f".{name}")]
        if len(ends) != 1:
            raise unknown("input", name, self.keys)
        return ends[0]

    def check(self, vector: Array) -> None:
        """Refuse values outside of the trained range."""
        for place in self.outside(vector):
            raise TurgorError(
                f"the input '{self.keys[place]}' is {self.shown(place, vector[place])}, outside of the trained range "
                f"from {self.shown(place, self.low[place])} to {self.shown(place, self.high[place])}."
            )

    def shown(self, place: int, value: float) -> str:
        """A value of an input with its unit."""
        unit = self.units[place]
        return f"{value / COLUMN_UNITS[unit]:.6g} {unit}".strip()

    def text(self, vector: Array) -> str:
        """All values with their keys and units."""
        return ", ".join(f"{key} = {self.shown(place, vector[place])}" for place, key in enumerate(self.keys))

    def outside(self, vector: Array) -> list[int]:
        """Places of the values outside of the trained range; round-off does not count."""
        slack = 1e-9 * (self.high - self.low)
        return [int(place) for place in np.flatnonzero((vector < self.low - slack) | (vector > self.high + slack))]

    def scaled(self, vectors: Array) -> Array:
        """Values as shares of the ranges."""
        return np.asarray((vectors - self.low) / (self.high - self.low))
