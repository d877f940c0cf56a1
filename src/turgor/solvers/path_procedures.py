"""Procedures that follow a path past limit points, where the pressure falls although the actuator grows."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from turgor.errors import TurgorError
from turgor.solvers.step_checks import check_steps

#: Pressure of the air around [Pa].
STANDARD_ATMOSPHERE = 101_325.0


@dataclass(frozen=True, slots=True, kw_only=True)
class VolumeControl:
    """Inject an incompressible fluid into cavities; the pressure is the answer, so it may fall.

    The load factor is the share of the volume that was injected; other loads grow with it.

    Parameters
    ----------
    volume : float [m³], or mapping of str to float
        Volume injected in the end, of the whole actuator where a half is modeled; by cavity where there are several.
        Negative volumes are drawn off.
    first_step, max_step, min_step : float [-]
        First, largest and smallest increment of the load factor, in (0, 1].
    at : tuple of float [-]
        Load factors that must be hit exactly besides 1, each in (0, 1].
    tolerance : float [-]
        Largest relative residual force, and largest error of a volume relative to that of the cavity.
    max_iterations : int
        Newton iterations before a step is cut back.
    max_steps : int
        Attempted steps before the solve stops.
    duration : float [s], optional
        Time at load factor 1, for rubber that relaxes, as that of `Static`.

    Examples
    --------
    >>> VolumeControl(volume=12e-6).volume
    1.2e-05
    """

    volume: float | Mapping[str, float] = field(metadata={"dimension": "volume"})
    first_step: float = 0.02
    max_step: float = 0.1
    min_step: float = 1e-5
    at: tuple[float, ...] = ()
    tolerance: float = 1e-6
    max_iterations: int = 15
    max_steps: int = 1000
    duration: float | None = field(default=None, metadata={"dimension": "time"})

    def __post_init__(self) -> None:
        for where, volume in _by_cavity(self.volume, "volume").items():
            if not volume or not abs(volume) < 1e3:
                raise TurgorError(f"procedure.volume{where} is {volume:g} m³; a volume other than zero is needed.")
        self.check_steps()

    def check_steps(self) -> None:
        """Refuse steps, tolerances and numbers of iterations that make no sense."""
        check_steps(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class GasMass:
    """Pump a known amount of gas into closed cavities, or seal them and change the pressure around.

    Absolute pressure times volume to the power n follows the amount of gas: p Vⁿ = p₀ (m/m₀ V₀)ⁿ, with the ambient
    pressure p₀ and the volume V₀ at rest. The load factor leads from a mass ratio m/m₀ of 1 to the one that is asked
    for, and from the ambient pressure to that outside; other loads grow with it.

    Parameters
    ----------
    mass_ratio : float [-], or mapping of str to float
        Gas in a cavity in the end over the gas in it at rest; by cavity where there are several.
    exponent : float [-]
        1 where the gas keeps its temperature (slow), 1.4 for air that exchanges no heat (fast), in [1, 1.7].
    ambient : float [Pa], absolute
        Pressure of the air around and inside at rest.
    outside : float [Pa], absolute, optional
        Pressure around in the end; that at rest if it is not given.
    pressure : float [Pa], gauge
        Pressure at which the cavities are sealed: up to the load factor ``seal`` they are filled to it, and what is
        said above about states at rest holds for that one. Zero seals them at rest.
    seal : float [-]
        Load factor at which they are sealed, in (0, 1); of no meaning without a pressure.
    first_step, max_step, min_step, at, tolerance, max_iterations, max_steps, duration
        As those of `VolumeControl`.

    Examples
    --------
    >>> GasMass(mass_ratio=2.0).final_outside
    101325.0
    """

    mass_ratio: float | Mapping[str, float] = field(default=1.0, metadata={"dimension": "number"})
    exponent: float = 1.0
    ambient: float = field(default=STANDARD_ATMOSPHERE, metadata={"dimension": "pressure"})
    outside: float | None = field(default=None, metadata={"dimension": "pressure"})
    pressure: float = field(default=0.0, metadata={"dimension": "pressure"})
    seal: float = 0.5
    first_step: float = 0.05
    max_step: float = 0.1
    min_step: float = 1e-5
    at: tuple[float, ...] = ()
    tolerance: float = 1e-6
    max_iterations: int = 15
    max_steps: int = 1000
    duration: float | None = field(default=None, metadata={"dimension": "time"})

    def __post_init__(self) -> None:
        for where, ratio in _by_cavity(self.mass_ratio, "mass_ratio").items():
            if not 0 < ratio <= 1000:
                raise TurgorError(f"procedure.mass_ratio{where} is {ratio:g}; allowed is more than 0 up to 1000.")
        if not 1 <= self.exponent <= 1.7:
            raise TurgorError(f"procedure.exponent is {self.exponent:g}; allowed is 1 to 1.7.")
        for name, value in (("ambient", self.ambient), ("outside", self.final_outside)):
            if not 0 <= value <= 1e8 or (name == "ambient" and not value):
                raise TurgorError(f"procedure.{name} is {value:g} Pa; an absolute pressure up to 1e8 Pa is needed.")
        if not -self.ambient < self.pressure <= 1e8:
            raise TurgorError(f"procedure.pressure is {self.pressure:g} Pa; more than minus the ambient one is needed.")
        if not 0 < self.seal < 1:
            raise TurgorError(f"procedure.seal is {self.seal:g}; a load factor between 0 and 1 is needed.")
        check_steps(self)

    @property
    def final_outside(self) -> float:
        """Pressure around in the end [Pa]."""
        return self.ambient if self.outside is None else self.outside


@dataclass(frozen=True, slots=True, kw_only=True)
class ArcLength:
    """Follow the path by its length, so that the load may rise and fall; all loads keep their proportion.

    The length of a step joins the change of the load factor with that of the displacement, scaled so that both are
    alike in the first step; a body that buckles is measured by its own displacement from then on. The path ends where
    the load factor reaches 1 or 0, at one of the bounds, or where it goes back the way it came.

    Parameters
    ----------
    max_stretch : float [-]
        Largest principal stretch anywhere at which the path ends, more than 1.
    max_displacement : float [m], optional
        Largest displacement of a node at which the path ends.
    first_step : float [-]
        Load factor of the first state, in (0, 1].
    max_step, min_step : float [-]
        Largest and smallest length of a step.
    at : tuple of float [-]
        Load factors at which a state is made wherever the path crosses them, each in (0, 1].
    tolerance, max_iterations
        As those of `VolumeControl`.
    max_steps : int
        Attempted arcs before the solve stops.

    Examples
    --------
    >>> ArcLength(max_stretch=3.0).max_stretch
    3.0
    """

    max_stretch: float = 10.0
    max_displacement: float | None = field(default=None, metadata={"dimension": "length"})
    first_step: float = 0.05
    max_step: float = 0.5
    min_step: float = 1e-4
    at: tuple[float, ...] = ()
    tolerance: float = 1e-6
    max_iterations: int = 15
    max_steps: int = 1000

    def __post_init__(self) -> None:
        if not self.max_stretch > 1:
            raise TurgorError(f"procedure.max_stretch is {self.max_stretch:g}; a stretch above 1 is needed.")
        if self.max_displacement is not None and not self.max_displacement > 0:
            raise TurgorError(f"procedure.max_displacement is {self.max_displacement:g} m; it must be above 0.")
        check_steps(self, longest=100.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Auto:
    """Load control as long as it goes; before a limit point or a leap the volume of the cavities or the arc takes over.

    Where all loads are pressures in cavities, the volume weighted with the pressures takes over, and the path goes on
    until the load factor has come back to 1 or the cavities have grown ``past`` times as much as at the first limit
    point. Where other loads act, the arc length takes over, up to ``max_stretch``.

    Parameters
    ----------
    past : float [-]
        How far to follow the path: injected volume over that at the limit point, in (1, 1000].
    max_stretch : float [-]
        Largest principal stretch anywhere at which the path ends, more than 1.
    first_step, max_step, min_step, at, tolerance, max_iterations, max_steps
        As those of `Static`.

    Examples
    --------
    >>> Auto(past=4.0).past
    4.0
    """

    past: float = 3.0
    max_stretch: float = 10.0
    first_step: float = 0.05
    max_step: float = 0.25
    min_step: float = 1e-4
    at: tuple[float, ...] = ()
    tolerance: float = 1e-6
    max_iterations: int = 15
    max_steps: int = 1000

    def __post_init__(self) -> None:
        if not 1 < self.past <= 1000:
            raise TurgorError(f"procedure.past is {self.past:g}; allowed is more than 1 up to 1000.")
        if not self.max_stretch > 1:
            raise TurgorError(f"procedure.max_stretch is {self.max_stretch:g}; a stretch above 1 is needed.")
        check_steps(self)


def _by_cavity(value: float | Mapping[str, float], name: str) -> dict[str, float]:
    """Values by the text that names their place after the field."""
    if not isinstance(value, Mapping):
        return {"": value}
    if not value:
        raise TurgorError(f"procedure.{name} names no cavity; state a number, or one for each cavity.")
    return {f".{cavity}": each for cavity, each in value.items()}
