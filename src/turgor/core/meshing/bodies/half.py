"""Half of a mesh: the cells on one side of a mirror plane, which becomes a face."""

from dataclasses import replace

import numpy as np

from turgor.core.meshing.bodies.placing import refuse_wedge
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import outer_triangles
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm

#: How much farther one side of a mirror plane may reach than the other, as a share of the whole width.
UNLIKE = 0.01


def half_of(mesh: Mesh, axis: str) -> Mesh:
    """Return the half of a mesh at positive x, y or z, with the face ``symmetry_x``, ``symmetry_y`` or ``symmetry_z``.

    Sides of cells must lie on the mirror plane through the origin, as a generator puts them if the part is built of
    two halves: no cell is cut.

    Parameters
    ----------
    mesh : Mesh
    axis : str
        The normal of the mirror plane: ``"x"``, ``"y"`` or ``"z"``.

    Returns
    -------
    Mesh
        Faces, regions and node sets without a part in this half are gone.

    Raises
    ------
    TurgorError
        If cells reach across the plane, or the part does not reach as far on one side as on the other.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.generate import mesh
    >>> half_of(mesh(FastPneuNet(chambers=1, length=10e-3).build(), size=4e-3), "x")
    Traceback (most recent call last):
    turgor.TurgorError: 'fast PneuNet, 1 chamber, half' has no mirror plane x = 0: it reaches from 0 to 10 mm along \
x; move the plane to 0.
    """
    if axis not in ("x", "y", "z"):
        raise unknown("normal of a mirror plane", axis, ("x", "y", "z"))
    refuse_wedge(mesh)
    number, name = "xyz".index(axis), f"symmetry_{axis}"
    slack = ROUND_OFF.mesh_digits * float(np.ptp(mesh.points, axis=0).max())
    at = np.where(np.abs(mesh.points[:, number]) <= slack, 0.0, mesh.points[:, number])
    low, high = (at[mesh.cells].min(axis=1), at[mesh.cells].max(axis=1))
    across = int(((low < 0) & (high > 0)).sum())
    if across or abs(at.max() + at.min()) > UNLIKE * np.ptp(at):
        what = (
            f"{across} of {len(mesh.cells)} cells reach across it, and no cell is cut; mesh the part with sides on it"
            if across
            else f"it reaches from {at.min() / mm:.4g} to {at.max() / mm:.4g} mm along {axis}; move the plane to 0"
        )
        raise TurgorError(f"'{mesh.name}' has no mirror plane {axis} = 0: {what}.")
    points = mesh.points.copy()
    points[:, number] = at
    chosen = np.flatnonzero(high > 0)
    nodes = np.unique(mesh.cells[chosen])
    new = np.full(len(points), -1, dtype=np.int64)
    new[nodes] = np.arange(len(nodes))
    cells = np.full(len(mesh.cells), -1, dtype=np.int64)
    cells[chosen] = np.arange(len(chosen))
    faces = {face: new[sides[(new[sides] >= 0).all(axis=1)]] for face, sides in mesh.faces.items() if face != name}
    regions = {region: cells[rows[cells[rows] >= 0]] for region, rows in mesh.regions.items()}
    sets = {each: new[rows[new[rows] >= 0]] for each, rows in mesh.node_sets.items()}
    half = replace(
        mesh,
        points=points[nodes],
        cells=new[mesh.cells[chosen]],
        regions={region: rows for region, rows in regions.items() if len(rows)},
        faces={face: sides for face, sides in faces.items() if len(sides)},
        node_sets={each: rows for each, rows in sets.items() if len(rows)},
    )
    outer = outer_triangles(half)
    plane = outer[(half.points[outer, number] == 0).all(axis=1)]
    return replace(half, faces=dict(sorted({**half.faces, name: plane}.items())))
