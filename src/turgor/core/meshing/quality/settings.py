"""Settings of the checks of a mesh: every number that was chosen, with its reason."""

from dataclasses import dataclass

#: Cells, rays or edges that are evaluated together, to bound the memory.
CHUNK = 2_000


@dataclass(frozen=True, slots=True)
class FacingSettings:
    """Which walls face each other (`test_facing_pairs`, `test_thin_walls`); angles by their cosine.

    Parameters
    ----------
    opposed : float
        Two triangles face each other if the angle between one normal and the reversed other one is below 45°.
    smooth : float
        Triangles that share an edge belong to the same wall when their normals differ by less than 40°.
    continued : float
        A triangle extends a wall when its normal is within 20° of the normal at which the extension started.
    """

    opposed: float = 0.7
    smooth: float = 0.77
    continued: float = 0.94


FACING = FacingSettings()


@dataclass(frozen=True, slots=True)
class ProximitySettings:
    """How gaps between walls are measured (`test_proximity`).

    Parameters
    ----------
    reach : float
        Reach of the search for facing walls by default, as a share of the longest side.
    measured : int
        Nodes whose gap is computed exactly: those with the smallest estimated gap.
    iterations : int
        Newton iterations to the foot point; each multiplies the error by distance times curvature, small near contact.
    overhang : float
        A foot point may lie outside its triangle by this much, in barycentric coordinates. Normals jump between
        quadratic triangles, so points in front of a convex edge have no foot point inside a triangle.
    """

    reach: float = 0.25
    measured: int = 100
    iterations: int = 6
    overhang: float = 0.1


PROXIMITY = ProximitySettings()


@dataclass(frozen=True, slots=True)
class OverlapSettings:
    """Where a mesh is tested for overlaps of its walls (`test_solvers_contact_findings`).

    Parameters
    ----------
    depth : float
        Depth below both surfaces, as a share of the edge, of the point where the winding number is evaluated.
    steep : float
        Smallest length of the sum of the two normals at a crossing that counts: walls in contact, such as round bodies
        that fit, cross at flat angles.
    points : int
        Most crossings, and most points all over the surface, where it is evaluated.
    """

    depth: float = 0.1
    steep: float = 0.7
    points: int = 150


OVERLAPS = OverlapSettings()


@dataclass(frozen=True, slots=True)
class StraighteningSettings:
    """How curved cells that are nearly inverted are made straight (`test_mend`).

    Parameters
    ----------
    jacobian_ratio : float
        A cell with a smaller ratio of smallest to largest Jacobian would invert as soon as the actuator deforms.
        Generated cells at fillets as small as the mesh size have 0.15 or more.
    halvings : int
        Each round halves the curvature of the edges of such a cell; after so many rounds the edges are made straight.
    notable_miss : float
        A deviation from the surface above this share of the mean edge is a warning, a smaller one a note.
    """

    jacobian_ratio: float = 0.1
    halvings: int = 4
    notable_miss: float = 0.1


STRAIGHTENING = StraighteningSettings()
