"""mooney_rivlin: constants of SOFA's Mooney–Rivlin law for any law of rubber."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import nnls

from turgor.core.materials.laws.curves import CurveMode, curve
from turgor.core.materials.laws.laws import Hooke, Law, MooneyRivlin
from turgor.core.materials.material import Material
from turgor.foundation.errors import TurgorError

#: Tests that the constants are fitted to, with their largest stretch as a power of the given one: in all of them the
#: largest stretch is about the same, and equibiaxial tension is half as far.
TESTS: dict[CurveMode, float] = {"uniaxial": 1.0, "planar": 1.0, "equibiaxial": 0.5}

#: Stretches of each test.
COUNT = 40


@dataclass(frozen=True, slots=True, kw_only=True)
class FittedMooney:
    """Constants of W = C10 (Ī₁ − 3) + C01 (Ī₂ − 3) + κ/2 ln² J.

    Parameters
    ----------
    C10, C01, bulk_modulus : float [Pa]
    error : float [-]
        Largest error of the nominal stress, over the largest of its test.
    """

    C10: float
    C01: float
    bulk_modulus: float
    error: float


def mooney_rivlin(material: Material, stretch: float, poisson: float) -> FittedMooney:
    """Fit constants that are not negative, so that the law is stable, to uniaxial, planar and equibiaxial tension.

    Parameters
    ----------
    material : Material
    stretch : float [-]
        Largest one.
    poisson : float [-]
        Of rubber that keeps its volume.
    """
    law = material.law
    if isinstance(law, Hooke):
        raise TurgorError(f"material '{material.name}' is linear elastic; a law of rubber is needed for a region.")
    rows, stresses, sizes = [], [], []
    for mode, power in TESTS.items():
        stretches = np.linspace(1.0, stretch**power, COUNT + 1)[1:]
        units: tuple[Law, ...] = (MooneyRivlin(C10=1.0, C01=0.0), MooneyRivlin(C10=0.0, C01=1.0))
        size = float(np.abs(curve(law, mode, stretches).nominal_stress).max())
        rows.append(np.column_stack([curve(unit, mode, stretches).nominal_stress for unit in units]) / size)
        stresses.append(curve(law, mode, stretches).nominal_stress / size)
        sizes.append(size)
    matrix, wanted = np.vstack(rows), np.concatenate(stresses)
    constants, _ = nnls(matrix, wanted)
    shear = 2.0 * float(constants.sum())
    bulk = material.bulk_modulus if np.isfinite(material.bulk_modulus) else 0.0
    return FittedMooney(
        C10=float(constants[0]),
        C01=float(constants[1]),
        bulk_modulus=bulk or shear * 2 * (1 + poisson) / (3 * (1 - 2 * poisson)),
        error=float(np.abs(matrix @ constants - wanted).max()),
    )
