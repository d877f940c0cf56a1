"""Settings of surfaces of triangles: every number that was chosen, with its reason.

Shares without another reference are of the size, or of the area, of the part. `test_stl_surfaces` needs them where
nothing else is stated.
"""

from dataclasses import dataclass
from math import cos

from turgor.units import deg


@dataclass(frozen=True, slots=True)
class SurfaceSettings:
    """How surfaces of triangles are read, closed, turned and divided into faces.

    Parameters
    ----------
    most_triangles, most_shells : int
        A file with more of them is refused: reading 20,000 triangles takes minutes, and each shell is compared with
        each other one. A part has one shell, and one for each cavity.
    sewn_triangles, sewn_faces, sewn_share : int, int, float
        A body becomes one of the CAD kernel where it has at most so many triangles and faces, of which plane ones make
        at least this share of the area: sewing takes a second for a thousand faces, and curved ones stay facets.
    plane_cosine, plane_distance : float
        Normals of a plane differ by less than this cosine (2°) from that of its largest facet, and its corners lie
        within this share of the size.
    plane_group : float
        A group of facets is plane where the mean of its normals is longer than this: they are within about 8°, as on
        prints with rough walls.
    smooth_cosine : float
        Facets whose normals differ by less (30°) belong to one curved face.
    larger : float
        A strip of a curved face has a neighbor of similar area, which continues it smoothly. A plane is so many times
        larger than all regions together that continue it.
    flat_rim, small_hole : float
        A hole is closed where its rim leaves its plane by at most this share of its size, or where its size is at most
        this share of the part.
    probes : int
        Corners of a shell that are looked at to see whether it lies within another one.
    ahead : float
        Distance in front of a facet, as a share of the root of its area, at which to look whether it is inside.
    """

    most_triangles: int = 400_000
    most_shells: int = 200
    sewn_triangles: int = 20_000
    sewn_faces: int = 150
    sewn_share: float = 0.999
    plane_cosine: float = cos(2 * deg)
    plane_distance: float = 1e-3
    plane_group: float = 0.99
    smooth_cosine: float = cos(30 * deg)
    larger: float = 1.5
    flat_rim: float = 0.02
    small_hole: float = 0.05
    probes: int = 12
    ahead: float = 1e-3


SURFACE = SurfaceSettings()
