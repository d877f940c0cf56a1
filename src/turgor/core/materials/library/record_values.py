"""Values in the table of a record: texts, numbers with units, density, and strength, each named where it is wrong."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf, isfinite
from typing import Any

from turgor.core.materials.laws.conventions import has_no_unit
from turgor.core.materials.strength import STRENGTHS, Strength
from turgor.core.materials.table_keys import table
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import number
from turgor.units import parse_quantity


@dataclass(frozen=True, slots=True, kw_only=True)
class Supplier:
    """Statements of the maker of a material, to compare records with.

    Parameters
    ----------
    source : str
        Where it is stated.
    stress_at_stretch_2 : float or None [Pa]
        Nominal stress in uniaxial tension at stretch 2, called 100 % modulus by the trade.
    modulus : float or None [Pa]
        Young's modulus of a stiff part.
    mixing, cure : str
        How the parts are mixed and cured, in words; empty where that is not known or does not matter.
    doubts : tuple of str
        What is questionable about these numbers.
    """

    source: str
    stress_at_stretch_2: float | None = None
    modulus: float | None = None
    mixing: str = ""
    cure: str = ""
    doubts: tuple[str, ...] = ()


def text(entry: Mapping[str, Any], key: str, where: str) -> str:
    """Return a text that must be there."""
    value = entry.get(key)
    if not isinstance(value, str) or not value.strip():
        raise TurgorError(f"{where}: '{key}' is {value!r}; a text in quotes is needed.")
    return value


def texts(entry: Mapping[str, Any], key: str, where: str) -> tuple[str, ...]:
    """Return a list of texts; empty where the key is missing."""
    values = entry.get(key, [])
    if not isinstance(values, list) or not all(isinstance(value, str) for value in values):
        raise TurgorError(f"{where}: '{key}' is {values!r}; a list of texts is needed.")
    return tuple(values)


def quantity(value: object, dimension: str, place: str) -> float:
    """Return a number with its unit in SI."""
    try:
        return parse_quantity(value, dimension)
    except TurgorError as error:
        raise TurgorError(f"{place}: {error}") from None


def constant(value: object, symbol: str, where: str) -> float:
    """Return a modulus with its unit, or a plain number for an exponent and Poisson's ratio."""
    place = f"{where}.parameters.{symbol}"
    if not has_no_unit(symbol):
        return quantity(value, "pressure", place)
    if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
        raise TurgorError(f"{place}: {value!r} is not a number without a unit.")
    return float(value)


def bulk_modulus(values: Any, where: str) -> float:
    """Return κ = 2 / D1 of Abaqus's D1 [1/Pa]; terms with D2 and D3 are zero in every record."""
    if values is None:
        return inf
    place = f"{where}.compressibility"
    given = table(values, place, ("D1", "D2", "D3", "bulk_modulus"))
    if "bulk_modulus" in given:
        return quantity(given["bulk_modulus"], "pressure", f"{place}.bulk_modulus")
    inverse = {key: _inverse_pressure(value, f"{place}.{key}") for key, value in given.items()}
    if inverse.get("D2") or inverse.get("D3"):
        raise TurgorError(f"{place}: D2 and D3 are not zero; only the term with D1 is known here.")
    if not inverse.get("D1", 0.0) > 0:
        raise TurgorError(f"{place}: D1 must be positive; leave compressibility out for an incompressible rubber.")
    return 2.0 / inverse["D1"]


def _inverse_pressure(value: object, place: str) -> float:
    amount, _, unit = str(value).partition(" ")
    if not unit.endswith("^-1"):
        raise TurgorError(f"{place}: '{value}' needs a unit, for example '2.93 MPa^-1'.")
    one = quantity(f"1 {unit.removesuffix('^-1')}", "pressure", place)
    try:
        return float(amount) / one
    except ValueError:
        raise TurgorError(f"{place}: '{value}' is not a number with a unit.") from None


def stretch_range(values: Any, where: str) -> tuple[float, float] | None:
    """Return the smallest and largest stretch of the tests."""
    if values is None:
        return None
    fits = isinstance(values, list) and len(values) == 2 and all(isinstance(value, int | float) for value in values)
    if not fits or not 0 < values[0] <= 1 <= values[1]:
        raise TurgorError(f"{where}: stretch_range is {values!r}; [smallest, largest] with 1 between them is needed.")
    return float(values[0]), float(values[1])


def density(values: Any, where: str) -> tuple[float | None, tuple[str, ...]]:
    """Return a density [kg/m³] and the doubts about it."""
    if values is None:
        return None, ()
    if isinstance(values, str):
        values = {"value": values}
    place = f"{where}.density"
    given = table(values, place, ("value", "source", "doubts"), ("value",))
    return quantity(given["value"], "density", place), texts(given, "doubts", place)


def expansion(values: Any, where: str) -> tuple[float | None, str]:
    """Return a linear thermal expansion [1/K] and its source."""
    if values is None:
        return None, ""
    place = f"{where}: expansion"
    given = table(values, place, ("value", "source"), ("value", "source"))
    return quantity(given["value"], "expansion", place), text(given, "source", place)


def strength(values: Any, where: str) -> Strength | None:
    """Return what a material bears: each number in a table of its own with the source, or all with one source."""
    if values is None:
        return None
    given = table(values, where, (*STRENGTHS, "source", "doubts"))
    common = {"source": given["source"]} if "source" in given else {}
    entries = {
        name: table(
            given[name] if isinstance(given[name], Mapping) else {"value": given[name], **common},
            f"{where}.{name}",
            ("value", "source", "doubts"),
            ("value", "source"),
        )
        for name in STRENGTHS
        if name in given
    }
    numbers = {
        name: number(entry["value"], f"{where}.{name}.value", STRENGTHS[name]) for name, entry in entries.items()
    }
    doubts = tuple(each for name, entry in entries.items() for each in texts(entry, "doubts", f"{where}.{name}"))
    try:
        return Strength(
            **numbers,
            sources={name: text(entry, "source", f"{where}.{name}") for name, entry in entries.items()},
            doubts=(*texts(given, "doubts", where), *doubts),
        )
    except TurgorError as error:
        raise TurgorError(f"{where}: {error}") from None
