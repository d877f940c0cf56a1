"""The pull of a law by differences of its energy: quick checks of library records, without SymPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.laws.homogeneous import DEFORMATIONS, nominal_stress
from turgor.core.materials.laws.laws import FoamLaw, Law, StretchLaw

Array = NDArray[np.float64]


def pull(law: Law, mode: str, stretch: Array) -> Array:
    """Nominal stress [Pa] of a law by differences of its energy along a path of stretch.

    Parameters
    ----------
    law : Law
        With an energy in invariants or in principal stretches.
    mode : str
        ``"uniaxial"``, ``"planar"`` or ``"equibiaxial"``.
    stretch : (n,) array [-]
        Positive stretches.

    Returns
    -------
    (n,) array [Pa]
        The work conjugate of the stretch; half of it in equibiaxial tension, where two directions work. No SymPy is
        needed, so that reading a job stays quick.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> pull(NeoHooke(C10=0.12e6), "uniaxial", np.array([2.0])).round(2)
    array([420000.])
    """
    if isinstance(law, FoamLaw):  # the stretches across need the derivatives
        return np.asarray(nominal_stress(law, DEFORMATIONS[mode](stretch))[..., 0, 0])
    step = 1e-5
    stretch = np.asarray(stretch, dtype=np.float64)
    slope = (_energy(law, mode, stretch + step) - _energy(law, mode, stretch - step)) / (2 * step)
    return np.asarray(slope / 2 if mode == "equibiaxial" else slope)


def _energy(law: Law, mode: str, a: Array) -> Array:
    if mode == "uniaxial":
        b, c = a**-0.5, a**-0.5
    elif mode == "planar":
        b, c = np.ones_like(a), 1 / a
    else:
        b, c = a, a**-2.0
    if isinstance(law, StretchLaw):
        return _of_arrays(law.energy_of_stretches, a, b, c)
    return _of_arrays(law.energy, a**2 + b**2 + c**2, a**2 * b**2 + b**2 * c**2 + c**2 * a**2)


def _of_arrays(energy: Callable[..., Any], *at: Array) -> Array:
    """Evaluate an energy for arrays, point by point where it takes only numbers, as functions of SymPy do."""
    try:
        values = np.asarray(energy(*at))
    except (TypeError, AttributeError, ValueError):
        values = np.empty(0, dtype=object)
    if values.dtype == object:
        return np.array([float(energy(*point)) for point in zip(*at, strict=True)])
    return np.asarray(values + np.zeros_like(at[0]))
