"""Settings of calibrations: every number that was chosen, with its reason.

`tests/unit/studies/calibration` and the fits of `benchmarks/studies/searches.py` need them. All are without unit.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class CalibrationSettings:
    """Settings of the search and of its estimates.

    Parameters
    ----------
    bounds : float
        Bounds of a positive parameter where none are given: its starting value over and times this factor.
    step, meshed_step : float
        Relative steps of the finite differences, and those of numbers that change the mesh.
    nudge : float
        Motion of a curve with which its interpolation is differentiated: share of the range of its values, and of the
        smallest step of its drive.
    assumed_spread : float
        Standard deviation of a measurement where it is not known, as a share of the measured range: it weighs
        experiments against each other, and the standard errors are scaled by what remains.
    failed : float
        Weighted difference of every row where a run failed: far above what a curve that misses the measured one has,
        and small enough to be squared.
    margin : float
        Measured rows may lie beyond the computed range by this share of it: a gauge reads a little more than the
        pressure that was set.
    least_scatter : float
        Smallest scatter that assumed spreads are lowered to: differences of a made-up curve may be zero.
    least_gain, resolved : float
        The search ends where one more step would gain less than a fifth of a standard error: this share of the variance
        of the differences, in half the sum of squares. They count as no smaller than the second share of an assumed
        spread: 0.1 % of the measured range, which neither rigs nor meshes resolve. Where the runs are used up, the
        search has converged if a further step would lower the differences by less than this share of the spread.
    smallest_step : float
        It also ends where a step would move every coordinate by less than this: 0.02 % of a positive parameter.
    round_gain : float
        Relative gain at which the search between two fresh Jacobians ends.
    idle_gains : float
        Runs change next to nothing that are higher by at most so many of the least gains. After `RUNS.idle` of them,
        the first point included, it ends as well: a fresh Jacobian knows more.
    undetermined : float
        A combination of parameters is not determined if its standard deviation is above this: 30 % of a positive
        parameter, or of the range of another one.
    least_effect : float
        Nor is it if its effect on the curves is below this share of the strongest one: differences see no less.
    named : float
        Parameters with a smaller share in a combination are not named.
    correlated : float
        Standard errors above this correlation of neighboring differences are too small.
    """

    bounds: float = 10.0
    step: float = 0.01
    meshed_step: float = 0.03
    nudge: float = 1e-6
    assumed_spread: float = 0.02
    failed: float = 1e3
    margin: float = 0.02
    least_scatter: float = 1e-3
    least_gain: float = 0.02
    resolved: float = 0.05
    smallest_step: float = 2e-4
    round_gain: float = 1e-3
    idle_gains: float = 20.0
    undetermined: float = 0.3
    least_effect: float = 1e-4
    named: float = 0.2
    correlated: float = 0.5


CALIBRATION = CalibrationSettings()
