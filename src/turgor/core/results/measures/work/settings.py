"""Settings of measures: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class CycleSettings:
    """Settings of the search for the period of a history; errors are shares of the width of the history.

    Parameters
    ----------
    samples : int
        Intervals of the path: a number with many divisors, so that most cycles end at a sample.
    fine_samples : int
        Samples with which a shift between two of them is refined.
    near : float
        Largest error at a sample next to a period: a tenth of a cycle of 25 samples.
    same, same_refined : float
        Largest errors of a history that repeats itself, by round-off and by the width of the refined shift.
    shift : float
        Accuracy of a shift, as a share of the path.
    fit : float
        Largest distance of the ratio of two cycles from a whole number.
    least_steps : int
        Fewest steps in a cycle whose mean is taken: the thrust has twice the frequency of the motion, and four steps
        show each of its waves.
    """

    samples: int = 2520
    fine_samples: int = 200
    near: float = 0.1
    same: float = 1e-9
    same_refined: float = 1e-5
    shift: float = 1e-9
    fit: float = 1e-3
    least_steps: int = 8


CYCLES = CycleSettings()
