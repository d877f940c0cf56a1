"""Settings of reading tests: every number that was chosen, with its reason. All are without unit.

Each is tested in `tests/unit/core/materials/experiments` with files of test machines.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ExperimentSettings:
    """Settings of test files and of tests.

    Parameters
    ----------
    longest_header : int
        Number of letters of a header line beyond which names without a separator are not looked for: the time of that
        search grows with the square.
    same_dimension : float
        Share by which two statements of a dimension may differ.
    shortest_series : int
        Points of the shortest series that may be a copy of another: fewer may be equal by chance.
    half_cycle : float
        Smallest range of a half cycle, as a share of the whole range of stretch.
    jitter : float
        Smallest step back of the stretch that counts as a reversal, as a share of the whole range.
    """

    longest_header: int = 5000
    same_dimension: float = 0.01
    shortest_series: int = 4
    half_cycle: float = 0.2
    jitter: float = 0.01


EXPERIMENTS = ExperimentSettings()
