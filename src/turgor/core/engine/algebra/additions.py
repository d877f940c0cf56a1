"""Additions: forces besides those of rubber, faces and loads, such as inertia, that `System` adds to its equations."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.pattern import Pattern

Array = NDArray[np.float64]


class Addition(Protocol):
    """Scaled forces that depend on the unknowns, and their derivative on the pattern of the tangent.

    `System.evaluate` takes them and adds them to its residual, `System.tangent_data` to its tangent. Forces are along
    the directions of the nodes, as the unknowns are, and zero at the mean stresses.
    """

    def forces(self, unknowns: Array) -> Array:
        """Forces (size,), internal ones positive."""

    def data(self, unknowns: Array) -> Array:
        """Lower triangle (nnz,) of the symmetric derivative, before supports are applied."""


@dataclass(frozen=True, slots=True, eq=False)
class Linear:
    """Forces K x + f.

    Parameters
    ----------
    pattern : Pattern
    matrix : (nnz,) array
        Lower triangle of K.
    constant : (size,) array
        f.
    """

    pattern: Pattern
    matrix: Array
    constant: Array

    def forces(self, unknowns: Array) -> Array:
        """K x + f."""
        return self.pattern.product(self.matrix, unknowns) + self.constant

    def data(self, unknowns: Array) -> Array:
        """K."""
        return self.matrix


@dataclass(frozen=True, slots=True, eq=False)
class Together:
    """The sum of several additions."""

    parts: Sequence[Addition]

    def forces(self, unknowns: Array) -> Array:
        """Sum of the forces."""
        return np.sum([part.forces(unknowns) for part in self.parts], axis=0)

    def data(self, unknowns: Array) -> Array:
        """Sum of the derivatives."""
        return np.sum([part.data(unknowns) for part in self.parts], axis=0)
