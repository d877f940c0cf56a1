"""Describe a library material in words: printed and canonical constants, sources, and doubts."""

from collections.abc import Iterator, Sequence
from math import inf

from turgor.core.materials.library.choose import MaterialRow, choose, material_rows
from turgor.core.materials.library.doubts import find_doubts
from turgor.core.materials.library.reasons import against_maker, why_taken
from turgor.core.materials.library.record import Record
from turgor.core.materials.library.record_files import all_records, library, records
from turgor.core.materials.library.record_history import describe_history
from turgor.core.materials.library.records import find_record, recommended
from turgor.core.materials.library.spread import spread_of
from turgor.core.materials.strength import STRENGTHS, Strength
from turgor.foundation.errors import TurgorError
from turgor.units import format_quantity

#: Units of strengths, by their dimensions.
_UNITS = {"pressure": "MPa", "force per length": "kN/m"}

#: Columns of the overview of rubbers, and of that of stiff parts.
_RUBBERS = ("material", "Shore", "E", "100 % modulus", "of the maker", "spread", "tested to", "breaks at",
            "tensile strength", "tear strength", "density", "record to take")  # fmt: skip
_STIFF = ("material", "kind", "E", "breaks at a strain of", "tensile strength", "density", "record to take")


def describe_material(name: str, record: str | None = None) -> str:
    """Describe the records of a material in plain text.

    Parameters
    ----------
    name : str
        One of `turgor.core.materials.library.record_files.library`, or the path of a file of your own.
    record : str, optional
        Name of one record; by default all are described.

    Returns
    -------
    str
        Several lines.

    Examples
    --------
    >>> print(describe_material("fiber-yarn"))
    Fiber yarn
    <BLANKLINE>
    hooke-wang-2016
      law: hooke
      printed: E = 103 GPa, nu = 0.34
      canonical: E = 103 GPa, nu = 0.34
      recommended: The only set: as published.
      source: B. Wang, K. C. Aw, M. Biglari-Abhari, A. McDaid, in Proc. IEEE/ASME Int. Conf. on Advanced \
Intelligent Mechatronics, IEEE, Piscataway, NJ 2016, pp. 83–88
      quoted in: Table 3 of Xavier, Fleming and Yong 2021, references 144
      doubts: none known
    """
    chosen = records(name) if record is None else (find_record(name, record),)
    lines = list(_heading(chosen[0]))
    for entry in chosen:
        lines += ["", entry.name, *(f"  {line}" for line in _lines(entry))]
    return "\n".join(lines)


def library_tables() -> dict[str, str]:
    """Return the tables of the library in Markdown: ``rubbers``, ``reinforcements``, ``records`` and ``doubts``.

    Examples
    --------
    >>> list(library_tables())
    ['rubbers', 'reinforcements', 'records', 'doubts']
    """
    return {
        "rubbers": rubber_table(),
        "reinforcements": reinforcement_table(),
        "records": library_table(),
        "doubts": doubts_list(),
    }


def library_table() -> str:
    """Return a Markdown table of every record of the library, for the documentation.

    Examples
    --------
    >>> library_table().splitlines()[0]
    '| material | record | law | as printed | as computed with | software | references | doubts |'
    """
    columns = ("material", "record", "law", "as printed", "as computed with", "software", "references", "doubts")
    rows = [columns, ("---",) * len(columns)]
    for name in library():
        for record in records(name):
            doubts = ", ".join(f"{doubt.code} {doubt.kind}" for doubt in find_doubts(record))
            cited = ", ".join(str(number) for number in record.references)
            rows.append(
                (
                    name,
                    record.name,
                    record.law,
                    record.printed,
                    _canonical(record),
                    record.software or "",
                    cited,
                    doubts,
                )
            )
    return "\n".join(f"| {' | '.join(row)} |".replace("|  |", "| |") for row in rows) + "\n"


def doubts_list() -> str:
    """Return a Markdown list of every doubt in the library in full, for the documentation.

    Examples
    --------
    >>> doubts_list().splitlines()[0][:61]
    '- **agilus30**, neo-hooke-relaxed: M04 stated: Fast pulls mee'
    """
    places: dict[str, list[str]] = {}
    for record in all_records():
        for doubt in find_doubts(record):
            places.setdefault(str(doubt), []).append(f"**{record.library}**, {record.name}")
    return "".join(f"- {'; '.join(where)}: {doubt}\n" for doubt, where in places.items())


def _heading(record: Record) -> Iterator[str]:
    yield record.material_name + (f", Shore hardness {record.shore_hardness}" if record.shore_hardness else "")
    supplier = record.supplier
    if supplier is not None:
        if supplier.stress_at_stretch_2 is not None:
            stress = f"{supplier.stress_at_stretch_2 / 1e3:.3g} kPa"
            yield f"supplier: nominal stress at stretch 2 is {stress} ({supplier.source})"
        if supplier.modulus is not None:
            yield f"supplier: Young's modulus is {supplier.modulus / 1e9:.3g} GPa ({supplier.source})"
        cited = supplier.stress_at_stretch_2 is not None or supplier.modulus is not None
        recipe = [f"{what}: {text}" for what, text in (("mixing", supplier.mixing), ("cure", supplier.cure)) if text]
        yield from (line if cited else f"{line} ({supplier.source})" for line in recipe)
        yield from supplier.doubts
    if record.strength is not None:
        yield from _strength_lines(record.strength)
    if record.expansion is not None:
        yield f"thermal expansion: {record.expansion * 1e6:.4g} ppm/K ({record.expansion_source})"
    if record.kind == "rubber":
        try:
            yield f"spread: {str(spread_of(record.library)).partition(': ')[2]}"
        except TurgorError:
            yield "spread: no set of a rubber without a serious doubt"


def _strength_lines(strength: Strength) -> Iterator[str]:
    for name, dimension in STRENGTHS.items():
        value = getattr(strength, name)
        if value is None:
            continue
        shown = f"{value:.3g}" if not dimension else format_quantity(float(f"{value:.3g}"), _UNITS[dimension])
        yield f"{name.replace('_', ' ')}: {shown} ({strength.sources[name]})"
    yield from strength.doubts


def _lines(record: Record) -> Iterator[str]:
    yield f"law: {record.law}" + (f" in the convention {record.convention}" if record.law == "ogden" else "")
    yield f"printed: {record.printed}"
    yield f"canonical: {_canonical(record)}"
    if record.bulk_modulus != inf:
        yield f"bulk modulus: {record.bulk_modulus / 1e6:.4g} MPa"
    if record.stretch_range is not None:
        yield f"fitted from stretch {record.stretch_range[0]:g} to {record.stretch_range[1]:g}"
    best = recommended(record.library)
    if best is not None and best.name == record.name and why_taken(record):
        yield f"recommended: {why_taken(record)}"
    if check := against_maker(record):
        yield f"check: {check}"
    if record.fitted is not None:
        yield f"fitted by turgor ({record.fitted.law}) to {', '.join(record.fitted.names)}, which the library holds"
    for what, text in describe_history(record):
        yield f"{what}: {text}"
    if record.density is not None:
        yield f"density: {record.density:g} kg/m³"
    if record.diameter is not None:
        yield f"diameter: {record.diameter * 1e3:.4g} mm"
    if record.form:
        yield f"as a strain-limiting layer: {record.form}"
    if record.bending_stiffness is not None:
        yield f"bending stiffness: {record.bending_stiffness * 1e6:.4g} µN m"
    if record.software:
        yield f"software: {record.software}"
    yield f"source: {record.source}"
    for text in record.cited_by:
        yield f"also in: {text}"
    if record.quoted_in:
        numbers = f", references {', '.join(map(str, record.references))}" if record.references else ""
        yield f"quoted in: {record.quoted_in} of Xavier, Fleming and Yong 2021{numbers}"
    yield from _doubt_lines(find_doubts(record))


def _doubt_lines(doubts: Sequence[object]) -> Iterator[str]:
    if not doubts:
        yield "doubts: none known"
    for doubt in doubts:
        yield f"doubt {doubt}"


def _canonical(record: Record) -> str:
    try:
        return record.canonical
    except TurgorError:
        return "no law"


def rubber_table() -> str:
    """Return a Markdown table of all rubbers, softest first, for the documentation.

    Examples
    --------
    >>> rubber_table().splitlines()[0][:24]
    '| material | Shore | E |'
    """
    rows = _sorted("rubber")
    at_2 = {
        row.name: (row.record, value)
        for row, value in choose(1e6, 2.0)
        if row.stretch_range is None or row.stretch_range[1] >= 2.0
    }
    return _markdown(_RUBBERS, [_rubber(row, *at_2.get(row.name, ("", None))) for row in rows])


def reinforcement_table() -> str:
    """Return a Markdown table of all fibers, sheets and composites, for the documentation.

    Examples
    --------
    >>> "| paper | sheet | 6.5 GPa |" in reinforcement_table()
    True
    """
    rows = [row for kind in ("fiber", "sheet", "composite") for row in _sorted(kind)]
    return _markdown(_STIFF, [_stiff(row) for row in rows])


def _sorted(kind: str) -> list[MaterialRow]:
    return sorted((row for row in material_rows() if row.kind == kind), key=lambda row: row.modulus or inf)


def _rubber(row: MaterialRow, record: str, at_2: float | None) -> tuple[str, ...]:
    first = records(row.name)[0]
    strength, maker = first.strength, first.supplier.stress_at_stretch_2 if first.supplier else None
    try:
        spread = f"{spread_of(row.name).deviation:.0%}" + (" (typical)" if spread_of(row.name).others else "")
    except TurgorError:
        spread = ""
    return (
        row.name, row.hardness, _stress(row.modulus), _stress(at_2), _stress(maker), spread,
        "" if row.stretch_range is None else f"{row.stretch_range[1]:g}",
        "" if row.ultimate is None else f"{row.ultimate:.3g}",
        _stress(strength.tensile_strength if strength else None),
        f"{strength.tear_strength / 1e3:.3g} kN/m" if strength and strength.tear_strength else "",
        "" if first.density is None else f"{first.density:g} kg/m³",
        row.record if record in ("", row.record) else f"{row.record}; {record} at stretch 2",
    )  # fmt: skip


def _stiff(row: MaterialRow) -> tuple[str, ...]:
    first = records(row.name)[0]
    return (
        row.name, row.kind, _stress(row.modulus),
        "" if row.ultimate is None else f"{row.ultimate - 1:.2g}",
        _stress(first.strength.tensile_strength if first.strength else None),
        "" if first.density is None else f"{first.density:g} kg/m³", row.record,
    )  # fmt: skip


def _stress(value: float | None) -> str:
    if value is None:
        return ""
    factor, unit = next((each for each in ((1e9, "GPa"), (1e6, "MPa")) if value >= each[0]), (1e3, "kPa"))
    return f"{value / factor:.3g} {unit}"


def _markdown(head: tuple[str, ...], rows: list[tuple[str, ...]]) -> str:
    lines = (head, ("---",) * len(head), *rows)
    return "\n".join(f"| {' | '.join(line)} |".replace("|  |", "| |") for line in lines) + "\n"
