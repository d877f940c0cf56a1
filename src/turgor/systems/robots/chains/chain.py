"""Chain: rigid links with springs in their joints, on which pressures act as generalized forces.

A joint turns about y, then about z, and slides along its x then, or has some of these. Springs are cubic,

    torque = k₁ x + k₂ x² + k₃ x³,

and a pressure p does the work p dV on the joints with V = L + ½ g L², L = Σ cⱼ xⱼ, so its generalized force at joint j
is p cⱼ (1 + g L). These are forces that MuJoCo has: `stiffness` of a joint, and an actuator with an affine gain on a
fixed tendon of coefficients c.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.display import Shown
from turgor.foundation.errors import NotSolved
from turgor.systems.robots.backbone import Array

#: Newton's method: updates, the torque that may be left over the largest, the longest update [rad] and [lengths].
UPDATES, TOLERANCE, LONGEST = 100, 1e-10, 0.3

#: An update is halved at most so often, while it leaves more than so many times the force.
HALVED, GROWN = 6, 3.0

#: Kinds of joints, and the axis of each.
TURN_Y, TURN_Z, SLIDE = 1, 2, 0


@dataclass(frozen=True, slots=True, eq=False)
class Placed:
    """A chain in some shape.

    Parameters
    ----------
    turns, origins : (n, 3, 3), (n, 3) arrays
        Frames of the links.
    axes, anchors : (d, 3) arrays
        Of the joints: direction, and a point on the axis.
    """

    turns: Array
    origins: Array
    axes: Array
    anchors: Array


class Outside(Protocol):
    """What acts on a chain from outside."""

    def forces(self, chain: "Chain", at: Placed) -> Array:
        """Generalized forces (d,)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Chain(Shown):
    """A chain of rigid links along x.

    Parameters
    ----------
    base : (3,) array [m]
        Center of the fixed end.
    pivots : (n, 3) array [m]
        Origin of each link at its joint, in the frame of the link before; the first in that of the base.
    end : (3,) array [m]
        The tip in the frame of the last link.
    kinds : tuple of int
        Coordinates of every joint in order: 1 turns about y, 2 about z, 0 slides along x.
    springs : (d, 3) array [N m, N]
        Coefficients of the torque of each coordinate, d = n times the number of kinds.
    gains : (p, d) array [m³ by coordinate]
        c of each pressure.
    growth : (p,) array [1/m³]
        g of each pressure.
    masses : (n,) array [kg]
    centers : (n, 3) array [m]
        Of mass, in the frame of each link.
    inertias : (n, 3) array [kg m²]
        About the axes of each link through its center.
    gravity : (3,) array [m/s²]
    limits : (d, 2) array
        Range of each coordinate.
    capsules : (n, 7) array [m]
        Of each link in its frame: both ends of the line inside, and the radius.
    names : tuple of str
        Of the pressures.
    high : (p,) array [Pa]
        Largest pressures.
    low : (p,) array [Pa]
    rolls : (n, 3, 3) array, optional
        Rotation of each link at rest from the one before; none by default.
    """

    base: Array
    pivots: Array
    end: Array
    kinds: tuple[int, ...]
    springs: Array
    gains: Array
    growth: Array
    masses: Array
    centers: Array
    inertias: Array
    gravity: Array
    limits: Array
    capsules: Array
    names: tuple[str, ...]
    high: Array
    low: Array
    rolls: Array | None = None

    def __repr__(self) -> str:
        return f"Chain({len(self.pivots)} links, {len(self.springs)} coordinates, pressures {', '.join(self.names)})"

    @property
    def links(self) -> int:
        """Number of links."""
        return len(self.pivots)

    @cached_property
    def rest_turns(self) -> Array:
        """Rotation (n, 3, 3) of each link at rest from the one before."""
        return np.tile(np.eye(3), (self.links, 1, 1)) if self.rolls is None else self.rolls

    @cached_property
    def owners(self) -> NDArray[np.int64]:
        """Link (d,) that each coordinate moves first."""
        return np.repeat(np.arange(self.links), len(self.kinds))

    @cached_property
    def slides(self) -> NDArray[np.bool_]:
        """Which coordinates (d,) are lengths."""
        return np.tile(np.array(self.kinds) == SLIDE, self.links)

    def placed(self, x: Array) -> Placed:
        """Frames and axes at coordinates (d,)."""
        turn, origin = np.eye(3), np.zeros(3)
        turns, origins, axes, anchors = [], [], [], []
        for pivot, rest, own in zip(self.pivots, self.rest_turns, x.reshape(self.links, -1), strict=True):
            origin, turn = origin + turn @ pivot, turn @ rest
            for kind, value in zip(self.kinds, own, strict=True):
                axis = turn[:, kind]
                axes.append(axis)
                anchors.append(origin)
                if kind == SLIDE:
                    origin = origin + axis * value
                else:
                    turn = turn @ about(kind, value)
            turns.append(turn)
            origins.append(origin)
        return Placed(np.array(turns), np.array(origins), np.array(axes), np.array(anchors))

    def tip(self, at: Placed) -> Array:
        """Place (3,) [m] of the tip."""
        return at.origins[-1] + at.turns[-1] @ self.end

    def work(self, at: Placed, link: int, point: Array, force: Array, moment: Array | None = None) -> Array:
        """Generalized forces (d,) of a force at a point of a link, and a moment."""
        out = np.cross(at.axes, point - at.anchors) @ force
        if moment is not None:
            out = out + at.axes @ moment
        out = np.where(self.slides, at.axes @ force, out)
        out[self.owners > link] = 0.0
        return np.asarray(out)

    def weight(self, at: Placed) -> Array:
        """Generalized forces (d,) of gravity."""
        out = np.zeros(len(self.springs))
        if not self.gravity.any():
            return out
        for link, (mass, center) in enumerate(zip(self.masses, self.centers, strict=True)):
            out += self.work(at, link, at.origins[link] + at.turns[link] @ center, mass * self.gravity)
        return out

    def spring_forces(self, x: Array) -> tuple[Array, Array]:
        """Generalized forces (d,) of the springs, and their slopes."""
        a, b, c = self.springs.T
        return x * (a + x * (b + x * c)), a + x * (2 * b + 3 * c * x)

    def pressed(self, x: Array) -> Array:
        """Generalized forces (p, d) of a unit of each pressure."""
        return self.gains * (1 + self.growth * (self.gains @ x))[:, None]

    def volumes(self, x: Array) -> Array:
        """Volumes (p,) [m³] that the pressures have filled since rest."""
        swept = self.gains @ x
        return np.asarray(swept + 0.5 * self.growth * swept**2)

    def tangent(self, x: Array, pressures: Array, outside: Outside | None = None) -> Array:
        """Stiffness (d, d) at coordinates: slope of the forces that are needed to stay there."""
        out = np.diag(self.spring_forces(x)[1])
        out -= np.einsum("p,pi,pj->ij", pressures * self.growth, self.gains, self.gains)
        if outside is None and not self.gravity.any():
            return out
        step = 1e-6 * np.where(self.slides, np.abs(self.pivots).sum() / self.links, 1.0)
        for k, h in enumerate(step):
            moved = np.zeros(len(x))
            moved[k] = h
            out[:, k] -= (self._outer(x + moved, outside) - self._outer(x - moved, outside)) / (2 * h)
        return np.asarray(0.5 * (out + out.T))

    def equilibrium(self, pressures: Array, start: Array | None = None, outside: Outside | None = None) -> Array:
        """Find coordinates (d,) at pressures (p,), with what acts from outside.

        Raises
        ------
        NotSolved
            If Newton's method finds none, or none that is stable.
        """
        x = np.zeros(len(self.springs)) if start is None else start.copy()
        scale = np.where(self.slides, np.abs(self.pivots).sum() / self.links, 1.0)
        residual = self._unbalanced(x, pressures, outside)
        for _ in range(UPDATES):
            # absolute eigenvalues: downhill where the tangent is not positive
            sizes, modes = np.linalg.eigh(self.tangent(x, pressures, outside) * np.outer(scale, scale))
            update = scale * (modes @ ((modes.T @ (residual * scale)) / np.maximum(np.abs(sizes), 1e-12)))
            update /= max(1.0, float(np.abs(update / scale).max()) / LONGEST)
            x, residual = self._advanced(x, update, residual, lambda y: self._unbalanced(y, pressures, outside))
            if np.abs(residual * scale).max() <= TOLERANCE * self._largest(pressures, scale):
                if np.linalg.eigvalsh(self.tangent(x, pressures, outside))[0] <= 0:
                    break
                return x
        raise NotSolved(f"the chain has no stable equilibrium at {self._text(pressures)}; take other links.")

    @staticmethod
    def _advanced(
        x: Array, update: Array, residual: Array, unbalanced: Callable[[Array], Array]
    ) -> tuple[Array, Array]:
        """Take the update, or the half of it while that leaves far more force, as where a link meets an obstacle."""
        for _ in range(HALVED):
            there = unbalanced(x + update)
            if np.linalg.norm(there) <= GROWN * np.linalg.norm(residual):
                break
            update = update / 2
        return x + update, unbalanced(x + update)

    def _text(self, pressures: Array) -> str:
        return ", ".join(f"{name} = {p / 1e3:.4g} kPa" for name, p in zip(self.names, pressures, strict=True))

    def _largest(self, pressures: Array, scale: Array) -> float:
        pressed = float(np.abs(pressures @ (self.gains * scale)).max(initial=0.0))
        return max(pressed, float(np.abs(self.springs[:, 0] * scale**2).max()) * 1e-3)

    def _unbalanced(self, x: Array, pressures: Array, outside: Outside | None) -> Array:
        out = pressures @ self.pressed(x) - self.spring_forces(x)[0]
        return out + self._outer(x, outside)

    def _outer(self, x: Array, outside: Outside | None) -> Array:
        if outside is None and not self.gravity.any():
            return np.zeros(len(x))
        at = self.placed(x)
        out = self.weight(at)
        return out if outside is None else out + outside.forces(self, at)


@dataclass(frozen=True, slots=True, eq=False)
class TipForce:
    """A force (3,) [N] on the tip that keeps its direction.

    Parameters
    ----------
    force : (3,) array
    """

    force: Array

    def forces(self, chain: Chain, at: Placed) -> Array:
        """Generalized forces (d,) on a chain."""
        return chain.work(at, chain.links - 1, chain.tip(at), self.force)


def about(axis: int, angle: float) -> Array:
    """Rotation about an axis of a frame."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]] if axis == TURN_Y else [[c, -s, 0], [s, c, 0], [0, 0, 1]])
