"""Numbers that were chosen for networks of air and liquid."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class FlowSettings:
    """How flow is computed.

    Parameters
    ----------
    laminar_ratio : float [-]
        Ratio of pressures above which flow through an orifice or a restriction is laminar, in proportion to the
        difference of pressures: that of ISO 6358-1. Without it the flow had a vertical tangent where it vanishes.
    laminar_friction, turbulent_friction : float [-]
        f = max(64 / Re, 0.3164 Re^(−1/4)): laminar, and turbulent in a smooth tube (Blasius); both agree at Re = 1190.
    """

    laminar_ratio: float = 0.999
    laminar_friction: float = 64.0
    turbulent_friction: float = 0.3164


@dataclass(frozen=True, slots=True)
class SolverSettings:
    """How networks are integrated in time.

    Parameters
    ----------
    tolerance : float [-]
        Relative error of a step: pressures of six chambers are then right to 3e-5 (`benchmarks/systems/air.md`).
    settled : float [-]
        Step of Newton's method, over the size of the unknown, that is the last one: the next would be its square.
    updates : int
        Most updates of Newton's method; every second one halves the interval at worst, so that they suffice.
    beyond : float [-]
        How far a pressure may leave a table, over its range: round-off and overshoot of steps.
    samples : int
        Times at which a result is stored, unless they are given.
    most_switches : int
        Most switching times of a network: a valve of 1 kHz for a minute has as many.
    agreed : float [-]
        Difference of the volumes of gas and actuator at the end of a step, over the volume, at which they agree.
    rounds : int
        Most updates of these volumes in a step; two or three are usual, and a step that needs more is halved.
    halvings : int
        How often a step is halved before the run ends.
    apart : float [-]
        A jump of a signal ends a step unless it is nearer than this share of a step to a time that is stored: a tiny
        step would turn round-off into velocity.
    """

    tolerance: float = 1e-5
    settled: float = 1e-9
    updates: int = 200
    beyond: float = 1e-3
    samples: int = 500
    most_switches: int = 120_000
    agreed: float = 1e-8
    rounds: int = 15
    halvings: int = 6
    apart: float = 0.01


@dataclass(frozen=True, slots=True)
class PerformanceSettings:
    """How the performance of an actuator is found.

    Parameters
    ----------
    empty : float [-]
        Share of the wanted pressure at which a chamber counts as vented.
    longest : float [s]
        Longest time to fill or vent.
    band : float [-]
        Missing pressure at which the valve of a regulator is fully open, over the wanted one.
    slow : float [-]
        Frequency at which the lag is stated, over the bandwidth.
    octave : float [-]
        Interval of the logarithm of the bandwidth: 1 %.
    samples, fine : int
        States of a period, and of a fill, at which integrals are taken.
    tolerance, event_tolerance : float [-]
        Relative error of a step: that of an amplitude is 1e-4, that of a time 1e-6.
    """

    empty: float = 0.05
    longest: float = 3600.0
    band: float = 0.02
    slow: float = 1 / 3
    octave: float = 0.004
    samples: int = 100
    fine: int = 400
    tolerance: float = 1e-5
    event_tolerance: float = 1e-6


FLOW = FlowSettings()
SOLVER = SolverSettings()
PERFORMANCE = PerformanceSettings()
