"""Settings of rods: every number of their solution that was chosen, with its reason. All are without unit."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class RodNewtonSettings:
    """How Newton's method iterates; motions are over the length of the longest rod, and rotations in rad.

    Parameters
    ----------
    iterations : int
        Updates at most.
    small_update : float
        Largest motion of an update with which a state is converged: the next is its square.
    large_update, good_update : float
        Update after the first one at which Newton's method is given up, and the first update that the next attempt aims
        at.
    depth : float
        Largest penetration, over the length of the longest rod, of points that press.
    """

    iterations: int = 25
    small_update: float = 1e-6
    large_update: float = 1.5
    good_update: float = 2.0
    depth: float = 1e-8


@dataclass(frozen=True, slots=True)
class RodPathSettings:
    """How paths of rods are followed.

    Parameters
    ----------
    shortest : float
        Shortest step of the load factor, and of an arc.
    growth : float
        Growth of the step of the load factor after one that converged.
    target_iterations : int
        Iterations that a step along an arc aims at.
    rate_step : float
        Change of the load factor by which the rate of the loads is found.
    """

    shortest: float = 1e-4
    growth: float = 4.0
    target_iterations: int = 4
    rate_step: float = 1e-6


#: Of a load factor, of a step along an arc, whose corrections are small, and of a step in time, whose error adds up.
AT_LOAD = RodNewtonSettings()
ALONG_ARC = RodNewtonSettings(iterations=12, small_update=1e-7)
IN_TIME = RodNewtonSettings(small_update=1e-9)

PATH = RodPathSettings()
