"""FoundationTerm: faces on springs, along the normals that they have at rest and across them."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import side_tables
from turgor.core.engine.term import Configuration, Setting, Term, add_at_nodes, displacements, lower
from turgor.core.model.model import Model

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class FoundationTerm(Term):
    """½ ∫ kₙ (u·N)² + kₜ |u − (u·N) N|² dA over the area at rest, of displacements u and normals N at rest.

    Parameters
    ----------
    sides : (f, n) int array
        Nodes of the sides of one face.
    rest : (n, 3) array
        Scaled positions at rest.
    normal, tangential : float
        Scaled stiffness per area.
    """

    sides: Ints
    rest: Array
    normal: float
    tangential: float

    @property
    def unknowns(self) -> Ints:
        """Displacements of the sides."""
        return displacements(self.sides)

    @cached_property
    def _stiffness(self) -> Array:
        """Constant stiffness (f, n, 3, n, 3) of the sides."""
        reference = side_tables(self.sides.shape[1])
        tangents = np.einsum("qad,fai->fqid", reference.dN, self.rest[self.sides])
        areas = np.cross(tangents[..., 0], tangents[..., 1])
        size = np.linalg.norm(areas, axis=2)
        along = np.einsum("fqi,fqj->fqij", areas, areas) / (size**2)[..., None, None]
        springs = self.tangential * np.eye(3) + (self.normal - self.tangential) * along
        return np.asarray(
            np.einsum(
                "fq,q,qa,qb,fqij->faibj", size, reference.weights, reference.N, reference.N, springs, optimize=True
            )
        )

    def _forces(self, position: Array) -> Array:
        moved = (position - self.rest)[self.sides]
        return np.asarray(np.einsum("faibj,fbj->fai", self._stiffness, moved, optimize=True))

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the forces of the springs."""
        add_at_nodes(out, self.sides, self._forces(at.position))

    def energy(self, position: Array) -> float:
        """Energy of the springs."""
        return 0.5 * float(((position - self.rest)[self.sides] * self._forces(position)).sum())

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """The constant stiffness."""
        count = 3 * self.sides.shape[1]
        return lower(self._stiffness.reshape(len(self.sides), count, count))


def foundation_terms(setting: Setting) -> list[FoundationTerm]:
    """One for each face on springs."""
    scale = setting.length / setting.stress
    return [
        FoundationTerm(
            setting.model.mesh.carrying_sides(support.place), setting.points, *(scale * k for k in support.bedding)
        )
        for support in setting.model.supports
        if any(support.bedding)
    ]


def foundation_force(model: Model, displacement: Array) -> Array:
    """Sum of the forces of the springs on the modeled part, (3,) [N].

    Parameters
    ----------
    model : Model
    displacement : (n, 3) array [m]
    """
    total, rest = np.zeros(3), model.mesh.points
    for support in model.supports:
        if any(support.bedding):
            term = FoundationTerm(model.mesh.carrying_sides(support.place), rest, *support.bedding)
            total -= term._forces(rest + displacement).sum(axis=(0, 1))
    return total
