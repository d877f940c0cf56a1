"""Dimensions of a specimen that the header of a table states, such as ``# Length = 11mm``."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from turgor.core.materials.experiments.columns import FACTORS
from turgor.core.materials.experiments.settings import EXPERIMENTS
from turgor.core.materials.experiments.specimen import Specimen
from turgor.foundation.errors import TurgorError

#: A name, perhaps its unit in brackets, a sign or separator, a number, and perhaps its unit, also in a cell of its own.
_STATED = re.compile(
    r"([^\W\d_][\w \-]{0,40})\"?\s?(?:[(\[]([^)\]]{0,10})[)\]])?\s*[=:;,\t][=:;,\t\s\"]*"
    r"(\d{1,9}(?:[.,]\d{1,12})?(?:[eE][+-]?\d{1,2})?)\"?(?:[;,\t]\"?([cmµu]?m[²2]?)\"?"
    r"|\s?([A-Za-zµ]{1,4}[²2^]{0,2})?)(?=[\s,;\".)\]]|$)"
)

#: Words next to the name of a dimension that do not change its meaning.
_QUALIFIERS = re.compile(r"\b(specimen|sample|strip|initial|original|gauge|gage|free|of|the|l0|w0|b0|t0|d0|a0)\b")

#: Dimension by its name, and by its symbol.
_NAMES = {
    "length": "length",
    "width": "width",
    "thickness": "thickness",
    "area": "area",
    "cross section": "area",
    "cross sectional area": "area",
    "cross section area": "area",
    "section": "area",
    **dict.fromkeys(("länge", "messlänge", "einspannlänge", "anfangslänge", "probenlänge"), "length"),
    **{"breite": "width", "probenbreite": "width", "dicke": "thickness", "probendicke": "thickness"},
    **dict.fromkeys(("querschnitt", "querschnittsfläche", "probenquerschnitt"), "area"),
}
_SYMBOLS = {"l0": "length", "w0": "width", "t0": "thickness", "a0": "area"}

#: Units of an area in m².
_AREAS = {f"{unit}{two}": factor**2 for unit, factor in FACTORS["length"].items() for two in ("²", "2", "^2")}


@dataclass(frozen=True, slots=True, kw_only=True)
class Sizes:
    """Initial length and cross-section of a specimen, as far as they are known.

    Parameters
    ----------
    length : float or None [m]
        Initial length.
    section : float or None [m²]
        Initial cross-section.
    header : mapping of str to str
        Words of the header about each dimension.
    """

    length: float | None
    section: float | None
    header: Mapping[str, str] = field(default_factory=dict)


def sizes_of(file: str, notes: Sequence[str], specimen: Specimen | None) -> Sizes:
    """Return the dimensions that a user or the header of a file states; contradictions are errors.

    Parameters
    ----------
    file : str
        Name of the file, for messages.
    notes : sequence of str
        Lines of the header above the column names.
    specimen : Specimen or None
        Dimensions that the user states.

    Examples
    --------
    >>> sizes_of("a.csv", ["Strip 7", "Length = 50mm", "Cross-section (cm^2);0.18"], None)
    Sizes(length=0.05, section=1.8e-05, header={'length': 'Length = 50mm', 'area': 'Cross-section (cm^2) 0.18'})
    """
    dimensions: dict[str, tuple[float, str]] = {}
    for note in notes:
        for name, value, text in _statements(file, note, needed=specimen is None):
            known = dimensions.setdefault(name, (value, text))
            if not _same(known[0], value):
                raise TurgorError(f"'{file}': its header states both '{known[1]}' and '{text}'; correct one of them.")
    if specimen is None:
        values = {name: value for name, (value, _) in dimensions.items()}
        section = values.get("area", values["width"] * values["thickness"] if _has_both(values) else None)
    else:
        values, section = {"length": specimen.length}, specimen.section
    header = {name: text for name, (_, text) in dimensions.items()}
    sizes = Sizes(length=values.get("length"), section=section, header=header)
    _check(file, dimensions, specimen, sizes)
    return sizes


def known_specimen(sizes: Callable[[], Sizes]) -> Specimen | None:
    """Return the dimensions where length and section are known; None where they are not, which most tests permit.

    Parameters
    ----------
    sizes : callable
        ``sizes()`` gives the dimensions, or raises an error for a header that cannot be understood.
    """
    try:
        stated = sizes()
    except TurgorError:
        return None
    if stated.length is None or stated.section is None:
        return None
    return Specimen(length=stated.length, area=stated.section)


def _statements(file: str, note: str, *, needed: bool) -> list[tuple[str, float, str]]:
    """Dimensions in one line of a header: name, value in SI, and its words."""
    dimensions = []
    for match in _STATED.finditer(note):
        name = _dimension(match[1])
        if name is None:
            continue
        unit = match[4] or match[5] or match[2]
        factors = _AREAS if name == "area" else FACTORS["length"]
        text = " ".join(re.split(r'[";\t\s]+', match[0].strip(' \t;,"')))
        if unit is None or unit.strip() not in factors:
            if not needed:
                continue
            example = "mm²" if name == "area" else "mm"
            raise TurgorError(
                f"'{file}': '{text}' in its header states no unit that is known; write it as '{match[3]} {example}'."
            )
        dimensions.append((name, float(match[3].replace(",", ".")) * factors[unit.strip()], text))
    return dimensions


def _dimension(words: str) -> str | None:
    """Dimension that some words name; None for other words, such as the length of a stroke."""
    plain = re.sub(r"[_\-]+", " ", words.lower()).strip()
    return _SYMBOLS.get(plain) or _NAMES.get(" ".join(_QUALIFIERS.sub(" ", plain).split()))


def _check(file: str, dimensions: Mapping[str, tuple[float, str]], specimen: Specimen | None, sizes: Sizes) -> None:
    """Compare what the header states with the specimen, and with itself."""
    for name, (value, text) in dimensions.items():
        if not value > 0:
            raise TurgorError(f"'{file}': '{text}' in its header is no dimension; it must be more than 0.")
        given = None if specimen is None else specimen.section if name == "area" else getattr(specimen, name)
        if given is not None and not _same(value, given):
            factor, unit = (1e6, "mm²") if name == "area" else (1e3, "mm")
            raise TurgorError(
                f"'{file}': its header states '{text}', but the specimen has {given * factor:g} {unit}; "
                "correct one of them."
            )
    if _has_both(dimensions) and sizes.section is not None:
        area = dimensions["width"][0] * dimensions["thickness"][0]
        if not _same(area, sizes.section):
            raise TurgorError(
                f"'{file}': width times thickness of its header is {area * 1e6:g} mm², but the cross-section is "
                f"{sizes.section * 1e6:g} mm²; correct one of them."
            )


def _has_both(values: Mapping[str, object]) -> bool:
    """Whether both width and thickness are stated."""
    return "width" in values and "thickness" in values


def _same(one: float, other: float) -> bool:
    return abs(one - other) <= EXPERIMENTS.precision * max(abs(one), abs(other))
