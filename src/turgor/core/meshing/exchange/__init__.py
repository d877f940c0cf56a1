"""Exchange: meshes from files of other programs, closed surfaces made into meshes, and surfaces written for others.

The formats are read by short parsers of our own: the only library for all of them, meshio, is hardly maintained, leaves
sets and surfaces of .inp files out and ends the process on some VTU files; vtk reads two of the four formats and weighs
hundreds of megabytes. Names are imported on first use, because the model of a body takes one of them.
"""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.core.meshing.exchange.formats.stl import Triangles as Triangles
    from turgor.core.meshing.exchange.formats.stl import read_stl as read_stl
    from turgor.core.meshing.exchange.formats.write_stl import write_stl as write_stl
    from turgor.core.meshing.exchange.mesh_file import MeshFile as MeshFile
    from turgor.core.meshing.exchange.read import read_mesh as read_mesh
    from turgor.core.meshing.exchange.surface_filling import mesh_surfaces as mesh_surfaces

if not TYPE_CHECKING:
    __getattr__, __dir__, __all__ = public(__file__, globals())
