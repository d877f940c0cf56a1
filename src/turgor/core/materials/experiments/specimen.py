"""Specimen: dimensions for the conversion of length and force to stretch and nominal stress."""

from dataclasses import dataclass
from math import inf

from turgor.foundation.errors import TurgorError


@dataclass(frozen=True, slots=True, kw_only=True)
class Specimen:
    """Dimensions of a specimen before the test, for the conversion of length and force to stretch and nominal stress.

    Parameters
    ----------
    length : float [m]
        Initial length between the marks or the grips.
    area : float or None [m²]
        Initial cross-section; or give width and thickness.
    width, thickness : float or None [m]
        Initial width and thickness of the cross-section.

    Examples
    --------
    >>> from turgor.units import mm
    >>> round(Specimen(length=33 * mm, width=6 * mm, thickness=3 * mm).section * 1e6, 6)
    18.0
    """

    length: float
    area: float | None = None
    width: float | None = None
    thickness: float | None = None

    def __post_init__(self) -> None:
        for key in ("length", "area", "width", "thickness"):
            value = getattr(self, key)
            if value is not None and not (0 < value < inf):
                unit = "m²" if key == "area" else "m"
                raise TurgorError(f"specimen: {key} is {value:g} {unit}; it must be more than 0.")
        if (self.area is None) == (self.width is None or self.thickness is None):
            given = [key for key in ("area", "width", "thickness") if getattr(self, key) is not None]
            raise TurgorError(
                f"specimen: its section is stated by {', '.join(given) or 'nothing'}; give either its area, or its "
                "width and its thickness."
            )

    @property
    def section(self) -> float:
        """Initial cross-section [m²]."""
        if self.area is not None:
            return self.area
        assert self.width is not None and self.thickness is not None
        return self.width * self.thickness
