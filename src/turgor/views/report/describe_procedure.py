"""Describe: procedures in rows for a report, and what each stage of a sequence changes."""

from collections.abc import Mapping
from typing import Any

from turgor.core.model.history import RAMP, with_history
from turgor.core.model.history_text import history_text
from turgor.core.model.loads import Load
from turgor.core.model.obstacles.rigid_shape import in_mm
from turgor.core.model.supports import Displacement
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.procedures.step_options import fields_in_order
from turgor.core.solvers.solution import Status
from turgor.units import kPa, mL, mm
from turgor.views.report.describe import Rows


def procedure(of: Procedure) -> Rows:
    """Describe how the path was followed: the fields of a procedure, or what each stage of a sequence changed."""
    if not of.stages:
        return fields_of(of)
    rows = []
    for stage in of.stages:
        changes = [_with_settings(stage.procedure), *(_changed(load) for load in stage.loads)]
        changes += [_moved(each) for each in stage.displacements]
        changes += [f"{name} moves to {in_mm(place)} from where it was at first" for name, place in stage.moves.items()]
        rows.append((stage.name, "; ".join(changes)))
    return rows


def ending(status: Status) -> str:
    """Describe how a solve ended. "Converged" could be read as converged in the mesh, which a single solve cannot show.

    Examples
    --------
    >>> ending(Status.CONVERGED), ending(Status.LIMIT_POINT)
    ('solved to the end', 'limit point')
    """
    return "solved to the end" if status is Status.CONVERGED else str(status).replace("_", " ")


def _with_settings(of: Procedure) -> str:
    """Name of a procedure with its settings other than the defaults."""
    usual = {each.name: each.default for each in fields_in_order(type(of))}
    stated = {name.replace(" ", "_"): text for name, text in fields_of(of)}
    changed = [f"{name.replace('_', ' ')} {text}" for name, text in stated.items() if getattr(of, name) != usual[name]]
    return f"{type(of).__name__} ({', '.join(changed)})" if changed else type(of).__name__


def _changed(load: Load) -> str:
    """The load at the end of a stage, and its history unless it is even."""
    way = "" if load.history == RAMP else f", its share of the way over the load factor: {history_text(load.history)}"
    return f"{with_history(load, RAMP).text().rstrip('.')}{way}"


def _moved(each: Displacement) -> str:
    """Where a face is moved."""
    if each.way is not None:
        return f"{each.face} moves to {in_mm(each.shift)} from where it was at first"
    return f"{each.face} is moved in {', '.join(each.directions)}"


def fields_of(value: Any) -> Rows:
    """Fields of a dataclass as rows, empty ones left out."""
    rows = []
    for each in fields_in_order(type(value)):
        content = getattr(value, each.name)
        if each.init and content not in ((), None, ""):
            rows.append((each.name.replace("_", " "), _content(content, each.metadata.get("dimension", ""))))
    return rows


def _content(value: Any, dimension: str) -> str:
    """A field in words, in the unit of its dimension where it states one."""
    if isinstance(value, Mapping):
        return ", ".join(f"{name} {_content(each, dimension)}" for name, each in value.items())
    if isinstance(value, tuple):
        return ", ".join(map(str, value))
    scale, unit = {"volume": (mL, " mL"), "pressure": (kPa, " kPa"), "length": (mm, " mm"), "time": (1.0, " s")}.get(
        dimension, (1.0, "")
    )
    return f"{value / scale:g}{unit}" if isinstance(value, float) else str(value)
