"""Reading of a file of a network."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeVar

from turgor.foundation.errors import TurgorError, near_file, unknown
from turgor.foundation.toml_text import read_text, read_toml
from turgor.job.text.lines import key_lines
from turgor.job.text.overrides import changed, changed_places
from turgor.job.text.problems import Problems
from turgor.systems.air.driven import ACTUATOR, VALVE
from turgor.systems.air.file.tables import NodeReader, check_keys, read_part
from turgor.systems.air.file.values import Wrong, quantity, table
from turgor.systems.air.fluids import FLUIDS, REFERENCE_TEMPERATURE, STANDARD_ATMOSPHERE, Fluid, Liquid
from turgor.systems.air.network import Network
from turgor.systems.air.settings import SOLVER

Value = TypeVar("Value")

#: Keys of the file with their meaning.
TOP: Mapping[str, str] = {
    "name": "Name of the run; that of the file by default.",
    "fluid": f"One of {', '.join(FLUIDS)}; `air` by default.",
    "air": "Share of a liquid's volume that is air at 101.325 kPa; 0 by default.",
    "duration": "End of the run.",
    "samples": f"States that are stored besides the first; {SOLVER.samples} by default.",
    "ambient": "Absolute pressure around, from which gauge pressures count; 101.325 kPa by default.",
    "temperature": "Around and at the start, such as `20 °C` or `293.15 K`; 20 °C by default.",
    "nodes": "A table for each node.",
    "parts": "A table for each part.",
    "performance": "What `turgor air` finds besides the run: times, bandwidth, the part that limits.",
}

#: Keys of ``[performance]`` with their meaning.
PERFORMANCE_KEYS: Mapping[str, str] = {
    "pressure": "Wanted gauge pressure in the chamber.",
    "chamber": f"Its node; `{ACTUATOR}` by default.",
    "valve": f"The 3/3 valve that fills and vents it; `{VALVE}` by default.",
}

_NAME = re.compile(r"[A-Za-z]\w*")


@dataclass(frozen=True, slots=True, kw_only=True)
class AirFile:
    """What a file of a network says.

    Parameters
    ----------
    name : str
    network : Network
    duration : float [s]
    samples : int
    performance : mapping, optional
        Arguments of `performance`: ``pressure``, ``chamber``, ``valve``.
    """

    name: str
    network: Network
    duration: float
    samples: int = SOLVER.samples
    performance: Mapping[str, Any] | None = None


def read_air(path: str | Path, changes: Mapping[str, Any] = MappingProxyType({})) -> AirFile:
    """Read a file of a network: TOML, in which every quantity carries its unit.

    Parameters
    ----------
    path : str or Path
    changes : mapping of str to value
        Values that replace or join those of the file, by dotted key: ``{"nodes.supply.pressure": "200 kPa"}``.

    Returns
    -------
    AirFile

    Raises
    ------
    JobError
        If anything in the file is wrong: a line for each problem with file, line, key, value and what is allowed.
    """
    path = Path(path)
    if not path.exists():
        there = sorted(each.name for each in path.parent.glob("*.toml")) if path.parent.is_dir() else []
        raise TurgorError(f"there is no file '{path}'{near_file(path, there)}")
    text = read_text(path)
    content = changed(read_toml(text, str(path)), {}, changes)
    problems = Problems(str(path), changed_places(key_lines(text), changes))
    parsed = _read(content, path, problems)
    problems.raise_any()
    assert parsed is not None
    return parsed


def _read(content: Mapping[str, Any], path: Path, problems: Problems) -> AirFile | None:
    _attempt((), lambda: check_keys(content, TOP), problems)
    nodes = _each("nodes", content, NodeReader(path.parent).read, problems)
    parts = _each("parts", content, read_part, problems)
    fluid = _attempt(("fluid",), lambda: _fluid(content), problems)
    duration = _attempt(("duration",), lambda: _quantity(content, "duration", "time"), problems)
    ambient = _attempt(("ambient",), lambda: _quantity(content, "ambient", "pressure", STANDARD_ATMOSPHERE), problems)
    temperature = _attempt(
        ("temperature",), lambda: _quantity(content, "temperature", "temperature", REFERENCE_TEMPERATURE), problems
    )
    performance = _attempt(("performance",), lambda: _performance(content, nodes, parts), problems)
    samples = content.get("samples", SOLVER.samples)
    if type(samples) is not int or not 1 <= samples <= 100_000:
        problems.add(("samples",), f"{samples!r} is not a whole number from 1 to 100000.")
    if problems.entries or fluid is None or duration is None or ambient is None or temperature is None:
        return None
    try:
        network = Network(nodes=nodes, parts=parts, fluid=fluid, ambient=ambient, temperature=temperature)
    except TurgorError as error:
        problems.add(_place_in(str(error), content), str(error))
        return None
    name = str(content.get("name", path.stem))
    return AirFile(name=name, network=network, duration=duration, samples=samples, performance=performance)


def _attempt(key: tuple[str, ...], make: Callable[[], Value], problems: Problems) -> Value | None:
    """Make a value, or note what is wrong at its key."""
    try:
        return make()
    except Wrong as error:
        problems.add((*key, error.key), str(error))
    except TurgorError as error:
        match = re.match(r"(\w+)(?: of [\w ]+)? is ", str(error))
        problems.add((*key, match[1]) if match and len(key) == 2 else key, str(error))
    return None


def _each(
    section: str, content: Mapping[str, Any], read: Callable[[Mapping[str, Any]], Value], problems: Problems
) -> dict[str, Value]:
    """Read each table of a section."""
    values: dict[str, Value] = {}
    tables = content.get(section)
    if not isinstance(tables, Mapping) or not tables:
        problems.add((section,), f"the file has no table [{section}.NAME]; one at least is needed.")
        return values
    for name, given in tables.items():
        if not _NAME.fullmatch(name):
            problems.add((section, name), f"'{name}' is no name; use letters, digits and '_', a letter first.")
        value = _attempt((section, name), lambda given=given: read(table(given)), problems)  # type: ignore[misc]
        if value is not None:
            values[name] = value
    return values


def _quantity(content: Mapping[str, Any], key: str, dimension: str, default: float | None = None) -> float:
    if key not in content and default is not None:
        return default
    if key not in content:
        raise TurgorError(f"it is missing; a {dimension} is needed, such as '2 s'.")
    value = quantity(content[key], dimension)
    if not value > 0:
        raise TurgorError(f"{content[key]!r} is not allowed; more than 0 is needed.")
    return value


def _fluid(content: Mapping[str, Any]) -> Fluid:
    name = content.get("fluid", "air")
    if not isinstance(name, str) or name not in FLUIDS:
        raise unknown("fluid", str(name), FLUIDS)
    fluid, air = FLUIDS[name], content.get("air", 0.0)
    if not isinstance(fluid, Liquid):
        if "air" in content:
            raise TurgorError(f"'{name}' is a gas; 'air' is a share of a liquid.")
        return fluid
    return replace(fluid, air=quantity(air, ""))


def _performance(
    content: Mapping[str, Any], nodes: Mapping[str, Any], parts: Mapping[str, Any]
) -> Mapping[str, Any] | None:
    if "performance" not in content:
        return None
    given = table(content["performance"])
    check_keys(given, PERFORMANCE_KEYS)
    if "pressure" not in given:
        raise Wrong("pressure", "it is missing; a wanted pressure is needed, such as '50 kPa'.")
    try:
        values: dict[str, Any] = {"pressure": quantity(given["pressure"], "pressure")}
    except TurgorError as error:
        raise Wrong("pressure", str(error)) from None
    for key, default, known in (("chamber", ACTUATOR, nodes), ("valve", VALVE, parts)):
        values[key] = given.get(key, default)
        if values[key] not in known:
            raise Wrong(key, str(unknown(key, str(values[key]), known)))
    return values


def _place_in(sentence: str, content: Mapping[str, Any]) -> tuple[str, ...]:
    """Key of the node or part that a sentence names first."""
    for name in re.findall(r"'(\w+)'", sentence):
        for section in ("parts", "nodes"):
            if name in content[section]:
                return (section, name)
    return ("nodes",)
