"""Viscoelasticity and stress softening in files: read, write and describe their tables."""

from collections.abc import Callable, Iterator
from typing import Any

from turgor.core.materials.history.softening import Mullins
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.materials.library.table_keys import table
from turgor.foundation.errors import TurgorError
from turgor.units import format_quantity, parse_quantity

PRONY_KEYS = ("g", "tau", "moduli")
MULLINS_KEYS = ("r", "m", "beta")


def read_viscoelasticity(values: Any, where: str = "viscoelasticity") -> Prony:
    """Read a Prony series from a table.

    Parameters
    ----------
    values : mapping
        With ``g``, a list of numbers, ``tau``, a list of times with their units, and ``moduli``.
    where : str
        Place of the table, for messages.

    Examples
    --------
    >>> read_viscoelasticity({"g": [0.2, 0.1], "tau": ["1 s", "10 s"], "moduli": "long_term"})
    Prony(g=(0.2, 0.1), tau=(1.0, 10.0), moduli='long_term')
    """
    given = table(values, where, PRONY_KEYS, PRONY_KEYS)
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


def history_tables(series: Prony | None, mullins: Mullins | None) -> dict[str, dict[str, Any]]:
    """Write viscoelasticity and softening as tables that read back to exactly the same.

    Parameters
    ----------
    series : Prony or None
        None adds nothing.
    mullins : Mullins or None
        None adds nothing.

    Examples
    --------
    >>> history_tables(None, Mullins(r=1.5, m=2e4))
    {'stress_softening': {'r': 1.5, 'm': '20 kPa', 'beta': 0.0}}
    """
    tables: dict[str, dict[str, Any]] = {}
    if series is not None:
        tau = [format_quantity(value, "s") for value in series.tau]
        tables["viscoelasticity"] = {"g": list(series.g), "tau": tau, "moduli": series.moduli}
    if mullins is not None:
        m = format_quantity(mullins.m, "kPa")
        tables["stress_softening"] = {"r": mullins.r, "m": m, "beta": mullins.beta}
    return tables


def describe_history(series: Prony | None, mullins: Mullins | None) -> Iterator[tuple[str, str]]:
    """Yield viscoelasticity and softening in words: a heading, and the numbers.

    Parameters
    ----------
    series : Prony or None
        None yields nothing.
    mullins : Mullins or None
        None yields nothing.

    Examples
    --------
    >>> list(describe_history(Prony(g=(0.2,), tau=(1.5,), moduli="long_term"), None))
    [('viscoelasticity', 'g = 0.2 at tau = 1.5 s; moduli long_term')]
    """
    if series is not None:
        terms = ", ".join(f"g = {g:.4g} at tau = {tau:.4g} s" for g, tau in zip(series.g, series.tau, strict=True))
        yield "viscoelasticity", f"{terms}; moduli {series.moduli}"
    if mullins is not None:
        yield "stress softening", f"r = {mullins.r:.4g}, m = {mullins.m / 1e3:.4g} kPa, beta = {mullins.beta:.4g}"


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
