"""Controlled: answers at given volumes or amounts of gas of cavities, whose pressures are unknown.

Volumes are cubic polynomials of the coordinates, so each is one exact equation more, and its pressure one unknown.
"""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from turgor.core.solvers.procedures.gas_mass import STANDARD_ATMOSPHERE
from turgor.foundation.errors import NotSolved, TurgorError, unknown
from turgor.reduced.parts.obstacles import ObstructingAt
from turgor.reduced.settings import NEWTON
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.equations import Equations, EquationsAt
from turgor.reduced.states.newton import Balance, newton
from turgor.reduced.states.reduced import Reduced

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


class Law(Protocol):
    """What connects volumes and pressures of cavities."""

    def errors(self, volumes: Array, pressures: Array) -> tuple[Array, Array, Array]:
        """Errors (k,) of scaled volumes and pressures (k,), and their derivatives by both."""


@dataclass(frozen=True, slots=True, eq=False)
class Volumes:
    """Given scaled volumes (k,)."""

    wanted: Array

    def errors(self, volumes: Array, pressures: Array) -> tuple[Array, Array, Array]:
        """Errors relative to the volumes."""
        return volumes / self.wanted - 1.0, 1.0 / self.wanted, np.zeros_like(volumes)


@dataclass(frozen=True, slots=True, eq=False)
class Gas:
    """Amounts of gas: absolute pressure times volume to a power follows the amount, as in `GasMass`.

    Parameters
    ----------
    rest : (k,) array
        Scaled volumes at rest.
    ratios : (k,) array
        Gas over that at rest.
    ambient, outside : float
        Scaled absolute pressures around, at rest and now.
    exponent : float
    """

    rest: Array
    ratios: Array
    ambient: float
    outside: float
    exponent: float

    def errors(self, volumes: Array, pressures: Array) -> tuple[Array, Array, Array]:
        """Errors of the pressures, relative to the ambient one."""
        should = self.ambient * (self.ratios * self.rest / volumes) ** self.exponent
        by_volume = self.exponent * should / volumes / self.ambient
        return (pressures + self.outside - should) / self.ambient, by_volume, np.full_like(volumes, 1.0 / self.ambient)


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Controlled(Equations):
    """Equations with the pressures of some cavities as further unknowns, in shares of the ranges of their inputs.

    Parameters
    ----------
    cavities : (k,) int array
        Their places among the faces under pressure.
    places : (k,) int array
        Places of their inputs, the share of the fixed loads first.
    widths : (k,) array
    law : Law
    """

    cavities: Ints
    places: Ints
    widths: Array
    law: Law

    def at(self, y: Array, inputs: Array) -> "ControlledAt | None":  # type: ignore[override]
        """Evaluate at unknowns (r + m + k,); the inputs of the cavities are those of the unknowns."""
        count = len(self.cavities)
        inputs = inputs.copy()
        inputs[self.places] = y[-count:] * self.widths
        # no zero-argument super: a class with slots is made twice
        plain = Equations.at(self, y[:-count], inputs)
        return None if plain is None else ControlledAt(plain, self, y)


@dataclass(frozen=True, slots=True, eq=False)
class ControlledAt:
    """Equations and conditions on cavities at some unknowns."""

    plain: EquationsAt
    controlled: Controlled
    y: Array

    @property
    def equations(self) -> Controlled:
        """The equations."""
        return self.controlled

    @property
    def inputs(self) -> Array:
        """Inputs (1 + n,), the found ones among them."""
        return self.plain.inputs

    @property
    def obstacles(self) -> tuple[ObstructingAt, ...]:
        """What the obstacles do."""
        return self.plain.obstacles

    @property
    def _conditions(self) -> tuple[Array, Array, Array]:
        c = self.controlled
        return c.law.errors(self.plain.cubics.values[c.cavities], (c.pressures @ self.inputs)[c.cavities])

    @property
    def residual(self) -> Array:
        """Residual (r + m + k,)."""
        return np.concatenate([self.plain.residual, self._conditions[0]])

    def tangent(self, geometric: list[Array | None] | None = None) -> Array:
        """Tangent (r + m + k, r + m + k)."""
        c, n, r = self.controlled, len(self.plain.y), len(self.controlled.forces)
        out = np.zeros((len(self.y), len(self.y)))
        out[:n, :n] = self.plain.tangent(geometric)
        out[:n, n:] = self.plain.by_inputs()[:, c.places] * c.widths
        _, by_volume, by_pressure = self._conditions
        out[n:, :r] = by_volume[:, None] * self.plain.cubics.gradients[c.cavities]
        out[n:, n:] = by_pressure[:, None] * c.pressures[c.cavities][:, c.places] * c.widths
        return out

    def linearized(self, update: Array) -> list[Array | None]:
        """Stresses of the parts linearized for an update."""
        return self.plain.linearized(update[: len(self.plain.y)])


def at_volumes(
    reduced: Reduced, volumes: Mapping[str, float], values: Mapping[str, float] | None = None
) -> ReducedState:
    """Find the equilibrium at injected volumes, as `VolumeControl` does; the pressures are the answer.

    Parameters
    ----------
    reduced : Reduced
    volumes : mapping of str to float [m³]
        Volume injected in each of some cavities of the whole actuator since rest.
    values : mapping of str to float [SI], optional
        The other inputs.

    Returns
    -------
    ReducedState

    Raises
    ------
    TurgorError
        If a cavity is unknown or has no pressure of its own among the inputs, or a pressure lies outside of the trained
        range.
    NotSolved
        If no equilibrium was found.
    """
    cavities, rest = _cavities(reduced, volumes), _volumes_at_rest(reduced)
    injected = np.array(list(volumes.values())) / (reduced.scales[0] ** 3 * reduced.model.mesh.symmetry_factor)
    wanted = rest[cavities] + injected
    for name, volume in zip(volumes, wanted, strict=True):
        if volume <= 0:
            raise TurgorError(f"{volumes[name] * 1e6:g} mL is more than the cavity '{name}' has at rest.")
    return _solved(reduced, cavities, Volumes(wanted), values or {})


def at_gas(
    reduced: Reduced,
    ratios: Mapping[str, float],
    values: Mapping[str, float] | None = None,
    *,
    exponent: float = 1.0,
    outside: float | None = None,
) -> ReducedState:
    """Find the equilibrium at amounts of gas, as `GasMass` does; the pressures are the answer.

    Parameters
    ----------
    reduced : Reduced
    ratios : mapping of str to float [-]
        Gas in each of some cavities over that at rest, under the standard atmosphere.
    values : mapping of str to float [SI], optional
        The other inputs.
    exponent : float [-]
        1 where the gas keeps its temperature, 1.4 for air that exchanges no heat.
    outside : float [Pa], absolute, optional
        Pressure around; the standard atmosphere by default.

    Returns
    -------
    ReducedState

    Raises
    ------
    TurgorError
        As `at_volumes`.
    NotSolved
        If no equilibrium was found.
    """
    for name, ratio in ratios.items():
        if not ratio > 0:
            raise TurgorError(f"the gas ratio of '{name}' is {ratio:g}; it must be more than 0.")
    cavities, rest = _cavities(reduced, ratios), _volumes_at_rest(reduced)
    around = STANDARD_ATMOSPHERE if outside is None else outside
    scaled = STANDARD_ATMOSPHERE / reduced.scales[1], around / reduced.scales[1]
    return _solved(
        reduced, cavities, Gas(rest[cavities], np.array(list(ratios.values())), *scaled, exponent), values or {}
    )


def _volumes_at_rest(reduced: Reduced) -> Array:
    """Scaled volumes of all cavities."""
    return reduced.equations.cubics.at(np.zeros(reduced.equations.sizes[0])).values


def _cavities(reduced: Reduced, names: Mapping[str, float]) -> Ints:
    for name in names:
        if name not in reduced.faces:
            raise unknown("cavity", name, reduced.faces)
    if not names:
        raise TurgorError(f"no cavity is stated; the reduced model has {', '.join(reduced.faces)}.")
    return np.array([reduced.faces.index(name) for name in names])


def _own_inputs(reduced: Reduced, cavities: Ints) -> Ints:
    """Place of the input of each cavity, the share of the fixed loads first."""
    drives, out = reduced.equations.pressures[:, 1:] != 0, []
    for cavity in cavities:
        own = [k for k in np.flatnonzero(drives[cavity]) if drives[:, k].sum() == 1]
        if len(own) != 1:
            raise TurgorError(
                f"'{reduced.faces[cavity]}' needs one input that is its own pressure; the inputs are "
                f"{', '.join(reduced.inputs.keys)}."
            )
        out.append(1 + int(own[0]))
    return np.array(out)


def _solved(reduced: Reduced, cavities: Ints, law: Law, values: Mapping[str, float]) -> ReducedState:
    """Newton's method from the training states that are nearest to the conditions."""
    box, e, places = reduced.inputs, reduced.equations, _own_inputs(reduced, cavities)
    names = {box.keys[place - 1] for place in places}
    given = {key: float(reduced.inputs.low[k]) for k, key in enumerate(box.keys) if key in names}
    stated = {box.keys[box.place(name)]: value for name, value in values.items()}
    for key in sorted(names & set(stated)):
        raise TurgorError(
            f"the input '{key}' is unknown where its cavity's volume or gas is given; leave its value out."
        )
    aim = np.concatenate([[1.0], box.vector(given | stated)])
    widths = (box.high - box.low)[places - 1]
    same = {each.name: getattr(e, each.name) for each in fields(Equations)}
    controlled = Controlled(**same, cavities=cavities, places=places, widths=widths, law=law)
    vain = 0
    for start in _starts(reduced, controlled, aim):
        result = newton(controlled, start, aim, reduced.size)
        if isinstance(result, Balance):
            at = result.at.plain  # type: ignore[attr-defined]
            box.check(at.inputs[1:])
            return ReducedState.of(reduced, Balance.of(at, result.iterations), vain)
        vain += result
    raise NotSolved(
        f"the reduced model finds no equilibrium with these volumes or this gas within {vain} updates; the pressure "
        "may lie outside of the trained range."
    )


def _starts(reduced: Reduced, controlled: Controlled, aim: Array) -> list[Array]:
    """Training states with their pressures, those with the smallest errors of the conditions first."""
    r, errors = reduced.equations.sizes[0], []
    others = np.setdiff1d(np.arange(1, len(aim)), controlled.places)
    for inputs, y in zip(reduced.trained_inputs, reduced.trained, strict=True):
        volumes = controlled.cubics.at(y[:r]).values[controlled.cavities]
        wrong = controlled.law.errors(volumes, (controlled.pressures @ inputs)[controlled.cavities])[0]
        away = ((inputs - aim) * reduced.weights)[others]
        errors.append(float(wrong @ wrong + away @ away))
    order = np.argsort(errors, kind="stable")[: NEWTON.starts]
    pressures = reduced.trained_inputs[:, controlled.places] / controlled.widths
    return [np.concatenate([reduced.trained[k], pressures[k]]) for k in order]
