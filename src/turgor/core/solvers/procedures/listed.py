"""Listed: the procedures by their names in job files, and the columns of what they prescribe."""

from collections.abc import Mapping
from typing import Any

from turgor.core.solvers.procedures.procedure import Procedure
from turgor.foundation.registry import Registry, class_of_file


def _solvable(kind: type) -> bool:
    """Whether a class is a procedure that is solved by itself, not a base of such or a sequence."""
    return issubclass(kind, Procedure) and kind.follow is not Procedure.follow and "__dataclass_fields__" in vars(kind)


#: The classes in this folder; the fields of a procedure are its keys in a job file.
PROCEDURES: Registry[type[Any]] = Registry("turgor.core.solvers.procedures", class_of_file(_solvable))


def prescribed_columns() -> Mapping[str, str]:
    """Return the columns of what procedures prescribe in cavities, with their units.

    Examples
    --------
    >>> prescribed_columns()["injected_volume"]
    'mL'
    """
    return {kind.drive: kind.drive_unit for kind in PROCEDURES.values() if kind.drive}
