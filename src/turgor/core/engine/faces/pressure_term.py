"""Pressure on faces: follower forces along the deformed normals."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import side_tables
from turgor.core.engine.faces import surfaces
from turgor.core.engine.term import Configuration, Setting, Term, add_at_nodes, displacements, lower
from turgor.core.model.history import History
from turgor.core.model.loads import Pressure

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


class FollowerTerm(Term):
    """Pressure on ``sides`` along their deformed normals; ``potential``: they are closed, or their rim is fixed."""

    __slots__ = ()

    external = True

    sides: Ints
    potential: bool

    @property
    def unknowns(self) -> Ints:
        """Displacements of the sides."""
        return displacements(self.sides)

    @property
    def symmetric(self) -> bool:
        """Whether there is a potential."""
        return self.potential

    def _tangents(self, at: Configuration) -> Array:
        """Tangent of each side, of which the symmetric part alone remains where there is a potential."""
        raise NotImplementedError

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """Symmetric part."""
        local = self._tangents(at)
        return lower(0.5 * (local + local.transpose(0, 2, 1)))

    def skew(self, at: Configuration) -> Array:
        """Skew part, of pressure on open faces."""
        local = self._tangents(at)
        return np.asarray(0.5 * (local - local.transpose(0, 2, 1)))


@dataclass(frozen=True, slots=True, eq=False)
class PressureTerm(FollowerTerm):
    """Faces under the same pressure.

    Parameters
    ----------
    sides : (f, n) int array
        Nodes of the sides.
    load : Pressure or None
        The load of one of them; None where the pressure is unknown.
    place : int
        Place among the unknown pressures.
    stress : float [Pa]
        Scale.
    potential : bool
        Whether the pressure has a potential: the faces are closed, or their rim is fixed.
    """

    sides: Ints
    load: Pressure | None
    place: int
    stress: float
    potential: bool

    def acting(self, at: Configuration) -> float:
        """Scaled pressure that acts."""
        if self.load is None:
            return 0.0 if at.unknown_pressures is None else float(at.unknown_pressures[self.place])
        return self.load.share(at.load_factor) * (self.load.pressure / self.stress)

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the pressure times the deformed areas, against the normals."""
        add_at_nodes(out, self.sides, -self.acting(at) * self._unit(at.position))

    def unit_forces(self, position: Array) -> Array:
        """External forces (n, 3) of a scaled pressure of one."""
        out = np.zeros_like(position)
        add_at_nodes(out, self.sides, -self._unit(position))
        return out

    def _unit(self, position: Array) -> Array:
        return np.asarray(surfaces.pressure_forces(position, self.sides, *self._tables))

    @property
    def _tables(self) -> tuple[Array, Array, Array]:
        reference = side_tables(self.sides.shape[1])
        return reference.N, reference.dN, np.tile(reference.weights, (len(self.sides), 1))

    def _tangents(self, at: Configuration) -> Array:
        local = np.asarray(surfaces.pressure_tangents(at.position, self.sides, *self._tables))
        local *= self.acting(at)
        return local


def pressure_terms(setting: Setting) -> list[PressureTerm]:
    """Unknown pressures first, in their order; then faces under equal pressure at all times, joined.

    Together they may be closed where each alone is open.
    """
    mesh, model, terms = setting.model.mesh, setting.model, []
    leaders = mesh.leaders  # where the cut faces of a wedge are joined, a surface goes on
    for place, name in enumerate(setting.controlled):
        sides = mesh.carrying_sides(name)
        potential = surfaces.has_potential(setting.points, leaders[sides], setting.prescribed)
        terms.append(PressureTerm(sides, None, place, setting.stress, potential))
    alike: dict[tuple[float, History], list[Pressure]] = {}
    for load in model.pressures:
        if load.face not in setting.controlled:
            alike.setdefault((load.pressure, load.history), []).append(load)
    for loads in alike.values():
        sides = np.ascontiguousarray(np.concatenate([mesh.carrying_sides(load.face) for load in loads]))
        potential = surfaces.has_potential(setting.points, leaders[sides], setting.prescribed)
        terms.append(PressureTerm(sides, loads[0], -1, setting.stress, potential))
    return terms
