"""Settings of studies: every number that was chosen, with its reason, and the level of all intervals."""

from dataclasses import dataclass
from statistics import NormalDist


@dataclass(frozen=True, slots=True)
class RunSettings:
    """Settings of runs and of their tables.

    Parameters
    ----------
    digits : int
        Digits of the values that functions are called with: the last ones of a float may differ from machine to
        machine, and a saved run is identified by its values. Tables have one more.
    letters : int
        Letters of a hash in the name of a file.
    range_levels, most_levels : int
        Levels of a factorial where only a range is given; values of a column beyond which they are those of a sample,
        and levels beyond which a choice has too few rows each to learn from.
    poll : float
        Time after which runs that are computed elsewhere are looked at again [s].
    patience : float
        Time in which a scheduler answers, and a process that has closed its end says how it ended [s].
    dask_runs : int
        Most runs that a scheduler has at once: this process holds a lock of each, and may open about a thousand files.
    attempts : int
        How often the folder of a path is created: other runs may remove the one above it while it is empty.
    idle : int
        Runs, or rounds of runs, in a row that gain next to nothing, after which a search ends.
    exact_slopes : float
        Estimated relative error up to which slopes count as exact.
    """

    digits: int = 9
    letters: int = 10
    range_levels: int = 3
    most_levels: int = 10
    poll: float = 0.1
    patience: float = 10.0
    dask_runs: int = 500
    attempts: int = 10
    idle: int = 2
    exact_slopes: float = 0.01


RUNS = RunSettings()

#: Level of all intervals, and half the width of such an interval of normal deviates, in standard deviations.
LEVEL = 0.95
HALF_WIDTH = NormalDist().inv_cdf((1 + LEVEL) / 2)
