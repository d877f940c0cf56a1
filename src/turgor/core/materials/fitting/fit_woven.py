"""Fit of a woven fabric to strips that were cut along its warp, along its weft, and on the bias between them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.laws.energies.woven import Woven
from turgor.core.materials.material import Material
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError, unknown

Array = NDArray[np.float64]

#: Angle [rad] of each strip from the warp.
STRIPS: Mapping[str, float] = {"warp": 0.0, "weft": pi / 2, "bias": pi / 4}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WovenFit:
    """A woven fabric that was fitted.

    Parameters
    ----------
    law : Woven
    values, errors : dict of str to float
        Moduli that were fitted [Pa] and their standard errors: from the scatter about the line, or from the standard
        deviation between strips where a direction has several.
    relative : float [-]
        Root mean square of the deviations over the largest stress of each strip.
    tests : tuple of (str, MaterialTest)
        What it was fitted to, with the direction of each strip.
    """

    law: Woven
    values: Mapping[str, float]
    errors: Mapping[str, float]
    relative: float
    tests: tuple[tuple[str, MaterialTest], ...] = ()

    __repr__ = brief

    def material(self) -> Material:
        """Return the material of a sheet of this fabric."""
        return Material(name="fabric", law=self.law)

    def stress(self, cut: str, stretch: Array) -> Array:
        """Return the nominal stress [Pa] of a strip, such as ``"bias"``, at stretches [-]."""
        return self.law.modulus_along(STRIPS[cut]) * strip_strain(stretch)

    def off(self, cut: str, test: MaterialTest) -> float:
        """Return the root mean square of the deviations from a test, over its largest stress.

        Parameters
        ----------
        cut : str
        test : MaterialTest
        """
        return _off(self.law.modulus_along(STRIPS[cut]), test)


def strip_strain(stretch: Array) -> Array:
    """Return λ (λ² − 1)/2, the nominal stress of a strip of a linear elastic sheet over its modulus.

    Parameters
    ----------
    stretch : (n,) array [-]

    Examples
    --------
    >>> round(float(strip_strain(np.array([1.02]))[0]), 6)  # hardly more than 0.02
    0.020604
    """
    return np.asarray(stretch * (stretch**2 - 1) / 2)


def fit_woven(tests: Mapping[str, MaterialTest | Sequence[MaterialTest]], *, nu: float) -> WovenFit:
    """Fit warp, weft and shear of a woven fabric to uniaxial tests of three strips.

    A pull on the bias turns the yarns at their crossings; with the moduli E and E_weft it gives the shear modulus,
    1/G = 4/E_bias − 1/E − 1/E_weft + 2 nu/E. Only the product of modulus and thickness counts: take the thickness by
    which the forces were divided.

    Parameters
    ----------
    tests : mapping of str to MaterialTest, or to several
        By the direction of the strip, ``"warp"``, ``"weft"`` and ``"bias"``, at 45° between them.
    nu : float [-]
        Contraction along the weft of a pull along the warp. Strips do not show it without a measured width; it moves
        the shear modulus of a fabric by 2 nu G/E, a few percent.

    Returns
    -------
    WovenFit

    Raises
    ------
    TurgorError
        If a direction is missing, the stress does not rise, or the bias strip is stiffer than warp and weft allow.

    Examples
    --------
    >>> x = np.linspace(1.002, 1.02, 10)
    >>> cloth = Woven(E=400e6, E_weft=200e6, G=5e6, nu=0.2)
    >>> strips = {
    ...     cut: MaterialTest(mode="uniaxial", stretch=x, name=cut,
    ...                       nominal_stress=cloth.modulus_along(angle) * strip_strain(x))
    ...     for cut, angle in STRIPS.items()
    ... }
    >>> round(fit_woven(strips, nu=0.2).values["G"] / 1e6, 6)
    5.0
    """
    known = tuple((cut, each) for cut, some in tests.items() for each in _several(some))
    _check(known)
    if not np.isfinite(nu):
        raise TurgorError(f"nu is {nu:g}; a number such as 0.2 is needed.")
    moduli, errors = {}, {}
    for cut in STRIPS:
        moduli[cut], errors[cut] = _modulus([test for each, test in known if each == cut])
    E, E_weft, bias = moduli["warp"], moduli["weft"], moduli["bias"]
    compliance = 4 / bias - 1 / E - 1 / E_weft + 2 * nu / E
    if not compliance > 0:
        raise TurgorError(
            f"the strip on the bias has {bias / 1e6:.4g} MPa, more than warp ({E / 1e6:.4g} MPa) and weft "
            f"({E_weft / 1e6:.4g} MPa) allow whatever the shear modulus is. Was it cut at 45° to both?"
        )
    G = 1 / compliance
    parts = (4 * errors["bias"] / bias**2, (1 - 2 * nu) * errors["warp"] / E**2, errors["weft"] / E_weft**2)
    law = Woven(E=E, E_weft=E_weft, G=G, nu=nu)
    return WovenFit(
        law=law,
        values={"E": E, "E_weft": E_weft, "G": G},
        errors={"E": errors["warp"], "E_weft": errors["weft"], "G": float(G**2 * np.linalg.norm(parts))},
        relative=float(np.sqrt(np.mean([_off(law.modulus_along(STRIPS[cut]), test) ** 2 for cut, test in known]))),
        tests=known,
    )


def _several(some: MaterialTest | Sequence[MaterialTest]) -> Sequence[MaterialTest]:
    return [some] if isinstance(some, MaterialTest) else some


def _modulus(tests: Sequence[MaterialTest]) -> tuple[float, float]:
    """Modulus of the strips of one direction, and its standard error: the mean of their least-squares lines."""
    lines = []
    for test in tests:
        x, y = strip_strain(test.stretch), test.nominal_stress
        if np.count_nonzero(x) < 2:
            raise TurgorError(f"test '{test.name}' has one point apart from rest; a line and its error need two.")
        size = float(x @ x)
        slope = float(x @ y) / size
        if not slope > 0:
            raise TurgorError(f"the stress of test '{test.name}' does not rise with the stretch; check its sign.")
        rest = y - slope * x
        lines.append((slope, float(np.sqrt(rest @ rest / (np.count_nonzero(x) - 1) / size))))
    slopes = np.array([slope for slope, _ in lines])
    if len(slopes) > 1:
        return float(slopes.mean()), float(slopes.std(ddof=1))
    return lines[0]


def _off(modulus: float, test: MaterialTest) -> float:
    rest = test.nominal_stress - modulus * strip_strain(test.stretch)
    return float(np.sqrt(np.mean(rest**2)) / np.abs(test.nominal_stress).max())


def _check(tests: Sequence[tuple[str, MaterialTest]]) -> None:
    for cut, test in tests:
        if cut not in STRIPS:
            raise unknown("direction of a strip", cut, STRIPS)
        if test.mode != "uniaxial":
            raise TurgorError(f"test '{test.name}' is {test.mode}; strips are pulled uniaxially.")
    missing = [cut for cut in STRIPS if cut not in {each for each, _ in tests}]
    if missing:
        raise TurgorError(
            f"no strip was pulled along the {' or the '.join(missing)}; a woven fabric needs warp, weft and bias."
        )
