"""Units of a deck, which states none: a length, a force, and the stress that follows from them."""

from dataclasses import dataclass

from turgor.foundation.errors import TurgorError, unknown
from turgor.units import UNITS

#: Units that are taken where none are stated: those of most decks of soft parts, with masses in tonnes.
USUAL = "mm, N, MPa"


@dataclass(frozen=True, slots=True, kw_only=True)
class DeckUnits:
    """Units of the numbers of a deck; time is in seconds.

    Parameters
    ----------
    length : float [m]
        Of one unit.
    force : float [N]
        Of one unit.
    word : str
        The unit of length.

    Examples
    --------
    >>> DeckUnits.of("mm, N, MPa").stress
    1000000.0
    >>> f"{DeckUnits.of('mm, N, MPa').density:.0e} kg/m³ is a tonne per cubic millimeter"
    '1e+12 kg/m³ is a tonne per cubic millimeter'
    """

    length: float
    force: float
    word: str = "mm"

    @classmethod
    def of(cls, text: str) -> "DeckUnits":
        """Read three units that fit each other, such as ``"mm, N, MPa"`` or ``"m, N, Pa"``.

        Raises
        ------
        TurgorError
            If one is unknown, or the stress is not the force over the square of the length.
        """
        words = [word.strip() for word in text.split(",")]
        if len(words) != 3:
            raise TurgorError(f"units are '{text}'; a length, a force and a stress are needed, such as '{USUAL}'.")
        for word, dimension in zip(words, ("length", "force", "pressure"), strict=True):
            if word not in UNITS[dimension]:
                raise unknown(f"unit of {dimension}", word, UNITS[dimension])
        length, force = UNITS["length"][words[0]], UNITS["force"][words[1]]
        stress = UNITS["pressure"][words[2]]
        if abs(force / length**2 - stress) > 1e-6 * stress:
            raise TurgorError(
                f"units are '{text}', but {words[1]} over {words[0]}² is {force / length**2:g} Pa and {words[2]} is "
                f"{stress:g} Pa; the numbers of a deck have units that fit each other, such as '{USUAL}'."
            )
        return cls(length=length, force=force, word=words[0])

    @property
    def stress(self) -> float:
        """One unit of stress [Pa]."""
        value = self.force / self.length**2
        return float(f"{value:.12g}")  # 1e6 and not 1000000.0000000001

    @property
    def density(self) -> float:
        """One unit of density [kg/m³]."""
        return float(f"{self.force / self.length**4:.12g}")
