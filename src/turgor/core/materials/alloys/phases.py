"""Phases of a shape-memory wire: austenite, twinned and detwinned martensite, and the stress that follows.

Three transformations, each a cosine of a variable that goes from 0 to 1 (Brinson 1993, eqs. 23 to 28):

- to austenite, x = (T − A_s − σ/C_A) / (A_f − A_s): all martensite is multiplied by g(x)
- to detwinned martensite, z = (σ − σ_s − C_M ⟨T − M_s⟩) / (σ_f − σ_s): all else is multiplied by g(z)
- cooled to twinned martensite, w = (M_s − T) / (M_s − M_f): the austenite is multiplied by g(w)

with g(x) = ½ (1 + cos π x). A step from x₀ to a larger x multiplies by g(x) / g(x₀), a step back by 1. Of a
transformation that goes one way from its beginning that is the formula of the paper, in any number of steps; of one
that starts again halfway it goes on without a jump, and the three fractions stay between 0 and 1.

σ = E(ξ) (ε − ε_L ξ_s − α (T − T₀)) with ξ = ξ_s + ξ_t, E by the rule of mixtures. A wire that would be pushed is slack:
its stress is zero.
"""

from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.alloys.alloy import ShapeMemoryAlloy

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Phases:
    """A wire at the end of a step.

    Parameters
    ----------
    stress : float [Pa]
        On the section at rest.
    temperature : float [K]
    detwinned, twinned : float
        Fractions of martensite that has the transformation strain, and of martensite without it.

    Examples
    --------
    >>> Phases(stress=0.0, temperature=293.15, detwinned=0.6, twinned=0.4).martensite
    1.0
    """

    stress: float
    temperature: float
    detwinned: float
    twinned: float

    @property
    def martensite(self) -> float:
        """Fraction of all martensite."""
        return self.detwinned + self.twinned

    @property
    def array(self) -> Array:
        """The four numbers, as a step stores them."""
        return np.array([self.stress, self.temperature, self.detwinned, self.twinned])

    @staticmethod
    def of(stored: Array) -> "Phases":
        """Return what a step has stored."""
        stress, temperature, detwinned, twinned = (float(each) for each in stored)
        return Phases(stress=stress, temperature=temperature, detwinned=detwinned, twinned=twinned)

    @staticmethod
    def at_rest(alloy: ShapeMemoryAlloy, temperature: float, strain: float) -> "Phases":
        """Return the phases of a wire that was stretched by a strain without stress; the rest of a cold one is twinned.

        Examples
        --------
        >>> alloy = ShapeMemoryAlloy.named("nitinol-brinson-1993")
        >>> Phases.at_rest(alloy, 293.15, 0.0335)
        Phases(stress=0.0, temperature=293.15, detwinned=0.5, twinned=0.5)
        """
        detwinned = strain / alloy.transformation_strain
        cold = temperature < alloy.austenite_start
        return Phases(stress=0.0, temperature=temperature, detwinned=detwinned, twinned=1 - detwinned if cold else 0.0)


@dataclass(frozen=True, slots=True)
class WireStep:
    """A step of a wire of an alloy from its phases at the end of the last one.

    Parameters
    ----------
    alloy : ShapeMemoryAlloy
    before : Phases
    temperature : float [K]
        At the end of the step.
    rest : float [K]
        Where thermal strain is zero.

    Examples
    --------
    A wire that was stretched by 4 % and cannot contract is heated:

    >>> alloy = ShapeMemoryAlloy.named("nitinol-brinson-1993")
    >>> step = WireStep(alloy, Phases.at_rest(alloy, 293.15, 0.04), 353.15, 293.15)
    >>> after, slope = step.to(0.04)
    >>> round(after.stress / 1e6), round(after.martensite, 2)
    (548, 0.66)
    """

    alloy: ShapeMemoryAlloy
    before: Phases
    temperature: float
    rest: float

    def to(self, strain: float) -> tuple[Phases, float]:
        """Return the phases at a strain, and the derivative of the stress by the strain [Pa]."""
        from scipy.optimize import brentq  # of no use without a wire

        def excess(stress: float) -> float:
            return stress - self._elastic(self.fractions(stress), strain)

        stress = 0.0
        if excess(0.0) < 0:  # the excess rises with the stress, by more than that
            stress = float(brentq(excess, 0.0, -excess(0.0), xtol=1e-4, rtol=1e-15, maxiter=200))
        detwinned, twinned = self.fractions(stress)
        after = Phases(stress=stress, temperature=self.temperature, detwinned=detwinned, twinned=twinned)
        return after, self._slope(strain, stress) if stress > 0 else 0.0

    def _elastic(self, fractions: tuple[float, float], strain: float) -> float:
        alloy = self.alloy
        thermal = alloy.expansion * (self.temperature - self.rest)
        return alloy.modulus(sum(fractions)) * (strain - alloy.transformation_strain * fractions[0] - thermal)

    def _slope(self, strain: float, stress: float) -> float:
        alloy, fractions = self.alloy, self.fractions(stress)
        modulus = alloy.modulus(sum(fractions))
        detwinned_by, twinned_by = self._rates(stress)
        softer = (alloy.martensite_modulus - alloy.austenite_modulus) * (detwinned_by + twinned_by)
        by_stress = softer * stress / modulus - modulus * alloy.transformation_strain * detwinned_by
        return modulus / (1 - by_stress)

    def fractions(self, stress: float) -> tuple[float, float]:
        """Detwinned and twinned martensite at a stress at the end of the step."""
        (warm, _), (pulled, _), (cold, _) = self._factors(stress)
        detwinned, twinned = self.before.detwinned * warm, self.before.twinned * warm
        austenite = 1 - detwinned - twinned
        return 1 - (1 - detwinned) * pulled, (twinned + austenite * (1 - cold)) * pulled

    def _rates(self, stress: float) -> tuple[float, float]:
        """Derivatives of the two fractions by the stress [1/Pa]."""
        (warm, warm_by), (pulled, pulled_by), (cold, _) = self._factors(stress)
        detwinned, twinned = self.before.detwinned * warm, self.before.twinned * warm
        detwinned_by, twinned_by = self.before.detwinned * warm_by, self.before.twinned * warm_by
        left = twinned + (1 - detwinned - twinned) * (1 - cold)
        left_by = twinned_by - (detwinned_by + twinned_by) * (1 - cold)
        return detwinned_by * pulled - (1 - detwinned) * pulled_by, left_by * pulled + left * pulled_by

    def _factors(self, stress: float) -> tuple[tuple[float, float], ...]:
        """Factors of the three transformations in the step, and their derivatives by the stress."""
        a, before = self.alloy, self.before
        return (
            _factor(_warm(a, before.stress, before.temperature), _warm(a, stress, self.temperature),
                    -1 / a.austenite_slope / (a.austenite_finish - a.austenite_start)),
            _factor(_pulled(a, before.stress, before.temperature), _pulled(a, stress, self.temperature),
                    1 / (a.detwinning_finish - a.detwinning_start)),
            _factor(_cold(a, before.temperature), _cold(a, self.temperature), 0.0),
        )  # fmt: skip


def _warm(a: ShapeMemoryAlloy, stress: float, temperature: float) -> float:
    return (temperature - a.austenite_start - stress / a.austenite_slope) / (a.austenite_finish - a.austenite_start)


def _pulled(a: ShapeMemoryAlloy, stress: float, temperature: float) -> float:
    onset = a.detwinning_start + a.martensite_slope * max(temperature - a.martensite_start, 0.0)
    return (stress - onset) / (a.detwinning_finish - a.detwinning_start)


def _cold(a: ShapeMemoryAlloy, temperature: float) -> float:
    return (a.martensite_start - temperature) / (a.martensite_start - a.martensite_finish)


def _factor(before: float, after: float, rate: float) -> tuple[float, float]:
    """g(after) / g(before) of a variable that rises, and its derivative where the variable has a rate."""
    start = min(max(before, 0.0), 1.0)
    if after <= start or start == 1.0:
        return 1.0, 0.0
    if after >= 1:
        return 0.0, 0.0
    size = 0.5 * (1 + cos(pi * start))
    return 0.5 * (1 + cos(pi * after)) / size, -0.5 * pi * sin(pi * after) / size * rate
