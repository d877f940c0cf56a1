"""Numbers of bonds that were chosen."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class BondSettings:
    """What was chosen for bonds.

    Parameters
    ----------
    stiffness : float [-]
        Stiffness of an undamaged bond over that of a layer of the softer neighbor as thick as an element is wide. 10
        makes the bond as compliant as a tenth of an element. With 100 a step takes twice the updates of Newton's
        method, and a double cantilever beam has the same load up to 0.5 %.
    brittleness : float [-]
        Smallest opening at the end over that at the strength, at peel and at shear, for a stiffness that was not
        stated: 10 leaves nine tenths of the fracture energy for the damage.
    zone : float [-]
        Elements that the zone of damage before a crack should span; with fewer the load jumps from element to element
        (Turon et al. 2007: 3 to 5).
    clearance : float [-]
        Depth over the width of an element from which the sides of a flaw press on each other. At rest they touch, and
        without a clearance Newton's method goes round between points that press and points that do not.
    """

    stiffness: float = 10.0
    brittleness: float = 10.0
    zone: float = 3.0
    clearance: float = 0.01


BOND = BondSettings()
