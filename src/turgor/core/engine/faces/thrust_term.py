"""Thrust: the pressure in a cavity on the plane sections that cut through it, as on a closed end."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.sections import Section, plane_sections
from turgor.core.engine.faces import surfaces
from turgor.core.engine.faces.openings import mirror_point
from turgor.core.engine.faces.pressure_term import PressureTerm, pressure_terms
from turgor.core.engine.term import Configuration, Setting, Term, displacements, lower

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: ∫ Nᵃ dNᵇ − Nᵇ dNᵃ along an edge with nodes at its ends and its middle: ½ xᵀ A y is the area that it sweeps.
SWEPT = np.array([[0.0, -1.0, 4.0], [1.0, 0.0, -4.0], [-4.0, 4.0, 0.0]]) / 3


@dataclass(frozen=True, slots=True, eq=False)
class ThrustTerm(Term):
    """The force of a pressure on the opening in a plane section.

    The rim of the opening stays in the plane, so that the work of the thrust and of the pressure on the walls together
    is the pressure times the change of the volume: the sum has a potential, whose second derivative is the sum of the
    symmetric parts of both tangents.

    Parameters
    ----------
    pressure : PressureTerm
        On the walls.
    edges : (e, 3) int array
        Rim of the walls in the section, each edge in the direction in which its side has it.
    section : Section
    origin : (3,) array
        A point on the mirror planes or the axis of a wedge, so that an opening that they cut is measured from there.
    """

    couples = True
    external = True

    pressure: PressureTerm
    edges: Ints
    section: Section
    origin: Array

    @property
    def place(self) -> int:
        """Place among the unknown pressures."""
        return self.pressure.place

    @property
    def unknowns(self) -> Ints:
        """Displacements of the leader and of each edge."""
        leaders = np.full((len(self.edges), 1), self.section.leader)
        return displacements(np.concatenate([leaders, self.edges], axis=1))

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the pressure times the area of the opening, at the leader."""
        out[self.section.leader, self.section.axis] += self.pressure.acting(at) * self._area(at.position)

    def unit_forces(self, position: Array) -> Array:
        """External forces (n, 3) of a scaled pressure of one."""
        out = np.zeros_like(position)
        out[self.section.leader, self.section.axis] = self._area(position)
        return out

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """Symmetric part."""
        b, c = self._across
        x, y = self._in_plane(at.position)
        by_edge = np.zeros((len(self.edges), 3, 3))
        by_edge[:, :, b], by_edge[:, :, c] = 0.5 * y @ SWEPT.T, 0.5 * x @ SWEPT
        local = np.zeros((len(self.edges), 12, 12))
        axis = self.section.axis
        local[:, 3:, axis] = local[:, axis, 3:] = -0.5 * self.pressure.acting(at) * by_edge.reshape(-1, 9)
        return lower(local)

    @property
    def _across(self) -> tuple[int, int]:
        return (self.section.axis + 1) % 3, (self.section.axis + 2) % 3

    def _in_plane(self, position: Array) -> tuple[Array, Array]:
        b, c = self._across
        corners = position[self.edges] - self.origin
        return corners[:, :, b], corners[:, :, c]

    def _area(self, position: Array) -> float:
        """Area of the opening, positive where the thrust is along the axis."""
        x, y = self._in_plane(position)
        return 0.5 * float(np.einsum("ea,ab,eb->", x, SWEPT, y))


def thrust_terms(setting: Setting) -> list[ThrustTerm]:
    """The thrust on every plane section of every pressure on walls that it cuts through."""
    terms = []
    sections = plane_sections(setting.model)
    for term in pressure_terms(setting) if sections else ():
        rim = surfaces.rim_edges(term.sides)
        for section in sections:
            edges = rim[np.isin(rim, section.nodes).all(axis=1)]
            if len(edges):
                terms.append(ThrustTerm(term, edges, section, mirror_point(setting.model.mesh) / setting.length))
    return terms
