"""Settings of surrogates: every number that was chosen, with its reason.

`tests/unit/studies/surrogates` and `benchmarks/studies/surrogates.py` need them. All are without unit.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class SurrogateSettings:
    """Settings of fits, of inverses, and of next designs.

    Parameters
    ----------
    amplitude, lengths, scatter : (float, float)
        Bounds of the amplitude and of the variance of the scatter, in units of the deviation of the outputs, and of the
        lengths of a kernel as a share of the range. A length at its upper bound means an input without influence.
    kernel_starts : int
        Starts of the search for a kernel.
    kernel_points : int
        Most points from which a kernel is searched: its time grows with their cube. All points condition the process.
    factors : (float, float)
        Bounds of the factor of standard deviations: where a few rows are reproduced exactly it says nothing.
    points : int
        Values of the drive that each path gives, and at which a next design is looked at, where the drive is an input.
    rows : int
        Rows below which there is nothing to hold out.
    tried, starts : int
        Points at which an inverse or a next design is looked for (a power of two), as many draws behind an expected
        improvement, as many combinations of choices at most, and the best points that searches for an inverse start
        from.
    reached : float
        Distance below which target outputs count as reached, as a share of the range of each.
    """

    amplitude: tuple[float, float] = (1e-2, 1e3)
    lengths: tuple[float, float] = (0.03, 100.0)
    scatter: tuple[float, float] = (1e-10, 1.0)
    kernel_starts: int = 3
    kernel_points: int = 400
    factors: tuple[float, float] = (0.1, 1000.0)
    points: int = 7
    rows: int = 5
    tried: int = 256
    starts: int = 6
    reached: float = 1e-4


SURROGATE = SurrogateSettings()
