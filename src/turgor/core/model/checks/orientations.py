"""Check that a modeled part of a body with directions is a part of a whole with the same directions."""

from math import isclose

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.laws.laws import Woven
from turgor.core.materials.material import Material
from turgor.core.materials.oriented import families_at
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.sheets import Sheet
from turgor.foundation.errors import TurgorError
from turgor.foundation.symmetric import PAIRS

Array = NDArray[np.float64]

#: How far a tensor of fibers may be from its mirror image: they have components up to 1.
_ALIKE = 1e-6

_WHOLE = "mesh the whole body: symmetric = false of an actuator, symmetry = 'none' of a part."


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
                f"mirror plane normal to {'xyz'[axis]}; {_WHOLE}"
            )


def check_woven(mesh: Mesh, name: str, sheet: Sheet) -> None:
    """Refuse a woven sheet that is not its own mirror image, or whose part the mesh repeats about an axis.

    The image of a warp along or across the mirror plane is the same; so is that of a warp at 45° where warp and weft
    are as stiff, which then change places.

    Parameters
    ----------
    mesh : Mesh
    name : str
        Face of the sheet.
    sheet : Shell or Membrane
    """
    law = sheet.material.law
    if sheet.warp is None or not isinstance(law, Woven):
        return
    warp = np.array(sheet.warp) / np.linalg.norm(sheet.warp)
    what = f"materials.{name}: the warp {sheet.warp} of '{sheet.material.name}'"
    axis = mesh.revolved or ("" if mesh.wedge is None else mesh.wedge.axis)
    if axis and abs(warp["xyz".index(axis)]) < 1 - _ALIKE:
        raise TurgorError(f"{what} is not along {axis}, about which the mesh is a part of the whole; {_WHOLE}")
    a, b, c = mesh.points[mesh.face(name)[:, :3].T]
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    for across, _ in mesh.mirror_planes:
        image = warp.copy()
        image[across] *= -1
        crossed = np.abs(warp @ image - (normals @ warp) * (normals @ image)).max() < _ALIKE
        if abs(warp @ image) < 1 - _ALIKE and not (crossed and isclose(law.E, law.E_weft)):
            raise TurgorError(
                f"{what} is not its own mirror image across the mirror plane normal to {'xyz'[across]}; turn it, or "
                f"{_WHOLE}"
            )


def _mirrored(H: Array, axis: int) -> Array:
    signs = np.array([(-1.0) ** ((i == axis) + (j == axis)) for i, j in PAIRS])
    return H * signs
