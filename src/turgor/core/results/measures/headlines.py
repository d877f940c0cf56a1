"""Headlines: which columns of a response a reader looks for first, and which columns belong together."""

from collections.abc import Iterable

from turgor.core.results.measures.field_measures import (
    BY_REGION,
    maximum_principal_stretch,
    maximum_von_mises,
    principal_stretch_p99,
    von_mises_p99,
)
from turgor.foundation.response import Column, Response

#: What is shown first of an actuator, in this order.
HEADLINE = (
    "blocked_force", "holding_force", "bending_angle", "tip_displacement", "cavity_volume",
    principal_stretch_p99.name, maximum_principal_stretch.name, von_mises_p99.name, maximum_von_mises.name,
)  # fmt: skip

#: The maximum at a point is no headline where the response has what 99 % of the volume stay below.
_INSTEAD = {maximum_principal_stretch.name: principal_stretch_p99.name, maximum_von_mises.name: von_mises_p99.name}


def headlines(names: Iterable[str]) -> list[str]:
    """Return those of some columns that a reader looks for first.

    Parameters
    ----------
    names : iterable of str

    Returns
    -------
    list of str

    Examples
    --------
    >>> headlines(["maximum_von_mises", "von_mises_p99", "bending_angle", "reaction"])
    ['bending_angle', 'von_mises_p99']
    >>> headlines(["maximum_von_mises", "reaction"])
    ['maximum_von_mises']
    """
    known = set(names)
    return [name for name in HEADLINE if name in known and _INSTEAD.get(name) not in known]


def with_parts(response: Response, name: str) -> list[str]:
    """Return a column's name and those of its parts: the volume of each cavity, stress and stretch of each region.

    Parameters
    ----------
    response : Response
    name : str

    Returns
    -------
    list of str
    """
    others = [other for other in response.names if other != name]
    if name == "cavity_volume":
        return [name, *(other for other in others if other.startswith("cavity_") and other.endswith("_volume"))]
    if name in (each.name for each in BY_REGION):
        return [name, *(other for other in others if other.endswith(f"_{name}"))]
    return [name]


def in_regions(response: Response, name: str) -> str:
    """Say the last values of a column's regions: ``"body 147 kPa, base 224 kPa"``; empty where there are none.

    Parameters
    ----------
    response : Response
    name : str
        Column of the solid, such as ``"von_mises_p99"``.
    """
    if name not in (each.name for each in BY_REGION):
        return ""
    return ", ".join(
        f"{part.removesuffix(f'_{name}').replace('_', ' ')} {last_value(response.find(part))}"
        for part in with_parts(response, name)[1:]
    )


def last_value(column: Column) -> str:
    """Value of the last row with its unit.

    Examples
    --------
    >>> last_value(Column("pressure", "kPa", [0.0, 50e3]))
    '50 kPa'
    """
    return f"{column.in_unit[-1]:.4g} {column.unit}".strip()
