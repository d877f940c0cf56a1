"""Term: what adds forces and a tangent to the equations besides the cells and contact.

A term is one class in one file; `turgor.core.engine.terms.TERMS` names the functions that make the terms of a model,
and is the only place to change for a new one. Lengths, forces and stresses are scaled as in
`turgor.core.engine.system`.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol, Self

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.model.model import Model

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Setting:
    """Input of terms.

    Parameters
    ----------
    model : Model
    points : (n + e, 3) array
        Scaled reference positions of the nodes of the mesh, then of those of reference points.
    prescribed : (n + e, 3) bool array
        Prescribed components.
    dV : (c, q) array
        Scaled volumes of the quadrature points of the cells.
    length, stress : float [m], [Pa]
        Scales.
    controlled : tuple of str
        Faces whose pressure is unknown.
    """

    model: Model
    points: Array
    prescribed: NDArray[np.bool_]
    dV: Array
    length: float
    stress: float
    controlled: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Configuration:
    """Where terms are evaluated.

    Parameters
    ----------
    position : (n, 3) array
        Scaled positions of the nodes.
    load_factor : float
    unknown_pressures : (k,) array or None
        Scaled pressures of the controlled faces.
    bonds : mapping of str to array
        Internal variables of bonds and cables at the start of the step; those at rest where one is left out.
    """

    position: Array
    load_factor: float = 0.0
    unknown_pressures: Array | None = None
    bonds: Mapping[str, Array] = field(default_factory=dict)


class Term(Protocol):
    """Forces on nodes that stay tied to the same nodes, with their energy and tangent.

    A class of terms inherits the defaults, which are those of constant internal forces, and replaces what differs.
    """

    @property
    def couples(self) -> bool:
        """Whether the pieces tie degrees of freedom that no cell ties, so that the sparsity pattern has to grow."""
        return False

    @property
    def external(self) -> bool:
        """Whether the forces are those of a load."""
        return False

    @property
    def symmetric(self) -> bool:
        """Whether the forces have a potential; if not, `skew` gives the rest of the tangent."""
        return True

    @property
    def memory_key(self) -> str:
        """Key of its internal variables in a memory; empty where it has none."""
        return ""

    def remembered(self, at: Configuration) -> Array:
        """Internal variables at the end of a step."""
        return np.empty(0)

    def at(self, load_factor: float) -> Self:
        """Return the term at a load factor; most terms are the same at all of them."""
        return self

    @property
    def unknowns(self) -> Ints:
        """Degrees of freedom that each of the k pieces ties, (k, m); a row may list one twice."""
        return np.empty((0, 0), dtype=np.int64)

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the forces to those of the nodes (n, 3): internal forces, or external ones of a load."""

    def energy(self, position: Array) -> float:
        """Stored energy at positions (n, 3); zero for a load."""
        return 0.0

    def stresses(self, position: Array, update: Array) -> Array:
        """Stresses that enter the geometric stiffness, linearized for an update (n, 3); empty where there are none."""
        return np.empty(0)

    def continued(self, position: Array, update: Array, last: Array) -> Array:
        """`stresses`, where those before the update are known; a term may stay linear in the update."""
        return self.stresses(position, update)

    def correction(self, at: Configuration, stresses: Array) -> Array | None:
        """Forces (n, 3) beyond `add_forces`, where the tangent is that of stresses that are not those of the position.

        Newton's method adds them to the right side, so that its update solves one linear problem. None: no correction.
        """
        return None

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """Lower triangles of the symmetric tangents of all pieces, row by row, one piece after the other."""
        return np.empty(0)

    def unsymmetric(self, at: Configuration, size: int) -> sp.csc_matrix | None:
        """Tangent (size, size) of a few unknowns that has no potential, besides the others; None where there is none.

        The symmetric factors stay, and GMRES adds it; a few unknowns cost as many iterations.
        """
        return None

    def skew(self, at: Configuration) -> Array:
        """Skew parts (k, m, m) of the tangents; needed only where there is no potential."""
        return np.empty((0, 0, 0))


def lower(local: Array) -> Array:
    """Lower triangles of matrices (k, m, m), row by row."""
    rows, columns = np.tril_indices(local.shape[1])
    return np.asarray(local[:, rows, columns].ravel())


def displacements(nodes: Ints) -> Ints:
    """Degrees of freedom (k, 3 m) of the displacements of nodes (k, m)."""
    return (3 * nodes[:, :, None] + np.arange(3)).reshape(len(nodes), -1)


def add_at_nodes(out: Array, nodes: Ints, local: Array) -> None:
    """Add forces (k, m, 3) on nodes (k, m) to (n, 3)."""
    flat = nodes.ravel()
    for i in range(3):
        out[:, i] += np.bincount(flat, local[:, :, i].ravel(), minlength=len(out))
