"""Pieces: parts of terms that are no polynomials, such as the bending of shells, on some sides or edges."""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.term import Configuration, Term
from turgor.foundation.store.codec import SEVEN_DIGITS

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """Pieces of a term; each has nodes of its own, so that their forces stay apart.

    Parameters
    ----------
    term : Term
        Its k pieces have the nodes 0 to m − 1, m to 2 m − 1 and so on.
    rest : (k m, 3) array
        Scaled positions of these nodes.
    modes : (k m 3, r) array
        Displacements of the modes.
    """

    term: Any
    rest: Array
    modes: Array = field(metadata=SEVEN_DIGITS)

    @staticmethod
    def of(term: Term, points: Array, vectors: Array) -> "Pieces":
        """All pieces of a term, with the scaled points (n, 3) and modes (3 n, r) of the mesh."""
        nodes: Ints = term.nodes  # type: ignore[attr-defined]
        own: Any = replace(term, nodes=np.arange(nodes.size).reshape(nodes.shape))  # type: ignore[type-var]
        flat = nodes.ravel()
        rows = (3 * flat[:, None] + np.arange(3)).ravel()
        return Pieces(own, points[flat], np.ascontiguousarray(vectors[rows]))

    def at(self, q: Array) -> "PiecesAt":
        """Evaluate at coordinates (r,)."""
        return PiecesAt(self, self.rest + (self.modes @ q).reshape(-1, 3))


@dataclass(frozen=True, slots=True, eq=False)
class PiecesAt:
    """Pieces at some positions of their nodes."""

    pieces: Pieces
    position: Array

    def energy(self) -> float:
        """Energy."""
        return float(self.pieces.term.energy(self.position))

    def forces(self) -> Array:
        """Forces (r,)."""
        out = np.zeros_like(self.position)
        self.pieces.term.add_forces(out, Configuration(self.position))
        return out.ravel() @ self.pieces.modes

    def tangent(self, geometric: Array | None) -> Array:
        """Tangent (r, r), with given stresses in its geometric part."""
        term, count = self.pieces.term, len(self.pieces.term.nodes)
        stresses = self.linearized(np.zeros(self.pieces.modes.shape[1])) if geometric is None else geometric
        size = self.position.size // count
        local = np.zeros((count, size, size))
        rows, columns = np.tril_indices(size)
        packed = term.tangents(Configuration(self.position), stresses).reshape(count, -1)
        local[:, rows, columns] = packed
        local[:, columns, rows] = packed
        modes = self.pieces.modes.reshape(count, size, -1)
        return np.asarray(self.pieces.modes.T @ (local @ modes).reshape(self.pieces.modes.shape))

    def linearized(self, update: Array) -> Array:
        """Stresses linearized for an update (r,)."""
        moved = (self.pieces.modes @ update).reshape(-1, 3)
        return np.asarray(self.pieces.term.stresses(self.position, moved))
