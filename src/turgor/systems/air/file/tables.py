"""Tables of a file: nodes and parts by their types."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from turgor.core.results.files.response_csv import read_response
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.registry import Registry
from turgor.systems.air.file.values import (
    PASSAGES,
    Key,
    Wrong,
    keys_of,
    listed,
    made,
    passage_keys,
    quantity,
    read_signal,
    read_valve_passage,
)  # fmt: skip
from turgor.systems.air.nodes import Chamber, Node, Supply, junction, syringe
from turgor.systems.air.parts.connection import Connection
from turgor.systems.air.parts.part import Part
from turgor.systems.air.volumes.coupled import Coupled
from turgor.systems.air.volumes.curve import VolumeCurve
from turgor.systems.air.volumes.moving import MovingActuator

if TYPE_CHECKING:
    from turgor.reduced.states.reduced import Reduced


def _parts_of_file(module: ModuleType) -> Iterable[tuple[str, type[Part]]]:
    """Parts that a file defines, by their types."""
    own = [each for each in vars(module).values() if isinstance(each, type) and each.__module__ == module.__name__]
    return [(each.kind, each) for each in own if issubclass(each, Part) and each.kind]


#: Parts by their types: those of the files in their folder.
PARTS: Registry[type[Part]] = Registry("turgor.systems.air.parts", _parts_of_file)

#: Ways to state the volume of a chamber.
SOURCES: Mapping[str, str] = {
    "volume": "Volume of a rigid vessel.",
    "points": 'Table of pressures and volumes, such as [["0 kPa", "18 mL"], ["50 kPa", "30 mL"]]; volumes rise.',
    "table": "CSV file with pressures and volumes, such as `response.csv` of a run.",
    "job": "Job file: its actuator is solved, and gives pressures and volumes.",
    "reduced": "Reduced model, whose inputs are pressures.",
}

#: Further keys of a chamber.
COLUMNS: Mapping[str, str] = {
    "pressure_column": "Column of the table with the pressure; `pressure` by default.",
    "volume_column": "Column of the table with the volume; `cavity_volume` by default.",
    "chamber": "Number of the chamber, from 1, where a reduced model has several inputs.",
    "step": "Time step of a reduced model in motion; without it the chamber has no inertia.",
    "damping": "Damping of a reduced model in motion, in proportion to the rate of strain: a time; none by default.",
}

#: Types of nodes with their keys besides those of `Chamber` and `Supply`.
NODES = ("chamber", "junction", "supply", "syringe")


def part_types() -> tuple[str, ...]:
    """Return the types of parts."""
    return tuple(sorted((*PARTS, *PASSAGES)))


def part_keys(kind: str) -> dict[str, Key]:
    """Return the keys of a type of part."""
    if kind in PASSAGES:
        return keys_of(Connection, ("passage",)) | keys_of(PASSAGES[kind])
    keys = keys_of(PARTS[kind])
    return {name: key for name, key in keys.items() if name != "passage"} | (
        passage_keys() if "passage" in keys else {}
    )


def node_keys(kind: str) -> dict[str, Key]:
    """Return the keys of a type of node that are fields."""
    if kind == "supply":
        return keys_of(Supply)
    names = {"syringe": ("pressure",), "junction": (), "chamber": ("pressure", "process", "heat", "temperature")}[kind]
    return {name: key for name, key in keys_of(Chamber, ("volume",)).items() if name in names}


def other_keys(kind: str) -> dict[str, str]:
    """Return the keys of a type of node that are no fields, with their meaning."""
    if kind == "chamber":
        return {**SOURCES, **COLUMNS}
    meanings = {"junction": "Volume besides that of tubes; none by default.", "syringe": "Volume over time, a signal."}
    return {"volume": meanings[kind]} if kind in meanings else {}


def check_keys(content: Mapping[str, Any], known: Iterable[str]) -> None:
    """Raise an error for a key that is not known."""
    for key in content:
        if key not in known and key != "type":
            raise Wrong(key, str(unknown("key", key, known)))


def read_part(content: Mapping[str, Any]) -> Part:
    """Read a part."""
    kind = _type(content, part_types())
    check_keys(content, part_keys(kind))
    if kind in PASSAGES:
        passage: Any = PASSAGES[kind]
        ends = made(Connection, {"to": "ambient", **content} if kind == "leak" else content, ("passage",))
        return Connection(**ends, passage=passage(**made(passage, content)))
    cls: Any = PARTS[kind]
    values = made(cls, content, ("passage",))
    if "passage" in keys_of(cls):
        values["passage"] = read_valve_passage({key: content[key] for key in passage_keys() if key in content})
    part: Part = cls(**values)
    return part


@dataclass(frozen=True, slots=True)
class NodeReader:
    """Reads nodes; what several of them share is read once.

    Parameters
    ----------
    folder : Path
        Of the file, from which the paths in it count.
    tables : dict of str to Coupled or MovingActuator
        Coupled chambers by the path of their reduced model.
    """

    folder: Path
    tables: dict[str, Coupled | MovingActuator] = field(default_factory=dict)

    def read(self, content: Mapping[str, Any]) -> Node:
        """Read a node."""
        kind = _type(content, NODES)
        check_keys(content, {**node_keys(kind), **other_keys(kind)})
        if kind == "supply":
            return Supply(**made(Supply, content))
        if kind == "junction":
            return junction(
                _at("volume", lambda: quantity(content["volume"], "volume")) if "volume" in content else None
            )
        if kind == "syringe":
            if "volume" not in content:
                raise Wrong("volume", 'it is missing; a signal is needed, such as [["0 s", "20 mL"], ["1 s", "5 mL"]].')
            volume = _at("volume", lambda: read_signal(content["volume"], "volume", lines=True))
            return syringe(volume, **made(Chamber, content, ("volume", "process", "heat", "temperature")))
        return self._chamber(content)

    def _chamber(self, content: Mapping[str, Any]) -> Chamber:
        stated = [key for key in SOURCES if key in content]
        if len(stated) != 1:
            there = ", ".join(stated) or "none"
            raise Wrong(
                stated[-1] if stated else "volume",
                f"state the volume of a chamber by one of {', '.join(SOURCES)}; there is {there}.",
            )
        volume = _at(stated[0], lambda: self._volume(stated[0], content))
        return Chamber(volume, **made(Chamber, content, ("volume",)))

    def _volume(self, source: str, content: Mapping[str, Any]) -> Any:
        value = content[source]
        if source == "volume":
            return quantity(value, "volume")
        if source == "points":
            rows = [listed(row) for row in listed(value)]
            if any(len(row) != 2 for row in rows):
                raise TurgorError('each point has a pressure and a volume, such as ["20 kPa", "25 mL"].')
            pressures = [quantity(row[0], "pressure") for row in rows]
            return VolumeCurve(np.array(pressures), np.array([quantity(row[1], "volume") for row in rows]))
        if not isinstance(value, str):
            raise TurgorError(f"{value!r} is no path of a file.")
        if source == "job":
            return _solved(self.folder / value)
        if source == "table":
            pressure = str(content.get("pressure_column", "pressure"))
            volume = str(content.get("volume_column", "cavity_volume"))
            return VolumeCurve.of_response(read_response(self.folder / value), pressure=pressure, volume=volume)
        return self._reduced(value, content)

    def _reduced(self, path: str, content: Mapping[str, Any]) -> Any:
        from turgor.reduced.states.reduced import Reduced  # here: it loads the engine

        if path not in self.tables:
            reduced = Reduced.load(self.folder / path)
            moves = "step" in content
            if len(reduced.inputs.keys) == 1 and not moves:
                return VolumeCurve.of_reduced(reduced)
            self.tables[path] = self._moving(reduced, content) if moves else Coupled.of_reduced(reduced)
        table = self.tables[path]
        count = len(table.low) if isinstance(table, Coupled) else len(table.reduced.inputs.keys)
        number = content.get("chamber", 1 if count == 1 else None)
        if type(number) is not int or not 1 <= number <= count:
            raise Wrong("chamber", f"{number!r} is not a number from 1 to {count}, those of the reduced model.")
        return table.chamber(number - 1)

    def _moving(self, reduced: "Reduced", content: Mapping[str, Any]) -> MovingActuator:
        from turgor.reduced.states.following import Moving  # here: it loads the engine

        step = _at("step", lambda: quantity(content["step"], "time"))
        damping = _at("damping", lambda: quantity(content.get("damping", "0 s"), "time"))
        return MovingActuator(reduced, Moving(step=step, stiffness_damping=damping))


def _solved(path: Path) -> VolumeCurve:
    """Solve the actuator of a job, and read its curve."""
    from turgor.core.results.measures.measures import find_measure, measure  # here: it loads the engine
    from turgor.core.results.measures.standard_measures import cavity_volume
    from turgor.core.solvers.solve import solve
    from turgor.job.prepare import prepare
    from turgor.job.read import read_job

    job = read_job(path)
    model, _ = prepare(job)
    names = [name for name in ("bending_angle", "tip_displacement") if name in job.output.measures]
    solution = solve(model, job.procedure, progress=False)
    return VolumeCurve.of_response(measure(solution, cavity_volume, *map(find_measure, names)))


def _type(content: Mapping[str, Any], known: Iterable[str]) -> str:
    if "type" not in content:
        raise Wrong("type", f"it is missing; one of {', '.join(known)} is needed.")
    kind = content["type"]
    if not isinstance(kind, str) or kind not in known:
        raise Wrong("type", str(unknown("type", str(kind), known)))
    return kind


def _at(key: str, make: Callable[[], Any]) -> Any:
    """Make a value; an error belongs to a key unless it names one itself."""
    try:
        return make()
    except Wrong:
        raise
    except TurgorError as error:
        raise Wrong(key, str(error)) from None
