"""Settings of extrapolation: every number that was chosen, with its reason. All are without unit."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ExtrapolationSettings:
    """Settings of extrapolation, tested in `tests/unit/core/results/test_results_extrapolation.py`.

    Parameters
    ----------
    least_order, most_order : float
        Orders between which a sequence counts as converging. Below them the meshes are too coarse. Above the highest
        order of quadratic cells (4, in energy) a sequence is fast by chance, and is extrapolated with order 4.
    safety : float
        The error is this many times the distance to the extrapolated value (Roache 1994, for three or more meshes).
    equal : float
        Values that differ by less than this share are equal: solvers stop at about 1e-8.
    """

    least_order: float = 0.5
    most_order: float = 4.0
    safety: float = 1.25
    equal: float = 1e-7


EXTRAPOLATION = ExtrapolationSettings()
