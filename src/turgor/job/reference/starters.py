"""Starters: a commented job for each actuator family, ready to run, with every key of its tables."""

import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from textwrap import wrap
from typing import Any

from turgor.core.geometry.geometry import Geometry
from turgor.foundation.errors import unknown
from turgor.job.job import ACTUATORS
from turgor.job.read import DEFAULTS, SECTIONS
from turgor.job.reference.kinds import Kind
from turgor.job.reference.sections import section_tables
from turgor.job.reference.tables import JobKey, JobTable, family_table, toml
from turgor.job.tables.mesh_files import MESH_FILE

#: Example jobs in an installed package, and in the source tree, where the package is built from them.
_INSTALLED, _IN_SOURCE = Path(__file__).parent / "examples", Path(__file__).parents[4] / "examples"

#: Tables whose name the user chooses: how the reference calls them.
_NAMED = ("materials", "fibers", "bonds", "obstacles", "points")

_HEAD = """\
# Every key of these tables stands below, with its range and its default. A "#" before a key leaves its default.
# `turgor check` looks at the job, `turgor run` solves it. Tables that this job does not need are left out:
# {absent}.
"""


def example_job(name: str) -> Path:
    """Return the example job of an actuator family; one of your own need not have it.

    Parameters
    ----------
    name : str
        One of `ACTUATORS`.

    Raises
    ------
    TurgorError
        For an unknown name, with the near match.

    Examples
    --------
    >>> example_job("fast_pneunet").name
    'fast_pneunet.toml'
    """
    if name not in ACTUATORS:
        raise unknown("actuator family", name, ACTUATORS)
    folder = _INSTALLED if _INSTALLED.is_dir() else _IN_SOURCE
    own = folder / "actuators" / f"{name}.toml"
    return own if own.exists() else folder / f"{name}.toml"


def starter(name: str) -> str:
    """Write a commented job for an actuator family: the example job, and all other keys with their defaults.

    Parameters
    ----------
    name : str
        One of `ACTUATORS`.

    Returns
    -------
    str
        TOML.

    Examples
    --------
    >>> print(starter("fast_pneunet").split("[actuator]")[1].splitlines()[1])
    type = "fast_pneunet"
    """
    example, shape = example_job(name), ACTUATORS[name]().build()
    text = example.read_text(encoding="utf-8") if example.exists() else _plain_job(name, shape)
    return commented(text, shape, family_table(name))


def commented(text: str, shape: Geometry, actuator: JobTable) -> str:
    """Write a job again with all other keys of its tables, as comments with their defaults.

    Parameters
    ----------
    text : str
        The job; the comments at its top stay.
    shape : Geometry
        The actuator, to which ranges refer.
    actuator : JobTable
        The keys of its table ``[actuator]``.

    Returns
    -------
    str
        TOML.
    """
    content = {**{key: dict(values) for key, values in DEFAULTS.items()}, **tomllib.loads(text)}
    content["mesh"].pop("size", None)  # the default of the quality suits every dimension, a size only the example's
    always = ("contact", "output", "engine", *(() if content["actuator"]["type"] == MESH_FILE else ("mesh",)))
    content = {key: content[key] for key in SECTIONS if content.get(key) or key in always}
    absent = [f"[{key}]" for key in SECTIONS if key not in (*content, "name", "written_by")]
    intro = "".join(re.findall(r"\A(?:#.*\n)+", text))
    tables = {table.header: table for table in section_tables(shape)}
    tables["[actuator]"] = actuator
    lines = [line for section in content.items() for line in _section(*section, tables)]
    return f"{intro}#\n{_HEAD.format(absent=', '.join(absent))}" + "\n".join(lines) + "\n"


def _plain_job(name: str, shape: Geometry) -> str:
    """Write a job for a family without an example: one rubber, and a small pressure."""
    return f'[actuator]\ntype = "{name}"\n\n{first_materials(shape)}\n[loads]\npressure = "1 kPa"\n'


def first_materials(shape: Geometry) -> str:
    """Write the materials of a job to begin with: one rubber for all regions."""
    rubber = '{ library = "ecoflex-00-30", record = "yeoh-steck-2019" }'
    return "[materials]\n" + "".join(f"{region} = {rubber}\n" for region in shape.regions)


def _section(name: str, values: Mapping[str, Any], tables: Mapping[str, JobTable]) -> Iterator[str]:
    """Write a section; the keys of a second table of a kind have no comments."""
    if name == "supports":
        keys = [_named(tables["[supports]"].keys[0], face) for face in values]
        yield from _table("[supports]", keys, values)
    elif name in _NAMED:
        explained: set[str] = set()
        for each, inner in values.items():
            keys = list(_keys(name, inner, tables))
            yield from _table(f"[{name}.{each}]", keys, inner, explained)
            explained |= {key.name for key in keys}
    elif name == "loads":
        inner = {key: value for key, value in values.items() if isinstance(value, Mapping) and key != "gravity"}
        if len(inner) < len(values) or not inner:
            yield from _table("[loads]", tables["[loads]"].keys, {k: v for k, v in values.items() if k not in inner})
        for face, each in inner.items():
            known = tables["[loads.CAVITY]" if "pressure" in each else "[loads.FACE]"].keys
            yield from _table(f"[loads.{face}]", known, each)
    else:
        yield from _table(f"[{name}]", list(_keys(name, values, tables)), values)


def _keys(name: str, values: Mapping[str, Any], tables: Mapping[str, JobTable]) -> Iterator[JobKey]:
    """Keys of a table, after the one that chooses the kind."""
    if name == "materials" and "law" in values:
        stated, law = "[materials.NAME], stated by its law", f'[materials.NAME], law = "{values["law"]}"'
        yield from tables[stated].keys
        yield from tables[law].keys
    elif name == "materials":
        yield from tables["[materials.NAME], from the library"].keys
    elif name == "obstacles":
        yield from tables["[obstacles.NAME]"].keys
        yield from tables[f'[obstacles.NAME], shape = "{values["shape"]}"'].keys
    elif name == "procedure":
        yield JobKey(name="type", kind="text", meaning="How the path is followed.", example="", needed=True)
        yield from tables[f'[procedure], type = "{values["type"]}"'].keys
    elif name == "actuator":
        yield JobKey(name="type", kind="text", meaning=tables["[actuator]"].words, example="", needed=True)
        yield from tables["[actuator]"].keys
    else:
        yield from tables[f"[{name}.NAME]" if name in _NAMED else f"[{name}]"].keys


def _named(key: JobKey, name: str) -> JobKey:
    return JobKey(name=name, kind=key.kind, allowed=key.allowed, meaning=key.meaning, example=key.example)


def _table(
    header: str, keys: Iterable[JobKey], values: Mapping[str, Any], explained: Iterable[str] = ()
) -> Iterator[str]:
    yield ""
    yield header
    for key in keys:
        if key.name not in explained and key.name != "type":
            yield from wrap(_comment(key), 110, initial_indent="# ", subsequent_indent="#   ")
        if key.name in values:
            yield f"{key.name} = {toml(values[key.name], Kind(words=''))}"
        else:
            yield f"#{key.name} = {key.default or key.example}"


def _comment(key: JobKey) -> str:
    """Say what a key is, its range and its default."""
    default = f"default {key.default}" if key.default else "needed" if key.needed else "none by default"
    facts = [key.kind, f"allowed: {key.allowed}", default] if key.allowed else [key.kind, default]
    return f"{key.name}: {key.meaning.replace('`', '')} [{'; '.join(facts)}]"
