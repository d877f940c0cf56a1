"""Choose a rubber: one row for each material, in the order of the distance from a wanted stress."""

from dataclasses import dataclass

import numpy as np

from turgor.core.materials.laws.homogeneous import nominal_stress, uniaxial
from turgor.core.materials.laws.laws import Hooke
from turgor.core.materials.library.doubts import find_doubts
from turgor.core.materials.library.record import Record
from turgor.core.materials.library.record_files import library, records
from turgor.core.materials.library.records import recommended
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Severity


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


def material_rows() -> tuple[MaterialRow, ...]:
    """Return one row for each material of the library.

    Examples
    --------
    >>> [row.record for row in material_rows() if row.name == "mold-star-16"]
    ['yeoh-marechal-2020']
    """
    return tuple(map(_row, library()))


def _row(name: str) -> MaterialRow:
    known, chosen = records(name), recommended(name)
    moduli = [_modulus(each) for each in known if not _warned(each)]
    sure = [each for each in moduli if each is not None]
    return MaterialRow(
        name=name, kind=known[0].kind, hardness=known[0].shore_hardness,
        modulus=None if chosen is None else _modulus(chosen),
        spread=(min(sure), max(sure)) if sure else None,
        stretch_range=None if chosen is None else chosen.stretch_range,
        record="" if chosen is None else chosen.name, why="" if chosen is None else chosen.recommended,
        records=len(known),
    )  # fmt: skip


def _warned(record: Record) -> bool:
    return any(doubt.severity is Severity.WARNING for doubt in find_doubts(record))


def _modulus(record: Record) -> float | None:
    try:
        law = record.build_law()
    except TurgorError:
        return None
    return law.E if isinstance(law, Hooke) else 3 * law.shear_modulus


def choose(modulus: float, stretch: float = 2.0) -> tuple[tuple[MaterialRow, float], ...]:
    """Return rubbers in the order of how near their stress over strain at a stretch is to a wanted modulus.

    Parameters
    ----------
    modulus : float [Pa]
        Nominal stress in uniaxial tension over the strain, which the trade calls the 100 % modulus at stretch 2.
    stretch : float [-]
        Above 1.

    Returns
    -------
    tuple of (MaterialRow, float)
        Each with its modulus at that stretch [Pa].

    Raises
    ------
    TurgorError
        If the modulus is not positive, or the stretch not above 1.

    Examples
    --------
    >>> [row.name for row, _ in choose(190e3)][:2]
    ['mold-star-16', 'body-double-silk']
    """
    if not modulus > 0:
        raise TurgorError(f"modulus is {modulus:g} Pa; allowed is above 0.")
    if not stretch > 1:
        raise TurgorError(f"stretch is {stretch:g}; allowed is above 1.")
    known = []
    for row in material_rows():
        record = recommended(row.name)
        if row.kind != "rubber" or record is None or row.modulus is None:
            continue
        law = record.build_law()
        if not isinstance(law, Hooke):
            known.append((row, float(nominal_stress(law, uniaxial(np.array([stretch])))[0, 0, 0]) / (stretch - 1)))
    return tuple(sorted(known, key=lambda each: abs(np.log(max(each[1], 1e-9) / modulus))))
