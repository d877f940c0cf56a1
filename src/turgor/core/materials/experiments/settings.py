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
    precision : float
        Share to which numbers of a test are known: two statements of a dimension may differ by it, and the stretch may
        step back by it, of the whole range, without a reversal.
    shortest_series : int
        Points of the shortest series that may be a copy of another: fewer may be equal by chance.
    half_cycle : float
        Smallest range of a half cycle, as a share of the whole range of stretch.
    plain_strain : float
        Largest strain whose column may have no unit: the softest silicones break at 17; more is percent.
    """

    longest_header: int = 5000
    precision: float = 0.01
    shortest_series: int = 4
    half_cycle: float = 0.2
    plain_strain: float = 20.0


EXPERIMENTS = ExperimentSettings()


@dataclass(frozen=True, slots=True)
class SlackSettings:
    """How the stretch without stress is estimated.

    Of 13 published curves whose stretch comes from the crosshead (Marechal et al. 2020), nine are reported; of eight
    others, none.

    Parameters
    ----------
    beginning : float
        The beginning of a curve: points within this stretch of its first.
    points : int
        Fewest points of a beginning.
    floor : float
        Smallest stress for relative weights, as a share of the largest of the beginning.
    searched : (float, float)
        Bounds of the stretch without stress.
    least : float
        Stretch without stress above which a test is reported: 1.005 is within the scatter of curves that begin at rest.
    shortest : float
        Smallest stretch of a pull: a sheet may be slack below its nominal length, but is not compressed.
    at_rest : float
        Points this near to stretch 1 show the stress at rest: the first step of a machine.
    preload_share : float
        Share of the stress of the strain behind a curve's zero from which the stress at rest counts as a preload: a
        rubber that is stiff at first has a zero below 1, too, but no stress at rest.
    """

    beginning: float = 0.3
    points: int = 5
    floor: float = 0.05
    searched: tuple[float, float] = (0.8, 1.3)
    least: float = 1.01
    shortest: float = 0.9
    at_rest: float = 0.003
    preload_share: float = 0.5


SLACK = SlackSettings()


@dataclass(frozen=True, slots=True)
class SlipSettings:
    """When the stress of a pull falls because the specimen slips.

    Of 70 published curves of silicones, natural rubber and printed TPU, none is reported.

    Parameters
    ----------
    share : float
        Smallest fall, as a share of the stress: the noise of those curves is below 1 % of their largest stress.
    above : float
        Share of the largest stress below which no fall counts: load cells waver there.
    noise : float
        Smallest fall, as a multiple of the median change from one interval to the next.
    points : int
        Intervals over which the curve is averaged before: with 17,000 points the extremes of the noise are 6 %.
    """

    share: float = 0.03
    above: float = 0.1
    noise: float = 6.0
    points: int = 200


SLIP = SlipSettings()


@dataclass(frozen=True, slots=True, kw_only=True)
class MachineSettings:
    """When the way of a crosshead shows how far the testing machine gives way.

    Parameters
    ----------
    settled : float
        Share of the largest force of a reference run below which couplings and grips settle.
    points : int
        Fewest points of a reference run above it.
    straight : float
        Largest deviation from a straight line over the force, root mean square over the range: a step of slip that
        is a quarter of the range makes 7 %, the backlash of a load cell 1 %.
    excess : float
        Share of the way of the crosshead up to which it agrees with the strain of the specimen: a video
        extensometer is no better.
    """

    settled: float = 0.1
    points: int = 5
    straight: float = 0.05
    excess: float = 0.01


MACHINE = MachineSettings()
