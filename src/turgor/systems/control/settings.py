"""Settings of control: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ControlSettings:
    """Settings of the search for pressures.

    Parameters
    ----------
    smoothness : float
        Weight μ of the change of the inputs since the last row, inputs over their ranges and outputs over their size.
        It decides where several inputs give one output. A row that the inputs can reach is missed by about this share
        of the change.
    iterations : int
        Gauss–Newton updates of a row at most.
    tolerance : float
        Update of the inputs over their ranges, below which a row counts as solved.
    along : float
        Last update of the inputs over their ranges, and its effect on the output over its size, that need no new
        equilibrium: the derivatives miss about the square of it, a hundredth of what a reduced model misses.
    gained : float
        Share of the squared distance below which an update has gained nothing: a target out of reach is approached
        more and more slowly, and its distance is then known to some 1e-4.
    longest : float
        Longest update of an input over its range. A row of a path is nearer than that; the first row may be far.
    shortest : float
        An update that is shortened below this ends the row: nothing nearby is closer to the target.
    near : float
        An input counts as at its limit within this share of its range: a few times the tolerance.
    infeasible : float
        Residual of the least distance problem below which no point fulfills all limits.
    exceeded : float
        Share of a volume by which its limit may be exceeded.
    stalled : float
        Distance from a target over the size of the output, above which other starts are tried, once on a path that
        leaves what it can reach: near rest a chamber does little, and a search may end where its pressure is zero. None
        are tried where rates leave the inputs less than the longest update: all starts are within it.
    starts : int
        How many: the nearest training states.
    approach : float
        Force that a gap to an obstacle counts as, over the largest force, for a gap of the length of the actuator: a
        gap of a tenth of the length misses as much as the largest force does.
    """

    smoothness: float = 1e-7
    iterations: int = 25
    tolerance: float = 1e-6
    along: float = 3e-3
    gained: float = 1e-5
    longest: float = 0.25
    shortest: float = 1e-4
    near: float = 1e-5
    infeasible: float = 1e-12
    exceeded: float = 1e-10
    stalled: float = 1e-3
    starts: int = 5
    approach: float = 10.0


CONTROL = ControlSettings()
