"""A CAD part as facets, for parts whose faces are too small or too odd for the mesh generator."""

from dataclasses import replace

from turgor.core.geometry.cad.facets import find_facets
from turgor.core.geometry.cad.surface.shape import SurfaceFace, SurfaceShape
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity


def faceted(geometry: Geometry) -> Geometry:
    """Return a CAD part of one body as flat facets of its faces, with their names.

    Parameters
    ----------
    geometry : Geometry
        With a CAD shape.
    """
    shape = geometry._cad
    faces = list(dict.fromkeys(shape.faces))
    facets = find_facets(shape, faces)
    surface = SurfaceShape(
        points=facets.points,
        triangles=facets.triangles,
        face=facets.face,
        faces=tuple(SurfaceFace(name=str(face.name), mass=float(face.mass)) for face in faces),
    )
    return replace(geometry, shape=surface, solid_volume=surface.mass * geometry.length_scale**3)


def meshed_by_facets(error: TurgorError, result: Mesh, geometry: Geometry) -> Finding:
    """Say why a CAD part was meshed from its facets.

    Parameters
    ----------
    error : TurgorError
        Why the mesh generator did not fill its faces.
    result : Mesh
    geometry : Geometry
        The part with its CAD shape.
    """
    lost = 1 - float(cell_volumes(result).sum()) / geometry.solid_volume
    return Finding(
        code="G10",
        severity=Severity.NOTE,
        message="The part was meshed from flat facets of its faces, because the faces themselves could not be meshed: "
        f"{str(error).split(';')[0].rstrip('.')}. The cells fill {abs(lost):.2%} {'less' if lost > 0 else 'more'} than "
        "the part.",
        advice="Faces far smaller than the cells are the usual cause; leave them out in the CAD program to get cells "
        "on the true faces.",
    )
