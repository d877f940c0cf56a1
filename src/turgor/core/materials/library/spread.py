"""Spread between laboratories: how far the sets of a rubber and the number of its maker lie apart."""

from dataclasses import dataclass, replace
from functools import cache
from math import exp, log

import numpy as np

from turgor.core.materials.laws.laws import Hooke, Law
from turgor.core.materials.laws.pull import pull
from turgor.core.materials.library.doubts import find_doubts
from turgor.core.materials.library.record import Record
from turgor.core.materials.library.record_files import library, records
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Severity

#: Kinds of doubt about a set that is a measurement all the same: its caveat is in words, or about a convention.
_STILL_MEASURED = ("stated", "convention ambiguous", "density")

#: Stretch of the number that makers state, the 100 % modulus.
OF_MAKER = 2.0

#: Sources from which their own spread is taken: the deviation of two is known to a factor of two only.
LEAST = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class LibrarySpread:
    """How far the sources of a rubber lie apart in uniaxial tension.

    Parameters
    ----------
    name : str
        Material of the library.
    stretch : float [-]
    stresses : tuple of (str, float)
        Nominal stress of each set [Pa] by its name, and that of the maker as ``"maker"``.
    deviation : float [-]
        Standard deviation of the logarithm of the stress, that is, of its relative error.
    others : int
        Number of rubbers whose median spread it is; 0 where the rubber has enough sources of its own.
    """

    name: str
    stretch: float
    stresses: tuple[tuple[str, float], ...]
    deviation: float
    others: int = 0

    @property
    def median(self) -> float:
        """Median of the stresses [Pa]; nan where there are none."""
        values = [value for _, value in self.stresses]
        return exp(float(np.median(np.log(values)))) if values else float("nan")

    def __str__(self) -> str:
        if self.others:
            return (
                f"{self.name}: {self.deviation:.0%}, the median of {self.others} rubbers with several sources, as it "
                "has too few of its own"
            )
        low, high = (pick(value for _, value in self.stresses) for pick in (min, max))
        factor, unit = (1e6, "MPa") if high >= 1e6 else (1e3, "kPa")
        return (
            f"{self.name}: {self.deviation:.0%} between {len(self.stresses)} sources, {low / factor:.3g} to "
            f"{high / factor:.3g} {unit} at stretch {self.stretch:g}"
        )


def spread_of(name: str, stretch: float = OF_MAKER) -> LibrarySpread:
    """Return how far the sources of a rubber lie apart: sets without a serious doubt, and the maker.

    Parameters
    ----------
    name : str
        Material of the library, or the path of a file of your own.
    stretch : float [-]
        At which their nominal stress in uniaxial tension is compared; the maker counts at 2 only.

    Returns
    -------
    LibrarySpread
        With fewer than three sources, at least the median spread of the rubbers of the library that have three or more.

    Raises
    ------
    TurgorError
        If the stretch is 1 or not positive, or the material has no law of a rubber.

    Examples
    --------
    >>> print(spread_of("dragon-skin-10"))
    dragon-skin-10: 11% between 4 sources, 121 to 152 kPa at stretch 2
    """
    if not stretch > 0 or stretch == 1:
        raise TurgorError(f"stretch is {stretch:g}; allowed is above 0, and not 1, where there is no stress.")
    own = _own_spread(name, stretch)
    if not own.stresses:
        raise TurgorError(f"'{name}' has no law of a rubber without a serious doubt, and so no spread.")
    if len(own.stresses) >= LEAST:
        return own
    typical, others = typical_spread(stretch)
    return own if own.deviation > typical else replace(own, deviation=typical, others=others)


@cache
def typical_spread(stretch: float = OF_MAKER) -> tuple[float, int]:
    """Return the median spread of the rubbers with three sources or more, and their number.

    Examples
    --------
    >>> deviation, rubbers = typical_spread()
    >>> 0.1 < deviation < 0.5, rubbers >= 4
    (True, True)
    """
    rubbers = [name for name in library() if records(name)[0].kind == "rubber"]
    spreads = [_own_spread(name, stretch) for name in rubbers]
    deviations = [each.deviation for each in spreads if len(each.stresses) >= LEAST]
    return float(np.median(deviations)), len(deviations)


def _own_spread(name: str, stretch: float) -> LibrarySpread:
    """Spread of the sources of a rubber; 0 with one."""
    known = records(name)
    sound = sound_laws(name)
    reach = {_origin(record) for record, _ in sound if _reaches(record, stretch)}
    stresses: dict[str, float] = {}
    for record, law in sound:
        if not _reaches(record, stretch) and _origin(record) in reach:
            continue  # the same tests have a set that goes further
        stress = float(pull(law, "uniaxial", np.array([stretch]))[0])
        if all(abs(log(stress / other)) > 1e-9 for other in stresses.values()):  # the same set, quoted twice
            stresses[record.name] = stress
    maker = known[0].supplier.stress_at_stretch_2 if known[0].supplier else None
    if maker is not None and stretch == OF_MAKER and stresses:
        stresses["maker"] = maker
    logarithms = np.log([abs(value) for value in stresses.values()])
    deviation = float(logarithms.std(ddof=1)) if len(stresses) >= 2 else 0.0
    return LibrarySpread(name=name, stretch=stretch, stresses=tuple(stresses.items()), deviation=deviation)


def _reaches(record: Record, stretch: float) -> bool:
    return record.stretch_range is None or record.stretch_range[1] >= stretch


def _origin(record: Record) -> str:
    """Publication and tests of a set, without how it was fitted."""
    return record.source.partition("; fitted by turgor")[0]


def sound_laws(name: str) -> tuple[tuple[Record, Law], ...]:
    """Return the sets of a rubber that are measurements of it, without a serious doubt, with their laws.

    Parameters
    ----------
    name : str
        Material of the library, or the path of a file of your own.

    Examples
    --------
    >>> len(sound_laws("ecoflex-00-30")), len(sound_laws("silicone-o-ring"))
    (10, 0)
    """
    laws = ((record, record.build_law()) for record in records(name) if not _doubted(record))
    return tuple((record, law) for record, law in laws if not isinstance(law, Hooke))


def _doubted(record: Record) -> bool:
    """Whether a set is no measurement of this rubber; one that turgor fitted to a curve may be far from the maker's."""
    kinds = {doubt.kind for doubt in find_doubts(record) if doubt.severity is Severity.WARNING}
    return bool(kinds.difference(_STILL_MEASURED, ("far from the supplier",) if record.fitted else ()))
