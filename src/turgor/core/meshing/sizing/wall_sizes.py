"""fitted_to_walls: a mesh whose cells suit their walls, made again with smaller sizes at walls that are too thin."""

from collections.abc import Callable
from dataclasses import replace

from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.generator import GeneratorSizes
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.sizing.settings import THIN_WALLS
from turgor.core.meshing.sizing.sizes import wall_size
from turgor.core.meshing.sizing.thin_walls import (
    find_thin_walls,
    refuse_thin_walls,
    thin_walls_finer,
    thin_walls_remain,
)


def fitted_to_walls(
    geometry: Geometry, chosen: MeshSettings, sizes: GeneratorSizes, make: Callable[[GeneratorSizes], Mesh]
) -> Mesh:
    """Make a mesh, and again with smaller sizes along walls that are too thin for their cells.

    Faces with a size of their own keep it, also where it is long for their wall, unless ``wall_cells`` asks for cells
    through every wall.

    Parameters
    ----------
    geometry : Geometry
    chosen : MeshSettings
        With a size and a kind of cells.
    sizes : GeneratorSizes
        Sizes to begin with.
    make : callable
        ``make(sizes)`` returns a valid mesh.

    Returns
    -------
    Mesh
        With G09 where cells are shorter than stated, or stayed too long.

    Raises
    ------
    TurgorError
        If the walls are so thin for their area that nothing could solve such a mesh.
    """
    result = make(sizes)
    if sizes.size <= wall_size(geometry) * (1 + 1e-9):
        return result  # the size suits every wall
    stated = tuple(chosen.face_sizes) if chosen.wall_cells == 1 else ()
    for _ in range(THIN_WALLS.rounds):
        walls = find_thin_walls(result, sizes.size, stated)
        if not len(walls.points):
            break
        refuse_thin_walls(walls, geometry.name)
        sizes = replace(sizes, places=(*sizes.places, walls))
        result = make(sizes)
    findings = []
    if sizes.places and chosen.wall_cells == 1:
        findings.append(thin_walls_finer(sizes.size, geometry.smallest_wall))
    if len((thin := find_thin_walls(result, sizes.size)).points):
        findings.append(thin_walls_remain(thin))
    return replace(result, findings=(*result.findings, *findings))
