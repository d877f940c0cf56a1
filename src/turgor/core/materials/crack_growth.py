"""Crack growth: how far a crack in a rubber grows in each cycle of load, and how many cycles it takes to tear through.

A small crack of the length c releases the tearing energy T = 2 k W c for each unit of new area (R. S. Rivlin,
A. G. Thomas, J. Polym. Sci. 10 (1953) 291), where W is the energy density that is available to open it and
k = (2.95 − 0.08 (λ − 1))/√λ at the stretch λ (P. B. Lindley, J. Strain Anal. 7 (1972) 132). Above a threshold it grows
in each cycle by dc/dN = r (T/T₁)^β (A. G. Thomas, J. Polym. Sci. 31 (1958) 467; G. J. Lake, P. B. Lindley, Rubber J.
146 (1964) 24). From the first flaw to where it tears this gives the number of cycles.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity, number

Array = NDArray[np.float64]

#: Tearing energy that the rate belongs to, T₁ [J/m²].
REFERENCE = 1e3


@dataclass(frozen=True, slots=True, kw_only=True)
class CrackGrowth:
    """Growth of a crack in each cycle from rest to a load and back, dc/dN = rate (T / 1 kJ/m²)^exponent.

    Parameters
    ----------
    rate : float [m]
        Growth in one cycle at a tearing energy of 1 kJ/m².
    exponent : float [-]
        Slope β in a logarithmic plot, more than 1.
    flaw : float [m]
        Length of the cracks that are there at first: cut edges, bubbles, dirt.
    threshold : float [N/m, which is J/m²]
        Tearing energy below which no crack grows.
    spread : float [-]
        Factor by which rates of equal specimens differ, upwards and downwards; at least 1.
    source : str
        Where the numbers come from.

    Examples
    --------
    >>> ours = CrackGrowth(rate="0.1 µm", exponent=2, flaw="0.05 mm", source="our tests of May")
    >>> f"{ours.cycles(4e6):.3g}"  # 2 k W = 4 MJ/m³: T = 200 J/m² at first
    '1.25e+04'
    """

    rate: float
    exponent: float
    flaw: float
    threshold: float = 0.0
    spread: float = 1.0
    source: str = ""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            rate: Quantity,
            exponent: float,
            flaw: Quantity,
            threshold: Quantity = 0.0,
            spread: float = 1.0,
            source: str = "",
        ) -> None: ...

    def __post_init__(self) -> None:
        dimensions = {"rate": "length", "exponent": "", "flaw": "length", "threshold": "force per length", "spread": ""}
        least = {"exponent": 1.0, "spread": 1.0}
        for name, dimension in dimensions.items():
            value = number(getattr(self, name), f"crack growth: {name}", dimension)
            object.__setattr__(self, name, value)
            lowest = least.get(name, 0.0)
            if value < lowest or (value == lowest and name not in ("threshold", "spread")):
                allowed = f"{'at least' if name in ('threshold', 'spread') else 'more than'} {lowest:g}"
                raise TurgorError(f"crack growth: {name} is {value:g}; {allowed} is needed.")

    def cycles(self, energy_per_length: ArrayLike, critical: float = inf, faster: float = 1.0) -> Array:
        """Return the number of cycles until the first flaw has grown to where it tears.

        Parameters
        ----------
        energy_per_length : array [J/m³]
            Tearing energy per length of the crack at the peak of each cycle, 2 k W.
        critical : float [N/m]
            Tearing energy at which it tears at once; by default it grows without end, which takes hardly longer.
        faster : float
            Factor on the rate, for the ends of its spread.

        Returns
        -------
        array
            Infinite where the flaw does not grow, 0 where it tears at once.
        """
        each = np.asarray(energy_per_length, dtype=np.float64)
        first = each * self.flaw
        with np.errstate(divide="ignore", invalid="ignore"):
            power = self.exponent - 1
            growth = faster * self.rate * (first / REFERENCE) ** self.exponent
            count = self.flaw / (power * growth) * (1 - (first / critical) ** power)
        count = np.where(first <= self.threshold, inf, count)
        return np.asarray(np.where(first >= critical, 0.0, count))


def tearing_energy_of_crack(energy: ArrayLike, stretch: ArrayLike, crack: float) -> Array:
    """Return the tearing energy of a small crack across the largest stretch, T = 2 k W c.

    Parameters
    ----------
    energy : array [J/m³]
        Energy density that is available to open it; in simple tension the strain energy density.
    stretch : array [-]
        Largest principal stretch around it.
    crack : float [m]
        Length of a crack from an edge, or half of that of a crack inside, in the undeformed body.

    Returns
    -------
    array [J/m²]

    Examples
    --------
    >>> f"{float(tearing_energy_of_crack(0.1e6, 1.5, 0.1e-3)):.3g}"  # J/m²
    '47.5'
    """
    elongation = np.maximum(np.asarray(stretch, dtype=np.float64) - 1, 0.0)
    k = np.maximum(2.95 - 0.08 * elongation, 0.0) / np.sqrt(1 + elongation)
    return np.asarray(2 * k * np.asarray(energy) * crack)


_ORDER = (
    "order of magnitude, chosen to pass through what is common in publications, not at hand ({}); measure your "
    "own rubber where the number counts"
)

#: Typical rubbers, for a first estimate.
CRACK_GROWTH: Mapping[str, CrackGrowth] = MappingProxyType(
    {
        "natural rubber": CrackGrowth(
            rate=1e-7, exponent=2.0, flaw=25e-6, threshold=50.0, spread=10.0,
            source=_ORDER.format("exponent 2 and threshold 50 J/m², Lake and Lindley 1965; flaws of 25 µm, Gent, "
                                 "Lindley and Thomas 1964"),
        ),
        "non-crystallizing rubber": CrackGrowth(
            rate=1e-5, exponent=4.0, flaw=50e-6, threshold=50.0, spread=10.0,
            source=_ORDER.format("exponent 4 and threshold 50 J/m² of styrene-butadiene rubber, Lake and Lindley 1964 "
                                 "and 1965; silicones crystallize at no stretch at room temperature either"),
        ),
    }
)  # fmt: skip
