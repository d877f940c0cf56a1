"""Lumped dynamics: one mass, damper and spring, identified from a step or from a sweep of frequencies."""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, pi, sqrt
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import least_squares

from turgor.fast_models.formulas.formula import Formula
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source

Array = NDArray[np.float64]

#: Share of the motion that a second-order system may leave unexplained.
UNEXPLAINED = 0.03

LUMPED = Formula(
    name="identify_step",
    title="Mass, damper and spring of an actuator from a step, or from a sweep of frequencies.",
    families=(),
    assumptions=(
        "One mass, one damper and one spring: m ẍ + c ẋ + k x = drive; higher modes do not matter.",
        "The motion is proportional to the drive, and the drive rises at once.",
        "Rubber does not creep during the record.",
    ),
    source=Source(text="linear vibrations of one degree of freedom", detail="least squares, covariance of residuals"),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class SecondOrder:
    """A second-order system x'' + 2 ζ ω x' + ω² x = ω² g drive, with its uncertainties (one standard deviation).

    Parameters
    ----------
    natural_frequency : float [Hz]
        ω / 2π, without damping.
    damping_ratio : float [-]
        ζ: 1 is critical.
    gain : float
        Motion for each unit of drive at rest, in SI units.
    delay : float [s]
        Time before the motion begins.
    offset : float
        Motion before the step.
    natural_frequency_uncertainty, damping_ratio_uncertainty, gain_uncertainty : float
        Infinite where the record does not determine them.
    unexplained : float [-]
        Root mean square of what is left over, as a share of the spread of the motion.
    findings : tuple of Finding
        F07 where the motion is not that of such a system.
    """

    natural_frequency: float
    damping_ratio: float
    gain: float
    delay: float = 0.0
    offset: float = 0.0
    natural_frequency_uncertainty: float
    damping_ratio_uncertainty: float
    gain_uncertainty: float
    unexplained: float
    findings: tuple[Finding, ...] = ()

    @property
    def stiffness(self) -> float:
        """Spring k: drive for each unit of motion."""
        return 1 / self.gain

    @property
    def mass(self) -> float:
        """Mass m = k / ω²."""
        return self.stiffness / (2 * pi * self.natural_frequency) ** 2

    @property
    def damping(self) -> float:
        """Damper c = 2 ζ √(k m)."""
        return 2 * self.damping_ratio * self.stiffness / (2 * pi * self.natural_frequency)

    def step(self, time: ArrayLike, drive: float, *, measure: Column) -> Response:
        """Return its motion after a step of the drive: ``time`` and the measure, named and in the unit of a column."""
        t = np.asarray(time, dtype=np.float64)
        own = self.gain * drive, self.natural_frequency, self.damping_ratio
        moved = self.offset + own[0] * step_shape(t - self.delay, own[1], own[2])
        columns = [Column("time", "s", t), Column(measure.name, measure.unit, moved)]
        return LUMPED.response(columns, self.findings)


def step_shape(time: Array, frequency: float, damping: float) -> Array:
    """Motion of unit gain after a unit step at the time 0, for any damping, (n,).

    Examples
    --------
    >>> step_shape(np.array([-1.0, 0.0, 0.5, 50.0]), 1.0, 0.1).round(3)
    array([0.   , 0.   , 1.729, 1.   ])
    """
    t, w = np.maximum(time, 0.0), 2 * pi * frequency
    if abs(damping - 1) < 1e-6:
        return np.asarray(1 - (1 + w * t) * np.exp(-w * t))
    if damping < 1:
        wd = w * sqrt(1 - damping**2)
        return np.asarray(1 - np.exp(-damping * w * t) * (np.cos(wd * t) + damping * w / wd * np.sin(wd * t)))
    root = sqrt(damping**2 - 1)
    slow, fast = w * (damping - root), w * (damping + root)
    return np.asarray(1 - (fast * np.exp(-slow * t) - slow * np.exp(-fast * t)) / (fast - slow))


def identify_step(response: Response, measure: str, *, drive: float = 1.0, delayed: bool = False) -> SecondOrder:
    """Identify mass, damper and spring from the motion after a step of the drive at the time 0.

    Assumptions: One mass, one damper and one spring: m ẍ + c ẋ + k x = drive; higher modes do not matter. The motion is
    proportional to the drive, and the drive rises at once. Rubber does not creep during the record.

    Least squares from several starts; uncertainties come from the residuals, which count as independent.

    Parameters
    ----------
    response : Response
        With ``time`` and the measure, from a dynamic solve or an experiment; values at negative times are at rest.
    measure : str
        Name of the column, such as ``"bending_angle"``.
    drive : float
        Height of the step: a pressure [Pa] or a force [N]; m, c and k are for this drive.
    delayed : bool
        Whether a delay before the motion is estimated, too.

    Returns
    -------
    SecondOrder

    Raises
    ------
    TurgorError
        If there are fewer than eight rows, or nothing moves.

    Examples
    --------
    >>> t = np.linspace(0, 2, 200)
    >>> moved = 0.3 * step_shape(t, 4.0, 0.05)
    >>> columns = (Column("time", "s", t), Column("bending_angle", "deg", moved))
    >>> found = identify_step(Response(columns=columns, source=Source(text="a camera")), "bending_angle", drive=10e3)
    >>> round(found.natural_frequency, 6), round(found.damping_ratio, 6), round(found.gain * 10e3, 6)
    (4.0, 0.05, 0.3)
    """
    t, x = response.column("time"), response.column(measure)
    _check(t, x, measure, drive)
    ahead = float(x[np.argmax(t >= 0)])
    last = float(x[-max(1, len(x) // 4) :].mean()) - ahead
    spread = float(np.ptp(x))

    def residual(p: Array) -> Array:
        gain, log_f, log_z, offset, *late = p
        shape = step_shape(t - (late[0] if late else 0.0), float(np.exp(log_f)), float(np.exp(log_z)))
        return np.asarray((offset * spread + gain * spread * shape - x) / spread)

    starts = []
    for f in _frequencies(t, x):
        for z in (0.05, 0.5, 1.5):
            starts.append([last / spread or 1.0, np.log(f), np.log(z), ahead / spread, *[0.0] * delayed])
    best = _best(residual, starts)
    gain, log_f, log_z, offset, *late = best.x.tolist()
    errors = _uncertainties(best.jac, best.fun)
    frequency, damping = float(np.exp(log_f)), float(np.exp(log_z))
    return SecondOrder(
        natural_frequency=frequency,
        damping_ratio=damping,
        gain=gain * spread / drive,
        delay=late[0] if late else 0.0,
        offset=offset * spread,
        natural_frequency_uncertainty=frequency * errors[1],
        damping_ratio_uncertainty=damping * errors[2],
        gain_uncertainty=spread / abs(drive) * errors[0],
        unexplained=_unexplained(best.fun, x / spread),
        findings=_not_second_order(_unexplained(best.fun, x / spread), measure),
    )


def identify_sweep(frequency: ArrayLike, amplitude: ArrayLike, *, drive: float = 1.0) -> SecondOrder:
    """Identify mass, damper and spring from a sweep: amplitudes of the motion, with or without their phase.

    The assumptions are those of `identify_step`; the drive is a sine of the amplitude ``drive``, in steady state.

    Parameters
    ----------
    frequency : (n,) array [Hz]
        Positive.
    amplitude : (n,) array
        Of the motion in SI units; complex where the phase against the drive is known.
    drive : float
        Amplitude of the drive: a pressure [Pa] or a force [N].

    Returns
    -------
    SecondOrder

    Raises
    ------
    TurgorError
        If there are fewer than five frequencies, or nothing moves.

    Examples
    --------
    >>> f = np.linspace(1, 10, 40)
    >>> found = identify_sweep(f, 0.3 / np.abs(1 - (f / 4) ** 2 + 2j * 0.1 * f / 4))
    >>> round(found.natural_frequency, 6), round(found.damping_ratio, 6), round(found.gain, 6)
    (4.0, 0.1, 0.3)
    """
    f, moved = np.asarray(frequency, dtype=np.float64), np.asarray(amplitude)
    if f.ndim != 1 or f.shape != moved.shape or len(f) < 5 or not (f > 0).all():
        given = f"{f.size} frequencies and {moved.size} amplitudes"
        raise TurgorError(f"a sweep has {given}; five positive frequencies or more, with amplitudes, are needed.")
    size = float(np.abs(moved).max())
    if not np.isfinite(moved).all() or not size > 0 or drive == 0:
        given = f"amplitude goes up to {size:.4g} and drive is {drive:.4g}"
        raise TurgorError(f"{given}; finite numbers other than zero are needed.")
    known = bool(np.iscomplexobj(moved))

    def residual(p: Array) -> Array:
        gain, log_f, log_z = p
        share = f / np.exp(log_f)
        model = gain / (1 - share**2 + 2j * np.exp(log_z) * share)
        off = model - moved / size if known else np.abs(model) - np.abs(moved) / size
        return np.concatenate([off.real, off.imag]) if known else np.asarray(off)

    peak = float(f[np.argmax(np.abs(moved))])
    first = float(np.real(moved[np.argmin(f)])) / size
    starts = [[first, np.log(at), np.log(z)] for at in (peak, 0.5 * peak, 2 * peak) for z in (0.03, 0.3, 1.0)]
    best = _best(residual, starts)
    errors = _uncertainties(best.jac, best.fun)
    gain, natural, damping = best.x[0], float(np.exp(best.x[1])), float(np.exp(best.x[2]))
    motion = np.concatenate([moved.real, moved.imag]) if known else np.abs(moved)
    unexplained = _unexplained(best.fun, motion / size)
    return SecondOrder(
        natural_frequency=natural,
        damping_ratio=damping,
        gain=float(gain) * size / drive,
        natural_frequency_uncertainty=natural * errors[1],
        damping_ratio_uncertainty=damping * errors[2],
        gain_uncertainty=size / abs(drive) * errors[0],
        unexplained=unexplained,
        findings=_not_second_order(unexplained, "amplitude"),
    )


def _check(t: Array, x: Array, measure: str, drive: float) -> None:
    if len(t) < 8:
        raise TurgorError(f"a step needs at least eight rows; this response has {len(t)}.")
    if not np.isfinite(x).all() or not np.ptp(x) > 0 or drive == 0:
        raise TurgorError(f"'{measure}' is {x.min():.4g} to {x.max():.4g} at a drive of {drive:.4g}; it must move.")
    if not (np.diff(t) > 0).all() or t[-1] <= 0:
        raise TurgorError(f"times are {t[0]:.4g} to {t[-1]:.4g} s; they must rise beyond 0, when the drive rises.")


def _frequencies(t: Array, x: Array) -> list[float]:
    """First guesses [Hz]: from the crossings of the mean of the second half, and from the length of the record."""
    after = t >= 0
    t, x = t[after], x[after]
    about = x - x[len(x) // 2 :].mean()
    crossings = int((about[:-1] * about[1:] < 0).sum())
    length = float(t[-1] - t[0])
    return [max(crossings, 1) / 2 / length, 1 / length, 10 / length]


def _best(residual: Callable[[Array], Array], starts: list[list[float]]) -> Any:
    fits = [least_squares(residual, start, x_scale="jac", xtol=1e-14, ftol=1e-14, gtol=1e-14) for start in starts]
    return min(fits, key=lambda each: each.cost)


def _uncertainties(jacobian: Array, residuals: Array) -> list[float]:
    """Standard deviations from the residuals, as of independent errors; infinite where there is no information."""
    spare = len(residuals) - jacobian.shape[1]
    normal = jacobian.T @ jacobian
    if spare < 1 or np.linalg.cond(normal) > 1e14:
        return [inf] * jacobian.shape[1]
    return np.sqrt(np.diag(np.linalg.inv(normal)) * float(residuals @ residuals) / spare).tolist()


def _unexplained(residuals: Array, motion: Array) -> float:
    spread = float(np.std(motion)) or 1.0
    return float(np.sqrt((residuals**2).mean())) / spread


def _not_second_order(unexplained: float, measure: str) -> tuple[Finding, ...]:
    """F07: one mass, damper and spring do not explain the motion."""
    if unexplained < UNEXPLAINED:
        return ()
    return (
        Finding(
            code="F07",
            severity=Severity.WARNING,
            message=f"One mass, damper and spring leave {100 * unexplained:.3g} % of '{measure}' unexplained.",
            advice="Look at the record: a second mode, creep, a drive that rises slowly (delayed=True helps with a "
            "dead time) or large motion; use natural_frequencies or a dynamic solve instead.",
        ),
    )
