"""Viscoelasticity, stress softening and permanent set in files: read, write and describe their tables."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import MISSING, fields
from typing import Any, Protocol

from turgor.core.materials.history.bergstrom_boyce import BergstromBoyce
from turgor.core.materials.history.permanent_set import PermanentSet
from turgor.core.materials.history.softening import Mullins
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.materials.table_keys import table
from turgor.foundation.errors import TurgorError
from turgor.units import format_quantity, parse_quantity

PRONY_KEYS = ("g", "tau", "moduli")
MULLINS_KEYS = ("r", "m", "beta")

#: Units of constants in files; the others are numbers.
_UNITS = {"rate": "1/s", "stress": "kPa", "onset": "kPa"}


class WithHistory(Protocol):
    """What has a behavior in time: a material or a record of one."""

    @property
    def viscoelasticity(self) -> Prony | BergstromBoyce | None:
        """How the stress relaxes."""

    @property
    def stress_softening(self) -> Mullins | None:
        """How the rubber softens."""

    @property
    def permanent_set(self) -> PermanentSet | None:
        """How much longer the rubber stays."""


def read_viscoelasticity(values: Any, where: str = "viscoelasticity") -> Prony | BergstromBoyce:
    """Read a Prony series, or the network of Bergström and Boyce, from a table.

    Parameters
    ----------
    values : mapping
        With ``g``, a list of numbers, ``tau``, a list of times with their units, and ``moduli``; or with the fields of
        `BergstromBoyce`.
    where : str
        Place of the table, for messages.

    Examples
    --------
    >>> read_viscoelasticity({"g": [0.2, 0.1], "tau": ["1 s", "10 s"], "moduli": "long_term"})
    Prony(g=(0.2, 0.1), tau=(1.0, 10.0), moduli='long_term')
    """
    network = tuple(item.name for item in fields(BergstromBoyce))
    if _some(values, network):
        return _constants(BergstromBoyce, values, where)
    known = PRONY_KEYS if _some(values, PRONY_KEYS) else (*PRONY_KEYS, *network)
    given = table(values, where, known, PRONY_KEYS)
    for name in ("g", "tau"):
        if not isinstance(given[name], list):
            raise TurgorError(f"{where}.{name}: {given[name]!r} is not a list; give one entry for each term.")
    g = tuple(_number(value, f"{where}.g") for value in given["g"])
    tau = tuple(_quantity(value, "time", f"{where}.tau") for value in given["tau"])
    return _placed(lambda: Prony(g=g, tau=tau, moduli=given["moduli"]), where)


def read_stress_softening(values: Any, where: str = "stress_softening") -> Mullins:
    """Read the constants of stress softening from a table.

    Parameters
    ----------
    values : mapping
        With ``r``, ``m`` with the unit of a pressure, and ``beta``, by default 0.
    where : str
        Place of the table, for messages.

    Examples
    --------
    >>> read_stress_softening({"r": 1.5, "m": "20 kPa"})
    Mullins(r=1.5, m=20000.0, beta=0.0)
    """
    given = table(values, where, MULLINS_KEYS, ("r", "m"))
    r, beta = _number(given["r"], f"{where}.r"), _number(given.get("beta", 0.0), f"{where}.beta")
    m = _quantity(given["m"], "pressure", f"{where}.m")
    return _placed(lambda: Mullins(r=r, m=m, beta=beta), where)


def read_permanent_set(values: Any, where: str = "permanent_set") -> PermanentSet:
    """Read the constants of a permanent set from a table.

    Parameters
    ----------
    values : mapping
        With ``stress`` with the unit of a pressure, ``exponent``, and ``onset``, by default 0.
    where : str
        Place of the table, for messages.

    Examples
    --------
    >>> read_permanent_set({"stress": "10 MPa", "exponent": 2})
    PermanentSet(stress=10000000.0, exponent=2.0, onset=0.0)
    """
    return _constants(PermanentSet, values, where)


def history_tables(of: WithHistory) -> dict[str, dict[str, Any]]:
    """Write viscoelasticity, softening and permanent set as tables that read back to exactly the same.

    Parameters
    ----------
    of : Material or Record
        What it does not have adds nothing.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> from turgor.core.materials.material import Material
    >>> history_tables(Material(name="rubber", law=NeoHooke(C10=1e5), stress_softening=Mullins(r=1.5, m=2e4)))
    {'stress_softening': {'r': 1.5, 'm': '20 kPa', 'beta': 0.0}}
    """
    tables: dict[str, dict[str, Any]] = {}
    series, mullins = of.viscoelasticity, of.stress_softening
    if isinstance(series, BergstromBoyce):
        tables["viscoelasticity"] = _written(series)
    elif series is not None:
        tau = [format_quantity(value, "s") for value in series.tau]
        tables["viscoelasticity"] = {"g": list(series.g), "tau": tau, "moduli": series.moduli}
    if mullins is not None:
        m = format_quantity(mullins.m, "kPa")
        tables["stress_softening"] = {"r": mullins.r, "m": m, "beta": mullins.beta}
    if of.permanent_set is not None:
        tables["permanent_set"] = _written(of.permanent_set)
    return tables


def describe_history(of: WithHistory) -> Iterator[tuple[str, str]]:
    """Yield viscoelasticity, softening and permanent set in words: a heading, and the numbers.

    Parameters
    ----------
    of : Material or Record
        What it does not have yields nothing.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> from turgor.core.materials.material import Material
    >>> series = Prony(g=(0.2,), tau=(1.5,), moduli="long_term")
    >>> list(describe_history(Material(name="rubber", law=NeoHooke(C10=1e5), viscoelasticity=series)))
    [('viscoelasticity', 'g = 0.2 at tau = 1.5 s; moduli long_term')]
    """
    series, mullins = of.viscoelasticity, of.stress_softening
    if isinstance(series, BergstromBoyce):
        yield "viscoelasticity", f"Bergström and Boyce: {_in_words(series)}"
    elif series is not None:
        terms = ", ".join(f"g = {g:.4g} at tau = {tau:.4g} s" for g, tau in zip(series.g, series.tau, strict=True))
        yield "viscoelasticity", f"{terms}; moduli {series.moduli}"
    if mullins is not None:
        yield "stress softening", f"r = {mullins.r:.4g}, m = {mullins.m / 1e3:.4g} kPa, beta = {mullins.beta:.4g}"
    if of.permanent_set is not None:
        yield "permanent set", _in_words(of.permanent_set)


def _some(values: Any, keys: tuple[str, ...]) -> bool:
    """Whether a table has any of the keys."""
    return isinstance(values, Mapping) and any(key in keys for key in values)


def _constants(kind: type, values: Any, where: str) -> Any:
    """A dataclass of constants from a table with its fields."""
    items = fields(kind)
    needed = [item.name for item in items if item.default is MISSING]
    given = table(values, where, [item.name for item in items], needed)
    numbers = {}
    for name, value in given.items():
        place = f"{where}.{name}"
        dimension = {"1/s": "rate", "kPa": "pressure"}.get(_UNITS.get(name, ""))
        numbers[name] = _number(value, place) if dimension is None else _quantity(value, dimension, place)
    return _placed(lambda: kind(**numbers), where)


def _written(constants: Any) -> dict[str, Any]:
    values = {item.name: getattr(constants, item.name) for item in fields(constants)}
    return {name: format_quantity(each, _UNITS[name]) if name in _UNITS else each for name, each in values.items()}


def _in_words(constants: Any) -> str:
    scales = {"1/s": 1.0, "kPa": 1e3}
    words = []
    for item in fields(constants):
        unit, value = _UNITS.get(item.name, ""), getattr(constants, item.name)
        words.append(f"{item.name.replace('_', ' ')} = {value / scales.get(unit, 1.0):.4g} {unit}".rstrip())
    return ", ".join(words)


def _placed(make: Callable[[], Any], where: str) -> Any:
    try:
        return make()
    except TurgorError as error:
        raise TurgorError(f"{where}: {error}") from None


def _number(value: object, place: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TurgorError(f"{place}: {value!r} is not a number without a unit.")
    return float(value)


def _quantity(value: object, dimension: str, place: str) -> float:
    return float(_placed(lambda: parse_quantity(value, dimension), place))
