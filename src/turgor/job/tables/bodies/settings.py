"""Settings of rigid bodies in job files."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class FillingSettings:
    """What fills a rigid body.

    Parameters
    ----------
    modulus : float [Pa]
        Shear modulus. The stiffness of contact follows from it: as that of a hard silicone it lets no finger sink in,
        and does not make steps harder than a finger on a finger.
    bulk_ratio : float [-]
        Bulk modulus over the shear modulus; finite, because a rigid surface leaves the mean stress of an
        incompressible body undetermined.
    """

    modulus: float = 1e6
    bulk_ratio: float = 20.0


FILLING = FillingSettings()
