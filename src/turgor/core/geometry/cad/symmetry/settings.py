"""Settings of the symmetry of parts: every number that was chosen, with its reason.

Shares without another reference are of the size of the part.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class SymmetrySettings:
    """When a part is the same after a mirror or a turn, and where it is cut.

    Parameters
    ----------
    same : float
        Two places are the same if they are nearer than this share; two areas, or the part and its mirror image, if
        they differ by less. A surface is even about an axis if none of its waves is larger: facets of a round wall are
        no images of each other, and leave waves below 1e-3 (`test_symmetry_of_facets`).
    alike : float
        Two faces lie alike about their centers if their second moments of area differ by less than this share, and
        are halves of one face if their areas do: facets with 36 corners on a circle are off by 0.5 %. Radii around the
        part are the same up to it.
    most_fold : int
        Turns that are tried: a full turn divided by up to this number. Twice as many waves around the axis are looked
        at.
    any_angle : float [rad]
        A body of revolution is the same after this turn, which divides no full turn.
    pieces : int
        Pieces across the part into which facets are cut to integrate their waves.
    wide : float
        A sector is cut in gaps between corners of at least this share of the widest one.
    sectors : int
        Sectors of a body of revolution, which has as many as one likes: slices of 60° have cells of a good shape.
    """

    same: float = 4e-3
    alike: float = 0.03
    most_fold: int = 12
    any_angle: float = 1.0
    pieces: int = 40
    wide: float = 0.5
    sectors: int = 6


SYMMETRY = SymmetrySettings()
