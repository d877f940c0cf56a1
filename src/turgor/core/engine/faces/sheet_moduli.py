"""Moduli of sheets in the frames of their surface: those of a woven sheet differ from point to point."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces.membranes import plane_stress_moduli
from turgor.core.engine.faces.settings import WARP
from turgor.core.materials.laws.laws import Hooke
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
