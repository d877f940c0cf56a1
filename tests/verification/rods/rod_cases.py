"""Rods for the verification tests: nearly inextensible and unshearable ones of length and bending stiffness 1."""

from collections.abc import Sequence

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from turgor.rods import Rod, RodModel, RodSection, static

#: Stiffness against stretch and shear that changes a tip position by some 1e-9 of the length.
STIFF = 1e9


def slender(**more) -> RodSection:
    """A section with bending stiffness 1 that hardly stretches or shears."""
    return RodSection.from_moduli(EA=STIFF, GA=STIFF, EI=1.0, GJ=1.0, **more)


def bent(loads: Sequence, elements: int, at=1, **more) -> np.ndarray:
    """Positions of the tip of a cantilever of length 1 along x, (n, 3), the state at rest left out."""
    rod = Rod(section=slender(), length=1.0, elements=elements, **more)
    return static(RodModel(rods=[rod], loads=loads), at).tip[1:]


def elastica(force: float) -> np.ndarray:
    """Tip (x, z) of the inextensible cantilever under a dead force across, by integration to 1e-11 (shooting)."""

    def ends(curvature):
        def rates(_, y):
            return [y[1], -force * np.cos(y[0]), np.cos(y[0]), np.sin(y[0])]

        return solve_ivp(rates, (0, 1), [0, curvature, 0, 0], rtol=1e-11, atol=1e-12).y[:, -1]

    first = brentq(lambda k: ends(k)[1], 0.0, np.sqrt(2 * force) + 1, xtol=1e-13)
    return ends(first)[2:]


def rates(errors: Sequence[float]) -> np.ndarray:
    """Orders of convergence between meshes of which each has twice the elements of the one before."""
    return np.log2(np.array(errors)[:-1] / np.array(errors)[1:])
