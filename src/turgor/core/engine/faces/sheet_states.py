"""States of sheets: shrinkage, pre-stretch, swelling and temperature of a shell or a membrane.

With the stress-free stretch U of the loads on a sheet and E₀ = ½ (U² − 1) in its plane, the stress is ℂ : (E − E₀).
"""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces.membranes import Frames
from turgor.core.meshing.cells import side_type
from turgor.core.model.model import Model

Array = NDArray[np.float64]


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
