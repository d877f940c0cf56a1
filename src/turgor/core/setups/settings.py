"""Settings of the blocked tip: every number that was chosen, with its reason. All are without unit."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class BlockedTipSettings:
    """Settings of the blocked tip, and of the free actuator that says in which direction it is blocked.

    Parameters
    ----------
    reach : float
        The plate touches sides that reach back from the tip over this share of the actuator's length.
    first_share : float
        Share of the load up to which the free actuator is followed, or farther until its tip moves. Sheets that bear
        tension only are taut long before: above films of 0.1 mm of paper and 0.5 mm of silk the direction is the same
        from 0.003 on.
    between : int
        Points along each side of an element's side at which the gap of a round button is measured.
    pushed : float
        Share of the load at which a plate that is pushed into the tip has reached its place: before the actuator moves.
    clear : float
        Share of the whole motion from which a part of it counts: a bender leaves its plane by what its mesh is askew.
    tolerance : float
        Tolerance of the equilibria of the free actuator: a direction needs no more.
    """

    reach: float = 0.25
    first_share: float = 0.05
    between: int = 9
    pushed: float = 0.02
    clear: float = 0.01
    tolerance: float = 1e-3


BLOCKED_TIP = BlockedTipSettings()
