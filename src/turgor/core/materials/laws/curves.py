"""Curves of a law: its stress in the tests of a rubber, its initial moduli, and where it loses stability."""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.core.materials.laws.homogeneous import DEFORMATIONS, biaxial, cauchy_stress, nominal_stress
from turgor.core.materials.laws.laws import Law
from turgor.core.materials.laws.stability import first_instability
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError, unknown

Array = NDArray[np.float64]
CurveMode = Literal["uniaxial", "equibiaxial", "planar", "simple_shear", "biaxial"]

CURVE_MODES = get_args(CurveMode)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Curve:
    """Stress of a law along a test.

    Parameters
    ----------
    law : Law
        The law.
    mode : str
        The test: ``"uniaxial"``, ``"equibiaxial"``, ``"planar"``, ``"simple_shear"`` or ``"biaxial"``.
    stretch : (n,) array [-]
        Stretch along the first axis, below 1 in compression; the amount of shear γ in simple shear.
    second_stretch : (n,) array [-]
        Stretch along the second axis.
    nominal_stress, cauchy_stress : (n,) array [Pa]
        Along the first axis; the shear stress 12 in simple shear.
    second_nominal_stress, second_cauchy_stress : (n,) array [Pa]
        Along the second axis: what holds the width in planar tension, and the second pull in general biaxial tension.
    instability : float or None [-]
        Stretch nearest to 1, in the range of the curve, at which the nominal stress stops rising; None where it never
        does, and in simple shear and general biaxial tension, where it is not looked for.
    """

    law: Law
    mode: str
    stretch: Array
    second_stretch: Array
    nominal_stress: Array
    cauchy_stress: Array
    second_nominal_stress: Array
    second_cauchy_stress: Array
    instability: float | None

    __repr__ = brief

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ [Pa]."""
        return self.law.shear_modulus

    @property
    def young_modulus(self) -> float:
        """Initial Young's modulus E₀ = 3 μ of an incompressible solid [Pa]."""
        return 3 * self.law.shear_modulus

    def inside(self, stretch_range: tuple[float, float] | None) -> NDArray[np.bool_]:
        """Which points lie in a range of stretch, such as that of the tests a law was fitted to; all without one.

        In simple shear the principal stretches count, in biaxial tension both.
        """
        if stretch_range is None:
            return np.ones(len(self.stretch), dtype=bool)
        low, high = stretch_range
        first, second = self.stretch, self.second_stretch
        if self.mode == "simple_shear":
            first = np.sqrt(1 + 0.25 * first**2) + 0.5 * np.abs(first)
        if self.mode not in ("simple_shear", "biaxial"):
            second = first
        return np.asarray((first >= low) & (first <= high) & (second >= low) & (second <= high))


def curve(law: Law, mode: CurveMode, stretch: ArrayLike, second_stretch: ArrayLike | None = None) -> Curve:
    """Compute the stress of any law along a test, for all points at once.

    Parameters
    ----------
    law : Law
        Any law, in invariants or in stretches.
    mode : {"uniaxial", "equibiaxial", "planar", "simple_shear", "biaxial"}
        The test; tension and compression alike.
    stretch : (n,) array [-]
        Stretches along the first axis, positive; in simple shear the amounts of shear, any sign.
    second_stretch : (n,) array or None [-]
        Stretches along the second axis, for ``"biaxial"`` alone.

    Returns
    -------
    Curve

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import Yeoh
    >>> pull = curve(Yeoh(C10=0.11e6, C20=0.02e6), "uniaxial", [1.5, 2.0])
    >>> pull.nominal_stress.round(1), pull.young_modulus, pull.instability
    (array([281481.5, 665000. ]), 660000.0, None)
    """
    if mode not in CURVE_MODES:
        raise unknown("mode", mode, CURVE_MODES)
    along = np.atleast_1d(np.asarray(stretch, dtype=np.float64))
    if not np.isfinite(along).all() or along.ndim != 1 or not len(along):
        raise TurgorError(
            f"stretch is {along.tolist()}; a list of finite numbers is needed, one for each point of the curve."
        )
    F = _deformation(mode, along, second_stretch)
    nominal, cauchy = nominal_stress(law, F), cauchy_stress(law, F)
    second = 1 if mode == "simple_shear" else 0
    return Curve(
        law=law,
        mode=mode,
        stretch=along,
        second_stretch=F[:, 1, 1],
        nominal_stress=nominal[:, 0, second],
        cauchy_stress=cauchy[:, 0, second],
        second_nominal_stress=nominal[:, 1, 1],
        second_cauchy_stress=cauchy[:, 1, 1],
        instability=_instability(law, mode, along),
    )


def _deformation(mode: str, along: Array, second_stretch: ArrayLike | None) -> Array:
    if (mode == "biaxial") != (second_stretch is not None):
        given = "missing" if second_stretch is None else "given"
        raise TurgorError(f"mode is '{mode}' and second_stretch is {given}; it goes with the mode biaxial alone.")
    if second_stretch is None:
        return DEFORMATIONS[mode](along)
    across = np.asarray(second_stretch, dtype=np.float64)
    if across.shape not in ((), along.shape):
        raise TurgorError(f"second_stretch has {across.size} points but stretch has {along.size}.")
    return biaxial(along, np.broadcast_to(across, along.shape))


def _instability(law: Law, mode: str, along: Array) -> float | None:
    if mode not in ("uniaxial", "equibiaxial", "planar"):
        return None
    upper, lower = max(1.0, float(along.max())), min(1.0, float(along.min()))
    return first_instability(law, mode, upper=upper, lower=lower)  # type: ignore[arg-type]
