"""Meshing: curved quadratic cells with the names of the geometry, their quality and checks.

The functions ``mesh`` and ``quality`` are imported from their files, `turgor.meshing.generate` and
`turgor.meshing.quality.cell_quality`: in this package their names belong to the files ``mesh.py`` and ``quality.py``.
"""

from turgor.meshing.generate import size_range
from turgor.meshing.mesh import Mesh
from turgor.meshing.quality.cell_quality import MeshQuality
from turgor.meshing.quality.checks import check_mesh
from turgor.meshing.quality.proximity import FacingWalls, find_facing_walls, smallest_gap
from turgor.meshing.surface import outer_triangles

__all__ = [
    "FacingWalls",
    "Mesh",
    "MeshQuality",
    "check_mesh",
    "find_facing_walls",
    "outer_triangles",
    "size_range",
    "smallest_gap",
]
