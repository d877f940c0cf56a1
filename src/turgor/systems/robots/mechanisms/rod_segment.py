"""Rods as segments of a mechanism: the table ``rod`` of a segment, a slender body whose section has a shape."""

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

from turgor.core.materials.library.records import from_library
from turgor.fast_models.rod.model import Rod
from turgor.fast_models.rod.sections.chamber import RodChamber
from turgor.fast_models.rod.sections.section import RodSection
from turgor.fast_models.rod.sections.shapes import HalfRound, Rectangle, Round, Tube
from turgor.foundation.errors import TurgorError, unknown
from turgor.systems.robots.chains.chain_of_rod import RodChain, chain_of_rod
from turgor.systems.robots.mechanisms.values import checked_keys, quantity, table

#: Shapes of a section by their names.
SHAPES: Mapping[str, Any] = {"half_round": HalfRound, "rectangle": Rectangle, "round": Round, "tube": Tube}

#: Keys besides the dimensions of the shape.
KEYS = ("shape", "length", "library", "record", "reinforced", "chambers", "up_to")

#: Links of a chain where the file does not say, and its largest pressure: over the one of the file, and without one.
LINKS, ABOVE, UP_TO = 12, 1.5, "100 kPa"


def rod_chain(given: Mapping[str, Any], links: int | None, pressures: Mapping[str, float], where: str) -> RodChain:
    """Make the chain of the table of a rod.

    Parameters
    ----------
    given : mapping
        ``shape`` with its dimensions, ``length``, ``library`` and ``record`` of the rubber, ``reinforced`` (whether
        fibers keep the wall from bulging, so that the cavity acts), ``chambers`` with ``area`` and ``offset`` by name
        instead of that of the shape, and ``up_to``, the largest pressure (1.5 times that of the segment by default).
    links : int or None
    pressures : mapping of str to float [Pa]
        Of the segment.
    where : str
        Key of the table, for messages.

    Returns
    -------
    RodChain

    Raises
    ------
    TurgorError
        If a key is unknown or missing, or a value cannot be.
    """
    name = str(given.get("shape"))
    if name not in SHAPES:
        raise unknown(f"{where}.shape", name, SHAPES)
    kind = SHAPES[name]
    sizes = [field.name for field in fields(kind)]
    checked_keys(given, (*KEYS, *sizes), where)
    for key in ("length", "library", *sizes):
        if key not in given:
            raise TurgorError(
                f"{where}.{key} is missing; a rod of the shape {name} needs {', '.join(sizes)}, length, library."
            )
    shape = kind(**{key: quantity(given[key], "length", f"{where}.{key}") for key in sizes})
    reinforced = given.get("reinforced", False)
    if not isinstance(reinforced, bool):
        raise TurgorError(f"{where}.reinforced is {reinforced!r}; allowed is true or false.")
    rubber = from_library(str(given["library"]), given.get("record"))
    section = RodSection.from_geometry(shape, rubber, reinforced=reinforced)
    if "chambers" in given:
        stated = table(given["chambers"], f"{where}.chambers")
        section = replace(section, chambers=tuple(_chamber(key, each, where) for key, each in stated.items()))
    rod = Rod(section=section, length=quantity(given["length"], "length", f"{where}.length"))
    most = ABOVE * max(pressures.values(), default=0.0)
    if "up_to" in given or not most > 0:
        most = quantity(given.get("up_to", UP_TO), "pressure", f"{where}.up_to")
    return chain_of_rod(rod, LINKS if links is None else links, pressure=most)


def _chamber(name: str, given: Any, where: str) -> RodChamber:
    where = f"{where}.chambers.{name}"
    values = table(given, where)
    checked_keys(values, ("area", "offset"), where)
    if "area" not in values:
        raise TurgorError(f"{where}.area is missing; it is that of the cavity across the rod.")
    offset = values.get("offset", ["0 mm", "0 mm"])
    if not isinstance(offset, list) or len(offset) != 2:
        raise TurgorError(f"{where}.offset is {offset!r}; two lengths are needed, across in y and z.")
    y, z = (0.0 if each == 0 else quantity(each, "length", f"{where}.offset") for each in offset)
    return RodChamber(name=name, area=quantity(values["area"], "area", f"{where}.area"), offset=(y, z))
