"""Fluids: gases, and liquids with or without air in them."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import exp, inf, sqrt
from types import MappingProxyType
from typing import TypeAlias

from turgor.foundation.errors import TurgorError
from turgor.systems.air.settings import FLOW

#: Reference state of flows (ISO 8778): 100 kPa and 20 °C.
REFERENCE_PRESSURE, REFERENCE_TEMPERATURE = 100e3, 293.15

#: Pressure of the air around [Pa], absolute.
STANDARD_ATMOSPHERE = 101_325.0


def _check_positive(fluid: object, *names: str) -> None:
    for name in names:
        if not 0 < getattr(fluid, name) < inf:
            raise TurgorError(f"{name} of a fluid is {getattr(fluid, name):g}; a positive number is needed.")


@dataclass(frozen=True, slots=True, kw_only=True)
class Gas:
    """A perfect gas: ρ = p / (R T).

    Parameters
    ----------
    name : str
    gas_constant : float [J/(kg K)]
        R of this gas.
    heat_ratio : float [-]
        γ = cp / cv.
    viscosity : float [Pa s]
        Dynamic viscosity, at any pressure.

    Examples
    --------
    >>> round(AIR.density(100e3, 293.15), 3), round(AIR.heat_capacity)
    (1.188, 1005)
    """

    name: str
    gas_constant: float
    heat_ratio: float
    viscosity: float

    def __post_init__(self) -> None:
        _check_positive(self, "gas_constant", "viscosity")
        if not 1 < self.heat_ratio < 2:
            raise TurgorError(f"heat_ratio is {self.heat_ratio:g}; allowed is more than 1 and less than 2.")

    @property
    def heat_capacity(self) -> float:
        """Heat capacity cp at constant pressure [J/(kg K)]."""
        return self.gas_constant * self.heat_ratio / (self.heat_ratio - 1)

    @property
    def reference_density(self) -> float:
        """Density at the reference state [kg/m³]."""
        return self.density(REFERENCE_PRESSURE, REFERENCE_TEMPERATURE)

    @property
    def critical_ratio(self) -> float:
        """Ratio of pressures below which the flow through a nozzle is choked [-]."""
        return float((2 / (self.heat_ratio + 1)) ** (self.heat_ratio / (self.heat_ratio - 1)))

    def density(self, pressure: float, temperature: float) -> float:
        """Density [kg/m³] at an absolute pressure [Pa] and a temperature [K]."""
        return pressure / (self.gas_constant * temperature)

    def compression(self, pressure: float, temperature: float) -> float:
        """Derivative of the density by the pressure at constant temperature [kg/(m³ Pa)]."""
        return 1 / (self.gas_constant * temperature)

    def potential(self, high: float, low: float, temperature: float) -> float:
        """Integral of the density over the pressure, which drives flow against friction [kg Pa/m³]."""
        return (high - low) * (high + low) / (2 * self.gas_constant * temperature)

    def nozzle(self, high: float, low: float, temperature: float) -> float:
        """Mass flow per area through a nozzle without friction [kg/(s m²)], choked below the critical ratio.

        Saint-Venant and Wantzel: ṁ/A = p₁ √(2γ/((γ−1) R T) (r^(2/γ) − r^((γ+1)/γ))) with r = p₂/p₁. Close to r = 1 the
        flow is laminar, in proportion to 1 − r.
        """
        if high <= 0:
            return 0.0
        ratio = max(low / high, self.critical_ratio)
        share = 1.0
        if ratio > FLOW.laminar_ratio:
            share, ratio = (1 - ratio) / (1 - FLOW.laminar_ratio), FLOW.laminar_ratio
        g = self.heat_ratio
        bracket = ratio ** (2 / g) - ratio ** ((g + 1) / g)
        return share * high * sqrt(2 * g / ((g - 1) * self.gas_constant * temperature) * bracket)


@dataclass(frozen=True, slots=True, kw_only=True)
class Liquid:
    """A liquid that is compressed a little, with air in it where ``air`` is more than zero.

    ρ = ρ₀ (1 − a) / ((1 − a) exp(−(p − p₀)/K) + a p₀/p) with the share ``a`` of air in the volume at p₀ = 101.325 kPa.

    Parameters
    ----------
    name : str
    reference_density : float [kg/m³]
        Density ρ₀ of the liquid without air at p₀.
    bulk_modulus : float [Pa]
        K of the liquid without air.
    viscosity : float [Pa s]
        Dynamic viscosity.
    air : float [-]
        Share of the volume that is air at p₀, in [0, 1). The air keeps its temperature.

    Examples
    --------
    >>> round(WATER.density(1.1e6, 293.15), 2)
    998.66
    """

    name: str
    reference_density: float
    bulk_modulus: float
    viscosity: float
    air: float = 0.0

    def __post_init__(self) -> None:
        _check_positive(self, "reference_density", "bulk_modulus", "viscosity")
        if not 0 <= self.air < 1:
            raise TurgorError(f"air in a liquid is {self.air:g}; allowed is 0 or more and less than 1.")

    def _parts(self, pressure: float) -> tuple[float, float]:
        """Volumes of liquid and air, over the volume at p₀."""
        liquid = (1 - self.air) * exp(min((STANDARD_ATMOSPHERE - pressure) / self.bulk_modulus, 700.0))
        return liquid, self.air * STANDARD_ATMOSPHERE / pressure if self.air else 0.0

    def density(self, pressure: float, temperature: float) -> float:
        """Density [kg/m³] at an absolute pressure [Pa]."""
        return self.reference_density * (1 - self.air) / sum(self._parts(pressure))

    def compression(self, pressure: float, temperature: float) -> float:
        """Derivative of the density by the pressure [kg/(m³ Pa)]."""
        liquid, air = self._parts(pressure)
        by_pressure = liquid / self.bulk_modulus + air / pressure
        return self.reference_density * (1 - self.air) * by_pressure / (liquid + air) ** 2

    def potential(self, high: float, low: float, temperature: float) -> float:
        """Density times difference of pressures, which drives flow against friction [kg Pa/m³]."""
        return self.density((high + low) / 2, temperature) * (high - low)

    def nozzle(self, high: float, low: float, temperature: float) -> float:
        """Mass flow per area through a nozzle without friction [kg/(s m²)]: √(2 ρ Δp), laminar at small Δp."""
        drop, least = high - low, (1 - FLOW.laminar_ratio) * STANDARD_ATMOSPHERE
        effective = drop if drop > least else drop * drop / least
        return sqrt(2 * self.density(high, temperature) * effective)


Fluid: TypeAlias = Gas | Liquid

AIR = Gas(name="air", gas_constant=287.05, heat_ratio=1.4, viscosity=18.2e-6)
WATER = Liquid(name="water", reference_density=998.2, bulk_modulus=2.18e9, viscosity=1.002e-3)

#: Fluids by name, at 20 °C.
FLUIDS: Mapping[str, Fluid] = MappingProxyType(
    {
        "air": AIR,
        "nitrogen": Gas(name="nitrogen", gas_constant=296.8, heat_ratio=1.4, viscosity=17.6e-6),
        "carbon_dioxide": Gas(name="carbon_dioxide", gas_constant=188.9, heat_ratio=1.29, viscosity=14.7e-6),
        "helium": Gas(name="helium", gas_constant=2077.1, heat_ratio=1.667, viscosity=19.6e-6),
        "water": WATER,
        "glycerol": Liquid(name="glycerol", reference_density=1261.0, bulk_modulus=4.5e9, viscosity=1.41),
        "silicone_oil": Liquid(name="silicone_oil", reference_density=960.0, bulk_modulus=1.0e9, viscosity=0.096),
    }
)
