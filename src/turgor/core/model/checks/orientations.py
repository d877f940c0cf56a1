"""Check that a modeled part of a body with directions is a part of a whole with the same directions."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.material import Material
from turgor.core.materials.oriented import families_at
from turgor.core.meshing.mesh import Mesh
from turgor.foundation.errors import TurgorError
from turgor.foundation.symmetric import PAIRS

Array = NDArray[np.float64]

#: How far a tensor of fibers may be from its mirror image: they have components up to 1.
_ALIKE = 1e-6


def check_oriented(mesh: Mesh, name: str, material: Material) -> None:
    """Refuse a region whose fibers are not their own mirror image, or whose part the mesh repeats about an axis.

    Parameters
    ----------
    mesh : Mesh
    name : str
        Of the region.
    material : Material
    """
    orientation = material.orientation
    if orientation is None:
        return
    cells = mesh.cells[mesh.regions[name]]
    X = mesh.points[cells[:, : mesh.cell_type.corners]].mean(axis=1)
    if any(np.isnan(H).any() for _, H in families_at(material, X)):
        raise TurgorError(f"materials.{name}: the axis of the orientation of '{material.name}' passes through a cell.")
    turned = mesh.wedge is not None or bool(mesh.revolved)
    if turned and orientation.around is None:
        raise TurgorError(
            f"materials.{name}: '{material.name}' has straight directions, and the mesh is a part that is repeated "
            "about an axis; take the whole body, or directions around an axis."
        )
    for axis, place in mesh.mirror_planes:
        image = X.copy()
        image[:, axis] = 2 * place - image[:, axis]
        own = [H for _, H in families_at(material, X)]
        others = [_mirrored(H, axis) for _, H in families_at(material, image)]
        if any(min(np.abs(H - each).max() for each in others) > _ALIKE for H in own):
            raise TurgorError(
                f"materials.{name}: the directions of '{material.name}' are not their own mirror image across the "
                f"mirror plane normal to {'xyz'[axis]}; mesh the whole body: symmetric = false of an actuator, "
                "symmetry = 'none' of a part."
            )


def _mirrored(H: Array, axis: int) -> Array:
    signs = np.array([(-1.0) ** ((i == axis) + (j == axis)) for i, j in PAIRS])
    return H * signs
