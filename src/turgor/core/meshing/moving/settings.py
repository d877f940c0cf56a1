"""Settings of meshes that follow the dimensions of a shape: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class MovingSettings:
    """How nodes are assigned to the curves and surfaces of a CAD shape (`test_moving`).

    Parameters
    ----------
    samples : int
        Points along an edge that is not straight, from which the nearest one to a point is refined.
    exact : float
        An edge is straight, and a surface a plane, whose parameters grow evenly if it is off by less than this share;
        and Newton's method for parameters ends at such a step. Nodes move by differences of positions, so that only
        rounding of double precision is left out.
    starts, refined : tuple of float, int
        Parameters at which the search for a point on a surface begins, as shares of 1, of a turn and of the size of the
        face in CAD units; and how many of the nearest ones are refined.
    iterations : int
        Newton's iterations for parameters at most.
    near : float
        A node lies on a part of the shape if it is nearer than this share of the shortest edge of the mesh there, or of
        the size of the face.
    straightened : float
        A mid-side node that was straightened is off at most by this share of the edge that it lies on.
    """

    samples: int = 65
    exact: float = 1e-12
    starts: tuple[float, ...] = (0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0)
    refined: int = 8
    iterations: int = 40
    near: float = 0.02
    straightened: float = 0.2


MOVING = MovingSettings()
