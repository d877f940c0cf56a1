"""sofa_law: constants of a hyperelastic law of SOFA for any law of rubber."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar, nnls

from turgor.core.materials.laws.curves import CurveMode, curve
from turgor.core.materials.laws.laws import FiberLaw, Hooke
from turgor.core.materials.material import Material
from turgor.foundation.errors import TurgorError
from turgor.units import kPa

Array = NDArray[np.float64]

#: Tests that constants are fitted to: their largest stretch as a power of the given one, and the third principal
#: stretch as a power of the first.
TESTS: dict[CurveMode, tuple[float, float]] = {
    "uniaxial": (1.0, -0.5),
    "planar": (1.0, -1.0),
    "equibiaxial": (0.5, -2.0),
}

#: Stretches of each test, and the range of Ogden's exponent.
COUNT, EXPONENTS = 40, (1.0, 20.0)

#: Ogden's law, which needs the principal stretches of every cell, is taken where its error is less than this share of
#: that of Mooney and Rivlin's.
BETTER = 0.8

#: Error with which Mooney and Rivlin's law is good enough.
SMALL = 0.02


@dataclass(frozen=True, slots=True, kw_only=True)
class SofaLaw:
    """A law of SOFA.

    Parameters
    ----------
    name : str
        ``"MooneyRivlin"``, W = a (Ī₁ − 3) + b (Ī₂ − 3), or ``"Ogden"``, W = a/b² (λ̄₁ᵇ + λ̄₂ᵇ + λ̄₃ᵇ − 3); and κ/2 ln² J.
    constants : (float, float)
        a and b, in Pa but for the exponent.
    bulk_modulus : float [Pa]
    error : float [-]
        Largest error of the nominal stress, over the largest of its test.
    """

    name: str
    constants: tuple[float, float]
    bulk_modulus: float
    error: float

    @property
    def parameters(self) -> list[float]:
        """Its ``ParameterSet``, in kPa."""
        a, b = self.constants
        return [a / kPa, b if self.name == "Ogden" else b / kPa, self.bulk_modulus / kPa]


def sofa_law(material: Material, stretch: float, poisson: float) -> SofaLaw:
    """Fit constants that are not negative, so that the law is stable, to uniaxial, planar and equibiaxial tension.

    Parameters
    ----------
    material : Material
    stretch : float [-]
        Largest one.
    poisson : float [-]
        Of rubber that keeps its volume.
    """
    if isinstance(material.law, Hooke):
        raise TurgorError(f"material '{material.name}' is linear elastic; a law of rubber is needed for a region.")
    if isinstance(material.law, FiberLaw):
        raise TurgorError(
            f"material '{material.name}' has directions ({type(material.law).__name__}); SOFA gets isotropic laws only."
        )
    if material.is_foam:
        raise TurgorError(f"material '{material.name}' is a foam ({type(material.law).__name__}); SOFA has none.")
    first, third, wanted, sizes = [], [], [], []
    for mode, (power, other) in TESTS.items():
        along = np.linspace(1.0, stretch**power, COUNT + 1)[1:]
        stress = curve(material.law, mode, along).nominal_stress
        first.append(along)
        third.append(along**other)
        wanted.append(stress)
        sizes.append(np.full(COUNT, np.abs(stress).max()))
    l1, l3, size = np.concatenate(first), np.concatenate(third), np.concatenate(sizes)
    stress = np.concatenate(wanted) / size
    mooney = np.column_stack([2 * (l1**2 - l3**2), 2 * (l3**-2 - l1**-2)]) / (l1 * size)[:, None]
    (a, b), _ = nnls(mooney, stress)
    error = float(np.abs(mooney @ (a, b) - stress).max())
    name, constants, shear = "MooneyRivlin", (float(a), float(b)), 2.0 * float(a + b)

    def modulus(exponent: float) -> tuple[float, Array]:
        unit = (l1**exponent - l3**exponent) / (exponent * l1 * size)
        best = float(unit @ stress / (unit @ unit))
        return best, best * unit - stress

    exponent = float(minimize_scalar(lambda x: float(np.sum(modulus(x)[1] ** 2)), bounds=EXPONENTS).x)
    factor, away = modulus(exponent)
    if factor > 0 and float(np.abs(away).max()) < BETTER * error and error > SMALL:
        name, constants, shear, error = "Ogden", (factor, exponent), 0.5 * factor, float(np.abs(away).max())
    finite = np.isfinite(material.bulk_modulus)
    bulk = material.bulk_modulus if finite else shear * 2 * (1 + poisson) / (3 * (1 - 2 * poisson))
    return SofaLaw(name=name, constants=constants, bulk_modulus=bulk, error=error)
