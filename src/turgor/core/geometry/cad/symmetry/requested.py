"""Which symmetry of a CAD part is used: the request of the caller, and the planes and turns that loads exclude."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from turgor.core.geometry.wedge import LEAST_FOLD, MOST_FOLD
from turgor.foundation.errors import TurgorError

#: Use what models the smallest share of the part: all mirror planes that are found, or a wedge.
AUTOMATIC = "automatic"

#: Use one of n equal sectors; "wedge 6" states their number.
WEDGE = "wedge"

#: Model the whole part.
NONE = "none"

AXES = "xyz"


@dataclass(frozen=True, slots=True)
class RequestedSymmetry:
    """Where to cut a part.

    Parameters
    ----------
    planes : str
        ``"none"``; ``"automatic"`` for every mirror plane of the part, or a wedge where that is the smaller share; the
        normals of the planes, such as ``"y"`` for a half and ``"yz"`` for a quarter; or ``"wedge"`` for one sector of
        a part that is the same after each of n turns, with n where it shall not be the largest: ``"wedge 3"``.
    broken : mapping of str to str
        Planes that must not be used, by their normal, with the reason: ``{"z": "gravity acts along z"}``.
    broken_turns : mapping of str to str
        Axes about which no wedge may be used, with the reason.

    Examples
    --------
    >>> RequestedSymmetry("yz").normals
    ('y', 'z')
    >>> RequestedSymmetry("wedge 6").fold
    6
    >>> RequestedSymmetry("third")
    Traceback (most recent call last):
    turgor.TurgorError: symmetry is 'third'; allowed are "none", "automatic", normals of mirror planes such as \
"y" for a half or "yz" for a quarter, and "wedge", with the number of sectors as in "wedge 6" (2 to 36).
    """

    planes: str = NONE
    broken: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    broken_turns: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))

    def __post_init__(self) -> None:
        text = self.planes if isinstance(self.planes, str) else ""
        letters = bool(text) and set(text) <= set(AXES) and len(set(text)) == len(text)
        if text not in (NONE, AUTOMATIC) and not letters and not self.wedge:
            raise TurgorError(
                f'symmetry is {self.planes!r}; allowed are "none", "automatic", normals of mirror planes such as '
                '"y" for a half or "yz" for a quarter, and "wedge", with the number of sectors as in "wedge 6" '
                f"({LEAST_FOLD} to {MOST_FOLD})."
            )

    @property
    def wedge(self) -> bool:
        """Whether a wedge is requested by name."""
        if not isinstance(self.planes, str) or self.planes.split(" ")[0] != WEDGE:
            return False
        return self.planes == WEDGE or self.fold is not None

    @property
    def fold(self) -> int | None:
        """The number of sectors that is requested; None where it is to be found."""
        word, _, number = self.planes.partition(" ")
        if word != WEDGE or not (number.isascii() and number.isdigit()):
            return None
        return int(number) if LEAST_FOLD <= int(number) <= MOST_FOLD else None

    @property
    def automatic(self) -> bool:
        """Whether what is found is used."""
        return self.planes == AUTOMATIC

    @property
    def normals(self) -> tuple[str, ...]:
        """Normals of the planes that are requested by name."""
        return () if self.planes in (NONE, AUTOMATIC) or self.wedge else tuple(sorted(self.planes))


#: No plane is used.
WHOLE = RequestedSymmetry()
