"""Contact in a job: ``[contact]`` and ``[obstacles]``, both ways."""

from functools import partial
from typing import Annotated, Any

from pydantic import BeforeValidator

from turgor.core.geometry.geometry import Geometry
from turgor.core.model.contact import Contact
from turgor.core.model.obstacles import SelfContact
from turgor.core.model.rigid import RigidFile
from turgor.foundation.errors import TurgorError
from turgor.job.tables.obstacles import ContactStiffness, read_obstacles
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Length, Says, Table, read_table, shown
from turgor.units import format_quantity

#: Text for the default of self-contact.
_AUTOMATIC = "automatic"


def _switch(value: object) -> bool | None:
    if value == _AUTOMATIC:
        return None
    if not isinstance(value, bool):
        raise TurgorError(f"{shown(value)} is not allowed; write true, false or '{_AUTOMATIC}'.")
    return value


class ContactTable(Table):
    """``[contact]``: what may touch what. Obstacles stand in tables of their own.

    Keys
    ----
    self_contact : bool
        Whether walls of the actuator have contact with each other; ``"automatic"``: where walls face each other
        across a gap, between bodies and films, and in cavities that are pressed together.
    friction : float [-]
        Coulomb's coefficient of self-contact; 0 by default.
    stiffness : float [Pa/m]
        Pressure per depth of penetration of self-contact; chosen from the material by default.
    elastic_slip : float [m]
        How far points that stick slip elastically in self-contact; half a percent of the side of a cell by default.
    """

    self_contact: Annotated[Any, BeforeValidator(_switch), Says(f'true, false or "{_AUTOMATIC}"', "true")] = None
    friction: float | None = None
    tolerance: float = Contact().tolerance
    stiffness: ContactStiffness | None = None
    elastic_slip: Length | None = None


def read_contact(
    values: Any, obstacles: Any, geometry: Geometry | None, problems: Problems
) -> tuple[Contact, dict[str, RigidFile]]:
    """Read ``[contact]``, and ``[obstacles]`` into it.

    Parameters
    ----------
    values, obstacles : mapping
        The two tables.
    geometry : Geometry or None
        The actuator, whose faces are known; None where it could not be built.
    problems : Problems
        Takes what is wrong.

    Returns
    -------
    contact : Contact
        The default after a mistake.
    files : dict of str to RigidFile
        The files of the obstacles that come from one.
    """
    key = ("contact",)
    table: ContactTable | None = read_table(ContactTable, values, key, problems)
    own = None if table is None else _self_contact(table, problems)
    shapes, files = read_obstacles(obstacles, geometry, problems)
    if table is None:
        return Contact(), {}
    contact = problems.attempt(key, partial(Contact, own, shapes, table.tolerance), fields=("tolerance",))
    return contact or Contact(), files


def _self_contact(table: ContactTable, problems: Problems) -> SelfContact | bool | None:
    """Value of self-contact; a friction or a stiffness for it switches it on."""
    stated = [name for name in ("friction", "stiffness", "elastic_slip") if getattr(table, name) is not None]
    if not stated:
        switch: bool | None = table.self_contact
        return switch
    if table.self_contact is False:
        problems.add(("contact", stated[0]), "that of self-contact, which self_contact = false switches off.")
        return False
    make = partial(
        SelfContact,
        friction=table.friction or 0.0,
        stiffness=table.stiffness,
        elastic_slip=table.elastic_slip,
    )
    return problems.attempt(("contact",), make, fields=stated)


def contact_table(contact: Contact) -> dict[str, Any]:
    """Write the settings of contact, without the obstacles, in the form that `read_contact` reads.

    Parameters
    ----------
    contact : Contact

    Returns
    -------
    dict
    """
    own = contact.self_contact
    values: dict[str, Any] = {"self_contact": _AUTOMATIC if contact.automatic else own is not None}
    values["tolerance"] = contact.tolerance
    if own is not None and not contact.automatic:
        values["friction"] = own.friction
        if own.stiffness is not None:
            values["stiffness"] = format_quantity(own.stiffness, "MPa/mm")
        if own.elastic_slip is not None:
            values["elastic_slip"] = format_quantity(own.elastic_slip, "mm")
    return values
