"""Materials with directions as Abaqus writes them: the law, and the axes and fibers of a body."""

import numpy as np

from turgor.core.materials.laws.laws import HolzapfelGasserOgden
from turgor.core.materials.material import Material
from turgor.foundation.errors import TurgorError
from turgor.units import MPa, mm


def fiber_lines(name: str, material: Material, program: str) -> list[str]:
    """Write the law of Holzapfel, Gasser and Ogden, the only one with directions that Abaqus has as it is here.

    Parameters
    ----------
    name : str
        Name in the file.
    material : Material
    program : str
        ``"abaqus"``; CalculiX has it in a subroutine of the user only.

    Examples
    --------
    >>> from turgor.core.materials.orientation import Orientation
    >>> law = HolzapfelGasserOgden(C10=5e3, k1=20e3, k2=0.8, kappa=0.1)
    >>> wound = Orientation(along=(0, 0, 1), around=(0, 0, 0), angle="30 deg")
    >>> fiber_lines("body", Material(name="wall", law=law, orientation=wound), "abaqus")
    ['*ANISOTROPIC HYPERELASTIC, HOLZAPFEL, LOCAL DIRECTIONS=2', '0.005, 0, 0.02, 0.8, 0.1']
    """
    law = material.law
    if not isinstance(law, HolzapfelGasserOgden):
        raise TurgorError(
            f"materials.{name}: {type(law).__name__} has no form in .inp files; of the laws with directions only "
            "HolzapfelGasserOgden has one, for Abaqus."
        )
    if program == "calculix":
        raise TurgorError(
            f"materials.{name}: CalculiX has HolzapfelGasserOgden as a subroutine of the user only; write for Abaqus."
        )
    if law.k2 == 0:
        raise TurgorError(f"materials.{name}: k2 is 0, which Abaqus does not allow; a small one such as 1e-3 is alike.")
    compressibility = 0.0 if material.incompressible else 2 / (material.bulk_modulus / MPa)
    values = (law.C10 / MPa, compressibility, law.k1 / MPa, law.k2, law.kappa)
    row = ", ".join(f"{value:.15g}" for value in values)
    return [f"*ANISOTROPIC HYPERELASTIC, HOLZAPFEL, LOCAL DIRECTIONS={len(_directions(material))}", row]


def orientation_lines(name: str, material: Material) -> tuple[list[str], str]:
    """Write the axes and the fibers of a body, and what the line of its section says of them; nothing without any.

    Examples
    --------
    >>> from turgor.core.materials.orientation import Orientation
    >>> law = HolzapfelGasserOgden(C10=5e3, k1=20e3, k2=0.8)
    >>> straight = Orientation(along=(1, 0, 0), across=(0, 1, 0))
    >>> lines, option = orientation_lines("body", Material(name="wall", law=law, orientation=straight))
    >>> lines[0], lines[1:], option  # doctest: +NORMALIZE_WHITESPACE
    ('*ORIENTATION, NAME=directions_body, SYSTEM=RECTANGULAR, LOCAL DIRECTIONS=1',
     ['1, 0, 0, 0, 1, 0', '3, 0', '1, 0, 0'], ', ORIENTATION=directions_body')
    """
    orientation = material.orientation
    if orientation is None:
        return [], ""
    label, directions = f"directions_{name}", _directions(material)
    system = "RECTANGULAR"
    if orientation.around is None:
        first, second, _ = orientation.frames(np.zeros(3))
    else:  # two points on the axis; the local axes are radial, around and along
        system, first = "CYLINDRICAL", np.array(orientation.around) / mm
        second = first + np.array(orientation.along)
        directions = directions[:, [2, 1, 0]]
    rows = [[*first, *second], [3, 0], *directions]
    head = f"*ORIENTATION, NAME={label}, SYSTEM={system}, LOCAL DIRECTIONS={len(directions)}"
    return [head, *(", ".join(f"{value:.12g}" for value in row) for row in rows)], f", ORIENTATION={label}"


def _directions(material: Material) -> np.ndarray:
    """Mean directions (k, 3) of the fibers by the three directions of the material."""
    assert isinstance(material.law, HolzapfelGasserOgden) and material.orientation is not None
    return np.array([each.direction for each in material.law.families(material.orientation.angle)])
