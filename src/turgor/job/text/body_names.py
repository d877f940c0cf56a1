"""Names of bodies in job files: keys that stand for a face or a region of one body, of its copies, or of all."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.exchange.mesh_file import MeshedShape
from turgor.job.text.problems import Problems

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
    names = {*geometry.regions, *geometry.faces}
    out: dict[str, Any] = {}
    lines = dict(problems.lines)
    for parts in _ranked(section, values, shape, names, frozenset(geometry.regions)):
        for full, value, stated in parts:
            out[full] = value
            new, old = ((*problems.within, section, *key) for key in ((full,), stated))
            lines |= {(*new, *key[len(old) :]): line for key, line in problems.lines.items() if key[: len(old)] == old}
    return out, replace(problems, lines=lines)


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
