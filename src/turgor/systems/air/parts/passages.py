"""Passages: what resists a flow. Each gives the mass flow from a higher pressure to a lower one."""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf, pi, sqrt
from typing import Protocol, TypeAlias

from turgor.foundation.errors import TurgorError
from turgor.systems.air.fluids import AIR, REFERENCE_PRESSURE, REFERENCE_TEMPERATURE, Fluid, Gas
from turgor.systems.air.settings import FLOW

#: Mass flow [kg/s] from absolute pressures high and low [Pa] and the temperature [K] where it is high.
FlowLaw: TypeAlias = Callable[[float, float, float], float]


class Passage(Protocol):
    """What resists a flow: an orifice, a restriction, a tube, a leak."""

    @property
    def volume(self) -> float:
        """Volume of the fluid in it [m³]."""

    def law(self, fluid: Fluid) -> FlowLaw:
        """Return the mass flow of a fluid."""

    def widened(self, factor: float) -> "Passage":
        """Return the passage with a cross-section that is larger by a factor."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Restriction:
    """Flow of gas by ISO 6358: ṁ = C ρ₀ p₁ √(T₀/T₁) for p₂/p₁ ≤ b, above it times (1 − ((p₂/p₁ − b)/(1 − b))²)^m.

    C and b are those of a data sheet, which states them for air. ρ₀ and T₀ belong to 100 kPa and 20 °C. From p₂/p₁ =
    0.999 on the flow falls linearly to zero.

    Parameters
    ----------
    conductance : float [m³/(s Pa)]
        Sonic conductance C; 1e-8 m³/(s Pa) is 1 dm³/(s bar).
    critical_ratio : float [-]
        b, in [0, 1).
    exponent : float [-]
        m, 0.5 unless measured.

    Examples
    --------
    >>> law = Restriction(conductance=1e-9, critical_ratio=0.3).law(AIR)
    >>> round(law(400e3, 100e3, 293.15) * 1e6, 2)
    475.35
    """

    conductance: float = field(metadata={"dimension": "conductance"})
    critical_ratio: float = 0.3
    exponent: float = 0.5

    def __post_init__(self) -> None:
        _check("conductance", self.conductance, 0.0, inf, "m³/(s Pa)")
        if not 0 <= self.critical_ratio < 1:
            raise TurgorError(f"critical_ratio is {self.critical_ratio:g}; allowed is 0 or more and less than 1.")
        _check("exponent", self.exponent, 0.0, 1.0, "")

    @property
    def volume(self) -> float:
        """None to speak of."""
        return 0.0

    def law(self, fluid: Fluid) -> FlowLaw:
        """Return the mass flow of a gas; other gases than air flow as through a nozzle of the same size."""
        if not isinstance(fluid, Gas):
            raise TurgorError(
                f"conductance belongs to a gas (ISO 6358), and the fluid is {fluid.name}; give the diameter of an "
                "orifice."
            )
        choked = [gas.nozzle(REFERENCE_PRESSURE, 0.0, REFERENCE_TEMPERATURE) for gas in (fluid, AIR)]
        factor = self.conductance * AIR.reference_density * choked[0] / choked[1]
        b, m, last = self.critical_ratio, self.exponent, FLOW.laminar_ratio
        end = (1 - ((last - b) / (1 - b)) ** 2) ** m if last > b else 1.0

        def flow(high: float, low: float, temperature: float) -> float:
            if high <= 0:
                return 0.0
            ratio = low / high
            whole = factor * high * sqrt(REFERENCE_TEMPERATURE / temperature)
            if ratio > last:
                return whole * end * (1 - ratio) / (1 - last)
            return whole if ratio <= b else whole * (1 - ((ratio - b) / (1 - b)) ** 2) ** m

        return flow

    def widened(self, factor: float) -> "Restriction":
        """Return it with a larger conductance."""
        return Restriction(
            conductance=self.conductance * factor, critical_ratio=self.critical_ratio, exponent=self.exponent
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Orifice:
    """A hole: the flow of a nozzle without friction times a discharge coefficient.

    Parameters
    ----------
    diameter : float [m]
        Of the hole.
    discharge : float [-]
        Discharge coefficient, in (0, 1].

    Examples
    --------
    >>> round(Orifice(diameter=1e-3, discharge=1.0).law(AIR)(200e3, 100e3, 293.15) * 1e3, 4)
    0.3708
    """

    diameter: float = field(metadata={"dimension": "length"})
    discharge: float = 0.7

    def __post_init__(self) -> None:
        _check("diameter", self.diameter, 0.0, 1.0, "m")
        _check("discharge", self.discharge, 0.0, 1.0, "")

    @property
    def volume(self) -> float:
        """None to speak of."""
        return 0.0

    def law(self, fluid: Fluid) -> FlowLaw:
        """Return the mass flow."""
        area = self.discharge * pi / 4 * self.diameter**2

        def flow(high: float, low: float, temperature: float) -> float:
            return area * fluid.nozzle(high, low, temperature)

        return flow

    def widened(self, factor: float) -> "Orifice":
        """Return it with a larger area."""
        return Orifice(diameter=self.diameter * sqrt(factor), discharge=self.discharge)


@dataclass(frozen=True, slots=True, kw_only=True)
class Tubing:
    """A smooth tube: laminar or turbulent friction, at most what a nozzle of its bore lets through.

    f L/d · G²/2 = ∫ρ dp with the mass flow per area G and f = max(64/Re, 0.3164 Re^(−1/4)). Where the flow is laminar,
    gas at constant temperature has ṁ = π d⁴ (p₁² − p₂²)/(256 μ L R T). Half of the volume belongs to each end.

    Parameters
    ----------
    diameter, length : float [m]
        Of the bore.

    Examples
    --------
    >>> tube = Tubing(diameter=1e-3, length=1.0)
    >>> round(tube.law(AIR)(101e3, 100e3, 293.15) * 1e6, 3)
    1.611
    """

    diameter: float = field(metadata={"dimension": "length"})
    length: float = field(metadata={"dimension": "length"})

    def __post_init__(self) -> None:
        _check("diameter", self.diameter, 0.0, 1.0, "m")
        _check("length", self.length, 0.0, 1e4, "m")

    @property
    def area(self) -> float:
        """Area of the bore [m²]."""
        return pi / 4 * self.diameter**2

    @property
    def volume(self) -> float:
        """Volume of the bore [m³]."""
        return self.area * self.length

    def law(self, fluid: Fluid) -> FlowLaw:
        """Return the mass flow."""
        d, length, mu, area = self.diameter, self.length, fluid.viscosity, self.area
        laminar = 2 * area * d**2 / (FLOW.laminar_friction * mu * length)
        # turbulent: c (m d/(A mu))^(-1/4) L/d m²/(2 A²) = drive, solved for m
        turbulent = 2 * area**2 * d / (length * FLOW.turbulent_friction) * (d / (area * mu)) ** 0.25

        def flow(high: float, low: float, temperature: float) -> float:
            drive = fluid.potential(high, low, temperature)
            friction = min(laminar * drive, (turbulent * drive) ** (1 / 1.75))
            return min(friction, area * fluid.nozzle(high, low, temperature))

        return flow

    def pressure_loss(self, fluid: Fluid, flow: float, density: float) -> float:
        """Pressure [Pa] that friction takes from a mass flow [kg/s]."""
        size = abs(flow)
        reynolds = max(size * self.diameter / (self.area * fluid.viscosity), 1e-12)
        factor = max(FLOW.laminar_friction / reynolds, FLOW.turbulent_friction * reynolds**-0.25)
        return factor * self.length / self.diameter * flow * size / (2 * density * self.area**2)

    def widened(self, factor: float) -> "Tubing":
        """Return it with a larger bore."""
        return Tubing(diameter=self.diameter * sqrt(factor), length=self.length)


@dataclass(frozen=True, slots=True, kw_only=True)
class Leakage:
    """A leak as it is measured: a laminar flow at a pressure against the air around.

    Parameters
    ----------
    flow : float [m³/s]
        Of a gas at 100 kPa and 20 °C.
    pressure : float [Pa], gauge
        At which the flow was measured.
    """

    flow: float = field(metadata={"dimension": "flow rate"})
    pressure: float = field(metadata={"dimension": "pressure"})

    def __post_init__(self) -> None:
        _check("flow", self.flow, 0.0, inf, "m³/s")
        _check("pressure", self.pressure, 0.0, inf, "Pa")

    @property
    def volume(self) -> float:
        """None to speak of."""
        return 0.0

    def law(self, fluid: Fluid) -> FlowLaw:
        """Return the mass flow, in proportion to ∫ρ dp."""
        around = REFERENCE_PRESSURE
        drive = fluid.potential(around + self.pressure, around, REFERENCE_TEMPERATURE)
        factor = self.flow * fluid.reference_density / drive

        def flow(high: float, low: float, temperature: float) -> float:
            return factor * fluid.potential(high, low, temperature)

        return flow

    def widened(self, factor: float) -> "Leakage":
        """Return it with a larger flow."""
        return Leakage(flow=self.flow * factor, pressure=self.pressure)


def _check(name: str, value: float, low: float, high: float, unit: str) -> None:
    if not (low < value <= high and value < inf):
        upper = f" and at most {high:g}" if high < inf else ""
        raise TurgorError(f"{name} is {value:g} {unit}".rstrip() + f"; allowed is more than {low:g}{upper}.")
