"""Settings of time stepping, stabilization and vibrations: every number that was chosen, with its reason.

All are without unit unless it is stated; lengths are scaled with the mean edge length, stresses with a shear modulus.
`benchmarks/robustness/constants.md` says which of the robustness cases need them.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class InitialMotionSettings:
    """Settings of initial motion.

    Parameters
    ----------
    difference : float
        Largest displacement, in edge lengths, of the differences along the velocity.
    """

    difference: float = 1e-3


INITIAL_MOTION = InitialMotionSettings()


@dataclass(frozen=True, slots=True)
class ModesSettings:
    """Settings of modes.

    Parameters
    ----------
    first_shift : float
        The first shift, as a share of (speed of shear waves / size of the body)², negative: below the slowest
        vibration.
    lanczos_residual, lanczos_refinements : float, int
        Relative residual of solutions in the Lanczos iterations, and how often they are refined at most.
    shift_lowerings : int
        How often the shift is moved down until no mode is below it.
    rigid_share : float
        An eigenvalue this much smaller than the first shift is that of a rigid motion, not of an instability.
    """

    first_shift: float = 1e-3
    lanczos_residual: float = 1e-12
    lanczos_refinements: int = 4
    shift_lowerings: int = 12
    rigid_share: float = 1e-3


MODES = ModesSettings()


@dataclass(frozen=True, slots=True)
class StabilizationSettings:
    """Settings of stabilization.

    Parameters
    ----------
    energy_error : float
        A step that leaves more of the strain energy unaccounted for than this share went too far, and is tried
        shorter.
    small_move : float
        A step that moves nothing by more than this many edge lengths is no jump.
    hold_growth, holds : float, int
        While the load is constant, each step is this many times as long as the last, up to so many.
    """

    energy_error: float = 1e-2
    small_move: float = 1e-3
    hold_growth: float = 2.0
    holds: int = 80


STABILIZATION = StabilizationSettings()


@dataclass(frozen=True, slots=True)
class TimeStepControlSettings:
    """Settings of time step control.

    Parameters
    ----------
    taken_back : float
        A step whose error is this many times the accuracy is rejected.
    safety, grow : float
        Share of the length at which the error is expected to meet the accuracy, and the largest growth.
    steady : (float, float)
        Changes of the length between these factors are not worth new factors of the tangent.
    stretch : float
        The last stretch to a target is taken whole if it is no longer than this many steps, in two halves up to twice
        that.
    """

    taken_back: float = 2.0
    safety: float = 0.9
    grow: float = 1.5
    steady: tuple[float, float] = (0.85, 1.25)
    stretch: float = 1.05


TIME_STEP_CONTROL = TimeStepControlSettings()


@dataclass(frozen=True, slots=True)
class TimeSteppingSettings:
    """Settings of time stepping.

    Parameters
    ----------
    small_displacement : float
        The error of a step is compared with the largest displacement so far, at least with this share of the body's
        size.
    same_length : float
        Factors of the tangent are used again in a step whose length differs by no more than this share. Without it the
        swinging bar of `benchmarks/robustness/constants.py` takes 28 factorizations instead of 23.
    """

    small_displacement: float = 1e-5
    same_length: float = 0.02


TIME_STEPPING = TimeSteppingSettings()
