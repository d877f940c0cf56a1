"""Which symmetry of a CAD part is used: what the caller asks for, and what loads forbid."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from turgor.errors import TurgorError

#: Use every mirror plane that is found.
AUTOMATIC = "automatic"

#: Model the whole part.
NONE = "none"

AXES = "xyz"


@dataclass(frozen=True, slots=True)
class WantedSymmetry:
    """Mirror planes to cut a part at.

    Parameters
    ----------
    planes : str
        ``"none"``; ``"automatic"`` for every mirror plane of the part; or the normals of the planes, such as ``"y"``
        for a half and ``"yz"`` for a quarter.
    broken : mapping of str to str
        Planes that must not be used, by their normal, with the reason: ``{"z": "gravity acts along z"}``.

    Examples
    --------
    >>> WantedSymmetry("yz").normals
    ('y', 'z')
    >>> WantedSymmetry("half")
    Traceback (most recent call last):
    turgor.errors.TurgorError: symmetry is 'half'; allowed are "none", "automatic", and normals of mirror planes such \
as "y" for a half or "yz" for a quarter.
    """

    planes: str = NONE
    broken: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))

    def __post_init__(self) -> None:
        named = isinstance(self.planes, str) and self.planes in (NONE, AUTOMATIC)
        letters = isinstance(self.planes, str) and bool(self.planes) and set(self.planes) <= set(AXES)
        if not named and (not letters or len(set(self.planes)) < len(self.planes)):
            raise TurgorError(
                f'symmetry is {self.planes!r}; allowed are "none", "automatic", and normals of mirror planes such as '
                '"y" for a half or "yz" for a quarter.'
            )

    @property
    def automatic(self) -> bool:
        """Whether the planes are those that are found."""
        return self.planes == AUTOMATIC

    @property
    def normals(self) -> tuple[str, ...]:
        """Normals of the planes that are asked for by name."""
        return () if self.planes in (NONE, AUTOMATIC) else tuple(sorted(self.planes))


#: No plane is used.
WHOLE = WantedSymmetry()
