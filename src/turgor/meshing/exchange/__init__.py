"""Exchange: meshes from files of other programs, closed surfaces made into meshes, and surfaces written for others.

The formats are read by short parsers of our own: the only library for all of them, meshio, is hardly maintained, leaves
sets and surfaces of .inp files out and ends the process on some VTU files; vtk reads two of the four formats and weighs
hundreds of megabytes.
"""

from turgor.meshing.exchange.fill import mesh_surfaces
from turgor.meshing.exchange.formats.stl import Triangles, read_stl
from turgor.meshing.exchange.formats.write_stl import write_stl
from turgor.meshing.exchange.mesh_file import MeshFile
from turgor.meshing.exchange.read import read_mesh

__all__ = ["MeshFile", "Triangles", "mesh_surfaces", "read_mesh", "read_stl", "write_stl"]
