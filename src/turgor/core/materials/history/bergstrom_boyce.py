"""Bergström and Boyce's rubber: a second network that flows with a power of its stress.

The law of the material is network A, the response of an infinitely slow test. Network B has the same law times a
stiffness ratio s and the gradient Fₑ of F = Fₑ F_v. It flows at the equivalent rate

    ε̇ = ε̇₀ (λ_v − 1 + ξ)^C (q/q̂)^m,    D_v = 3/2 ε̇ τ′/q,    λ_v = √(tr(F_vᵀ F_v)/3)

with the Mises stress q of its Kirchhoff stress τ (J. S. Bergström, M. C. Boyce, J. Mech. Phys. Solids 46 (1998) 931,
doi 10.1016/S0022-5096(97)00075-6, in the form of Abaqus, whose A is ε̇₀ q̂^(−m)). With m = 1 and C = 0 the network is a
linear one of the relaxation time q̂ / (3 μ_B ε̇₀). The step in time is in `turgor.core.materials.history.flow`.
"""

from dataclasses import dataclass, fields
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.history.resistance import Resistance
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class BergstromBoyce:
    """Rate-dependent rubber after Bergström and Boyce: a network that flows, besides that of the law.

    Parameters
    ----------
    stiffness : float [-]
        Stiffness s of the flowing network over that of the law; positive. A sudden test is 1 + s times as stiff as a
        slow one.
    rate : float [1/s]
        Rate of flow at the Mises stress ``stress`` where the factor of the creep strain is 1; positive.
    stress : float [Pa]
        Mises stress at which the network flows at this rate; positive.
    exponent : float [-]
        Power m of the stress, 1 or more.
    strain_exponent : float [-]
        Power C of the creep strain λ_v − 1 + ξ, from −1 to 0: a network that has flowed flows more slowly.
    offset : float [-]
        ξ, which bounds the rate before any flow; positive.

    Examples
    --------
    >>> BergstromBoyce(stiffness=1.6, rate=0.1, stress=1e5, exponent=4.0).strain_exponent
    -1.0
    """

    stiffness: float
    rate: float
    stress: float
    exponent: float
    strain_exponent: float = -1.0
    offset: float = 0.01

    def __post_init__(self) -> None:
        for item in fields(self):
            value = getattr(self, item.name)
            needed = _needed(item.name, value)
            if needed:
                raise TurgorError(f"BergstromBoyce: {item.name} is {value:g}; it must be {needed}.")

    @staticmethod
    def from_abaqus(*, S: float, A: float, m: float, C: float = -1.0, E: float = 0.01) -> "BergstromBoyce":
        """The network by the constants of ``*HYSTERESIS`` in N, mm and s.

        Parameters
        ----------
        S : float [-]
            Stress of the flowing network over that of the law.
        A : float [MPa^(−m)/s]
            Constant of the rate.
        m, C, E : float [-]
            Powers of stress and creep strain; offset of the creep strain.

        Examples
        --------
        >>> BergstromBoyce.from_abaqus(S=1.6, A=0.5, m=4).stress
        1000000.0
        """
        return BergstromBoyce(stiffness=S, rate=A, stress=1e6, exponent=m, strain_exponent=C, offset=E)

    def resistance(self, step: float, reference: Array) -> Resistance:
        """What network B opposes to flow in a step.

        Parameters
        ----------
        step : float [s]
            Length Δt of the step, finite.
        reference : (..., 3, 3) array
            F_v⁻¹ at its beginning.
        """
        X = reference @ np.swapaxes(reference, -1, -2)
        trace = np.trace(X, axis1=-2, axis2=-1)
        invariant = 0.5 * (trace**2 - np.einsum("...ij,...ji->...", X, X))  # tr(F_vᵀ F_v), because det F_v = 1
        creep = np.sqrt(np.maximum(invariant, 3.0) / 3.0) - 1.0 + self.offset
        amount = step * self.rate * creep**self.strain_exponent
        with np.errstate(divide="ignore"):
            stress = self.stress * amount ** (-1.0 / self.exponent)
        return Resistance(stress, self.exponent, 0.0, np.zeros(stress.shape))


def _needed(name: str, value: float) -> str:
    """What a constant must be; empty where it is that."""
    if name == "exponent":
        return "" if isfinite(value) and value >= 1 else "1 or more"
    if name == "strain_exponent":
        return "" if -1 <= value <= 0 else "from -1 to 0"
    return "" if isfinite(value) and value > 0 else "more than 0 and finite"
