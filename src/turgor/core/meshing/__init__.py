"""Meshing: curved quadratic cells with the names of the geometry, their quality and checks.

The functions ``mesh`` and ``quality`` are imported from their files, `turgor.core.meshing.generate` and
`turgor.core.meshing.quality.cell_quality`: in this package their names belong to the files ``mesh.py`` and
``quality.py``.

Names are imported on first use, because the engine needs the mesh and not what makes it.
"""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.core.meshing.generate import size_range as size_range
    from turgor.core.meshing.mesh import Mesh as Mesh
    from turgor.core.meshing.quality.cell_quality import MeshQuality as MeshQuality
    from turgor.core.meshing.quality.checks import check_mesh as check_mesh
    from turgor.core.meshing.quality.proximity import FacingWalls as FacingWalls
    from turgor.core.meshing.quality.proximity import find_facing_walls as find_facing_walls
    from turgor.core.meshing.quality.proximity import smallest_gap as smallest_gap
    from turgor.core.meshing.surface import outer_triangles as outer_triangles

if not TYPE_CHECKING:
    __getattr__, __dir__, __all__ = public(__file__, globals())
