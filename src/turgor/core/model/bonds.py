"""Bond: a glued face between two bodies, which peels off, slides and gaps."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.bodies.parted import parted
from turgor.core.meshing.mesh import Mesh
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.given import number
from turgor.units import kPa

#: How the fracture energy depends on the share of shear.
BENZEGGAGH_KENANE, POWER = "benzeggagh-kenane", "power"
MIXED_MODES = (BENZEGGAGH_KENANE, POWER)

Corner = tuple[float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Bond:
    """Bond between two regions of a mesh: it opens where the stress across it passes its strength.

    The nodes between both regions are doubled. The traction grows with the opening up to the strength and then falls to
    zero (bilinear); the area below this curve is the fracture energy. What is damaged stays damaged. Closed faces press
    on each other as before.

    Parameters
    ----------
    name : str
        Name in results; both faces of the bond are ``NAME_FIRST`` and ``NAME_SECOND``, after the regions.
    between : (str, str)
        Regions that are bonded.
    peel_strength : float [Pa]
        Largest traction across the bond.
    energy_peel : float [J/m²]
        Energy per area that peeling takes.
    shear_strength : float [Pa], optional
        Largest traction along the bond; that of peeling by default.
    energy_shear : float [J/m²], optional
        Energy per area that shearing takes; that of peeling by default.
    stiffness : float [Pa/m], optional
        Traction across the undamaged bond per opening. By default as small a compliance as 1 % of that of the cells
        next to it. Along the bond it is this times (shear_strength / peel_strength)².
    mixed_mode : str
        Fracture energy G(B) by the share B of shear in the elastic energy, with exponent η: ``"benzeggagh-kenane"``,
        G = G_peel + (G_shear − G_peel) B^η, or ``"power"``, ((1 − B) G / G_peel)^η + (B G / G_shear)^η = 1.
    exponent : float [-]
        η, 1 to 10.
    unbonded : two points (3,), optional [m]
        Lowest and highest corner of a box in which the bodies are not bonded at rest: a flaw. They touch there.
    source : str
        Where the numbers come from, for reports.

    Raises
    ------
    TurgorError
        If a number is not positive, or the stiffness leaves no energy for the damage.

    Examples
    --------
    >>> Bond(name="glue", between=("body", "base"), peel_strength=80e3, energy_peel=200.0).shear
    (80000.0, 200.0)
    """

    name: str
    between: tuple[str, str]
    peel_strength: float
    energy_peel: float
    shear_strength: float | None = None
    energy_shear: float | None = None
    stiffness: float | None = None
    mixed_mode: str = BENZEGGAGH_KENANE
    exponent: float = 1.0
    unbonded: tuple[Corner, Corner] | None = None
    source: str = ""

    def __post_init__(self) -> None:
        if len(self.between) != 2 or self.between[0] == self.between[1]:
            raise TurgorError(f"bond '{self.name}': between is {self.between!r}; two different regions are needed.")
        for name in ("peel_strength", "energy_peel", "shear_strength", "energy_shear", "stiffness"):
            value = getattr(self, name)
            if value is not None and not 0 < number(value, f"bond '{self.name}': {name}") < inf:
                raise TurgorError(f"bond '{self.name}': {name} is {value:g}; a positive number is needed.")
        if self.mixed_mode not in MIXED_MODES:
            raise unknown(f"mixed_mode of the bond '{self.name}'", self.mixed_mode, MIXED_MODES)
        if not 1 <= number(self.exponent, f"bond '{self.name}': exponent") <= 10:
            raise TurgorError(f"bond '{self.name}': exponent is {self.exponent:g}; allowed is 1 to 10.")
        least = self.least_stiffness
        if self.stiffness is not None and self.stiffness <= least:
            raise TurgorError(
                f"bond '{self.name}': stiffness is {self.stiffness:.3g} Pa/m, with which the strength is reached only "
                f"after the fracture energy is spent; more than {least:.3g} Pa/m is needed "
                f"(peel_strength {self.peel_strength / kPa:.4g} kPa squared over twice the energy)."
            )
        self._check_box()

    def _check_box(self) -> None:
        if self.unbonded is None:
            return
        box = np.asarray(self.unbonded, dtype=np.float64)
        if box.shape != (2, 3) or not (box[0] < box[1]).all():
            raise TurgorError(
                f"bond '{self.name}': unbonded is {self.unbonded!r}; two corners are needed, the first below the other."
            )

    @property
    def shear(self) -> tuple[float, float]:
        """Strength [Pa] and fracture energy [J/m²] in shear."""
        return self.shear_strength or self.peel_strength, self.energy_shear or self.energy_peel

    @property
    def least_stiffness(self) -> float:
        """Stiffness [Pa/m] at which the whole fracture energy is stored at the strength."""
        return self.peel_strength**2 / (2 * min(self.energy_peel, self.shear[1]))

    def text(self) -> str:
        """Sentence of a report."""
        strength, energy = self.shear
        source = f" ({self.source})" if self.source else ""
        return (
            f"{self.between[0]} and {self.between[1]} are bonded ({self.name}): {self.peel_strength / kPa:.4g} kPa and "
            f"{self.energy_peel:.4g} J/m² in peel, {strength / kPa:.4g} kPa and {energy:.4g} J/m² in shear{source}."
        )

    def flawed(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Whether points (..., 3) lie where nothing is bonded at rest."""
        if self.unbonded is None:
            return np.zeros(points.shape[:-1], dtype=bool)
        low, high = np.array(self.unbonded)
        return np.asarray(((points > low) & (points < high)).all(axis=-1))


def parted_mesh(mesh: Mesh, bonds: Sequence[Bond]) -> Mesh:
    """Double the nodes of a mesh along bonds.

    Parameters
    ----------
    mesh : Mesh
    bonds : sequence of Bond

    Returns
    -------
    Mesh

    Raises
    ------
    TurgorError
        If a region is unknown, two bonds share a name, or the mesh has no cells to part.
    """
    names = [bond.name for bond in bonds]
    for bond in bonds:
        if names.count(bond.name) > 1:
            raise TurgorError(f"bond '{bond.name}': the name is taken; every bond needs one of its own.")
        if mesh.wedge is not None:
            raise TurgorError(f"bond '{bond.name}': a sector of a whole cannot be parted; model the whole or a half.")
        mesh = parted(mesh, bond.name, bond.between)
    return mesh
