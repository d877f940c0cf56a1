"""Moduli of sheets in the frames of their surface, and what states before loading take from their stress.

The moduli of a woven sheet differ from point to point. With the stress-free stretch U of the loads on a sheet and
E₀ = ½ (U² − 1) in its plane, the stress is ℂ : (E − E₀).
"""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces.membranes import Frames, plane_stress_moduli
from turgor.core.engine.faces.settings import WARP
from turgor.core.materials.laws.laws import Hooke
from turgor.core.meshing.cells import side_type
from turgor.core.model.model import Model
from turgor.core.model.sheets import Sheet
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


def sheet_moduli(sheet: Sheet, e1: Array, e2: Array) -> Array:
    """Find the plane-stress moduli of a sheet in frames of its surface [Pa].

    Parameters
    ----------
    sheet : Shell or Membrane
    e1, e2 : (..., 3) arrays
        Orthonormal directions in the surface at rest.

    Returns
    -------
    (3, 3) or (..., 3, 3) array
        Between strains 11, 22, twice 12 and stresses; one for each frame where the sheet is woven. The direction of the
        warp is that of the sheet without its part across the surface.
    """
    assert isinstance(sheet.material.law, Hooke)
    moduli = plane_stress_moduli(sheet.material.law)
    if sheet.warp is None:
        return moduli
    warp = np.array(sheet.warp) / np.linalg.norm(sheet.warp)
    along, across = e1 @ warp, e2 @ warp
    size = np.hypot(along, across)
    if size.min() < WARP.least_share:
        raise TurgorError(
            f"warp {sheet.warp} of '{sheet.material.name}' stands across a part of its face, where it says nothing; "
            "give a direction along the face, or split the face."
        )
    turn = strain_turn(along / size, across / size)
    return np.asarray(np.swapaxes(turn, -1, -2) @ moduli @ turn)


def strain_turn(c: Array, s: Array) -> Array:
    """Matrices (..., 3, 3) that turn strains 11, 22, twice 12 into axes at an angle of cosine c and sine s (...)."""
    rows = [[c * c, s * s, c * s], [s * s, c * c, -c * s], [-2 * c * s, 2 * c * s, c * c - s * s]]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def has_state(model: Model, name: str) -> bool:
    """Whether a load is a state of the sheet on a face."""
    return any(load.place == name for load in model.states_of(name))


def free_stress(model: Model, name: str, at: tuple[Frames, Array], load_factor: float) -> Array:
    """Compute what the stress of a sheet is short of that of its strain, because its states change its length.

    Parameters
    ----------
    model : Model
    name : str
        Face of the sheet.
    at : (Frames, array)
        Where it is integrated, and its moduli, (3, 3) or (f, q, 3, 3).
    load_factor : float

    Returns
    -------
    (f, q, 3) array
        ℂ : E₀ in the unit of the moduli. States are read at the middle of each side.
    """
    frames, moduli = at
    sides = model.mesh.face(name)
    places = model.mesh.points[sides[:, : side_type(sides.shape[1]).corners]].mean(axis=1)[:, None]
    total = np.zeros((len(sides), 1, 3, 3))
    for load in model.states_of(name):
        log = load.log_stretch(places, load_factor)
        total = total if log is None else total + log
    values, vectors = np.linalg.eigh(total)
    strain = np.einsum("fqik,fqk,fqjk->fqij", vectors, 0.5 * np.expm1(2 * values), vectors)
    e = np.stack([frames.e1, frames.e2], axis=-2)
    plane = np.einsum("fqai,fpij,fqbj->fqab", e, strain, e)
    rows = np.stack([plane[..., 0, 0], plane[..., 1, 1], 2 * plane[..., 0, 1]], axis=-1)
    return np.ascontiguousarray((moduli @ rows[..., None])[..., 0])
