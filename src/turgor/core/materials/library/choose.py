"""Choose a rubber: one row for each material, in the order of the distance from what is wanted."""

import re
from dataclasses import dataclass

import numpy as np

from turgor.core.materials.laws.laws import Hooke, Law
from turgor.core.materials.laws.pull import pull
from turgor.core.materials.library.doubt_checks import USUAL_RANGE
from turgor.core.materials.library.doubts import find_doubts
from turgor.core.materials.library.reasons import why_taken
from turgor.core.materials.library.record import Record
from turgor.core.materials.library.record_files import library, records
from turgor.core.materials.library.records import recommended
from turgor.core.materials.library.settings import CHOICE
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Severity

#: A Shore hardness: ``"28 A"``, ``"00-30"``; what stands behind it, such as a range, does not count.
_SHORE = re.compile(r"(?:(00|OO)[-\s]?(\d+)|(\d+)\s*([AD]))\b.*", re.IGNORECASE)


@dataclass(frozen=True, slots=True, kw_only=True)
class MaterialRow:
    """One material of the library, by the record to take.

    Parameters
    ----------
    name, kind : str
    hardness : str
        Shore hardness with its scale; empty where it is not known.
    modulus : float or None [Pa]
        Initial Young's modulus of the record: three times the shear modulus of a rubber. None where there is no law.
    spread : (float, float) or None [Pa]
        Smallest and largest modulus of the records without a warning; None where there are none.
    stretch_range : (float, float) or None [-]
        Stretches of the tests behind the record, when known.
    record : str
        Its name; empty where the material has several and none is recommended.
    why : str
        Why this record.
    records : int
        Number of records.
    ultimate : float or None [-]
        Stretch at break in uniaxial tension, when known.
    """

    name: str
    kind: str
    hardness: str
    modulus: float | None
    spread: tuple[float, float] | None
    stretch_range: tuple[float, float] | None
    record: str
    why: str
    records: int
    ultimate: float | None = None


def material_rows() -> tuple[MaterialRow, ...]:
    """Return one row for each material of the library.

    Examples
    --------
    >>> [row.record for row in material_rows() if row.name == "mold-star-16"]
    ['yeoh-marechal-2020']
    """
    return tuple(_row(name, _sound(recommended(name))) for name in library())


def choose(
    modulus: float | None = None, stretch: float = 2.0, *, hardness: str = "", reach: float | None = None
) -> tuple[tuple[MaterialRow, float], ...]:
    """Return rubbers in the order of how near they are to a wanted modulus, or to a hardness where none is given.

    Parameters
    ----------
    modulus : float or None [Pa]
        Nominal stress in uniaxial tension over the strain, which the trade calls the 100 % modulus at stretch 2.
    stretch : float [-]
        Above 1.
    hardness : str
        Shore hardness such as ``"10 A"`` or ``"00-30"``: rubbers of another scale, or far off, are left out.
    reach : float or None [-]
        Largest stretch that the actuator sees, at least `stretch`: rubbers that break below are left out.

    Returns
    -------
    tuple of (MaterialRow, float)
        Each with its modulus at that stretch [Pa]. The row has the record to take up to the larger of both stretches:
        where the tests behind the recommended one end before, that of another whose tests go further. Rubbers whose
        tests all end before come last.

    Raises
    ------
    TurgorError
        If neither modulus nor hardness is given, a number is outside its range, or no rubber is left.

    Examples
    --------
    >>> [row.name for row, _ in choose(190e3)][:2]
    ['mold-star-16', 'mold-star-15']
    >>> [row.name for row, _ in choose(hardness="10 A", reach=2.5)][:2]
    ['dragon-skin-10', 'platsil-gel-10']
    """
    if modulus is None and not hardness:
        raise TurgorError(
            "what is wanted is not stated.",
            python="Give a modulus [Pa] or a hardness such as '10 A'.",
            command="Give --modulus '100 kPa', or --hardness '10 A'.",
        )
    if modulus is not None and not modulus > 0:
        raise TurgorError(f"modulus is {modulus:g} Pa; allowed is above 0.")
    for what, value in (("stretch", stretch), ("reach", reach)):
        if value is not None and not value > 1:
            raise TurgorError(f"{what} is {value:g}; allowed is above 1.")
    wanted = _shore(hardness, "hardness") if hardness else None
    end = max(stretch, reach or stretch)
    known = []
    for name in library():
        record = _record_at(name, end)
        law = None if record is None else _law(record)
        if record is None or record.kind != "rubber" or law is None or isinstance(law, Hooke):
            continue
        row = _row(name, record)
        points = _points_off(row, wanted)
        if points is None or (row.ultimate is not None and row.ultimate < end):
            continue
        value = float(pull(law, "uniaxial", np.array([stretch]))[0]) / (stretch - 1)
        off = points if modulus is None else abs(float(np.log(max(value, 1e-9) / modulus)))
        known.append((not _reaches(record, end), off, row, value))
    if not known:
        near = f" within {CHOICE.points:g} points of {hardness}" if hardness else ""
        raise TurgorError(f"no rubber of the library{near} bears a stretch of {end:g}; 'turgor materials' lists all.")
    return tuple((row, value) for _, _, row, value in sorted(known, key=lambda each: each[:2]))


def _row(name: str, chosen: Record | None) -> MaterialRow:
    known = records(name)
    moduli = [_modulus(each) for each in known if not _warned(each)]
    sure = [each for each in moduli if each is not None]
    return MaterialRow(
        name=name, kind=known[0].kind, hardness=known[0].shore_hardness,
        modulus=None if chosen is None else _modulus(chosen),
        spread=(min(sure), max(sure)) if sure else None,
        stretch_range=None if chosen is None else chosen.stretch_range,
        record="" if chosen is None else chosen.name, why="" if chosen is None else why_taken(chosen),
        records=len(known), ultimate=known[0].strength.ultimate_stretch if known[0].strength else None,
    )  # fmt: skip


def _warned(record: Record, but: str = "") -> bool:
    return any(doubt.severity is Severity.WARNING and doubt.kind != but for doubt in find_doubts(record))


def _modulus(record: Record) -> float | None:
    law = _law(record)
    if law is None:
        return None
    return law.E if isinstance(law, Hooke) else 3 * law.shear_modulus


def _law(record: Record) -> Law | Hooke | None:
    try:
        return record.build_law()
    except TurgorError:
        return None


def _record_at(name: str, stretch: float) -> Record | None:
    """Return the record to take up to a stretch."""
    best = recommended(name)
    if best is None or _reaches(best, stretch):
        return best
    further = (each for each in records(name) if each.stretch_range and _reaches(each, stretch))
    return next((each for each in further if not _warned(each, but="stated")), best)


def _reaches(record: Record, stretch: float) -> bool:
    return reaches(record.stretch_range, stretch)


def reaches(stretch_range: tuple[float, float] | None, stretch: float) -> bool:
    """Return whether the tests behind a set reach a stretch; unknown tests count as those of the usual range.

    Parameters
    ----------
    stretch_range : (float, float) or None [-]
    stretch : float [-]

    Examples
    --------
    >>> reaches((1.0, 2.5), 3.0), reaches(None, 3.0), reaches(None, 12.0)
    (False, True, False)
    """
    return (stretch_range or USUAL_RANGE["uniaxial"])[1] >= stretch


def _sound(record: Record | None) -> Record | None:
    """Return a record, or None where its constants are impossible for the material."""
    impossible = record is not None and any(doubt.kind == "no rubber" for doubt in find_doubts(record))
    return None if impossible else record


def _points_off(row: MaterialRow, wanted: tuple[str, float] | None) -> float | None:
    """Points of hardness between a rubber and the wanted one; None where it is another rubber altogether."""
    if wanted is None:
        return 0.0
    if not _SHORE.fullmatch(row.hardness):
        return None
    scale, points = _shore(row.hardness, row.name)
    off = abs(points - wanted[1])
    return off if scale == wanted[0] and off <= CHOICE.points else None


def _shore(text: str, what: str) -> tuple[str, float]:
    """Return scale and points of a Shore hardness."""
    match = _SHORE.fullmatch(text.strip().removeprefix("Shore").strip())
    if match is None:
        raise TurgorError(f"{what} is '{text}'; write a Shore hardness with its scale, such as '10 A' or '00-30'.")
    scale, points = ("00", float(match[2])) if match[1] else (match[4].upper(), float(match[3]))
    if points > 100:
        raise TurgorError(f"{what} is '{text}'; a Shore hardness is from 0 to 100.")
    return scale, points
