"""CentrifugalTerm: the force on a mass that turns about an axis, which grows with its distance from the axis."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.element import element_of
from turgor.core.engine.cells.reference import side_tables
from turgor.core.engine.faces.dead_loads import cell_density
from turgor.core.engine.term import Configuration, Setting, Term, add_at_nodes, displacements
from turgor.core.model.history import share_at
from turgor.core.model.loads.centrifugal import Centrifugal
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class CentrifugalTerm(Term):
    """Force ω² M P (x − c), with the consistent mass M, and P across the axis through c.

    Parameters
    ----------
    load : Centrifugal
    nodes : (k, n) int array
        Nodes of the pieces: cells, or sides of sheets.
    masses : (k, n, n) array
        Scaled mass matrices times ω².
    center : (3,) array
        Scaled point of the axis.
    """

    load: Centrifugal
    nodes: Ints
    masses: Array
    center: Array

    external = True

    @property
    def unknowns(self) -> Ints:
        """Displacements of the pieces."""
        return displacements(self.nodes)

    @property
    def _across(self) -> Array:
        """The projection across the axis, (3, 3)."""
        return np.eye(3) - np.outer(self.load.along, self.load.along)

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the forces at the positions."""
        arms = (at.position[self.nodes] - self.center) @ self._across
        share = share_at(self.load.history, at.load_factor)
        add_at_nodes(out, self.nodes, share * np.einsum("kab,kbi->kai", self.masses, arms))

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """What the forces grow by, against the stiffness."""
        rows, columns = np.tril_indices(3 * self.nodes.shape[1])
        share = share_at(self.load.history, at.load_factor)
        along = self._across[rows % 3, columns % 3]
        return np.asarray((-share * self.masses[:, rows // 3, columns // 3] * along).ravel())


def centrifugal_terms(setting: Setting) -> list[CentrifugalTerm]:
    """One for the cells and one for each sheet with a density, for each speed."""
    loads = [each for load in setting.model.loads if (each := load.spinning) is not None]
    if loads and any(point.mass for point in setting.model.points.values()):
        raise TurgorError("a centrifugal force has no form for masses of reference points; leave one of them out.")
    return [
        CentrifugalTerm(load, nodes, masses * load.speed**2, np.array(load.through) / setting.length)
        for load in loads
        for nodes, masses in _masses(setting)
    ]


def _masses(setting: Setting) -> Iterator[tuple[Ints, Array]]:
    """Nodes and scaled mass matrices of cells and of sheets, for a scaled acceleration in units of length per s²."""
    model, element = setting.model, element_of(setting.model)
    if len(model.mesh.cells):
        weights = cell_density(model)[:, None] * setting.dV * (setting.length**2 / setting.stress)
        N = element.tables.N
        yield element.cells, np.einsum("cq,qa,qb->cab", weights, N, N, optimize=True)
    for name, mass in model.sheet_masses.items():
        sides = model.mesh.carrying_sides(name)
        table = side_tables(sides.shape[1])
        tangents = np.einsum("qad,fai->fqid", table.dN, setting.points[sides])
        area = np.linalg.norm(np.cross(tangents[..., 0], tangents[..., 1]), axis=2) * table.weights
        weights = area * (mass * setting.length / setting.stress)
        yield sides, np.einsum("fq,qa,qb->fab", weights, table.N, table.N, optimize=True)
