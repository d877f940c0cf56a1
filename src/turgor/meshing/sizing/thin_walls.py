"""Find walls that are too thin for the cells along them, by rays through the solid, and give them smaller sizes."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.finding import Finding, Severity
from turgor.meshing.mesh import TRIANGLE_EDGES, Mesh
from turgor.meshing.quality.facing import OPPOSED, first_hits, unit_normals
from turgor.meshing.sizing.sizes import LARGEST_SIZE_PER_WALL
from turgor.meshing.surface import outer_triangles
from turgor.units import mm

Array = NDArray[np.float64]

#: Longest edge over thickness of a wall that is accepted. The largest size is four times the wall, and the generator
#: makes some edges half as long again as the size it is given.
LONGEST_EDGE_PER_WALL = 1.5 * LARGEST_SIZE_PER_WALL

#: Size asked for at a thin wall over its thickness at first, and its factor each time that this did not suffice.
ASKED_SIZE_PER_WALL, FIRMER = 3.0, 0.7


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ThinWalls:
    """Places on the surface behind which the wall is too thin for the cells there.

    Parameters
    ----------
    points : (p, 3) array [m]
        Middles of outer triangles.
    thickness : (p,) array [m]
        Thickness of the wall behind each, along its normal.
    """

    points: Array
    thickness: Array

    def sizes(self, rounds: int) -> Array:
        """Sizes that suit the walls after some rounds of asking, (p,) [m]."""
        return ASKED_SIZE_PER_WALL * FIRMER**rounds * self.thickness


def find_thin_walls(mesh: Mesh, size: float) -> ThinWalls:
    """Find walls that are too thin for the cells along them: an edge is over six times as long as the wall is thick.

    Every outer triangle looks into the solid along its normal, to the opposed triangle behind the wall.

    Parameters
    ----------
    mesh : Mesh
        Ten-node tetrahedra.
    size : float [m]
        Size that was aimed at; thicker walls than a quarter of it are not looked for.

    Returns
    -------
    ThinWalls

    Examples
    --------
    >>> from turgor.geometry import FastPneuNet
    >>> from turgor.meshing.generate import mesh
    >>> len(find_thin_walls(mesh(FastPneuNet(chambers=2, length=20e-3).build(), size=3e-3), 3e-3).points)
    0
    """
    surface = outer_triangles(mesh)
    on_mirror = np.zeros(len(surface), dtype=bool)
    for name in mesh.cut_faces:
        on_mirror |= np.isin(surface, mesh.face_nodes(name)).all(axis=1)
    corners = mesh.points[surface[~on_mirror][:, :3]]
    inward = surface[~on_mirror][:, [0, 2, 1]]
    normal, middle = unit_normals(mesh.points, inward), corners.mean(axis=1)
    hit = first_hits(mesh.points, inward, size / LARGEST_SIZE_PER_WALL)
    facing = np.einsum("ti,ti->t", normal, normal[hit])
    seen = np.flatnonzero((hit >= 0) & (facing < -OPPOSED))
    depth = np.einsum("ti,ti->t", middle[hit[seen]] - middle[seen], normal[hit[seen]]) / facing[seen]
    longest = np.max([np.linalg.norm(corners[seen, a] - corners[seen, b], axis=1) for a, b in TRIANGLE_EDGES], axis=0)
    thin = longest > LONGEST_EDGE_PER_WALL * depth
    return ThinWalls(points=middle[seen][thin], thickness=depth[thin])


def thin_walls_left(walls: ThinWalls) -> Finding:
    """Say that walls stayed too thin for their cells."""
    thinnest = int(walls.thickness.argmin())
    x, y, z = walls.points[thinnest] / mm
    return Finding(
        code="G09",
        severity=Severity.WARNING,
        message=f"In {len(walls.points)} places cells are more than six times as long as their wall is thick; the "
        f"thinnest of these walls is {walls.thickness[thinnest] / mm:.3g} mm thick, at ({x:.3g}, {y:.3g}, {z:.3g}) mm.",
        advice="Use a smaller mesh size, or set a smaller size for the faces of these walls alone (face_sizes).",
    )
