"""Settings of comparisons with measurements: every number that was chosen, with its reason. All are without unit."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class LaboratorySettings:
    """Settings of what is reported of a measurement.

    Parameters
    ----------
    rest : float
        Share of the range of the drive below which an actuator counts as at rest: a gauge without pressure shows less.
    shown : float
        Share of the measured range above which offset, drift and loop are reported: cameras and gauges resolve 1 %.
    closed : float
        A computed drive that comes back to within this share of its range has been unloaded; a path past a limit point
        comes back by less.
    loop_points : int
        Values of the drive at which the width of a loop is averaged.
    """

    rest: float = 0.02
    shown: float = 0.01
    closed: float = 0.05
    loop_points: int = 101


LABORATORY = LaboratorySettings()
