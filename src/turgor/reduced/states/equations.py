"""Equations: equilibrium of a reduced model, its tangent, and how loads follow from the inputs.

Unknowns are the coordinates q of the displacement modes and s of the mean stress modes. Equilibrium is

    Σ gₚ(q) + Σ sₖ ∂cₖ/∂q = Σ pressureᵢ ∂Vᵢ/∂q + force,        cₖ(q) = Σ Cₖₗ sₗ

with the forces g of the parts (sampled rubber, sheets, contact), constraints c and volumes V. All numbers are scaled.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from turgor.reduced.parts.moments import Moments, MomentsAt
from turgor.reduced.parts.obstacles import Obstructing, ObstructingAt
from turgor.reduced.parts.polynomials import Cubics, CubicsAt

Array = NDArray[np.float64]


class PartAt(Protocol):
    """What a part of the equations does at some coordinates."""

    def forces(self) -> Array:
        """Forces (r,)."""

    def tangent(self, geometric: Array | None) -> Array:
        """Tangent (r, r), with given stresses in its geometric part."""

    def linearized(self, update: Array) -> Array | None:
        """Stresses linearized for an update (r,), for the next geometric part; None where there are none."""


class Part(Protocol):
    """A part of the equations."""

    def at(self, q: Array) -> PartAt | None:
        """Evaluate at coordinates (r,); None where that is impossible, as where a point is turned inside out."""


@dataclass(frozen=True, slots=True, eq=False)
class Equations:
    """Equilibrium in reduced coordinates.

    Parameters
    ----------
    parts : tuple of Part
    cubics : Cubics
        Volumes of the cavities first, then the constraint of each mean stress mode.
    pressures : (k, n) array
        Pressure of each cavity by the inputs, the share of the fixed loads first.
    forces : (r, n) array
        Dead forces by the same inputs.
    compliance : (m, m) array
        C, zero for incompressible rubber.
    moments : Moments or None
        Of the lost volume of hexahedra.
    obstacles : tuple of Obstructing
    """

    parts: tuple[Part, ...]
    cubics: Cubics
    pressures: Array
    forces: Array
    compliance: Array
    moments: Moments | None = None
    obstacles: tuple[Obstructing, ...] = ()

    @property
    def sizes(self) -> tuple[int, int]:
        """Numbers of displacement and of mean stress modes."""
        return len(self.forces), len(self.compliance)

    def at(self, y: Array, inputs: Array) -> "EquationsAt | None":
        """Evaluate at unknowns (r + m,) and inputs (n,); None where a part cannot."""
        q = y[: len(self.forces)]
        ats: list[PartAt] = []
        for part in self.parts:
            at = part.at(q)
            if at is None:
                return None
            ats.append(at)
        ats += [obstacle.at(q, inputs) for obstacle in self.obstacles]
        moments = None if self.moments is None else self.moments.at(y)
        return EquationsAt(self, y, inputs, tuple(ats), self.cubics.at(q), moments)


@dataclass(frozen=True, slots=True, eq=False)
class EquationsAt:
    """The equations at some unknowns and inputs."""

    equations: Equations
    y: Array
    inputs: Array
    parts: tuple[PartAt, ...]
    cubics: CubicsAt
    moments: MomentsAt | None

    @property
    def factors(self) -> Array:
        """Factors of the cubic polynomials in the energy: minus the pressures, then the mean stresses."""
        of_cavities = -(self.equations.pressures @ self.inputs)
        return np.concatenate([of_cavities, self.y[len(self.equations.forces) :]])

    @property
    def loads(self) -> Array:
        """Forces (r,) of pressures and dead loads."""
        e = self.equations
        return np.asarray(
            (e.pressures @ self.inputs) @ self.cubics.gradients[: len(e.pressures)] + e.forces @ self.inputs
        )

    @property
    def residual(self) -> Array:
        """Residual (r + m,)."""
        e, r = self.equations, len(self.equations.forces)
        out = np.empty(len(self.y))
        out[:r] = self.factors @ self.cubics.gradients - e.forces @ self.inputs
        for part in self.parts:
            out[:r] += part.forces()
        out[r:] = self.cubics.values[len(e.pressures) :] - e.compliance @ self.y[r:]
        return out if self.moments is None else out + self.moments.forces()

    def tangent(self, geometric: Sequence[Array | None] | None = None) -> Array:
        """Tangent (r + m, r + m), with given stresses of the parts in the geometric part."""
        e, r = self.equations, len(self.equations.forces)
        out = np.empty((len(self.y), len(self.y)))
        out[:r, :r] = self.cubics.hessian(self.factors)
        for place, part in enumerate(self.parts):
            out[:r, :r] += part.tangent(None if geometric is None else geometric[place])
        rows = self.cubics.gradients[len(e.pressures) :]
        out[r:, :r], out[:r, r:], out[r:, r:] = rows, rows.T, -e.compliance
        if self.moments is not None:
            out += self.moments.tangent(None if geometric is None else geometric[-1])
        return out

    def linearized(self, update: Array) -> list[Array | None]:
        """Stresses of the parts linearized for an update (r + m,), then the moments."""
        out = [part.linearized(update[: len(self.equations.forces)]) for part in self.parts]
        return out if self.moments is None else [*out, self.moments.linearized(update)]

    def by_inputs(self) -> Array:
        """Derivative (r + m, n) of the residual by the inputs."""
        e, r = self.equations, len(self.equations.forces)
        out = np.zeros((len(self.y), len(self.inputs)))
        out[:r] = -(self.cubics.gradients[: len(e.pressures)].T @ e.pressures) - e.forces
        out[:r] += sum(obstacle.by_inputs() for obstacle in self.obstacles)
        return out

    @property
    def obstacles(self) -> tuple[ObstructingAt, ...]:
        """What the obstacles do."""
        return tuple(part for part in self.parts if isinstance(part, ObstructingAt))


def unstable_modes(tangent: Array, r: int) -> int:
    """Directions in which the energy falls and that the constraints allow, of a tangent (r + m, r + m).

    Examples
    --------
    >>> unstable_modes(np.diag([2.0, -1.0]), 2)
    1
    >>> unstable_modes(np.array([[2.0, 0.0, 0.0], [0.0, -1.0, 1.0], [0.0, 1.0, 0.0]]), 2)  # fixed by a constraint
    0
    """
    values = np.linalg.eigvalsh(0.5 * (tangent + tangent.T))
    return max(0, int((values < 0).sum()) - (len(tangent) - r))
