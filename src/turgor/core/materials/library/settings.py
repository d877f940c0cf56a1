"""Settings of the library: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class DoubtSettings:
    """Settings of doubts about records, tested in `tests/unit/core/materials/library/test_library_doubts.py`.

    Parameters
    ----------
    same : float
        Constants of two rubbers that lie this close are taken to be the same numbers, as a share.
    far : float
        Factor by which a stress may differ from the supplier's before it is doubted; good fits of one rubber differ by
        a factor of 2.
    stiffest_rubber : float [Pa]
        No rubber is stiffer than this; the hardest, at 95 Shore A, have some 50 MPa.
    """

    same: float = 0.1
    far: float = 2.5
    stiffest_rubber: float = 100e6


DOUBTS = DoubtSettings()


@dataclass(frozen=True, slots=True)
class ChoiceSettings:
    """Settings of the choice of a rubber.

    Parameters
    ----------
    points : float
        Points of Shore hardness by which a rubber may differ from a wanted one; makers state theirs to 5 points.
    """

    points: float = 10.0


CHOICE = ChoiceSettings()
