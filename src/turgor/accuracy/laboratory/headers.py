"""Headers of laboratory tables: the name and the unit of a column, however its author wrote them."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches

from turgor.foundation.errors import TurgorError
from turgor.foundation.response import COLUMN_UNITS
from turgor.units import UNITS

#: Dimensions that a column of a table may have, as in `turgor.units.UNITS`.
DIMENSIONS = ("pressure", "angle", "length", "force", "time", "volume", "mass", "moment", "flow rate")

#: Spellings of units, in lower case, and the one that is known.
_SPELLINGS = {
    "°": "deg", "º": "deg", "degree": "deg", "degrees": "deg", "deg.": "deg", "radian": "rad", "radians": "rad",
    "kpa": "kPa", "psig": "psi", "bars": "bar", "sec": "s", "secs": "s", "second": "s", "seconds": "s", "ml": "mL",
    "cm^3": "cm3", "mm^3": "mm3", "newton": "N", "newtons": "N", "n": "N", "mm.": "mm", "µl": "uL", "l": "L",
    "kgf/cm²": "kgf/cm2", "kgf/cm^2": "kgf/cm2", "n/mm²": "N/mm2", "n/mm^2": "N/mm2", "n/cm²": "N/cm2",
}  # fmt: skip

#: Unit that a column of a dimension is shown in where its own is none of `COLUMN_UNITS`.
_SHOWN = {
    "pressure": "kPa", "angle": "deg", "length": "mm", "force": "N", "time": "s", "volume": "mL", "mass": "g",
    "moment": "Nm", "flow rate": "mL/min",
}  # fmt: skip

#: Words of a name that say its dimension; a number below such a name has a unit.
_WORDS = (
    ("pressure", "pressure"), ("angle", "angle"), ("force", "force"), ("load", "force"), ("displacement", "length"),
    ("height", "length"), ("deflection", "length"), ("distance", "length"), ("volume", "volume"), ("time", "time"),
    ("flow", "flow rate"),
)  # fmt: skip

#: Short names that everybody uses, and German ones.
_SHORT = {
    **{"p": "pressure", "t": "time", "f": "force"},
    **{"druck": "pressure", "zeit": "time", "kraft": "force", "biegewinkel": "bending_angle", "volumen": "volume"},
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Header:
    """Meaning of the header of a column.

    Parameters
    ----------
    name : str
        Name of the column in a response, such as ``"bending_angle"``.
    unit : str
        Unit that the column is shown in; empty for a pure number.
    factor : float
        From the numbers of the file to SI.
    """

    name: str
    unit: str
    factor: float


def read_header(text: str, unit: str | None = None, *, file: str = "table") -> Header:
    """Read the name and the unit of a column from its header.

    Parameters
    ----------
    text : str
        Such as ``"Bending Angle (°)"``, ``"Pressure [psi]"``, ``"Force / N"`` or ``"tip_displacement_mm"``.
    unit : str, optional
        The unit, where the header has none or a wrong one.
    file : str
        Name of the file, for messages.

    Returns
    -------
    Header

    Raises
    ------
    TurgorError
        If the unit is unknown, or missing although the name says what was measured.

    Examples
    --------
    >>> read_header("Bending Angle (°)")
    Header(name='bending_angle', unit='deg', factor=0.017453292519943295)
    >>> read_header("Pressure [psi]").unit, read_header("tip_displacement_mm").name, read_header("sweep").unit
    ('kPa', 'tip_displacement', '')
    >>> read_header("pressure", file="finger.csv")
    Traceback (most recent call last):
    turgor.TurgorError: 'finger.csv': column 'pressure' states no unit; ...
    """
    words, written = split_header_unit(text)
    name = column_name(words)
    given = unit if unit is not None else written
    if given in (None, "", "-", "1"):
        dimension = next((kind for word, kind in _WORDS if word in name.split("_")), "")
        if dimension and given is None:
            example = _SHOWN[dimension]
            raise TurgorError(
                f"'{file}': column '{text}' states no unit; write it into the header, such as '{text} ({example})',",
                python=f"or give it: units={{'{name}': '{example}'}}.",
                command=f"or give it: --unit {name}={example}.",
            )
        return Header(name=name, unit="", factor=1.0)
    dimension, known, factor = find_unit(str(given), f"'{file}', column '{text}'")
    return Header(name=name, unit=known if known in COLUMN_UNITS else _SHOWN[dimension], factor=factor)


def find_unit(unit: str, where: str) -> tuple[str, str, float]:
    """Find a unit: its dimension, its usual spelling, and its factor to SI.

    Parameters
    ----------
    unit : str
        As it was written.
    where : str
        Where it stands, for the message.

    Raises
    ------
    TurgorError
        If no dimension has it.

    Examples
    --------
    >>> find_unit("Degrees", "here")
    ('angle', 'deg', 0.017453292519943295)
    """
    plain = unit.strip().replace("\N{GREEK SMALL LETTER MU}", "µ")
    table = _units()
    known = plain if plain in table else _SPELLINGS.get(plain.lower(), plain)
    if known not in table:
        nearest = get_close_matches(plain.lower(), [each.lower() for each in table], n=1)
        meant = next((each for each in table if each.lower() in nearest), None)
        hint = (
            f"did you mean '{meant}'?" if meant else f"known are {', '.join(each for each in table if each.isascii())}."
        )
        raise TurgorError(f"{where}: unknown unit '{plain}'; {hint}")
    dimension, factor = table[known]
    return dimension, known, factor


def split_header_unit(text: str) -> tuple[str, str | None]:
    """Split a header into its words and its unit; the unit is None where there is none.

    Examples
    --------
    >>> split_header_unit("Force / N"), split_header_unit("pressure_kPa"), split_header_unit("Angle")
    (('Force', 'N'), ('pressure', 'kPa'), ('Angle', None))
    """
    bracket = re.fullmatch(r"(.*?)\s*[(\[]([^()\[\]]*)[)\]]\s*", text)
    if bracket:
        return bracket[1], bracket[2].strip()
    last = re.fullmatch(r"(.*?)(?:\s*[/,]\s*|[_ ]+)([^_ ,/]+)\s*", text)
    if last and last[1] and (last[2] in _units() or last[2].lower() in _SPELLINGS):
        return last[1], last[2]
    return text, None


def column_name(words: str) -> str:
    """Return the words of a header as the name of a column: small letters, digits and underscores.

    Examples
    --------
    >>> column_name(" Tip-Displacement, y "), column_name("P")
    ('tip_displacement_y', 'pressure')
    """
    name = re.sub(r"[^0-9a-z]+", "_", words.lower()).strip("_")
    return _SHORT.get(name, name) or "column"


def spelled_column(text: str, names: Iterable[str]) -> str:
    """Return the name of a column that a text means, spelled as in the response or as in the file.

    Parameters
    ----------
    text : str
    names : iterable of str
        Names of the response.

    Examples
    --------
    >>> spelled_column("Druck (bar)", ["pressure", "angle"]), spelled_column("force", ["pressure"])
    ('pressure', 'force')
    """
    name = column_name(split_header_unit(text)[0])
    return name if text not in (known := tuple(names)) and name in known else text


def _units() -> dict[str, tuple[str, float]]:
    """Every unit with its dimension and its factor to SI."""
    return {unit: (kind, factor) for kind in DIMENSIONS for unit, factor in UNITS[kind].items()}
