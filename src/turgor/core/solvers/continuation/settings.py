"""Settings of continuation: every number that was chosen, with its reason.

All are without unit unless it is stated; lengths are scaled with the mean edge length, stresses with a shear modulus.
`benchmarks/robustness/constants.md` says which of the robustness cases need them.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class BranchJumpSettings:
    """Settings of branch jump.

    Parameters
    ----------
    jump_ratio : float
        A step in which a body moves this many times as much for its load as in the step before may have jumped.
        Towards a limit point steps get shorter, and the factor from one to the next stays at two or three.
    farther_than_rates : float
        A step that moves a body this many times as far as the faster of the rates at its ends has left the path.
    still_share : float
        A step that moves a body by less than this share of its displacement is no jump.
    """

    jump_ratio: float = 5.0
    farther_than_rates: float = 2.0
    still_share: float = 1e-2


BRANCH_JUMP = BranchJumpSettings()


@dataclass(frozen=True, slots=True)
class BranchSwitchSettings:
    """Settings of branch switch.

    Parameters
    ----------
    longest_step : float
        Longest arc, and longest step by volume in the injected volume at which it takes over, over the longest step of
        the load.
    auto_min_step : float
        Smallest step of load control before `Auto` prescribes the volume or the arc length instead.
    """

    longest_step: float = 2.0
    auto_min_step: float = 2e-3


BRANCH_SWITCH = BranchSwitchSettings()


@dataclass(frozen=True, slots=True)
class ContinuitySettings:
    """Settings of continuity.

    Parameters
    ----------
    straight_chord : float
        The chord of a step has this cosine at least with the directions of the path at both of its ends.
    corner_cuts : int
        At a corner of the path, as where walls meet, no step is short enough for that: half of it suffices after so
        many cuts: `test_a_sharp_turn_is_cut_and_a_corner_taken_in_the_end`.
    bifurcation_jump : float
        The remaining step may be longer than along a smooth path by this factor; beyond that it is a jump. Needed by
        `test_path_continuity.py`.
    """

    straight_chord: float = 0.8
    corner_cuts: int = 4
    bifurcation_jump: float = 4.0


CONTINUITY = ContinuitySettings()


@dataclass(frozen=True, slots=True)
class LimitPointsSettings:
    """Settings of limit points.

    Parameters
    ----------
    solves, flat_slope : int, float
        Solves at most to find one limit point, and to find one bifurcation; the slope times the width of the step, as
        a share of the value, below which a limit point is found.
    """

    solves: int = 8
    flat_slope: float = 1e-6


LIMIT_POINTS = LimitPointsSettings()


@dataclass(frozen=True, slots=True)
class LoadControlSettings:
    """Settings of load control.

    Parameters
    ----------
    reach : float
        Where no step succeeds, pseudo-transient continuation is tried over at most this share of the load.
    long_first_step : float
        If the first step is at least this share of the load, the response to a small load is computed first. Needed by
        `test_a_long_first_step_uses_the_factors_of_the_state_at_rest`.
    """

    reach: float = 0.05
    long_first_step: float = 0.2


LOAD_CONTROL = LoadControlSettings()


@dataclass(frozen=True, slots=True)
class PredictorSettings:
    """Settings of predictor.

    Parameters
    ----------
    history : int
        States used at most: a quartic through the last five.
    far : float
        A step so many times as long as the last one is far: the first steps of a path are then compared with staying
        where they begin. Steps grow to twice the length; a load that acts at once is followed by one that is
        thousands of times longer.
    wrinkling_history : int
        States used where sheets wrinkle, for a parabola. Four films (one chamber to 30 kPa, one with thick walls to
        50, five to 15, paper to 60) took 210, 197 and 241 iterations with 2, 3 and 5 states, and 289 with stress and
        strain of the sheet extrapolated by the same order as the displacement instead of a line.
    good_prediction : float
        An extrapolation that leaves a smaller relative residual is taken without trying a lower order.
    stays_on : float
        Where a smaller share of the points that touch would still touch along the tangent, it leads off a curved
        body. Of 63 points of a belt that slides on a drum, 12 stayed in contact along the tangent.
    shortenings : int
        An extrapolation is shortened this often at most where it presses walls into each other. With one, "bellows
        under vacuum" takes over 104 iterations instead of 63.
    """

    history: int = 5
    far: float = 4.0
    wrinkling_history: int = 3
    good_prediction: float = 0.05
    stays_on: float = 0.8
    shortenings: int = 3


PREDICTOR = PredictorSettings()


@dataclass(frozen=True, slots=True)
class StepAcceptanceSettings:
    """Settings of step acceptance.

    Parameters
    ----------
    support_aside : float
        In one step no support leaves the straight line to its next place by more than this share of its length; on a
        circle that is a quarter turn.
    """

    support_aside: float = 0.2


STEP_ACCEPTANCE = StepAcceptanceSettings()


@dataclass(frozen=True, slots=True)
class StepControlSettings:
    """Settings of step control.

    Parameters
    ----------
    comfortable_iterations : int
        Iterations of a step that is neither too easy nor too hard.
    wrinkling_iterations : int
        The same where sheets wrinkle: each step finds again which points are slack, in 6 to 9 iterations whatever its
        length.
    touching_iterations, touching_growth : int, float
        The same where walls touch: each step finds again which points do; with 9, blocked fingers took up to a third
        more. A step grows by the second factor at most there: needed by "plate that sticks, 40 %", which takes 65
        iterations instead of 49 with a factor of 2.
    touching_share : float
        An easy step that was shortened, so that walls meet gently, is followed by one of this share of the length
        that it would have had, at least: with 0, 0.3 and 0.5 six blocked fingers took 450, 448 and 436 iterations, a
        seventh 61, 61 and 52, and six other cases with contact 332, 327 and 342.
    step_cut : float
        A failed step is tried again with this share of its length.
    creeping_attempts, creeping_advance : int, float
        A run ends where half of so many attempts failed and the others advanced by less than this share of the load.
        With the usual smallest step they advance farther; a run that may take steps of 1e-8 made 945 attempts.
        `test_steps_that_creep_are_in_vain` has it.
    stretch : float
        The last stretch to a target is taken whole if it is no longer than this many steps.
    smallest_tolerance : float
        In steps shorter than the first one the tolerance shrinks with them, to no less than this. Of twelve columns
        bowed by 5e-6 to 5e-5 of their length, eleven pass their buckling load so, and seven or eight with the same
        tolerance.
    load_digits : int
        Load factors between targets are rounded to this many digits, so that tables read well.
    """

    comfortable_iterations: int = 6
    wrinkling_iterations: int = 9
    touching_iterations: int = 7
    touching_growth: float = 3.0
    touching_share: float = 0.5
    step_cut: float = 0.35
    creeping_attempts: int = 60
    creeping_advance: float = 1e-3
    stretch: float = 1.25
    smallest_tolerance: float = 1e-9
    load_digits: int = 6


STEP_CONTROL = StepControlSettings()
