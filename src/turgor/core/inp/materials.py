"""Materials as Abaqus and CalculiX write them."""

from collections.abc import Callable, Sequence
from typing import Any

from turgor.core.inp.directions import fiber_lines
from turgor.core.inp.history import history_lines, moduli_of
from turgor.core.materials.laws.laws import (
    ArrudaBoyce,
    BlatzKo,
    GeneralizedRivlin,
    Hooke,
    Hyperfoam,
    MooneyRivlin,
    NeoHooke,
    Ogden,
    Yeoh,
    YeohN,
)
from turgor.core.materials.material import Material
from turgor.foundation.errors import TurgorError
from turgor.units import MPa

#: Exponents of the coefficients of a polynomial law in the order of the file.
POLYNOMIAL = ((1, 0), (0, 1), (2, 0), (1, 1), (0, 2), (3, 0), (2, 1), (1, 2), (0, 3))

#: One tonne per cubic millimeter [kg/m³]: with mm and N, masses are tonnes.
TONNE_PER_CUBIC_MM = 1e12

#: Poisson's ratio at rest that CalculiX takes where none is given; its cells lock beyond it.
CALCULIX_POISSON = 0.475


def material_lines(name: str, material: Material, program: str) -> list[str]:
    """Write a material in N, mm, MPa and tonnes.

    Parameters
    ----------
    name : str
        Name in the file.
    material : Material
    program : str
        ``"abaqus"`` or ``"calculix"``.

    Returns
    -------
    list of str

    Raises
    ------
    TurgorError
        If the program has no such law, or the material is incompressible and the program is CalculiX.

    Examples
    --------
    >>> rubber = Material(name="rubber", law=NeoHooke(C10=0.1e6), bulk_modulus=4e6, density=1070)
    >>> material_lines("body", rubber, "calculix")
    ['*MATERIAL, NAME=body', '*HYPERELASTIC, NEO HOOKE', '0.1, 0.5', '*DENSITY', '1.07e-09']
    """
    law = material.law
    lines = [f"*MATERIAL, NAME={name}"]
    if isinstance(law, Hooke):
        lines += ["*ELASTIC", _row([law.E / MPa, law.nu])]
    elif material.has_fibers:
        lines += fiber_lines(name, material, program)
    elif isinstance(law, BlatzKo | Hyperfoam):
        lines += _foam(name, law, program)
    else:
        form = _FORMS.get(type(law))
        if form is None:
            known = ", ".join(kind.__name__ for kind in (*_FORMS, Hyperfoam, BlatzKo))
            raise TurgorError(
                f"materials.{name}: {type(law).__name__} has no form in .inp files; these have one: {known}."
            )
        keyword, values, compressions = form(law)
        numbers = [*(value / MPa for value in values), _compressibility(name, material, program)]
        numbers += [0.0] * (compressions - 1)
        lines += [f"*HYPERELASTIC, {keyword}{moduli_of(material)}", *_rows(numbers)]
        lines += history_lines(name, material, program)
    if material.density is not None:
        lines += ["*DENSITY", _row([material.density / TONNE_PER_CUBIC_MM])]
    return lines


def _compressibility(name: str, material: Material, program: str) -> float:
    """D1 = 2/κ [1/MPa]; 0 means incompressible to Abaqus, but to CalculiX a Poisson's ratio of 0.475."""
    if not material.incompressible:
        return 2 / (material.bulk_modulus / MPa)
    if program == "calculix":
        factor = 2 * (1 + CALCULIX_POISSON) / (3 * (1 - 2 * CALCULIX_POISSON))
        law: Any = material.law
        raise TurgorError(
            f"materials.{name}: '{material.name}' is incompressible, and CalculiX has no cells for that; give it a "
            f"bulk modulus, for example {factor * law.shear_modulus / MPa:.4g} MPa (Poisson's ratio "
            f"{CALCULIX_POISSON}), or write for Abaqus."
        )
    return 0.0


def _rivlin(law: GeneralizedRivlin) -> tuple[str, Sequence[float], int]:
    terms = {(i, j): C for i, j, C in law.coefficients}
    order = max(i + j for i, j in terms)
    if order > 3:
        raise TurgorError(f"GeneralizedRivlin of order {order} has no form in .inp files; 3 is the highest.")
    values = [terms.get(exponents, 0.0) for exponents in POLYNOMIAL if sum(exponents) <= order]
    return f"POLYNOMIAL, N={order}", values, order


def _yeoh_n(law: YeohN) -> tuple[str, Sequence[float], int]:
    order = len(law.coefficients)
    if order > 3:
        raise TurgorError(f"YeohN with {order} terms has no form in .inp files; 3 is the most.")
    return f"REDUCED POLYNOMIAL, N={order}", law.coefficients, order


def _foam(name: str, law: Hyperfoam | BlatzKo, program: str) -> list[str]:
    """Pairs μᵢ, αᵢ and then all νᵢ in Abaqus's convention, of which Blatz and Ko's law is one.

    CalculiX 2.20 reads them but crashes with one term.
    """
    if program == "calculix":
        raise TurgorError(
            f"materials.{name}: the foams of CalculiX are wrong: a cube of *HYPERFOAM crashes it or has another stress "
            "than its formula; write for Abaqus."
        )
    if isinstance(law, BlatzKo):
        law = Hyperfoam.from_abaqus(mu=(law.mu,), alpha=(-2.0,), nu=(0.25,))
    mu, alpha, nu = law.to_abaqus()
    if len(mu) > 3:
        raise TurgorError(f"Hyperfoam with {len(mu)} terms has no form in .inp files; 3 is the most.")
    pairs = [value for m, a in zip(mu, alpha, strict=True) for value in (m / MPa, a)]
    return [f"*HYPERFOAM, N={len(mu)}", *_rows([*pairs, *nu])]


def _ogden(law: Ogden) -> tuple[str, Sequence[float], int]:
    """Pairs μᵢ, αᵢ in Abaqus's convention; the exponents are no stresses, so they are scaled for the division later."""
    mu, alpha = law.to_abaqus()
    if len(mu) > 3:
        raise TurgorError(f"Ogden with {len(mu)} terms has no form in .inp files; 3 is the most.")
    values = [value for m, a in zip(mu, alpha, strict=True) for value in (m, a * MPa)]
    return f"OGDEN, N={len(mu)}", values, len(mu)


_FORMS: dict[type, Callable[[Any], tuple[str, Sequence[float], int]]] = {
    NeoHooke: lambda law: ("NEO HOOKE", [law.C10], 1),
    MooneyRivlin: lambda law: ("MOONEY-RIVLIN", [law.C10, law.C01], 1),
    Yeoh: lambda law: ("YEOH", [law.C10, law.C20, law.C30], 3),
    YeohN: _yeoh_n,
    GeneralizedRivlin: _rivlin,
    Ogden: _ogden,
    ArrudaBoyce: lambda law: ("ARRUDA-BOYCE", [law.mu, law.locking_stretch * MPa], 1),
}


def _rows(numbers: Sequence[float]) -> list[str]:
    """Lines of eight numbers at most."""
    return [_row(numbers[start : start + 8]) for start in range(0, len(numbers), 8)]


def _row(numbers: Sequence[float]) -> str:
    return ", ".join(f"{value:.15g}" for value in numbers)
