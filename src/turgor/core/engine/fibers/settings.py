"""Settings of fibers: every number that was chosen, with its reason. All are without unit.

Cases that need them are in `tests/unit/core/engine/test_fiber_trusses.py` and `tests/verification` (fibers).
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class FiberSettings:
    """Settings of fibers.

    Parameters
    ----------
    cylinder_like : float
        Largest cosine between the normals of a wound face and its axis.
    prismatic : float
        A node may be this share of the perimeter away from the contour at the start of the face.
    contradiction : float
        Largest difference between a spacing and the one that pitch and a whole number of threads make, as a share.
    parts_of_edge : int
        Straight parts into which each curved edge is cut to measure its length.
    slack_tangent : float
        Share of its stiffness that a slack thread keeps in the tangent, so that Newton's method knows where it will
        end.
    """

    cylinder_like: float = 0.2
    prismatic: float = 0.01
    contradiction: float = 0.1
    parts_of_edge: int = 32
    slack_tangent: float = 1e-4


FIBERS = FiberSettings()


@dataclass(frozen=True, slots=True)
class TrussSettings:
    """Settings of discrete threads, which are cut into trusses.

    Parameters
    ----------
    trusses_of_side : int
        Trusses of a thread that crosses a whole side. A thread is looked up first as often along the smaller extent of
        the smaller sides.
    halvings : int
        Halvings by which the passage from one side to the next is found.
    shortest : float
        Trusses shorter than this share of the smaller sides are left out: they only cut a corner.
    nudge_around, nudge_along : float
        Threads are moved by these shares of the perimeter and the length, so that none runs along the border of two
        sides.
    seeds : int
        Points on each edge of a side from which the search for the side under a point starts.
    tries, newton_steps : int
        Sides that are tried for a point, nearest first, and Newton's iterations in each.
    """

    trusses_of_side: int = 2
    halvings: int = 22
    shortest: float = 1e-4
    nudge_around: float = 1.7e-7
    nudge_along: float = 2.3e-7
    seeds: int = 5
    tries: int = 10
    newton_steps: int = 12


TRUSSES = TrussSettings()
