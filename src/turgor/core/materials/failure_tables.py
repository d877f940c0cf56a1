"""Strength and crack growth in files: read, write and describe their tables."""

from collections.abc import Iterator, Mapping
from dataclasses import fields, replace
from typing import Any

from turgor.core.materials.crack_growth import CRACK_GROWTH, CrackGrowth
from turgor.core.materials.library.record_values import strength
from turgor.core.materials.material import Material
from turgor.core.materials.strength import STRENGTHS, Strength
from turgor.core.materials.table_keys import table
from turgor.foundation.errors import TurgorError, unknown
from turgor.units import format_quantity

_GROWTH = tuple(item.name for item in fields(CrackGrowth))

#: Units in which files state a number, by its dimension.
_UNITS = {"pressure": "MPa", "force per length": "N/m"}


def read_strength(values: Any, where: str = "strength") -> Strength:
    """Read what a material bears from a table: numbers with one source, or each in a table with its own.

    Parameters
    ----------
    values : mapping
        With ``elongation_at_break``, ``tensile_strength``, ``tear_strength`` and ``source``.
    where : str
        Place of the table, for messages.

    Examples
    --------
    >>> read_strength({"elongation_at_break": 8.35, "source": "data sheet"}).ultimate_stretch
    9.35
    """
    given = strength(table(values, where), where)
    assert given is not None
    return given


def read_crack_growth(values: Any, where: str = "crack_growth") -> CrackGrowth:
    """Read how cracks grow: the name of a typical rubber, or a table of numbers, perhaps ``like`` a typical one.

    Parameters
    ----------
    values : str or mapping
    where : str
        Place of the table, for messages.

    Examples
    --------
    >>> read_crack_growth({"like": "natural rubber", "flaw": "0.2 mm"}).flaw
    0.0002
    """
    values = {"like": values} if isinstance(values, str) else values
    given = dict(table(values, where, ("like", *_GROWTH)))
    like = given.pop("like", None)
    if like is not None and like not in CRACK_GROWTH:
        raise unknown(f"rubber in {where}", str(like), CRACK_GROWTH)
    try:
        return CrackGrowth(**given) if like is None else replace(CRACK_GROWTH[like], **given)
    except TypeError:
        missing = [name for name in ("rate", "exponent", "flaw") if name not in given]
        raise TurgorError(
            f"{where}: {' and '.join(missing)} missing; state rate, exponent and flaw, or a typical rubber: "
            f'like = "{next(iter(CRACK_GROWTH))}".'
        ) from None
    except TurgorError as error:
        raise TurgorError(f"{where}: {error}") from None


def failure_tables(material: Material) -> dict[str, dict[str, Any]]:
    """Write strength and crack growth of a material as tables that read back to exactly the same.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> failure_tables(Material(name="rubber", law=NeoHooke(C10=1e5), crack_growth=CRACK_GROWTH["natural rubber"]))[
    ...     "crack_growth"]["threshold"]
    '50 N/m'
    """
    tables: dict[str, dict[str, Any]] = {}
    if material.strength is not None:
        bears = material.strength
        numbers = {name: getattr(bears, name) for name in STRENGTHS if getattr(bears, name) is not None}
        tables["strength"] = {
            name: {"value": _text(value, STRENGTHS[name]), "source": bears.sources[name]}
            for name, value in numbers.items()
        }
        if bears.doubts:
            tables["strength"]["doubts"] = list(bears.doubts)
    if material.crack_growth is not None:
        growth = material.crack_growth
        lengths = {name: format_quantity(getattr(growth, name), "mm") for name in ("rate", "flaw")}
        plain: Mapping[str, Any] = {name: getattr(growth, name) for name in ("exponent", "spread", "source")}
        tables["crack_growth"] = {**lengths, "threshold": format_quantity(growth.threshold, "N/m"), **plain}
    return tables


def describe_failure(material: Material) -> Iterator[tuple[str, str]]:
    """Yield strength and crack growth in words: a heading, and the numbers.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> stated = read_strength({"elongation_at_break": 8.35, "source": "data sheet"})
    >>> list(describe_failure(Material(name="rubber", law=NeoHooke(C10=1e5), strength=stated)))
    [('elongation at break', '835 % (data sheet)')]
    """
    if material.strength is not None:
        for name, dimension in STRENGTHS.items():
            value = getattr(material.strength, name)
            if value is not None:
                text = _text(value, dimension) if dimension else f"{100 * value:.4g} %"
                yield name.replace("_", " "), f"{text} ({material.strength.sources[name]})"
    growth = material.crack_growth
    if growth is not None:
        yield (
            "crack growth",
            f"{growth.rate:.3g} m in a cycle at 1 kJ/m², exponent {growth.exponent:g}, threshold "
            f"{growth.threshold:g} J/m², first flaws {growth.flaw / 1e-3:g} mm, rates known to a factor of "
            f"{growth.spread:g} ({growth.source or 'no source stated'})",
        )


def _text(value: float, dimension: str) -> Any:
    return format_quantity(value, _UNITS[dimension]) if dimension else value
