"""Settings of the meshes of sections: every number that was chosen, with its reason. All are without unit."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class SectionMeshSettings:
    """How a section is found and meshed.

    Parameters
    ----------
    uniform_share : float
        A section is that of the longest layer, which must be at least this share of an actuator.
    cells, lattice : int
        Cells that the default size would make if the solids were a square lattice; and points along each side of the
        square in which the area of the solids is counted.
    corner_edge : float
        Length of the cells at sharp corners, as a share of the size. An omnidirectional actuator with half-round
        chambers, their flat side outward, bends at 20 kPa by 7 % too little without short cells, by 3 % with 1/4, by
        1 % with this.
    sharp_angle : float
        Share of the full angle around a corner from which solids make it sharp: 216°. Less hardly disturbs the stress.
    directions, near : int, float
        Directions in which the surroundings of a corner are searched, and how far away, as a share of the size of the
        section.
    """

    uniform_share: float = 0.5
    cells: int = 60
    lattice: int = 160
    corner_edge: float = 0.08
    sharp_angle: float = 0.6
    directions: int = 40
    near: float = 1e-4


SECTION_MESH = SectionMeshSettings()
