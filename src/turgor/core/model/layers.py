"""Layers: a stiff sheet as a solid region of its own, instead of a membrane or a shell on a face."""

from dataclasses import replace

from turgor.core.materials.laws.laws import Hooke, NeoHooke, Woven
from turgor.core.materials.material import Material
from turgor.foundation.errors import TurgorError


def as_solid(material: Material) -> Material:
    """Return a linear elastic material as a rubber of the same moduli, so that it can fill a region.

    Regions need a law for large strains. The neo-Hookean law has the same initial shear and bulk modulus, so both laws
    agree while strains are small. A material of any other law is returned as it is.

    Parameters
    ----------
    material : Material

    Returns
    -------
    Material

    Examples
    --------
    >>> from turgor.core.materials.library.records import from_library
    >>> paper = as_solid(from_library("paper", record="hooke-polygerinos-2020"))
    >>> round(paper.law.shear_modulus / 1e6), round(paper.bulk_modulus / 1e6)
    (2708, 3611)
    """
    law = material.law
    if not isinstance(law, Hooke):
        return material
    if isinstance(law, Woven):
        raise TurgorError(f"'{material.name}' is woven, and rubber of the same moduli has no warp; make it a sheet.")
    rubber = NeoHooke(C10=law.shear_modulus / 2)
    return replace(material, law=rubber, bulk_modulus=law.bulk_modulus, bending_stiffness=None)
