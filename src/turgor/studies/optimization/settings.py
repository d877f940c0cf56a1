"""Settings of optimizations: every number that was chosen, with its reason.

`tests/unit/studies/optimization` and the formulas of `benchmarks/studies/searches.py` need them. All are without unit
unless it is stated; places are shares of the ranges of the factors.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class TrustRegionSettings:
    """Settings of the search in a trust region.

    Parameters
    ----------
    first_radius, widest : float
        Half the width of the first region, and of the widest.
    poor, good : float
        Shares of the promised gain below which a region shrinks and above which it grows.
    spanned, near : float
        Points span the region where the least singular value of their directions is at least the first number, counting
        those within so many radii. Points closer to each other than the first one times the radius are the same, and
        slopes are given to the surfaces as points at half this distance from each candidate.
    last_region : float
        A step below the precision ends the search where the region is at most so many times the precision.
    tries : int
        Points tried where the start gives no response, and Latin hypercubes drawn until enough designs satisfy
        the rules.
    aim : float
        A search aims at this violation; up to 1 counts as met.
    misfit_penalty : float
        Penalty of a violation beyond the aim, in misfits; in objectives over their scales it is 1. Without it, a path
        with a casting rule ends outside of it.
    smooth : float
        Misfits below this length count less and less: the length has a kink where all targets are met.
    least_gain : float
        A promised gain below this share of the merit is none.
    worth, worth_of_misfits : float
        A step below the precision counts where it promises at least this: of an objective over its scale, and of the
        misfits in tolerances. Without them, a search with slopes ends before its limits are met.
    beginnings : int
        Random beginnings of a search on the surfaces besides its center.
    whole : int
        Whole numbers on both sides are tried for so many factors at most.
    spare : int
        Points beyond the number of terms of a polynomial part from which it is used.
    """

    first_radius: float = 0.2
    widest: float = 0.5
    poor: float = 0.1
    good: float = 0.7
    spanned: float = 0.1
    near: float = 2.0
    last_region: float = 5.0
    tries: int = 8
    aim: float = 0.5
    misfit_penalty: float = 10.0
    smooth: float = 0.1
    least_gain: float = 1e-6
    worth: float = 1e-4
    worth_of_misfits: float = 0.1
    beginnings: int = 4
    whole: int = 4
    spare: int = 2


TRUST_REGION = TrustRegionSettings()


@dataclass(frozen=True, slots=True)
class ParetoSettings:
    """Settings of the search for a front.

    Parameters
    ----------
    population, generations : int
        Designs of a generation, and generations, on surfaces.
    computed_population : int
        Designs of a generation where the function itself is called.
    first_share : float
        Share of the runs that the first surfaces are laid through, at least 2 n + 2 of them.
    batch : int
        Designs that are computed between two searches on surfaces.
    front_error, gap : float
        The search ends where what the surfaces promised was computed to be on the front within the first share of its
        range and no promised design is farther than the second from a computed one, `RUNS.idle` times in a row.
    """

    population: int = 60
    generations: int = 80
    computed_population: int = 24
    first_share: float = 0.4
    batch: int = 4
    front_error: float = 0.02
    gap: float = 0.15


PARETO = ParetoSettings()
