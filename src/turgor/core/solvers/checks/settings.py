"""Settings of the checks: every number that was chosen, with its reason.

All are without unit unless it is stated; lengths are scaled with the mean edge length, stresses with a shear modulus.
`benchmarks/robustness/constants.md` says which of the robustness cases need them.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class CausesSettings:
    """Settings of causes.

    Parameters
    ----------
    turns_ahead : float
        A law turns over where its stress has an extreme at this many times the stretch that was reached, or before.
    turned_volume : float
        Share of the volume of a region beyond an extreme of its law, from which the law is named as the cause. A few
        cells suffice: where the stress falls, the strain concentrates in them, and they collapse.
    stretched : float
        Rubber stretched less than this is not near any extreme of its law, and its wall is no balloon.
    balloon : float
        A cavity of this many times its volume at rest is a balloon.
    breaks : float
        Stretch that elastomers bear (strains over 500 %, Xavier et al. 2021), where the tests of a law are not known.
    little_compression : float
        Compression that counts, as a share of the largest force per width in the sheet: less is round-off of a taut
        sheet.
    bond : float
        Share of its strength from which a bond is named as the cause: the last state before it softens may be a step
        below.
    """

    turns_ahead: float = 1.05
    turned_volume: float = 1e-3
    stretched: float = 1.15
    balloon: float = 1.3
    breaks: float = 6.0
    little_compression: float = 1e-3
    bond: float = 0.9


CAUSES = CausesSettings()


@dataclass(frozen=True, slots=True)
class ReportSettings:
    """From which size on an effect is reported.

    Parameters
    ----------
    notable_share : float
        Share of the area of a film that wrinkles; of the energy of an actuator that is in the bending that a membrane
        leaves out (five chambers on paper of 0.1 mm, with 6 %, bend by 9 % less once it counts); and of the requested
        spacing by which discrete threads are off.
    large_share : float
        Share of the requested spacing by which threads are off, from which it is a warning; and of the largest
        displacement that points which stick slip elastically.
    """

    notable_share: float = 0.02
    large_share: float = 0.1


REPORTS = ReportSettings()


@dataclass(frozen=True, slots=True)
class PlateSettings:
    """Settings of plate.

    Parameters
    ----------
    behind_tip : float
        Mean distance from the tip at which a plate is touched, as a share of the longest side of the actuator, from
        which it is not the tip that bears. An edge of the tip has 0.6 % (a finger of 3 chambers on cells of 5 mm,
        whose sides spread the force), a chamber whose floor bulges towards the plate 13 to 19 %.
    """

    behind_tip: float = 0.05


PLATE = PlateSettings()


@dataclass(frozen=True, slots=True)
class DistortionSettings:
    """Settings of distortion.

    Parameters
    ----------
    volume_share : float
        Rubber keeps its volume, a mesh keeps it on average. Where a point of a cell has less than this share of its
        volume left, or the inverse of it, the cell bends in a way that the rubber cannot.
    flat : float
        Share of the mean Jacobian determinant of a cell at rest below which a node says nothing: sides that meet on an
        axis, or in one line, have none there.
    """

    volume_share: float = 0.5
    flat: float = 1e-3


DISTORTION = DistortionSettings()


@dataclass(frozen=True, slots=True)
class FibersSettings:
    """Settings of fibers.

    Parameters
    ----------
    cells_between, share_of_perimeter : float
        Distance between smeared threads, in cells and as a share of the perimeter, from which smearing them is
        doubtful.
    nearly_hoops : float [rad]
        Angle from the axis [rad], 80°, from which threads of both hands are nearly hoops, and count twice.
    too_stiff : float
        Stiffness of slack-prone threads over that of the wall below them, per width, from which they are too stiff to
        be solved: which of them are slack changes from iteration to iteration. Tubes with 10,000 times took 140
        iterations, with 50,000 times none converged; Kevlar of 0.18 mm every 2 mm has 800. A tenth is as good as rigid.
    """

    cells_between: float = 1.5
    share_of_perimeter: float = 0.25
    nearly_hoops: float = 1.396
    too_stiff: float = 20_000.0


FIBERS = FibersSettings()


@dataclass(frozen=True, slots=True)
class ObstaclesSettings:
    """Settings of obstacles.

    Parameters
    ----------
    touching : float
        Obstacles may reach into the actuator by this share of its longest side: what just touches overlaps by
        round-off.
    """

    touching: float = 1e-4


OBSTACLES = ObstaclesSettings()


@dataclass(frozen=True, slots=True)
class TimeStepsSettings:
    """Settings of time steps.

    Parameters
    ----------
    long_relaxation_step, fast_relaxation : float
        Steps longer than the first of these shares of a relaxation time are inaccurate. Terms much faster than the
        steps, beyond the second, are always nearly relaxed and do no harm.
    hold_share : float
        A step in which no node moves by more than this share of the largest displacement counts as a hold, which is
        exact. So does one in which the difference of pressure along a channel changes by less than this share of the
        largest pressure.
    good_channel_step : float
        Step over the time constant of a channel from which pressures err by 0.2 %.
    """

    long_relaxation_step: float = 0.6
    fast_relaxation: float = 20.0
    hold_share: float = 0.02
    good_channel_step: float = 0.125


TIME_STEPS = TimeStepsSettings()


@dataclass(frozen=True, slots=True)
class TearingSettings:
    """Settings of tearing.

    Parameters
    ----------
    noted : float
        Share of the elongation at break or of the strength from which it is reported: both differ by a third between
        batches, a wall has two stretches where a dumb-bell has one, and many cycles take more.
    few_cycles : float
        Life below which it is a warning: a day at one cycle per second.
    near : float
        A face is near a place if its nearest node is at most so many times as far as the nearest node of all: the
        place is the middle of a cell.
    """

    noted: float = 0.5
    few_cycles: float = 86_400.0
    near: float = 1.5


TEARING = TearingSettings()
