"""Cavities: the volume that their faces enclose in a state."""

from collections.abc import Sequence

import numpy as np

from turgor.core.engine.faces import surfaces
from turgor.core.engine.faces.openings import mirror_point
from turgor.core.meshing.openings import find_rims, torn_rims
from turgor.core.meshing.surface import rim_edges
from turgor.core.results.fields.state_fields import StateFields
from turgor.foundation.errors import TurgorError


def enclosed_volume(at: StateFields, names: Sequence[str]) -> float:
    """Return the current volume that named faces enclose together, in the whole actuator.

    Parameters
    ----------
    at : StateFields
    names : sequence of str
        Faces of one or several cavities.

    Returns
    -------
    float [m³]

    Raises
    ------
    TurgorError
        If a face is unknown, or the faces lie open off the mirror planes elsewhere than at a plane opening.
    """
    triangles = np.unique(np.concatenate([at.mesh.face(name) for name in names]), axis=0)
    points = at.points - mirror_point(at.mesh)  # what is cut at planes and axes through the origin adds nothing
    rim = rim_edges(triangles)
    torn = torn_rims(at.mesh, at.facts.surface, rim) if find_rims(at.mesh, rim) else ()
    if torn:
        count = sum(each.edges for each in torn)
        raise TurgorError(
            f"{', '.join(names)} encloses no volume: {count} edges lie open, off any mirror plane; "
            "close the inlet or name all walls of the cavity."
        )
    # normals point out of the solid, which is into the cavity
    return -at.mesh.symmetry_factor * surfaces.enclosed_volume(points, triangles, at.mesh)
