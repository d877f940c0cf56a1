"""Strength: what a material bears until it breaks or tears, each number with its source."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite

from turgor.foundation.errors import TurgorError, near_match

#: Numbers of a strength, and the dimension of each; empty for a pure number.
STRENGTHS: Mapping[str, str] = {
    "elongation_at_break": "",
    "tensile_strength": "pressure",
    "tear_strength": "force per length",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Strength:
    """What a material bears in the tests of its maker or of a publication.

    These are means of a few specimens with cut edges, pulled once to break. A part breaks earlier at a notch, a bubble
    or a bond, and after many cycles.

    Parameters
    ----------
    elongation_at_break : float or None [-]
        Nominal strain at break in uniaxial tension: 9.0 for the 900 % of a data sheet.
    tensile_strength : float or None [Pa]
        Force at break per area of the undeformed section.
    tear_strength : float or None [N/m]
        Force per thickness that tears a specimen, after ASTM D624 or ISO 34-1 as the source states. The shape of the
        specimen matters: it is no tearing energy.
    sources : mapping of str to str
        Source of each number, by its name.
    doubts : tuple of str
        What is questionable about the numbers.

    Raises
    ------
    TurgorError
        If a number is not positive, or has no source.

    Examples
    --------
    >>> ours = Strength(elongation_at_break=9.0, sources={"elongation_at_break": "our tests of May"})
    >>> ours.ultimate_stretch
    10.0
    """

    elongation_at_break: float | None = None
    tensile_strength: float | None = None
    tear_strength: float | None = None
    sources: Mapping[str, str] = field(default_factory=dict, hash=False)  # so that a material can be a key
    doubts: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        for name in self.sources:
            if name not in STRENGTHS:
                raise TurgorError(f"strength: source of unknown '{name}'{near_match(name, STRENGTHS) or '.'}")
        for name in STRENGTHS:
            value = getattr(self, name)
            if value is None:
                continue
            if not (isfinite(value) and value > 0):
                raise TurgorError(f"strength: {name} is {value:g}; a finite number above 0 is needed.")
            if not self.sources.get(name, "").strip():
                raise TurgorError(f"strength: {name} has no source; state where the number came from.")

    @property
    def ultimate_stretch(self) -> float | None:
        """Stretch at break in uniaxial tension: 1 + elongation at break; None where that is not known."""
        return None if self.elongation_at_break is None else 1.0 + self.elongation_at_break
