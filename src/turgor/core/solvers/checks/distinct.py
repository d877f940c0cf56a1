"""Distinct materials of a model: a finding about equal ones is reported once."""

from collections.abc import Iterable
from dataclasses import replace

from turgor.core.materials.material import Material
from turgor.core.model.model import Model


def regions_and_sheets(model: Model) -> tuple[Material, ...]:
    """Return the materials of all regions, then those of membranes and shells."""
    return (*model.region_materials.values(), *(sheet.material for sheet in model.membranes.values()))


def distinct(materials: Iterable[Material]) -> tuple[Material, ...]:
    """Return every material once; those that differ by their names alone are one with all of the names.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> body, base = (Material(name=name, law=NeoHooke(C10=0.1e6)) for name in ("body", "base"))
    >>> [each.name for each in distinct([body, base, body])]
    ['body and base']
    """
    groups: list[tuple[Material, list[str]]] = []
    for each in materials:
        nameless = replace(each, name="")
        names = next((names for other, names in groups if other == nameless), None)
        if names is None:
            groups.append((nameless, [each.name]))
        elif each.name not in names:
            names.append(each.name)
    return tuple(replace(material, name=" and ".join(names)) for material, names in groups)
