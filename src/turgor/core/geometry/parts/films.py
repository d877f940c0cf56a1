"""Films: the geometry of a body that consists of patches alone."""

from collections.abc import Iterable, Mapping

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.shapes.film_shape import FilmShape, Patch


def film_geometry(
    name: str, patches: Iterable[Patch], smallest_wall: float, cavity_volumes: Mapping[str, float]
) -> Geometry:
    """Return the geometry of a film without a solid, with the faces that its patches and their edges name.

    Parameters
    ----------
    name : str
        Title, for reports.
    patches : iterable of Patch
    smallest_wall : float [m]
        The smallest length that cells should follow.
    cavity_volumes : mapping of str to float [m³]
        Volume of each cavity by the name of its face.

    Returns
    -------
    Geometry
        Without a region.
    """
    shape = FilmShape(patches=tuple(patches))
    faces = {face for patch in shape.patches for face in (*patch.faces, *patch.edges) if face}
    return Geometry(
        name=name,
        smallest_wall=smallest_wall,
        cavity_volumes=cavity_volumes,
        solid_volume=0.0,
        regions=(),
        faces=tuple(sorted(faces)),
        shape=shape,
    )
