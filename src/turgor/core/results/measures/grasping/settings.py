"""Settings of the force closure margin."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class GraspSettings:
    """Numbers that were chosen for the force closure margin.

    Parameters
    ----------
    edges : int
        Edges of the pyramid in each friction cone. With 8 the margin is no smaller than that of round cones with 8 %
        less friction (cos 22.5°).
    most_points : int
        Contact points of the hull at most; of more, those are taken that lie farthest apart. The hull of 24 takes half
        a second, and leaving points out makes the margin smaller, never larger.
    least_share : float
        A node touches where its pressing force is at least this share of the largest: round-off and the middles of
        quadratic sides leave small forces around the patch.
    """

    edges: int = 8
    most_points: int = 24
    least_share: float = 0.01


GRASP = GraspSettings()
