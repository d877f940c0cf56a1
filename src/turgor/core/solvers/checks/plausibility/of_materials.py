"""Magnitudes of materials: moduli, compressibility, locking, density."""

from collections.abc import Iterator
from math import acos, cos, inf, sqrt

from turgor.core.materials.laws.laws import ArrudaBoyce, Gent, Hooke
from turgor.core.materials.material import Material
from turgor.core.solvers.checks.distinct import distinct, regions_and_sheets
from turgor.core.solvers.checks.plausibility.question import Magnitude, Question

#: Bulk modulus over shear modulus at a Poisson's ratio of 0.45; a stiff solid with less is paper or plastic.
NO_RUBBER = 9.67

#: Shear modulus of the stiffest rubber [Pa].
STIFFEST_RUBBER = 20e6

#: Parts this many times as stiff as the softest do not give way.
RIGID = 30.0


#: Material of the inside of rigid bodies, whose density follows from a mass: it may be hollow, or a metal.
RIGID_BODY = "rigid body"


def rubber_modulus(question: Question) -> Iterator[Magnitude]:
    """Initial shear modulus of every region's law but those of stiff parts and of foams [Pa]."""
    return (_of(each, each.law.shear_modulus) for each, stiff in _solids(question) if not (stiff or each.is_foam))


def stiff_modulus(question: Question) -> Iterator[Magnitude]:
    """Initial shear modulus of regions that are no rubber: layers of paper, plates, links [Pa]."""
    return (_of(each, each.law.shear_modulus) for each, stiff in _solids(question) if stiff)


def poisson_ratio(question: Question) -> Iterator[Magnitude]:
    """Poisson's ratio of the compressible rubbers that are no foams [-]."""
    for each, stiff in _solids(question):
        bulk, shear = each.bulk_modulus, each.law.shear_modulus
        if bulk < inf and not stiff and not each.is_foam:
            yield Magnitude(
                f"Material '{each.name}' with a bulk modulus of {bulk / shear:.3g} times its shear modulus",
                (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear)),
            )


def locking_stretch(question: Question) -> Iterator[Magnitude]:
    """Stretch in uniaxial tension at which the chains of a law are straight [-]."""
    for each, _ in _solids(question):
        if isinstance(each.law, Gent):
            yield _of(each, _uniaxial(each.law.Jm))
        elif isinstance(each.law, ArrudaBoyce):
            yield _of(each, _uniaxial(3 * each.law.locking_stretch**2 - 3))


def rubber_density(question: Question) -> Iterator[Magnitude]:
    """Density of every region's rubber that states one and is no foam [kg/m³]."""
    rubbers = (each for each, stiff in _solids(question) if not stiff and not each.is_foam)
    return (_of(each, each.density) for each in rubbers if each.density is not None and each.name != RIGID_BODY)


def stiff_density(question: Question) -> Iterator[Magnitude]:
    """Density of stiff parts, sheets and threads that state one [kg/m³]."""
    rubbers = [each for each, stiff in _solids(question) if not stiff]
    others = (each for each in materials_of(question) if each not in rubbers)
    return (_of(each, each.density) for each in others if each.density is not None)


def has_rubber(question: Question) -> bool:
    """Whether any region is a rubber."""
    return any(not stiff for _, stiff in _solids(question))


def sheet_modulus(question: Question) -> Iterator[Magnitude]:
    """Young's modulus of sheets and threads [Pa]."""
    return (_of(each, each.law.E) for each in materials_of(question) if isinstance(each.law, Hooke))


def materials_of(question: Question) -> tuple[Material, ...]:
    """Materials of regions, sheets and threads, each once."""
    return distinct((*regions_and_sheets(question.model), *(each.material for each in question.model.reinforcements)))


def _solids(question: Question) -> list[tuple[Material, bool]]:
    """Materials of the regions, and whether each is a stiff part rather than a rubber."""
    materials = distinct(question.model.region_materials.values())
    softest = min((each.law.shear_modulus for each in materials), default=inf)
    return [(each, _is_stiff(each, softest)) for each in materials]


def _is_stiff(material: Material, softest: float) -> bool:
    """Whether a solid is stiffer than any rubber, and either compressible or far stiffer than the rubber next to it."""
    shear = material.law.shear_modulus
    return shear > STIFFEST_RUBBER and (material.bulk_modulus < NO_RUBBER * shear or shear > RIGID * softest)


def _of(material: Material, value: float) -> Magnitude:
    return Magnitude(f"Material '{material.name}'", value)


def _uniaxial(excess: float) -> float:
    """Stretch at which I₁ − 3 = λ² + 2/λ − 3 reaches a value: the largest root of λ³ − (3 + excess) λ + 2 = 0."""
    third = (3 + excess) / 3
    return 2 * sqrt(third) * cos(acos(-(third**-1.5)) / 3)
