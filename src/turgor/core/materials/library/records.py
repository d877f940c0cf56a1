"""Library records: published constants as printed, read into materials in one canonical form.

Each file ``library/<name>.toml`` holds one rubber or sheet and every published set of constants for it, a *record*.
A record keeps the numbers as they were printed, with the convention that says what the printed symbols mean; the
conversion to the coefficients of `turgor.core.materials.laws.laws` happens on load, and what is doubtful comes along.
"""

from turgor.core.materials.laws.conventions import CONVENTIONS, describe, law_from_printed
from turgor.core.materials.library.doubts import find_doubts
from turgor.core.materials.library.record import REVIEW, Record
from turgor.core.materials.library.record_files import all_records, library, read_records, records
from turgor.core.materials.material import Material
from turgor.foundation.errors import TurgorError, near_match
from turgor.foundation.source import Source

__all__ = [
    "CONVENTIONS",
    "REVIEW",
    "Record",
    "all_records",
    "describe",
    "find_record",
    "from_library",
    "law_from_printed",
    "library",
    "material_of",
    "read_records",
    "recommended",
    "records",
]


def from_library(name: str, record: str | None = None) -> Material:
    """Return a material of the library; where several records exist, one must be chosen by name.

    Parameters
    ----------
    name : str
        Name of the material, one of `library()`, or the path of a file of your own that ends in ``.toml``.
    record : str, optional
        Name of the record. May be left out only where there is a single one.

    Returns
    -------
    Material
        Law in canonical coefficients [Pa], bulk modulus and density where known, and the source with its doubts.

    Raises
    ------
    TurgorError
        If the name or the record is unknown, several records exist and none was chosen, or no law can have the
        printed constants; then the message quotes the doubt.

    Examples
    --------
    >>> from_library("elastosil-m4601", record="yeoh-mosadegh-2014").law
    Yeoh(C10=110000.0, C20=20000.0, C30=0.0)
    """
    return material_of(find_record(name, record))


def find_record(name: str, record: str | None = None) -> Record:
    """Return a record as printed; see `from_library` for the names.

    Examples
    --------
    >>> find_record("elastosil-m4601", record="neo-hooke-connolly-2015").printed
    'mu = 240 kPa'
    """
    known = {entry.name: entry for entry in records(name)}
    if record is None:
        if len(known) > 1:
            listed = "; ".join(f"{entry.name} ({entry.law}: {entry.printed})" for entry in known.values())
            advised = recommended(name)
            best = f" Recommended is {advised.name}: {advised.recommended}" if advised and advised.recommended else ""
            raise TurgorError(f"'{name}' has {len(known)} records; choose one with record: {listed}.{best}")
        record = next(iter(known))
    if record not in known:
        hint = near_match(record, known) or "."
        raise TurgorError(f"unknown record '{record}' of '{name}'{hint} Known: {', '.join(known)}.")
    return known[record]


def recommended(name: str) -> Record | None:
    """Return the record of a material to take where nothing else is known; None where there are several and no advice.

    Parameters
    ----------
    name : str
        One of `library()`, or the path of a file of your own.

    Examples
    --------
    >>> recommended("ecoflex-00-30").name
    'yeoh-kulkarni-2015'
    """
    known = records(name)
    return next((each for each in known if each.recommended), known[0] if len(known) == 1 else None)


def material_of(record: Record) -> Material:
    """Turn a record into a material with its law in canonical form, its source and its doubts.

    Parameters
    ----------
    record : Record
        As from `find_record`.

    Raises
    ------
    TurgorError
        If no law can have these constants; the message quotes the doubt.

    Examples
    --------
    >>> round(material_of(find_record("dragon-skin-10", "ogden-nuthi-2018")).bulk_modulus / 1e3)
    894
    """
    doubts = find_doubts(record)
    try:
        law = record.build_law()
    except TurgorError as error:
        reasons = " ".join(str(doubt) for doubt in doubts if doubt.code == "M06")
        what = reasons or str(error)
        raise TurgorError(f"record '{record.name}' of '{record.library}' has no law: {what}") from error
    canonical = describe(law)
    stated = record.printed if record.printed == canonical else f"printed as {record.printed}, here {canonical}"
    quoted = f"; quoted in {REVIEW}, {record.quoted_in}" if record.quoted_in else ""
    return Material(
        name=record.material_name,
        law=law,
        bulk_modulus=record.bulk_modulus,
        density=record.density,
        expansion=record.expansion,
        stretch_range=record.stretch_range,
        viscoelasticity=record.viscoelasticity,
        stress_softening=record.stress_softening,
        permanent_set=record.permanent_set,
        bending_stiffness=record.bending_stiffness,
        strength=record.strength,
        source=Source(text=record.source, detail=f"{stated}{quoted}", doubts=tuple(str(doubt) for doubt in doubts)),
    )
