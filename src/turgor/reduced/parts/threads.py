"""Threads: sampled pieces of fibers, which stretch along themselves and go slack in compression."""

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.fibers.settings import FIBERS
from turgor.foundation.store.codec import SEVEN_DIGITS

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Threads:
    """Pieces of fibers; see `turgor.core.engine.fibers.fiber_kernels`.

    Parameters
    ----------
    rest : (k, 3) array
        Tangents per reference length at rest.
    modes : (k, 3, r) array
        How they change with the coordinates.
    weights : (k,) array
        Reference length or area of each piece.
    stiffness : (k,) array
        Scaled.
    pushed : (k,) array
        Share of the stiffness that is left in compression.
    """

    rest: Array
    modes: Array = field(metadata=SEVEN_DIGITS)
    weights: Array
    stiffness: Array
    pushed: Array

    def chosen(self, which: Ints, weights: Array) -> "Threads":
        """Return some of the pieces with other weights."""
        modes = np.ascontiguousarray(self.modes[which])
        return replace(
            self, rest=self.rest[which], modes=modes, weights=weights, stiffness=self.stiffness[which],
            pushed=self.pushed[which],
        )  # fmt: skip

    def at(self, q: Array) -> "ThreadsAt":
        """Evaluate at coordinates (r,)."""
        along = self.rest + (self.modes.reshape(-1, len(q)) @ q).reshape(-1, 3)
        stretch = np.linalg.norm(along, axis=1)
        return ThreadsAt(self, along / stretch[:, None], stretch, np.zeros_like(stretch))


@dataclass(frozen=True, eq=False)
class ThreadsAt:
    """Pieces of fibers at some coordinates: unit tangents (k, 3) and stretches (k,)."""

    threads: Threads
    unit: Array
    stretch: Array
    zero: Array

    def forces(self, starts: Ints | None = None) -> Array:
        """Forces (r,) on the coordinates, or (g, r) of groups of pieces that begin at ``starts`` (g + 1,)."""
        pulled = (self.threads.weights * self._tension(self.zero))[:, None] * self._slopes
        return np.asarray(pulled.sum(axis=0) if starts is None else np.add.reduceat(pulled, starts[:-1], axis=0))

    def energy(self) -> float:
        """Energy of the stretched pieces, and of what slack ones resist."""
        t = self.threads
        stiffness = t.weights * t.stiffness * np.where(self.stretch >= 1, 1.0, t.pushed)
        return 0.5 * float(stiffness @ (self.stretch - 1) ** 2)

    def tangent(self, geometric: Array | None) -> Array:
        """Tangent (r, r), with the tensions (k,) in its geometric part where they are given."""
        t, slopes = self.threads, self._slopes
        tension = self._tension(self.zero) if geometric is None else geometric
        slack = np.maximum(t.pushed, FIBERS.slack_tangent)
        along = t.weights * t.stiffness * np.where(self.stretch >= 1, 1.0, slack)
        turning = t.weights * tension / self.stretch
        out = (slopes.T * (along - turning)) @ slopes
        flat = t.modes.reshape(-1, out.shape[0])
        return np.asarray(out + (flat.T * np.repeat(turning, 3)) @ flat)

    def linearized(self, update: Array) -> Array:
        """Tensions (k,) linearized for an update (r,)."""
        return self._tension(self._slopes @ update)

    def _tension(self, change: Array) -> Array:
        """Tensions (k,) at a change of the stretches."""
        t, stretch = self.threads, self.stretch + change
        return np.asarray(t.stiffness * np.where(stretch >= 1, 1.0, t.pushed) * (stretch - 1))

    @cached_property
    def _slopes(self) -> Array:
        """Derivatives (k, r) of the stretches."""
        return np.asarray((self.unit[:, None, :] @ self.threads.modes)[:, 0])
