"""Find walls that are too thin for the cells along them, by rays through the solid, and give them smaller sizes."""

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.mesh import TRIANGLE_EDGES, Mesh
from turgor.core.meshing.quality.facing_walls import first_hits, unit_normals
from turgor.core.meshing.quality.settings import FACING
from turgor.core.meshing.sizing.settings import SIZING, THIN_WALLS
from turgor.core.meshing.surface import outer_triangles
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.units import mm

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ThinWalls:
    """Places on the surface behind which the wall is too thin for the cells there.

    Parameters
    ----------
    points : (p, 3) array [m]
        Middles of outer triangles.
    thickness : (p,) array [m]
        Thickness of the wall behind each, along its normal.
    areas : (p,) array [m²]
        Areas of these triangles; a wall is seen from both sides.
    """

    points: Array
    thickness: Array
    areas: Array

    def sizes(self, rounds: int) -> Array:
        """Sizes that suit the walls after some rounds of requests, (p,) [m]."""
        return THIN_WALLS.requested_per_wall * THIN_WALLS.firmer**rounds * self.thickness

    def unknowns(self) -> float:
        """About so many unknowns lie in these walls with cells as short as requested."""
        return float((SIZING.unknowns_per_area / 2 * self.areas / self.sizes(0) ** 2).sum())

    def place(self) -> str:
        """Where the thinnest of these walls is, and how thick."""
        thinnest = int(self.thickness.argmin())
        x, y, z = self.points[thinnest] / mm
        return f"{self.thickness[thinnest] / mm:.3g} mm thick, at ({x:.3g}, {y:.3g}, {z:.3g}) mm"


def find_thin_walls(mesh: Mesh, size: float, stated: Collection[str] = ()) -> ThinWalls:
    """Find walls that are too thin for the cells along them: an edge is over six times as long as the wall is thick.

    Every outer triangle looks into the solid along its normal, to the opposed triangle behind the wall.

    Parameters
    ----------
    mesh : Mesh
        Ten-node tetrahedra.
    size : float [m]
        Size that was aimed at; thicker walls than a quarter of it are not looked for.
    stated : collection of str
        Faces that keep the size that was stated for them: walls on which they lie are left out.

    Returns
    -------
    ThinWalls

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.generate import mesh
    >>> len(find_thin_walls(mesh(FastPneuNet(chambers=2, length=20e-3).build(), size=3e-3), 3e-3).points)
    0
    """
    surface = outer_triangles(mesh)
    surface = surface[~_on_faces(mesh, surface, mesh.cut_faces)]
    corners, inward, on_stated = mesh.points[surface[:, :3]], surface[:, [0, 2, 1]], _on_faces(mesh, surface, stated)
    normal, middle = unit_normals(mesh.points, inward), corners.mean(axis=1)
    hit = first_hits(mesh.points, inward, size / SIZING.largest_per_wall)
    facing = np.einsum("ti,ti->t", normal, normal[hit])
    rows = np.flatnonzero((hit >= 0) & (facing < -FACING.opposed) & ~on_stated & ~on_stated[hit])
    depth = np.einsum("ti,ti->t", middle[hit[rows]] - middle[rows], normal[hit[rows]]) / facing[rows]
    longest = np.max([np.linalg.norm(corners[rows, a] - corners[rows, b], axis=1) for a, b in TRIANGLE_EDGES], axis=0)
    thin = longest > THIN_WALLS.longest_per_wall * depth
    one, two = (corners[rows, i] - corners[rows, 0] for i in (1, 2))
    areas = np.linalg.norm(np.cross(one, two), axis=1) / 2
    return ThinWalls(points=middle[rows][thin], thickness=depth[thin], areas=areas[thin])


def _on_faces(mesh: Mesh, surface: NDArray[np.int64], names: Collection[str]) -> NDArray[np.bool_]:
    """Whether each triangle lies on one of some faces."""
    on_faces = np.zeros(len(surface), dtype=bool)
    for name in names:
        on_faces |= np.isin(surface, mesh.face_nodes(name)).all(axis=1)
    return on_faces


def refuse_thin_walls(walls: ThinWalls, name: str) -> None:
    """Refuse walls of a geometry that are too thin for their area: nothing could solve cells that suit them."""
    if (unknowns := walls.unknowns()) > SIZING.most_unknowns:
        raise TurgorError(
            f"'{name}' has walls that are too thin for their area: cells three times as long as they are thick would "
            f"make about {unknowns / 1e6:.3g} million unknowns; the thinnest is {walls.place()}. Make them thicker, or "
            'state a size for one of their faces, which is then kept there: face_sizes = { NAME = "1 mm" }.'
        )


def thin_walls_remain(walls: ThinWalls) -> Finding:
    """Say that walls stayed too thin for their cells."""
    return Finding(
        code="G09",
        severity=Severity.WARNING,
        message=f"In {len(walls.points)} places cells are more than six times as long as their wall is thick; the "
        f"thinnest of these walls is {walls.place()}.",
        advice="Use a smaller mesh size, or set a smaller size for the faces of these walls alone (face_sizes).",
    )


def thin_walls_finer(size: float, wall: float) -> Finding:
    """Say that thin walls have smaller cells than the stated size [m]; ``wall`` is the thinnest one [m]."""
    return Finding(
        code="G09",
        severity=Severity.NOTE,
        message=f"The mesh size of {size / mm:.4g} mm is more than four times the thinnest wall, {wall / mm:.4g} mm: "
        f"walls thinner than {size / SIZING.largest_per_wall / mm:.3g} mm have shorter cells.",
        advice="Where such a wall does not bend, a size for its face keeps it coarse: face_sizes.",
    )


def section_finer(size: float, smallest: float, wall: float) -> Finding:
    """Say that cells of a section have a smaller size than the stated one, ``smallest`` [m]."""
    return Finding(
        code="G09",
        severity=Severity.NOTE,
        message=f"The mesh size of {size / mm:.4g} mm is more than four times the thinnest wall, {wall / mm:.4g} mm: "
        f"cells in the section stay below {smallest / mm:.4g} mm, and only those along its path may be longer.",
        advice=f"Use {smallest / mm:.4g} mm or less where walls bend along the path too.",
    )
