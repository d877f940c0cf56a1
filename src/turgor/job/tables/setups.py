"""Setups in a job: ``[procedure]`` with ``type = "blocked_force"`` or ``"grasp"``, both ways.

Such a table states the change of the model and the steps of the procedure, which is `Static`.
"""

from collections.abc import Mapping
from dataclasses import fields
from types import MappingProxyType
from typing import Any

from turgor.core.model.loads import Load
from turgor.core.setups.setup_values import BlockedForce, Grasp, Setup
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.procedures.static import Static
from turgor.job.tables.loads import only_pressure, requested_factors
from turgor.job.tables.procedures import field_keys, procedure_fields, requested, stated_fields, states_requested
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Table, fields_of_table, read_table, table_of

#: Setups by their names in job files; the keys of a setup are its fields and those of `Static`.
SETUPS: Mapping[str, type[Setup]] = MappingProxyType({"blocked_force": BlockedForce, "grasp": Grasp})

#: Defaults of steps other than those of `Static`: with friction the result depends on the path, so steps are short.
_STEPS: Mapping[type, Mapping[str, Any]] = {Grasp: {"max_step": 0.1}}

#: Reason why a setup cannot be a stage, with the alternative.
_INSTEAD: Mapping[str, str] = {
    "blocked_force": "it puts a plate before the tip at rest; add the plate as an obstacle, let a stage move it to the "
    "tip, and read its force, such as plate_force",
    "grasp": "it is a sequence itself; close the fingers in one stage with a pressure, and pull the object in the next "
    "one with moves, with a plane as obstacle where the fingers meet",
}


def setup_type(values: Any) -> str | None:
    """Return the class of the setup that ``[procedure]`` names, None if it names none."""
    name = values.get("type") if isinstance(values, Mapping) else None
    return name if isinstance(name, str) and name in SETUPS else None


def refuse_setup(values: Any, stage: str, problems: Problems) -> bool:
    """Note a mistake if ``[procedure]`` of a stage names a setup; return whether it does."""
    name = setup_type(values)
    if name is not None:
        problems.add(("procedure",), f"stage '{stage}': {name} cannot be a stage, because {_INSTEAD[name]}.")
    return name is not None


def read_setup(name: str, values: Any, loads: tuple[Load, ...], problems: Problems) -> tuple[Setup, Static] | None:
    """Read ``[procedure]`` that names a setup: the setup and the procedure."""
    key = ("procedure",)
    kind: Any = SETUPS[name]
    table = read_table(setup_table(kind), values, key, problems)
    if table is None:
        return None
    given = fields_of_table(table)
    why = "in a grasp the pressure rises until closing and is constant then" if kind is Grasp else ""
    if not states_requested(given["at"], why, problems):
        return None
    given["at"] = tuple(requested_factors(given["at"], loads, problems))
    stated = {item.name: given.pop(item.name) for item in fields(kind)}
    setup = problems.attempt(key, lambda: kind(**stated), fields=stated)
    procedure = problems.attempt(key, lambda: Static(**given), fields=given)
    return None if setup is None or procedure is None else (setup, procedure)


def setup_table(kind: type) -> type[Table]:
    """Make the table of a setup: a key for each of its fields and each of `Static`."""
    steps = field_keys(procedure_fields(Static))
    steps |= {name: (steps[name][0], default) for name, default in _STEPS.get(kind, {}).items()}
    return table_of(f"{kind.__name__}Table", field_keys(fields(kind)) | steps)


def written_setup(setup: Setup, procedure: Procedure, loads: tuple[Load, ...]) -> dict[str, Any]:
    """Write a setup and its procedure as the table of a job file; `read_setup` returns both."""
    name = next(name for name, kind in SETUPS.items() if type(setup) is kind)
    top = None if isinstance(setup, Grasp) else only_pressure(loads)
    stated = stated_fields(setup, fields(setup)) | stated_fields(procedure, procedure_fields(Static))
    return {"type": name} | stated | {"at": requested(procedure.at, top)}
