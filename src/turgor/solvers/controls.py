"""Controls: what drives a path when the load does not, as equations beside those of equilibrium.

Each adds a few scalars, such as the pressures in cavities, to the unknowns, and as many conditions, such as the volumes
of these cavities. Both may depend on a parameter that orders the states of the path.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from turgor.engine.chambers import Chambers
from turgor.engine.contact.part import Look
from turgor.engine.contact.terms import Contacts
from turgor.engine.system import Evaluation, System
from turgor.solvers.clock import Clock

Array = NDArray[np.float64]

#: Step by which changes along the parameter are measured; what depends on it is straight or nearly so.
NUDGE = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Conditions:
    """Conditions beside equilibrium: their errors (k,), and derivatives by unknowns (k, size) and scalars (k, k)."""

    errors: Array
    rows: Array
    corner: Array


class Sought(Protocol):
    """Scalars that are sought beside the unknowns."""

    @property
    def system(self) -> System:
        """The equations of equilibrium."""

    def load_factor(self, parameter: float, scalars: Array) -> float:
        """How much of the other loads acts."""

    def evaluate(
        self,
        unknowns: Array,
        parameter: float,
        scalars: Array,
        known: Contacts | None = None,
        how: Look = Look.FOLLOW,
    ) -> Evaluation | None:
        """The equations of equilibrium; None where a cell is turned inside out."""

    def columns(self, at: Evaluation) -> Array:
        """Derivative (k, size) of the residual by the scalars."""

    def unstable(self, modes: int | None, stiffness: Array) -> int | None:
        """Unstable modes of what is driven in this way, from those at given loads and the border's matrix (k, k)."""


class Place(Protocol):
    """A state of the path."""

    @property
    def parameter(self) -> float:
        """Its parameter."""

    @property
    def unknowns(self) -> Array:
        """Its unknowns (size,)."""

    @property
    def scalars(self) -> Array:
        """Its scalars (k,)."""

    @property
    def change(self) -> Array | None:
        """Change of the unknowns with the parameter; None where the tangent was singular."""

    @property
    def slope(self) -> Array | None:
        """Change of the scalars."""


class Target(Protocol):
    """Conditions that find the scalars."""

    def conditions(self, unknowns: Array, parameter: float, scalars: Array) -> Conditions:
        """The conditions at a parameter."""

    def onward(self, last: Place, now: Place) -> "Target":
        """The conditions beyond a state that was found after another one."""


@dataclass(frozen=True, slots=True, eq=False)
class Control:
    """What is sought, what it must fulfill, and how long it takes."""

    sought: Sought
    target: Target
    clock: Clock = field(default_factory=Clock)

    def onward(self, last: Place, now: Place) -> "Control":
        """The control beyond a state that was found after another one."""
        return Control(self.sought, self.target.onward(last, now), self.clock.onward(now.parameter))


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

    def evaluate(
        self,
        unknowns: Array,
        parameter: float,
        scalars: Array,
        known: Contacts | None = None,
        how: Look = Look.FOLLOW,
    ) -> Evaluation | None:
        """The equations at the pressures that are sought."""
        return self.system.evaluate(unknowns, parameter, scalars, known, how)

    def columns(self, at: Evaluation) -> Array:
        """Minus the force of a unit pressure in each cavity."""
        position = self.system.points + self.system.split(at.unknowns)[0]
        forces = self.system.faces.unit_forces(position, len(self.system.controlled))
        return np.array([-self.system.joined(force) for force in forces])

    def unstable(self, modes: int | None, stiffness: Array) -> int | None:
        """Fewer than at given pressures: those along which a volume or an amount of gas would change are held.

        The number of negative pivots of the bordered matrix follows from those of both parts (Haynsworth): a cavity
        that loses pressure as it grows takes one off.
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
        """The same all along."""
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
        """Sealed, if this is where."""
        if self.sealed or now.parameter < self.seal:
            return self
        return replace(self, sealed=True, volume=self.chambers.volumes(now.unknowns))


@dataclass(frozen=True, slots=True, eq=False)
class LoadFactor:
    """The load factor.

    Parameters
    ----------
    system : System
        Of a model whose loads all grow in proportion to the load factor, and whose supports stay.
    """

    system: System

    def load_factor(self, parameter: float, scalars: Array) -> float:
        """The scalar itself."""
        return float(scalars[0])

    def evaluate(
        self,
        unknowns: Array,
        parameter: float,
        scalars: Array,
        known: Contacts | None = None,
        how: Look = Look.FOLLOW,
    ) -> Evaluation | None:
        """The equations at the load factor that is sought."""
        return self.system.evaluate(unknowns, float(scalars[0]), None, known, how)

    def columns(self, at: Evaluation) -> Array:
        """Minus the forces of all loads, which are straight in the load factor."""
        full, none = (self.system.external(at.unknowns, factor) for factor in (1.0, 0.0))
        return (none - full)[None, :]

    def unstable(self, modes: int | None, stiffness: Array) -> int | None:
        """Those at given loads, because loads are what was asked for."""
        return modes


@dataclass(frozen=True, slots=True, eq=False)
class WorkTarget:
    """The volume of all cavities, weighted with their pressures at load factor 1, grows with the parameter from 0 to 1.

    Parameters
    ----------
    chambers : Chambers
    weights : (k,) array
        Pressures over the largest of them.
    first, last : float
        Weighted volume at parameters 0 and 1.
    """

    chambers: Chambers
    weights: Array
    first: float
    last: float

    def conditions(self, unknowns: Array, parameter: float, scalars: Array) -> Conditions:
        """Error of the weighted volume relative to its growth."""
        growth = self.last - self.first
        volume = float(self.weights @ self.chambers.volumes(unknowns))
        row = self.weights @ self.chambers.gradients(unknowns) / growth
        return Conditions(np.array([(volume - self.first) / growth - parameter]), row[None, :], np.zeros((1, 1)))

    def onward(self, last: Place, now: Place) -> "WorkTarget":
        """The same all along."""
        return self


@dataclass(frozen=True, slots=True, eq=False)
class ArcTarget:
    """The path has a length from its last state on, counted along its direction there (pseudo arc length).

    Parameters
    ----------
    system : System
    size : float
        Displacement that counts as much as a load factor of 1.
    parameter, unknowns, scalars
        The last state; the parameter is the length up to it.
    along : (size,) array
        Direction of the displacement there, divided by ``size`` twice; zero on mean stresses.
    rise : float
        Direction of the load factor there.
    """

    system: System
    size: float
    parameter: float
    unknowns: Array
    scalars: Array
    along: Array
    rise: float

    def conditions(self, unknowns: Array, parameter: float, scalars: Array) -> Conditions:
        """Error of the length along the direction."""
        length = float(self.along @ (unknowns - self.unknowns) + self.rise * (scalars - self.scalars)[0])
        error = length - (parameter - self.parameter)
        return Conditions(np.array([error]), self.along[None, :], np.array([[self.rise]]))

    def onward(self, last: Place, now: Place) -> "ArcTarget":
        """Go on in the direction of the path, or of the last step where the tangent is singular."""
        if now.change is not None and now.slope is not None:
            change, rise = now.change, float(now.slope[0])
        else:
            change, rise = now.unknowns - last.unknowns, float((now.scalars - last.scalars)[0])
        change = displacement_of(self.system, change)
        norm = float(np.hypot(np.linalg.norm(change) / self.size, rise))
        along = change / (norm * self.size**2)
        return replace(
            self, parameter=now.parameter, unknowns=now.unknowns, scalars=now.scalars, along=along, rise=rise / norm
        )


def displacement_of(system: System, unknowns: Array) -> Array:
    """The unknowns (size,) without mean stresses."""
    out = unknowns.copy()
    out[3 * system.node_count :] = 0.0
    return out


def acting_pressures(system: System, scalars: Array) -> Mapping[str, float]:
    """Gauge pressures [Pa] of the controlled faces."""
    return {name: float(p) * system.stress_scale for name, p in zip(system.controlled, scalars, strict=True)}
