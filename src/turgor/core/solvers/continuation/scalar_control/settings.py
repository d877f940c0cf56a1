"""Settings of paths with scalar unknowns: every number that was chosen, with its reason.

All are without unit unless it is stated; lengths are scaled with the mean edge length, stresses with a shear modulus.
`benchmarks/robustness/constants.md` says which of the robustness cases need them.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ArcScalingSettings:
    """Settings of arc scaling.

    Parameters
    ----------
    scale_growth : float
        The displacement counts at most this many times as much as the largest load so far.
    """

    scale_growth: float = 4.0


ARC_SCALING = ArcScalingSettings()


@dataclass(frozen=True, slots=True)
class CavityControlSettings:
    """Settings of cavity control.

    Parameters
    ----------
    no_volume : float
        A cavity with less than this share of the box around the body has no volume.
    """

    no_volume: float = 1e-9


CAVITY_CONTROL = CavityControlSettings()


@dataclass(frozen=True, slots=True)
class PathReversalSettings:
    """Settings of path reversal.

    Parameters
    ----------
    fallen : float
        Share of the largest load below which a path is compared with the way there; nearer to it both are alike.
    near : float
        A path that goes on is at least as far from the former path as that is from the turn; a path that returns is
        nearer than this share. Needed by `test_path_continuity.py`.
    """

    fallen: float = 0.95
    near: float = 0.3


PATH_REVERSAL = PathReversalSettings()
