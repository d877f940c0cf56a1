"""Overview of the library in Markdown: one row for each material, by the record to take."""

from turgor.core.materials.library.choose import MaterialRow, choose, material_rows
from turgor.core.materials.library.record_files import records
from turgor.core.materials.library.spread import spread_of
from turgor.foundation.errors import TurgorError

_RUBBERS = ("material", "Shore", "E", "100 % modulus", "of the maker", "spread", "tested to", "breaks at",
            "tensile strength", "tear strength", "density", "record to take")  # fmt: skip
_STIFF = ("material", "kind", "E", "breaks at a strain of", "tensile strength", "density", "record to take")


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
    return sorted((row for row in material_rows() if row.kind == kind), key=lambda row: row.modulus or 0.0)


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
