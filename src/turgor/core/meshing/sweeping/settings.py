"""Settings of swept meshes: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class SectionSettings:
    """How sections are divided into quadrilaterals (`test_swept_sections`).

    Parameters
    ----------
    core : float
        Radius of the core around an axis as a share of the smallest radius of the section.
    along_axes, along_diagonal : float
        The square in the core of a disc, as at the end of an extending cylinder, reaches this share of the radius along
        the axes, and between them.
    wall_of_several : int
        Cells through the wall of a tube of several materials. The stress of a two-material bender (99 %) is 148.7 kPa
        with one, 152.2 with two and 154.1 with four; other tubes are as exact with one.
    good_pair : float
        Triangles are joined where the sine of the worst corner is above this: corners between 37° and 143°. Sections of
        omnidirectional actuators, joints and trapezoidal PneuNets change at half and double.
    flat_corner, longest_per_gap : float
        Sections with a flatter corner than this sine are meshed again with shorter cells between near edges: their
        triangles are at most so many times as long as these edges are apart. The revolute joint needs them.
    """

    core: float = 0.5
    along_axes: float = 0.6
    along_diagonal: float = 0.46
    wall_of_several: int = 2
    good_pair: float = 0.6
    flat_corner: float = 0.25
    longest_per_gap: float = 2.0


SECTION = SectionSettings()
