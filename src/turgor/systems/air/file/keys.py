"""Keys of a file of a network, for the reference page: they follow from the dataclasses that the reader fills."""

from collections.abc import Mapping
from dataclasses import dataclass
from inspect import getdoc
from typing import Any

from turgor.job.reference.meanings import meanings
from turgor.systems.air.file.read import PERFORMANCE_KEYS, TOP
from turgor.systems.air.file.tables import NODES, PARTS, node_keys, other_keys, part_keys, part_types
from turgor.systems.air.file.values import OF_VALVES, PASSAGES, Key
from turgor.systems.air.nodes import Chamber, Supply, junction, syringe
from turgor.units import EXAMPLES, UNITS, format_quantity


@dataclass(frozen=True, slots=True)
class AirKey:
    """A key: its name, what its value is, its default (``needed`` where there is none), and its meaning."""

    name: str
    kind: str
    default: str
    meaning: str


@dataclass(frozen=True, slots=True)
class AirTable:
    """A table of a file: its header, what it is, and its keys."""

    header: str
    words: str
    keys: tuple[AirKey, ...]


def file_tables() -> tuple[AirTable, ...]:
    """Return all tables of a file of a network with their keys.

    Returns
    -------
    tuple of AirTable

    Examples
    --------
    >>> tables = {table.header: table for table in file_tables()}
    >>> [key.name for key in tables['[parts.NAME], type = "tube"'].keys]
    ['from', 'to', 'diameter', 'length']
    """
    makers: Mapping[str, Any] = {"chamber": Chamber, "junction": junction, "supply": Supply, "syringe": syringe}
    nodes = [
        AirTable(
            f'[nodes.NAME], type = "{kind}"',
            _first(makers[kind]),
            (*_plain(other_keys(kind)), *(_row(key, kind) for key in node_keys(kind).values())),
        )
        for kind in NODES
    ]
    parts = [
        AirTable(
            f'[parts.NAME], type = "{kind}"',
            _first(PASSAGES[kind] if kind in PASSAGES else PARTS[kind]),
            tuple(_row(key, kind) for key in part_keys(kind).values()),
        )
        for kind in part_types()
    ]
    top = AirTable("at the top", "The run and what surrounds the network.", _plain(TOP))
    performance = AirTable("[performance]", "An actuator with its supply.", _plain(PERFORMANCE_KEYS))
    return (top, *nodes, *parts, performance)


def _plain(keys: Mapping[str, str]) -> tuple[AirKey, ...]:
    return tuple(AirKey(name, "", "", meaning) for name, meaning in keys.items())


def _row(key: Key, kind: str) -> AirKey:
    default = '"ambient"' if kind == "leak" and key.name == "to" else _default(key)
    if kind in PARTS and key.owner in OF_VALVES.values() and key.name in OF_VALVES:
        default = "one of both"
    meaning = meanings(key.owner).get(key.item.name, "")
    return AirKey(key.name, key.kind, default, meaning or "A node; flow from `from` to `to` is positive.")


def _default(key: Key) -> str:
    if key.needed:
        return "needed"
    value = key.item.default
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float) and key.dimension:
        unit = EXAMPLES.get(key.dimension, " ").split(" ", 1)[1]
        return f'"{format_quantity(value, unit if unit in UNITS[key.dimension] else next(iter(UNITS[key.dimension])))}"'
    return f'"{value}"' if isinstance(value, str) else f"{value:g}"


def _first(described: Any) -> str:
    words = (getdoc(described) or "").splitlines()[0].removeprefix("Return ")
    return words[:1].upper() + words[1:]
