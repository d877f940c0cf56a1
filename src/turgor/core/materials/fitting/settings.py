"""Settings of fitting: every number that was chosen, with its reason. All are without unit.

Each is tested in `tests/unit/core/materials/fitting`; `benchmarks/core/fitting.py` measures their effect on measured
rubbers.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class FitSettings:
    """Settings of fits to curves.

    Parameters
    ----------
    weight_floor : float
        Smallest stress for relative weights, as a share of the largest stress of its test.
    least_share : float
        Smallest slope and initial shear modulus of a fitted law, relative to the neo-Hookean modulus of the tests, and
        smallest long-term share of the instantaneous stress; a rubber does not flow.
    least_exponent : float
        Smallest exponent of Ogden's law; no test distinguishes smaller ones.
    largest_order : int
        Largest order that a name may state; more terms than that describe noise.
    stability_points, beyond : int, float
        Number of stretches in each mode at which stability is required, and the factor by which these exceed the range.
    refined_starts : int
        Number of best starts that are iterated to convergence.
    same_decimals : int
        Stretches that are equal to so many decimals count as one.
    working : float
        Largest stretch of most soft actuators: their rubber works at strains up to 150 %.
    working_share : float
        Share of the points up to that stretch below which it is reported that the fit is for larger ones.
    trade_stretch : float
        Stretch at which rubbers are compared: makers state the 100 % modulus.
    far_from_library : float
        Ratio to the median of the sets of the library above which a fit is reported: the sound sets of Ecoflex 00-30
        differ by a factor of 1.4 at stretch 2.
    one_to_two_digits : float
        Ratio below which it is written as a fraction.
    alike : float
        Laws fit alike if their errors differ by less than this factor.
    close : float
        So do laws whose errors are below this: no actuator shows them.
    range_slack : float
        Tolerance of the ends of a range, as a share, because digitized curves have no sharp ends.
    """

    weight_floor: float = 0.05
    least_share: float = 1e-3
    least_exponent: float = 0.05
    largest_order: int = 6
    stability_points: int = 240
    beyond: float = 1.005
    refined_starts: int = 3
    same_decimals: int = 3
    working: float = 2.5
    working_share: float = 0.25
    trade_stretch: float = 2.0
    far_from_library: float = 1.5
    one_to_two_digits: float = 0.95
    alike: float = 1.25
    close: float = 0.05
    range_slack: float = 0.02


FIT = FitSettings()


@dataclass(frozen=True, slots=True)
class DeterminationSettings:
    """When tests do not determine a parameter.

    Parameters
    ----------
    correlated : float
        Correlation beyond which the tests determine only a combination of two parameters.
    large_error : float
        A parameter of a history whose standard error exceeds this share of its value counts as not determined.
    """

    correlated: float = 0.99
    large_error: float = 0.5


DETERMINATION = DeterminationSettings()


@dataclass(frozen=True, slots=True)
class HistoryFitSettings:
    """Settings of fits to histories.

    Parameters
    ----------
    points : int
        Number of points of each test that are used.
    starts : int
        Number of random starts of the search, with a fixed seed.
    inverse_r, m, beta : (float, float)
        Bounds of 1/r, of m relative to the largest energy density in the tests, and of β.
    """

    points: int = 400
    starts: int = 6
    inverse_r: tuple[float, float] = (0.05, 0.95)
    m: tuple[float, float] = (1e-3, 20.0)
    beta: tuple[float, float] = (0.0, 5.0)


HISTORY_FIT = HistoryFitSettings()


@dataclass(frozen=True, slots=True)
class FlowFitSettings:
    """Settings of fits of networks that flow.

    Parameters
    ----------
    between_turns : int
        Points of a test between two turns of its stretch: 50 leave an error of the step in time of 1 to 2 %.
    starts : int
        Number of starts of the search, with a fixed seed.
    tolerance : float
        Relative change of cost and parameters that ends a search.
    refused : float
        Residual, in largest stresses of a test, of constants for which a step has no solution.
    scale, stiffness, exponent : (float, float)
        Bounds of parameters.
    strain : (float, float)
        Bounds of the strain that flows in the longest test and between two points of it, at the largest stress.
    set_stress : (float, float)
        Bounds over the largest Cauchy stress of the tests.
    set_exponent : (float, float)
        Bounds.
    """

    between_turns: int = 50
    starts: int = 2
    tolerance: float = 1e-6
    refused: float = 1.0
    scale: tuple[float, float] = (0.2, 2.0)
    stiffness: tuple[float, float] = (0.02, 10.0)
    exponent: tuple[float, float] = (1.0, 12.0)
    strain: tuple[float, float] = (1e-4, 1e2)
    set_stress: tuple[float, float] = (1.0, 1e4)
    set_exponent: tuple[float, float] = (1.0, 6.0)


FLOW_FIT = FlowFitSettings()
