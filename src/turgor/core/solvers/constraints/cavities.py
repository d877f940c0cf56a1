"""Constraints by cavities: their pressures are unknown, their volumes or amounts of gas are given."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.chamber_volumes import Chambers
from turgor.core.engine.system import Evaluation, System
from turgor.core.solvers.constraints.constraint import Place
from turgor.core.solvers.constraints.elimination import Conditions

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class CavityPressures:
    """Pressures of cavities.

    Parameters
    ----------
    system : System
        Made with these cavities as controlled faces.
    """

    system: System

    def load_factor(self, parameter: float, scalars: Array) -> float:
        """The parameter itself."""
        return parameter

    def pressures(self, scalars: Array) -> Array | None:
        """The scalars themselves."""
        return scalars

    def columns(self, at: Evaluation) -> Array:
        """Minus the force of a unit pressure in each cavity."""
        position = self.system.points + self.system.split(at.unknowns)[0]
        forces = self.system.terms.unit_forces(position, len(self.system.controlled))
        return np.array([-self.system.joined(force) for force in forces])

    def unstable(self, modes: int | None, stiffness: Array) -> int | None:
        """Unstable modes at given volumes or amounts of gas, fewer than at given pressures.

        The number of negative pivots of the bordered matrix is the sum of those of both parts (Haynsworth): a cavity
        whose pressure falls as it grows takes one unstable mode off.
        """
        return None if modes is None else modes - int((np.linalg.eigvals(stiffness).real < 0).sum())


@dataclass(frozen=True, slots=True, eq=False)
class VolumeTarget:
    """Each cavity has its volume at rest plus a share of the injected one; the share is the parameter.

    Parameters
    ----------
    chambers : Chambers
    rest, injected : (k,) array
        Scaled volumes.
    """

    chambers: Chambers
    rest: Array
    injected: Array

    def conditions(self, unknowns: Array, parameter: float, scalars: Array) -> Conditions:
        """Errors of the volumes, relative to those at rest and injected."""
        scale = self.rest + np.abs(self.injected)
        volumes = self.chambers.volumes(unknowns)
        errors = (volumes - self.rest - parameter * self.injected) / scale
        rows = self.chambers.gradients(unknowns) / scale[:, None]
        return Conditions(errors, rows, np.zeros((len(scale), len(scale))))

    def onward(self, last: Place, now: Place) -> "VolumeTarget":
        """The same conditions at all states."""
        return self


@dataclass(frozen=True, slots=True, eq=False)
class GasTarget:
    """Each cavity holds an amount of gas: p Vⁿ = p₀ (m/m₀ V₀)ⁿ with the absolute pressure p.

    Up to the parameter ``seal`` the pressure is prescribed instead, and grows to ``pressure``.

    Parameters
    ----------
    chambers : Chambers
    volume : (k,) array
        V₀: scaled volumes when they are sealed, those at rest until then.
    mass_ratio : (k,) array
        m/m₀ at parameter 1; it is 1 when they are sealed.
    ambient, outside : float
        Scaled absolute pressure around when they are sealed and at parameter 1.
    exponent : float
    pressure : (k,) array
        Scaled gauge pressures at which they are sealed.
    seal : float
        The parameter there; zero where they are from the start.
    sealed : bool
        Whether they are.
    """

    chambers: Chambers
    volume: Array
    mass_ratio: Array
    ambient: float
    outside: float
    exponent: float
    pressure: Array
    seal: float
    sealed: bool

    def conditions(self, unknowns: Array, parameter: float, scalars: Array) -> Conditions:
        """Errors of the law of the gas, relative to its right side; before the seal those of the pressure."""
        if not self.sealed:
            errors = (scalars - parameter / self.seal * self.pressure) / np.abs(self.pressure)
            return Conditions(errors, np.zeros((len(scalars), len(unknowns))), np.diag(1 / np.abs(self.pressure)))
        share = (parameter - self.seal) / (1 - self.seal)
        n, volumes = self.exponent, np.maximum(self.chambers.volumes(unknowns), 0.0)
        ratio = 1 + share * (self.mass_ratio - 1)
        absolute = scalars + self.ambient + share * (self.outside - self.ambient)
        right = (self.pressure + self.ambient) * (ratio * self.volume) ** n
        errors = absolute * volumes**n / right - 1
        rows = (absolute * n * volumes ** (n - 1) / right)[:, None] * self.chambers.gradients(unknowns)
        return Conditions(errors, rows, np.diag(volumes**n / right))

    def onward(self, last: Place, now: Place) -> "GasTarget":
        """The conditions beyond a state: sealed from the seal on."""
        if self.sealed or now.parameter < self.seal:
            return self
        return replace(self, sealed=True, volume=self.chambers.volumes(now.unknowns))
