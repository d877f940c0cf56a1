"""Loads of a job file: one pressure for all cavities, a pressure with its history for each, gravity, forces."""

from collections.abc import Iterable, Mapping
from functools import partial
from typing import Any

from turgor.core.geometry.directions import DIRECTIONS
from turgor.core.geometry.geometry import Geometry
from turgor.core.materials.material import Material
from turgor.core.model.drive import common_pressure
from turgor.core.model.fibers import Fibers
from turgor.core.model.history import RAMP
from turgor.core.model.loads import STANDARD_GRAVITY, Force, Gravity, Load, Pressure, Traction, pressures_among
from turgor.core.model.places import NodesAt
from turgor.core.model.sheets import Sheet
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.foundation.errors import near_match
from turgor.job.text.body_names import by_body, unknown_part
from turgor.job.text.forces import is_force, on_faces
from turgor.job.text.listed_loads import fits, listed_values, loads_model, read_listed
from turgor.job.text.load_tables import CavityTable
from turgor.job.text.load_values import history_of, history_values
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import read_table
from turgor.units import format_quantity


def read_loads(
    values: Any,
    geometry: Geometry | None,
    materials: Mapping[str, Material | Sheet | Fibers],
    problems: Problems,
    needed: bool = True,
    duration: float | None = None,
) -> tuple[Load, ...]:
    """Read ``[loads]``: a pressure in all cavities, or in one as ``[loads.cavity_1]`` and the like; gravity, forces.

    ``[loads.tip]`` with a pressure is one on a face that is no cavity. ``materials`` has the windings, too.
    """
    key = ("loads",)
    values, problems = by_body("loads", values, geometry, problems)
    cavities = ("cavity",) if geometry is None else geometry.cavities
    plain, own, pulled = values, {}, {}
    if isinstance(values, Mapping):
        pulled = {name: value for name, value in values.items() if is_force(name, value, cavities)}
        faces = cavities if geometry is None else (*cavities, *pressed_faces(geometry))
        own = {n: value for n, value in values.items() if n not in pulled and _is_face(n, value, faces)}
        plain = {name: value for name, value in values.items() if name not in own and name not in pulled}
        plain = _without_history(plain, cavities, problems)
    table = read_table(loads_model(), plain, key, problems)
    pressures = {} if table is None or table.pressure is None else _in_all(table.pressure, cavities, own, problems)
    pressures |= _in_each(own, geometry, duration, problems)
    if table is None:
        return ()
    loads: list[Load] = [pressures[name] for name in (*cavities, *pressures) if name in pressures]
    loads = list(dict.fromkeys(loads))
    if table.gravity is not None:
        fallen, direction = table.gravity, DIRECTIONS[table.gravity.direction]
        gravity = problems.attempt(
            ("loads", "gravity"),
            lambda: Gravity(direction, fallen.acceleration, history_of(fallen, "gravity", duration)),
            fields=("history", "history_over_time"),
        )
        loads += [gravity] if gravity is not None and fits(gravity, geometry, ("loads", "gravity"), problems) else []
    loads += on_faces(pulled, geometry, table.gravity, duration, problems)
    windings = [name for name, each in materials.items() if isinstance(each, Fibers)]
    loads += read_listed(table, geometry, duration, problems, windings)
    _check_densities(next((load.kind for load in loads if load.needs_density), None), materials, problems)
    loads = [_of_materials(load, materials, problems) for load in loads]
    if needed and not (own or pulled or any(getattr(table, name) for name in type(table).model_fields)):
        problems.add(key, "nothing drives the actuator; give pressure, gravity or both.")
    return tuple(loads)


def _without_history(values: Mapping[str, Any], cavities: tuple[str, ...], problems: Problems) -> dict[str, Any]:
    """Keys of ``[loads]`` without a history, because a history belongs to the table of a cavity."""
    if "history" in values and cavities:
        problems.add(("loads", "history"), f"a history belongs to one cavity; write it below [loads.{cavities[0]}].")
    return {name: value for name, value in values.items() if name != "history" or not cavities}


def _is_face(name: str, value: object, faces: tuple[str, ...]) -> bool:
    """Whether a key of ``[loads]`` stands for a cavity or another face: it is a name of one, or holds a table."""
    called = name in faces or name.startswith("cavity_")
    return called or (isinstance(value, Mapping) and name not in loads_model().model_fields)


def _in_all(
    pressure: float, cavities: tuple[str, ...], own: Mapping[str, Any], problems: Problems
) -> dict[str, Pressure]:
    """Pressures of all cavities without one of their own."""
    rest = [name for name in cavities if name not in own]
    if not rest:
        why = "the actuator has no cavity" if not cavities else "every cavity has a pressure of its own"
        problems.add(("loads", "pressure"), f"{format_quantity(pressure, 'kPa')} acts nowhere, because {why}.")
    return {name: Pressure(name, pressure) for name in rest}


def _in_each(
    own: Mapping[str, Any], geometry: Geometry | None, duration: float | None, problems: Problems
) -> dict[str, Pressure]:
    """Pressures of tables such as ``[loads.cavity_1]`` or ``[loads.tip]``; the geometry is None if it is unknown."""
    pressures = {}
    for name, values in own.items():
        key = ("loads", name)
        wrong = "" if geometry is None else _no_face(name, geometry)
        if wrong:
            problems.add(key, wrong)
            continue
        table = read_table(CavityTable, values, key, problems)
        if table is None:
            continue
        pressure = problems.attempt(key, partial(_pressure, name, table, duration), fields=("pressure", "history"))
        if pressure is not None:
            pressures[name] = pressure
    return pressures


def _no_face(name: str, geometry: Geometry) -> str:
    """Why no pressure can act on a face of this name; empty where one can."""
    cavities, faces = geometry.cavities, pressed_faces(geometry)
    if name in (*cavities, *faces):
        return ""
    if name.startswith("cavity"):
        known = f" Its cavities are {', '.join(cavities)}." if cavities else ""
        return f"the actuator has no cavity '{name}'{near_match(name, cavities) or '.'}{known}"
    return str(unknown_part("face", name, (*cavities, *faces), geometry))


def pressed_faces(geometry: Geometry) -> tuple[str, ...]:
    """Return the faces besides cavities that a pressure can act on: all that are no plane of symmetry."""
    return tuple(face for face in geometry.faces if not face.startswith(("symmetry_", "cyclic_", "cavity")))


def _pressure(face: str, table: CavityTable, duration: float | None) -> Pressure:
    return Pressure(face, table.pressure, history_of(table, f"pressure on '{face}'", duration))


def check_motion(
    procedure: Procedure | None, loads: Iterable[Load], materials: Mapping[str, object], problems: Problems
) -> None:
    """Report materials without the density that motion needs, unless a load has reported them.

    Parameters
    ----------
    procedure : Procedure or None
    loads : iterable of Load
        Those that have been read with `read_loads`.
    materials : mapping of str to Material or Sheet
    problems : Problems
        Takes what is wrong.
    """
    if procedure is not None and procedure.has_inertia and not any(load.needs_density for load in loads):
        _check_densities("motion", materials, problems)


def _check_densities(heavy: str | None, materials: Mapping[str, object], problems: Problems) -> None:
    alone = not any(isinstance(each, Material) for each in materials.values())  # films; sheets on bodies may lack it
    for name, each in materials.items():
        material = each.material if alone and isinstance(each, Sheet) else each
        if heavy is not None and isinstance(material, Material) and material.density is None:
            problems.whole.add(
                ("materials", name), f"has no density, and {heavy} needs it; add density, such as '1100 kg/m³'."
            )


def _of_materials(load: Load, materials: Mapping[str, object], problems: Problems) -> Load:
    """The load with what it takes from the materials, such as a temperature the expansion."""
    return problems.attempt(("loads", load.job_key), partial(load.of_materials, materials)) or load


def only_pressure(loads: tuple[Load, ...]) -> float | None:
    """Return the pressure that is proportional to the load factor, if there is only one; else None."""
    common = common_pressure(loads)
    return common.pressure if common is not None and common.history == RAMP else None


def requested_factors(requested: list[Any], loads: tuple[Load, ...], problems: Problems) -> list[float]:
    """Convert requested pressures, written as ``(pressure,)``, into load factors; load factors stay as they are.

    Pressures can be requested if there is only one, and it is proportional to the load factor.
    """
    key, factors, top = ("procedure", "at"), [], only_pressure(loads)
    for value in requested:
        if not isinstance(value, tuple):
            factors.append(value)
            continue
        if not top:
            problems.add(key, _why_no_pressure(loads))
            break
        factor = value[0] / top
        if not 0 < factor <= 1:
            given, limit = format_quantity(value[0], "kPa"), format_quantity(top, "kPa")
            problems.add(key, f"{given} does not lie between 0 and loads.pressure, {limit}.")
            break
        factors.append(factor)
    return sorted(set(factors))


def _why_no_pressure(loads: tuple[Load, ...]) -> str:
    pressures = pressures_among(loads)
    if any(load.pressure for load in pressures):
        several = len({(load.pressure, load.history) for load in pressures}) > 1
        why = "the cavities have different ones" if several else "it has a history of its own"
        return f"a pressure does not say which state is meant, because {why}; request load factors, such as 0.5."
    return "pressures are requested, but loads.pressure is missing or zero."


def loads_table(loads: tuple[Load, ...]) -> dict[str, Any]:
    """Write loads as the table of a job file; `read_loads` gives the same loads back.

    Parameters
    ----------
    loads : tuple of Load

    Returns
    -------
    dict
    """
    pressures = list(pressures_among(loads))
    values: dict[str, Any] = {}
    if [load.face for load in pressures] == ["cavity"] and pressures[0].history == RAMP:
        values["pressure"] = format_quantity(pressures.pop().pressure, "kPa")
    for load in loads:
        if isinstance(load, Gravity):
            direction = next(text for text, vector in DIRECTIONS.items() if vector == load.direction)
            plain = load.history == RAMP and load.acceleration == STANDARD_GRAVITY
            values["gravity"] = direction if plain else _gravity_table(load, direction)
    for load in pressures:
        values[load.face] = {"pressure": format_quantity(load.pressure, "kPa")}
        values[load.face] |= history_values(load.history)
    for load in (load for load in loads if isinstance(load, Force)):
        values[load.place] = load.face.table() if isinstance(load.face, NodesAt) else {}
        values[load.place] |= {"force": [format_quantity(part, "N") for part in load.vector]}
        values[load.place] |= history_values(load.history)
    for pull in (load for load in loads if isinstance(load, Traction)):
        values[pull.face] = {"traction": [format_quantity(part, "kPa") for part in pull.vector]}
        values[pull.face] |= history_values(pull.history)
    return values | listed_values(loads)


def _gravity_table(load: Gravity, direction: str) -> dict[str, Any]:
    """Table of gravity, without the keys that have their default."""
    values: dict[str, Any] = {"direction": direction}
    if load.acceleration != STANDARD_GRAVITY:
        values["acceleration"] = format_quantity(load.acceleration, "m/s²")
    return values | history_values(load.history)
