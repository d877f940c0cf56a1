"""Forces of a job file on a face, an edge, a node or a box, or of what hangs from there."""

from collections.abc import Mapping
from functools import partial
from typing import Any

from turgor.core.geometry.directions import DIRECTIONS
from turgor.core.geometry.geometry import Geometry
from turgor.core.model.loads import STANDARD_GRAVITY, Force, Traction
from turgor.core.model.places import NodesAt, name_of
from turgor.foundation.errors import TurgorError
from turgor.job.text.listed_loads import fits
from turgor.job.text.load_tables import ForceTable, GravityTable
from turgor.job.text.load_values import history_of
from turgor.job.text.place_table import PLACES, lacks_faces
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import read_table


def is_force(name: str, value: object, cavities: tuple[str, ...]) -> bool:
    """Whether a table of ``[loads]`` states a force on a face."""
    return isinstance(value, Mapping) and name not in cavities and bool({"force", "hangs", "traction"} & set(value))


def on_faces(
    stated: Mapping[str, Any],
    geometry: Geometry | None,
    gravity: GravityTable | None,
    duration: float | None,
    problems: Problems,
) -> list[Force | Traction]:
    """Forces and tractions of tables such as ``[loads.tip]``."""
    forces: list[Force | Traction] = []
    for name, values in stated.items():
        key = ("loads", name)
        table = read_table(ForceTable, values, key, problems)
        face = None if table is None else problems.attempt(key, partial(table.face_of, name, geometry), fields=PLACES)
        if table is None or face is None or lacks_faces(face, key, geometry, problems):
            continue
        force = problems.attempt(
            key, partial(_force, face, table, gravity, duration), fields=("force", "hangs", "traction", "history")
        )
        if force is not None and fits(force, geometry, key, problems):
            forces.append(force)
    return forces


def _force(
    face: str | NodesAt, table: ForceTable, gravity: GravityTable | None, duration: float | None
) -> Force | Traction:
    if sum(value is not None for value in (table.force, table.hangs, table.traction)) != 1:
        raise TurgorError(
            "force: give one of force, such as [0, 0, '-0.5 N'], hangs, such as '50 g', and traction, such as "
            "[0, 0, '2 kPa']."
        )
    if table.traction is not None:
        if isinstance(face, NodesAt):
            raise TurgorError(f"traction is a force per area, and {face.text} has none; give force.")
        return Traction(face, table.traction, history_of(table, f"traction on '{face}'", duration))
    vector = table.force
    if table.hangs is not None:
        weight = table.hangs * (STANDARD_GRAVITY if gravity is None else gravity.acceleration)
        x, y, z = (weight * part for part in DIRECTIONS["-z" if gravity is None else gravity.direction])
        vector = (x, y, z)
    return Force(face, vector, history_of(table, f"force on '{name_of(face)}'", duration))
