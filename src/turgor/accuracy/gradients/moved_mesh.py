"""Moved mesh: models of other dimensions on the tetrahedra of the state, which move along with the shape."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from turgor.accuracy.gradients.variation import Variation
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.meshing.generate import mesh_with
from turgor.core.meshing.generator_override import meshing_instead
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.moving.movable_mesh import MovableMesh, movable
from turgor.core.meshing.settings import MeshSettings
from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError


def on_moved_mesh(variation: Variation, mesh: Mesh) -> Variation:
    """Return a variation whose models have the cells of a mesh.

    Hexahedra are swept again in the same order. Tetrahedra that are generated again would be others, so those of the
    mesh are moved along with the CAD shape that a model generates its mesh of.

    Parameters
    ----------
    variation : Variation
    mesh : Mesh
        Of the state.

    Returns
    -------
    Variation
    """
    if mesh.cell_type is not TETRAHEDRON:
        return variation
    return replace(variation, model=OnMovedMesh(variation, mesh).model)


@dataclass(frozen=True, eq=False)
class OnMovedMesh:
    """A variation whose models have the cells of one mesh, moved along with the shape.

    Parameters
    ----------
    variation : Variation
    mesh : Mesh
    """

    variation: Variation
    mesh: Mesh

    def model(self, values: Mapping[str, float]) -> Model:
        """The model of values, on the moved mesh."""
        with meshing_instead(self._mesh_of):
            return self.variation.model(values)

    def _mesh_of(self, geometry: Geometry, settings: MeshSettings) -> Mesh:
        """The mesh of a geometry: the known one, moved; or a new one, if that has the same cells."""
        known = self._movable
        if isinstance(known, MovableMesh):
            return known.at(geometry)
        with meshing_instead(None):
            new = mesh_with(geometry, settings)
        if known is None or same_cells(self.mesh, new):
            return new
        raise known

    @cached_property
    def _movable(self) -> MovableMesh | TurgorError | None:
        """The mesh with the shape of the values in between; why it cannot move; None if it is made of several parts."""
        parts: list[Geometry] = []

        def known(geometry: Geometry, _: MeshSettings) -> Mesh:
            parts.append(geometry)
            return self.mesh

        with meshing_instead(known):
            mesh = self.variation.model(self.variation.values).mesh
        if len(parts) != 1 or not same_cells(self.mesh, mesh) or not np.array_equal(mesh.points, self.mesh.points):
            return None
        try:
            return movable(self.mesh, parts[0])
        except TurgorError as error:
            return error


def same_cells(known: Mesh, mesh: Mesh) -> bool:
    """Whether a mesh has the cells and faces of another one, whose nodes may be elsewhere.

    Parameters
    ----------
    known, mesh : Mesh

    Returns
    -------
    bool
    """
    if mesh is known:
        return True
    alike = mesh.points.shape == known.points.shape and np.array_equal(mesh.cells, known.cells)
    alike = alike and mesh.faces.keys() == known.faces.keys()
    return alike and all(np.array_equal(mesh.faces[face], known.faces[face]) for face in known.faces)
