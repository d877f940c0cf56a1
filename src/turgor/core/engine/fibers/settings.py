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
        Share of its stiffness that a slack thread keeps in the tangent, so that the tangent shows where it will
        end.
    trusses_of_side : int
        Trusses of a discrete thread that crosses a whole side. A thread is looked up first as often along the smaller
        extent of the smaller sides.
    shortest_truss : float
        Trusses shorter than this share of the smaller sides are left out: they only cut a corner.
    nudge : float
        Discrete threads are moved by this share of the perimeter and of the length, so that none runs along the border
        of two sides.
    embedded_within : float
        Points of embedded threads may be this share of the mean edge of cells outside the body, as in Abaqus: curved
        surfaces are rounder than their cells.
    inverse_steps : int
        Newton steps that find the place of a point in a cell; quadratic cells need about five.
    """

    cylinder_like: float = 0.2
    prismatic: float = 0.01
    contradiction: float = 0.1
    parts_of_edge: int = 32
    slack_tangent: float = 1e-4
    trusses_of_side: int = 2
    shortest_truss: float = 1e-4
    nudge: float = 2e-7
    embedded_within: float = 0.05
    inverse_steps: int = 12


FIBERS = FiberSettings()
