"""Stress softening (Mullins effect): the pseudo-elastic model of Ogden and Roxburgh at the points of a rubber.

Rubber that was stretched once is softer below its largest stretch than it was. With the energy W of the law at a point
and the largest W_m of its history, the isochoric stress is multiplied by

    η = 1 − erf((W_m − W) / (m + β W_m)) / r

(R. W. Ogden, D. G. Roxburgh, Proc. R. Soc. A 455 (1999) 2861, doi 10.1098/rspa.1999.0431; β as in Abaqus). On the way
to a new maximum η = 1: the law itself is the response of the virgin rubber.

**In an engine.** The internal variable is W_m, one number for each quadrature point, zero at rest. In every iteration,
`softening` gives η and its slope η′ = ∂η/∂W from W and the W_m of the last accepted step. `softened_derivatives` turns
the derivatives of the energy into those of the softened rubber, S = η S₀ and D = η D₀ + η′ S₀ ⊗ S₀, exact and
symmetric. Where W passes W_m, η′ jumps to zero. Once per accepted step: W_m ← max(W_m, W). A Prony series acts on the
softened stress; Abaqus softens the long-term stress alone where a rubber has both.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]

#: Pairs of first derivatives that go with the second derivatives of a law in invariants: 11, 12, 22.
INVARIANT_PAIRS = ((0, 0), (0, 1), (1, 1))


@dataclass(frozen=True, slots=True, kw_only=True)
class Mullins:
    """Stress softening after Ogden and Roxburgh, η = 1 − erf((W_m − W)/(m + β W_m))/r.

    Parameters
    ----------
    r : float [-]
        More than 1; at most the share 1/r of the stress is lost.
    m : float [Pa]
        Energy density at which softening begins; with a small m it begins at small stretches.
    beta : float [-]
        Share of the largest energy that is added to m; 0 in the original model.

    Examples
    --------
    >>> Mullins(r=2.0, m=5e3).beta
    0.0
    """

    r: float
    m: float
    beta: float = 0.0

    def __post_init__(self) -> None:
        if not (isfinite(self.r) and self.r > 1):
            raise TurgorError(f"Mullins: r is {self.r:g}; it must be more than 1.")
        for name, unit in (("m", " Pa"), ("beta", "")):
            value = getattr(self, name)
            if not (isfinite(value) and value >= 0):
                raise TurgorError(f"Mullins: {name} is {value:g}{unit}; it must be 0 or more.")
        if self.m == 0 and self.beta == 0:
            raise TurgorError("Mullins: m and beta are both 0; at least one must be more than 0.")


def softening(mullins: Mullins, energy: ArrayLike, largest: ArrayLike) -> tuple[Array, Array]:
    """Return η and its slope η′ = ∂η/∂W at each point.

    Parameters
    ----------
    mullins : Mullins
        The constants.
    energy : (...) array [Pa]
        Energy density W of the law now.
    largest : (...) array [Pa]
        Largest W up to the last accepted step.

    Returns
    -------
    (...) array [-], (...) array [1/Pa]
        1 and 0 where W is not below the largest.

    Examples
    --------
    >>> eta, slope = softening(Mullins(r=2.0, m=1e3), [0.0, 1e3, 3e3], [2e3, 2e3, 2e3])
    >>> eta.round(4), (1e3 * slope).round(4)
    (array([0.5023, 0.5786, 1.    ]), array([0.0103, 0.2076, 0.    ]))
    """
    from scipy.special import erf

    energy, largest = np.asarray(energy, dtype=np.float64), np.asarray(largest, dtype=np.float64)
    width = mullins.m + mullins.beta * largest
    softened = (energy < largest) & (width > 0)
    gap = np.zeros(np.broadcast_shapes(energy.shape, largest.shape))
    np.divide(largest - energy, width, out=gap, where=softened)
    slope = np.zeros_like(gap)
    np.divide(2.0 / (np.sqrt(np.pi) * mullins.r) * np.exp(-(gap**2)), width, out=slope, where=softened)
    return np.asarray(1.0 - erf(gap) / mullins.r), slope


def softened_derivatives(
    eta: Array, slope: Array, derivatives: Sequence[Array] | Array, pairs: Sequence[tuple[int, int]] = INVARIANT_PAIRS
) -> Array:
    """Return the derivatives of the energy of a softened rubber: first η Wₖ, second η Wₖₗ + η′ Wₖ Wₗ.

    Parameters
    ----------
    eta, slope : (...) array
        As from `softening`.
    derivatives : (n, ...) array [Pa]
        First derivatives of the law's energy, then second ones, as from `energy_derivatives` or `stretch_derivatives`.
    pairs : sequence of (int, int)
        Which first derivatives belong to each second one; for a law in stretches `STRETCH_PAIRS`.

    Returns
    -------
    (n, ...) array [Pa]

    Examples
    --------
    >>> eta, slope = np.array([0.5]), np.array([2.0])
    >>> W = np.array([[3.0], [1.0], [4.0], [0.0], [0.0]])  # W1, W2, W11, W12, W22
    >>> softened_derivatives(eta, slope, W)[:, 0]
    array([ 1.5,  0.5, 20. ,  6. ,  2. ])
    """
    first = len(derivatives) - len(pairs)
    out = [eta * derivatives[k] for k in range(first)]
    for n, (k, l) in enumerate(pairs):
        out.append(eta * derivatives[first + n] + slope * derivatives[k] * derivatives[l])
    return np.stack(out)


def softening_dissipation(mullins: Mullins, largest: ArrayLike) -> Array:
    """Return the energy density that a virgin point dissipates in a cycle up to an energy W_m.

    It is (1/r) ∫ erf((W_m − W)/(m + β W_m)) dW from 0 to W_m. Only the first full cycle dissipates it, no later one.

    Parameters
    ----------
    mullins : Mullins
        The constants.
    largest : (...) array [Pa]
        Largest energy density W_m so far.

    Returns
    -------
    (...) array [Pa]

    Examples
    --------
    >>> softening_dissipation(Mullins(r=2.0, m=1e3), [0.0, 2e3]).round(2)
    array([  0.  , 718.39])
    """
    from scipy.special import erf

    top = np.asarray(largest, dtype=np.float64)
    width = mullins.m + mullins.beta * top
    gap = np.divide(top, width, out=np.zeros_like(top), where=width > 0)
    return np.asarray((top * erf(gap) + width / np.sqrt(np.pi) * np.expm1(-(gap**2))) / mullins.r)
