"""Generalized-α method: displacement, velocity and acceleration at the end of a time step."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Weights:
    """The four numbers of the generalized-α method (Chung and Hulbert 1993, doi 10.1115/1.2900803)."""

    alpha_m: float
    alpha_f: float
    beta: float
    gamma: float

    @staticmethod
    def of(spectral_radius: float) -> "Weights":
        """Return the weights for a spectral radius at infinite frequency; 1 gives the trapezoidal rule.

        Examples
        --------
        >>> Weights.of(1.0)
        Weights(alpha_m=0.5, alpha_f=0.5, beta=0.25, gamma=0.5)
        """
        alpha_m = (2 * spectral_radius - 1) / (spectral_radius + 1)
        alpha_f = spectral_radius / (spectral_radius + 1)
        gamma = 0.5 + alpha_f - alpha_m
        return Weights(alpha_m=alpha_m, alpha_f=alpha_f, beta=0.25 * (gamma + 0.5) ** 2, gamma=gamma)


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """Unknowns (size,) with their scaled velocity, acceleration and algorithmic acceleration (``algorithmic``).

    The algorithmic acceleration belongs to a time ``α_m − α_f`` steps later (``lead`` [s]) than the other.
    """

    unknowns: Array
    velocity: Array
    acceleration: Array
    algorithmic: Array
    lead: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class TimeStep:
    """One step: velocity and acceleration at its end as affine functions of the unknowns there.

    Parameters
    ----------
    weights : Weights
    before : Motion
        At the start of the step.
    length : float [s]
    moving : (size,) array
        1 where an unknown is a displacement, 0 where it is a mean stress, which has no velocity.
    """

    weights: Weights
    before: Motion
    length: float
    moving: Array

    @property
    def algorithmic_before(self) -> Array:
        """The algorithmic acceleration at the start, moved to the time at which a step of this length needs it."""
        shift = (self.weights.alpha_m - self.weights.alpha_f) * self.length
        if not self.before.lead:
            return self.before.algorithmic
        change = self.before.algorithmic - self.before.acceleration
        return self.before.acceleration + shift / self.before.lead * change

    @property
    def rate(self) -> float:
        """Derivative of the velocity by the unknowns [1/s]."""
        return self.weights.gamma / (self.weights.beta * self.length)

    @property
    def stiffness(self) -> float:
        """Derivative of the acceleration by the unknowns [1/s²]."""
        w = self.weights
        return (1 - w.alpha_m) / ((1 - w.alpha_f) * w.beta * self.length**2)

    def algorithmic(self, unknowns: Array) -> Array:
        """The algorithmic acceleration at the end."""
        w, b, h = self.weights, self.before, self.length
        known = h * b.velocity + h**2 * (0.5 - w.beta) * self.algorithmic_before
        return self.moving * (unknowns - b.unknowns - known) / (w.beta * h**2)

    def velocity(self, unknowns: Array) -> Array:
        """The velocity at the end."""
        w = self.weights
        mean = (1 - w.gamma) * self.algorithmic_before + w.gamma * self.algorithmic(unknowns)
        return np.asarray(self.before.velocity + self.length * mean)

    def acceleration(self, unknowns: Array) -> Array:
        """The acceleration at the end."""
        w = self.weights
        total = (1 - w.alpha_m) * self.algorithmic(unknowns) + w.alpha_m * self.algorithmic_before
        return np.asarray((total - w.alpha_f * self.before.acceleration) / (1 - w.alpha_f))

    def motion(self, unknowns: Array) -> Motion:
        """The motion at the end."""
        lead = (self.weights.alpha_m - self.weights.alpha_f) * self.length
        return Motion(unknowns, self.velocity(unknowns), self.acceleration(unknowns), self.algorithmic(unknowns), lead)

    def without_acceleration(self) -> Array:
        """Unknowns at the end if the acceleration there is zero."""
        w, b, h = self.weights, self.before, self.length
        algorithmic = (w.alpha_f * b.acceleration - w.alpha_m * self.algorithmic_before) / (1 - w.alpha_m)
        mean = (0.5 - w.beta) * self.algorithmic_before + w.beta * algorithmic
        return np.asarray(b.unknowns + h * (b.velocity + h * mean))

    def prediction(self) -> Array:
        """Unknowns at the end, extrapolated with velocity and acceleration at the start."""
        b, h = self.before, self.length
        return np.asarray(b.unknowns + h * b.velocity + 0.5 * h**2 * b.acceleration)

    def error(self, unknowns: Array) -> float:
        """Estimate of the largest error that the step made in a nodal displacement, in units of length.

        The difference to the third-order Taylor polynomial (Zienkiewicz and Xie 1991, doi 10.1002/eqe.4290200907).
        """
        change = (self.algorithmic(unknowns) - self.algorithmic_before)[self.moving > 0].reshape(-1, 3)
        return abs(self.weights.beta - 1 / 6) * self.length**2 * float(np.linalg.norm(change, axis=1).max())
