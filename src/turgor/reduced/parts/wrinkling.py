"""Wrinkling: sampled points of sheets that bear tension only."""

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces.tension_field import TensionField
from turgor.foundation.store.codec import SEVEN_DIGITS

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Wrinkling:
    """Points of a sheet that wrinkles; see `turgor.core.engine.faces.tension_field`.

    Parameters
    ----------
    rest : (p, 2, 3) array
        Tangents of the surface at rest.
    modes : (p, 2, 3, r) array
        How they change with the coordinates.
    weights : (p,) array
        Areas.
    field : TensionField
    """

    rest: Array
    modes: Array = field(metadata=SEVEN_DIGITS)
    weights: Array
    field: TensionField

    def chosen(self, which: Ints, weights: Array) -> "Wrinkling":
        """Return some of the points with other weights."""
        return replace(self, rest=self.rest[which], modes=np.ascontiguousarray(self.modes[which]), weights=weights)

    def at(self, q: Array) -> "WrinklingAt":
        """Evaluate at coordinates (r,)."""
        a, b = np.moveaxis(self.rest + (self.modes.reshape(-1, len(q)) @ q).reshape(-1, 2, 3), 1, 0)
        A, B = self.modes[:, 0], self.modes[:, 1]
        strain = np.stack([(a * a).sum(axis=1) - 1, (b * b).sum(axis=1) - 1, 2 * (a * b).sum(axis=1)], axis=1) / 2
        first, second = (a[:, None] @ A)[:, 0], (b[:, None] @ B)[:, 0]
        mixed = (a[:, None] @ B)[:, 0] + (b[:, None] @ A)[:, 0]
        return WrinklingAt(self, strain, np.stack([first, second, mixed], axis=1))


@dataclass(frozen=True, slots=True, eq=False)
class WrinklingAt:
    """A sheet at some coordinates: strains (p, 3) and their slopes (p, 3, r)."""

    sheet: Wrinkling
    strain: Array
    slopes: Array

    def forces(self, starts: Ints | None = None) -> Array:
        """Forces (r,) on the coordinates, or (g, r) of groups of points that begin at ``starts`` (g + 1,)."""
        pulled = (self.sheet.weights[:, None] * self.sheet.field.stress(self.strain))[:, None] @ self.slopes
        return np.asarray(pulled[:, 0].sum(axis=0) if starts is None else np.add.reduceat(pulled[:, 0], starts[:-1]))

    def energy(self) -> float:
        """Energy of the sheet."""
        return float(self.sheet.weights @ self.sheet.field.energy(self.strain))

    def tangent(self, geometric: Array | None) -> Array:
        """Tangent (r, r), with the stress (p, 3) in its geometric part where it is given."""
        s, count = self.sheet, self.slopes.shape[2]
        stress = s.field.stress(self.strain) if geometric is None else geometric
        moduli = s.weights[:, None, None] * s.field.tangent(self.strain)
        out = self.slopes.reshape(-1, count).T @ (moduli @ self.slopes).reshape(-1, count)
        turning = s.weights[:, None] * stress
        pairs = np.stack([turning[:, 0], turning[:, 2], turning[:, 2], turning[:, 1]], axis=1).reshape(-1, 2, 2)
        turned = pairs @ s.modes.reshape(len(pairs), 2, -1)
        return np.asarray(out + s.modes.reshape(-1, count).T @ turned.reshape(-1, count))

    def linearized(self, update: Array) -> Array:
        """Stress (p, 3) linearized for an update (r,)."""
        change = self.slopes @ update
        moved = (self.sheet.field.tangent(self.strain) @ change[:, :, None])[:, :, 0]
        return np.asarray(self.sheet.field.stress(self.strain) + moved)
