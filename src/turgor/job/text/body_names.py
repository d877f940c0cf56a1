"""Names of bodies in job files: keys that stand for a face or a region of one body, of its copies, or of all."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.exchange.mesh_file import MeshedShape
from turgor.foundation.errors import TurgorError, near_match, unknown
from turgor.job.text.problems import Problems

#: Keys of forces, which act on a face, not on the cavities of a body.
FORCES = ("force", "traction", "hangs")

#: A name in the mesh, its value, and the key that stated it.
Part = tuple[str, Any, tuple[str, ...]]


def by_body(section: str, values: Any, geometry: Geometry | None, problems: Problems) -> tuple[Any, Problems]:
    """Return a section with names of faces and regions of the mesh in the place of those of bodies.

    ``[loads.finger_1]`` with a pressure means the cavities of the body ``finger_1``, ``[loads.finger]`` those of all
    copies of ``finger``; ``materials.finger.base`` is a region of these; ``supports.fixed`` is that face of all bodies
    that have it. Where several keys stand for the same, the one that names fewest comes first.

    Parameters
    ----------
    section : str
        ``"loads"``, ``"materials"`` or ``"supports"``.
    values : object
        The section; anything but a table stays as it is.
    geometry : Geometry or None
        Only that of several bodies changes anything.
    problems : Problems

    Returns
    -------
    values : object
    problems : Problems
        The same, which know the lines of the new keys.
    """
    shape = None if geometry is None else geometry.shape
    if geometry is None or not isinstance(values, Mapping) or not isinstance(shape, MeshedShape) or not shape.bodies:
        return values, problems
    values = _without_unknown_parts(section, values, geometry, problems)
    names = {*geometry.regions, *geometry.faces}
    out: dict[str, Any] = {}
    lines = dict(problems.lines)
    for parts in _ranked(section, values, shape, names, frozenset(geometry.regions)):
        for full, value, stated in parts:
            out[full] = value
            new, old = ((*problems.within, section, *key) for key in ((full,), stated))
            lines |= {(*new, *key[len(old) :]): line for key, line in problems.lines.items() if key[: len(old)] == old}
    return out, replace(problems, lines=lines)


def unknown_part(kind: str, name: str, known: Iterable[str], geometry: Geometry | None) -> TurgorError:
    """Build the error for a name that is neither that of a part, such as a face, nor that of a body.

    Parameters
    ----------
    kind : str
        Of the part: ``"face"`` for example.
    name : str
    known : iterable of str
        Names of parts.
    geometry : Geometry or None
        Bodies are listed where it has several.
    """
    bodies = _members(geometry)
    before = "" if not bodies else "body, " if " or " in kind else "body or "
    return unknown(f"{before}{kind}", name, (*known, *bodies))


def _members(geometry: Geometry | None) -> dict[str, tuple[str, ...]]:
    """Bodies by the name that stands for them: that of their table, or their own."""
    shape = None if geometry is None else geometry.shape
    if not isinstance(shape, MeshedShape):
        return {}
    return {**shape.groups, **{name: (name,) for name in shape.bodies}}


def _without_unknown_parts(
    section: str, values: Mapping[str, Any], geometry: Geometry, problems: Problems
) -> dict[str, Any]:
    """The section without keys of bodies that stand for nothing; reports them."""
    out = dict(values)
    members, shape = _members(geometry), geometry.shape
    for name, table in values.items():
        if name not in members:
            continue
        own = shape.bodies[members[name][0]]
        if isinstance(table, Mapping):
            wrong = {key: why for key in table if (why := _why_unknown(section, name, key, table, own, geometry))}
            out[name] = {key: value for key, value in table.items() if key not in wrong}
            for key, why in wrong.items():
                problems.add((section, name, key), why)
        elif section != "supports" or "fixed" not in own:
            kind, known = _parts(section, own, geometry)
            problems.add((section, name), f"this is a body; name a {kind} of it, such as {section}.{name}.{known[0]}.")
            out[name] = {}
    return {name: value for name, value in out.items() if value != {}}


def _why_unknown(
    section: str, name: str, key: str, table: Mapping[str, Any], own: Mapping[str, str], geometry: Geometry
) -> str:
    """Why a key in the table of a body stands for nothing; empty where it stands for something."""
    if key in own:
        return ""
    kind, known = _parts(section, own, geometry)
    listed = f"Its {kind}s are {', '.join(known)}."
    if section == "supports" or (isinstance(table[key], Mapping) and not {"law", "library"} & set(table)):
        return f"the body '{name}' has no {kind} '{key}'{near_match(key, known) or '.'} {listed}"
    if section == "loads" and key in FORCES:
        return f"a force acts on a face; write [loads.{name}.{known[0]}]. {listed}"
    if section == "loads" and not any(part.startswith("cavity") for part in own):
        return f"the body '{name}' has no cavity; write [loads.{name}.{known[0]}]. {listed}"
    return ""


def _parts(section: str, own: Mapping[str, str], geometry: Geometry) -> tuple[str, list[str]]:
    """What keys of a section stand for, and the names of those of a body."""
    kind, names = ("region", geometry.regions) if section == "materials" else ("face", geometry.faces)
    return kind, [part for part, full in own.items() if full in names]


def _ranked(
    section: str, values: Mapping[str, Any], shape: MeshedShape, names: set[str], regions: frozenset[str]
) -> Iterator[list[Part]]:
    """What the keys stand for: those of all bodies first, then of copies, of one body, and of one face or region."""
    ranks: list[list[Part]] = [[], [], [], []]
    for name, value in values.items():
        owners = [own[name] for own in shape.bodies.values() if name in own]
        if name in names:
            ranks[3].append((name, value, (name,)))
        elif name in shape.groups or name in shape.bodies:
            members = (name,) if name in shape.bodies else shape.groups[name]
            ranks[2 if name in shape.bodies else 1] += [
                part for each in members for part in _of_body(section, name, shape.bodies[each], value, regions)
            ]
        elif owners and (section != "loads" or isinstance(value, Mapping)):
            ranks[0] += [(full, value, (name,)) for full in owners]
        else:
            ranks[3].append((name, value, (name,)))
    yield from ranks


def _of_body(section: str, name: str, own: Mapping[str, str], value: Any, regions: frozenset[str]) -> Iterator[Part]:
    """What the table of one body stands for: its own names, and what is left for all cavities or regions of it."""
    if not isinstance(value, Mapping):
        yield own.get("fixed", name) if section == "supports" else name, value, (name,)
        return
    rest = {key: each for key, each in value.items() if key not in own}
    for key, full in own.items():
        takes = key.startswith("cavity") if section == "loads" else full in regions and section == "materials"
        if rest and takes:
            yield full, rest, (name,)
    for key, each in value.items():
        if key in own:
            yield own[key], each, (name, key)
