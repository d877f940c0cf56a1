"""Bonds of a job file: one table ``[bonds.NAME]`` for each glued face between two regions."""

from collections.abc import Mapping
from functools import partial
from typing import Annotated, Any

from pydantic import BeforeValidator, Field

from turgor.core.geometry.geometry import Geometry
from turgor.core.model.bonds import BENZEGGAGH_KENANE, Bond
from turgor.foundation.errors import unknown
from turgor.job.text.box_table import BoxTable, box_table
from turgor.job.text.lines import Key
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Pressure, Says, Table, read_table, shown
from turgor.units import format_quantity, parse_quantity

Energy = Annotated[
    float,
    BeforeValidator(partial(parse_quantity, dimension="fracture energy")),
    Says("energy per area", '"200 J/m²"', "fracture energy"),
]
Stiffness = Annotated[
    float,
    BeforeValidator(partial(parse_quantity, dimension="contact stiffness")),
    Says("stress per length", '"50 MPa/mm"', "contact stiffness"),
]

#: Keys with a unit, and that of a lock file.
_UNITS = {
    "peel_strength": "kPa", "shear_strength": "kPa", "energy_peel": "J/m²", "energy_shear": "J/m²",
    "stiffness": "MPa/mm",
}  # fmt: skip


class BondTable(Table):
    """``[bonds.NAME]``: a glued face between two regions, which peels off.

    Keys
    ----
    between : list of str
        Two regions that are bonded.
    shear_strength, energy_shear
        Those of peeling by default.
    unbonded : table
        Box in which nothing is bonded at rest: a flaw.
    source : str
        Where the numbers come from.
    """

    between: list[str]
    peel_strength: Pressure
    energy_peel: Energy
    shear_strength: Pressure | None = Field(default=None, examples=['"50 kPa"'])
    energy_shear: Energy | None = Field(default=None, examples=['"400 J/m²"'])
    stiffness: Stiffness | None = Field(default=None, examples=['"50 MPa/mm"'])
    mixed_mode: str = BENZEGGAGH_KENANE
    exponent: float = 1.0
    unbonded: BoxTable | None = Field(default=None, examples=['{ x_from = "80 mm", x_to = "90 mm" }'])
    source: str = Field(default="", examples=['"our peel test of May"'])


def read_bonds(values: Any, geometry: Geometry | None, problems: Problems) -> dict[str, Bond]:
    """Read ``[bonds]``: a table for each bond."""
    key = ("bonds",)
    if not isinstance(values, Mapping):
        problems.add(key, f"{shown(values)} is not a table; write [bonds.glue] and the keys of a bond below it.")
        return {}
    flat = [name for name in values if name in BondTable.model_fields]
    if flat:
        problems.add((*key, flat[0]), "a bond needs a name of its own; write [bonds.glue] and the keys below it.")
        return {}
    bonds = {name: _read_bond(name, entry, (*key, name), geometry, problems) for name, entry in values.items()}
    return {name: bond for name, bond in bonds.items() if bond is not None}


def _read_bond(name: str, values: Any, key: Key, geometry: Geometry | None, problems: Problems) -> Bond | None:
    table: BondTable | None = read_table(BondTable, values, key, problems)
    if table is None:
        return None
    known = table.between if geometry is None else geometry.regions
    for region in table.between:
        if region not in known:
            problems.add((*key, "between"), str(unknown("region", region, known)))
    stated = {each: getattr(table, each) for each in (*_UNITS, "mixed_mode", "exponent", "source")}
    box = table.unbonded
    corners = None if box is None else box.corners
    between: Any = tuple(table.between)  # the bond refuses all but two
    make = partial(Bond, name=name, between=between, unbonded=corners, **stated)
    return problems.attempt(key, make, fields=BondTable.model_fields)


def bonds_tables(bonds: Mapping[str, Bond]) -> dict[str, Any]:
    """Write bonds as tables of a job file; `read_bonds` gives the same bonds back.

    Parameters
    ----------
    bonds : mapping of str to Bond

    Returns
    -------
    dict
    """
    return {name: _table(bond) for name, bond in bonds.items()}


def _table(bond: Bond) -> dict[str, Any]:
    values: dict[str, Any] = {"between": list(bond.between)}
    for name, unit in _UNITS.items():
        value = getattr(bond, name)
        if value is not None:
            values[name] = format_quantity(value, unit)
    values |= {"mixed_mode": bond.mixed_mode, "exponent": bond.exponent, "source": bond.source}
    if bond.unbonded is not None:
        values["unbonded"] = box_table(bond.unbonded)
    return values
