"""Stiffness of a section: how its forces change with the strains of the rod, and with the pressures in its cavities."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.fast_models.section.equations import Equations
from turgor.fast_models.section.path import Point

Array = NDArray[np.float64]

#: Strains of the rod, and the forces that work on them, in the order of the stiffness.
STRAIN_NAMES = ("stretch", "twist", "curvature_y", "curvature_z")
FORCE_NAMES = ("axial_force", "torque", "moment_y", "moment_z")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SectionStiffness:
    """Stiffness of a section at a state, for a rod model; the section is free to warp.

    Parameters
    ----------
    matrix : (4, 4) array [N, Nm, Nm²]
        Derivatives of axial force, torque and moments about y and z by stretch, twist and curvatures about y and z, in
        that order, at constant pressures. The curvatures are rotations per reference length.
    by_pressure : (4, k) array [m², m³]
        Derivatives of these forces by the pressure in each cavity, at constant strains: minus the area and the first
        moments of the cavity on closed ends, and what the wall takes over.
    strains : (4,) array [-, 1/m]
        Where the rod is.
    forces : (4,) array [N, Nm]
        What acts on the rod there, besides the pressures.
    point : (3,) array [m]
        Point of the section at rest that the reference line passes through: stretch and axial force belong to it.
    """

    matrix: Array
    by_pressure: Array
    strains: Array
    forces: Array
    point: Array

    @property
    def axial(self) -> float:
        """Axial force for each unit of stretch [N] at fixed curvatures and twist."""
        return float(self.matrix[0, 0])

    @property
    def bending(self) -> tuple[float, float]:
        """Bending stiffness about y and z [Nm²] of a rod whose axial force and torque stay as they are."""
        stiffnesses = []
        for i, others in ((2, [0, 1, 3]), (3, [0, 1, 2])):
            K, free = self.matrix, self._free(others)
            taken = K[i, free] @ np.linalg.solve(K[np.ix_(free, free)], K[free, i]) if free else 0.0
            stiffnesses.append(float(K[i, i] - taken))
        return stiffnesses[0], stiffnesses[1]

    def _free(self, others: list[int]) -> list[int]:
        """Strains that mirror planes do not hold."""
        return [i for i in others if self.matrix[i, i] != 0.0]


def stiffness_of(equations: Equations, point: Point) -> SectionStiffness:
    """Condense the tangent at a point of a path to the strains of the rod.

    Strains that a mirror plane keeps at rest have zeros in their rows and columns.
    """
    numbers, plane = equations.numbers, equations.plane
    S, behind, _ = equations.condensed(point.equations)
    own = numbers.strains
    others = np.setdiff1d(np.arange(len(S)), own)
    by_pressure = np.zeros((len(S), len(equations.cavities)))
    core, border = numbers.core >= 0, numbers.border >= 0
    for k, gradient in enumerate(equations.volume_gradients(point.unknowns)):
        by_pressure[:, k] = -gradient[border] - behind.T @ -gradient[core]
    taken = np.linalg.solve(S[np.ix_(others, others)], np.hstack([S[np.ix_(others, own)], by_pressure[others]]))
    matrix = S[np.ix_(own, own)] - S[np.ix_(own, others)] @ taken[:, :4]
    pushed = by_pressure[own] - S[np.ix_(own, others)] @ taken[:, 4:]
    for i in numbers.fixed:
        matrix[i], matrix[:, i], pushed[i] = 0.0, 0.0, 0.0
    force, strain = scales(equations)
    return SectionStiffness(
        matrix=matrix * np.outer(force, 1 / strain),
        by_pressure=pushed * force[:, None] / equations.stress,
        strains=point.unknowns.strains * strain,
        forces=forces_of(equations, point),
        point=plane.origin,
    )


def scales(equations: Equations) -> tuple[Array, Array]:
    """Units of scaled forces and strains: [N, Nm] of the whole section, and [-, 1/m]."""
    length = equations.plane.length
    force = equations.copies * equations.stress * length**2 * np.array([1.0, length, length, length])
    return force, np.array([1.0, 1 / length, 1 / length, 1 / length])


def forces_of(equations: Equations, point: Point) -> Array:
    """Axial force, torque and moments (4,) that act on the section: given ones, and those that hold strains."""
    first = equations.numbers.first_strain
    acting = point.equations.residual[first : first + 4] + point.question.forces
    acting[list(equations.numbers.fixed)] = 0.0
    return np.asarray(acting * scales(equations)[0])
