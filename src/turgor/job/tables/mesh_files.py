"""Mesh files in a job: ``[actuator]`` with ``type = "mesh_file"``, both ways."""

from collections.abc import Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any, TypeAlias

from pydantic import Field, model_validator

from turgor.core.geometry.cad.selectors import ByColor, ByName, InBox, NearestTo, Selector, WithNormal
from turgor.core.meshing.exchange.mesh_file import MeshFile
from turgor.core.meshing.exchange.node_selectors import ByNodes, BySides
from turgor.core.meshing.exchange.selectors import Choice
from turgor.core.meshing.revolved.plane_state import Axisymmetric, PlaneState, PlaneStrain
from turgor.foundation.errors import TurgorError, near_file, unknown
from turgor.job.tables.cad import SelectorTable, axes_table, file_axes, selector_table
from turgor.job.tables.obstacles import Lengths
from turgor.job.text.lines import Key
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Angle, Length, Table, read_table
from turgor.units import format_quantity

#: A selector of sides of a mesh.
SideSelector: TypeAlias = Selector | ByNodes | BySides

#: The type of an actuator that comes from a mesh file.
MESH_FILE = "mesh_file"


class SideTable(SelectorTable):
    """Selector of sides of a mesh: exactly one of the keys, such as ``{nodes = "fixed.txt"}``.

    Keys
    ----
    nodes : list of ints, or str
        Sides whose corners are all among these nodes, by their numbers in the file; VTK files count from 0. Or a text
        file of such numbers.
    sides : list of lists of ints, or str
        Sides with these corners, a list for each; or a text file with a line for each.
    """

    nodes: str | list[int] | None = Field(default=None, examples=['"fixed-nodes.txt"'])
    sides: str | list[list[int]] | None = Field(default=None, examples=['"cavity-triangles.txt"'])

    @model_validator(mode="after")
    def _one(self) -> "SideTable":
        if self.nodes is None and self.sides is None:
            self.selector()
        elif len(self.given) > 1:
            raise TurgorError(f"a selector has one key; this one has {', '.join(self.given)}.")
        return self

    def selector_in(self, folder: Path) -> SideSelector:
        """Return the selector of the table; names of files count from a folder."""
        if self.nodes is not None:
            return ByNodes(folder / self.nodes if isinstance(self.nodes, str) else self.nodes)
        if self.sides is not None:
            return BySides(folder / self.sides if isinstance(self.sides, str) else self.sides)
        return self.selector()


class MeshFileTable(Table):
    """``[actuator]``: an actuator that is meshed already.

    A table ``[mesh]`` with ``file`` and the same keys stands for ``[actuator]`` too.

    Keys
    ----
    file : str
        Mesh of gmsh, Abaqus, CalculiX or VTK, or a closed STL; its path counts from the folder of the job file.
    unit : str or float
        Unit of length of the file, or its length in meters; mm by default, and m for VTU files of turgor, which state
        it.
    turn : table
        Angles about x, y or z by which the mesh is turned, one of them: ``{ z = "90 deg" }``. Names are given before.
    move : (3,) lengths
        How far it is moved, after the turn.
    mirror : list of str
        Normals of mirror planes through the origin after the move; the half at positive x, y or z is taken.
        Tetrahedra across a plane are cut there.
    merge : bool
        Whether nodes at the same place become one. With false bodies that touch stay apart, with contact between them.
    plane_strain : length
        Thickness of the part whose section is the plane mesh of the file.
    axisymmetric : str
        Axis in the file, x, y or z through its origin, about which its plane mesh is turned.
    """

    type: str
    file: str = Field(examples=['"finger.msh"'])
    unit: str | float | None = Field(default=None, examples=['"mm"'])
    axes: list[str | list[float]] = Field(default=["x", "y", "z"])
    regions: dict[str, SelectorTable | list[SelectorTable]] = Field(
        default_factory=dict, examples=['{ body = { name = "RUBBER" } }']
    )
    faces: dict[str, SideTable | list[SideTable]] = Field(
        default_factory=dict, examples=['{ fixed = { normal = "-x" } }']
    )
    cavities: dict[str, str] = Field(default_factory=dict, examples=['{ cavity = "air.stl" }'])
    turn: dict[str, Angle] | None = Field(default=None, examples=['{ z = "90 deg" }'])
    move: Lengths | None = Field(default=None, examples=['["5 mm", 0, 0]'])
    mirror: list[str] = Field(default_factory=list, examples=['["y"]'])
    merge: bool = True
    plane_strain: Length | None = Field(default=None, examples=['"10 mm"'])
    axisymmetric: str | None = Field(default=None, examples=['"y"'])
    sha256: str = ""


def read_mesh_file(values: Mapping[str, Any], problems: Problems, key: Key = ("actuator",)) -> MeshFile | None:
    """Read an actuator that comes from a mesh file; paths count from the folder of the job file.

    Parameters
    ----------
    values : mapping
        The table.
    problems : Problems
        Takes what is wrong.
    key : tuple of str
        Where the table stands.

    Returns
    -------
    MeshFile or None
        None where something is wrong.
    """
    table: MeshFileTable | None = read_table(MeshFileTable, values, key, problems)
    if table is None:
        return None
    folder = Path(problems.file).parent
    paths: dict[Key, Path] = {(*key, "file"): folder / table.file}
    paths |= {(*key, "cavities", name): folder / file for name, file in table.cavities.items()}
    for place, file in paths.items():
        if not file.is_file():
            from turgor.core.meshing.exchange.read import READERS  # here: it loads all readers

            suffixes = (*READERS, ".stl")  # surfaces can be filled with a mesh
            there = sorted(p.name for p in file.parent.glob("*") if p.suffix.lower() in suffixes)
            listed = f" Mesh files there: {', '.join(there)}." if there else ""
            problems.add(place, f"there is no file '{file}'{near_file(file, there)}{listed}")
    if problems.entries:
        return None
    return problems.attempt(
        key,
        lambda: MeshFile(
            file=(folder / table.file).resolve(),
            unit=table.unit,
            axes=file_axes(table.axes) or ("x", "y", "z"),
            regions={name: _selectors(choice, folder) for name, choice in table.regions.items()},
            faces={name: _selectors(choice, folder) for name, choice in table.faces.items()},
            cavities={name: (folder / file).resolve() for name, file in table.cavities.items()},
            turn=_turn(table.turn),
            move=table.move,
            mirror=tuple(table.mirror),
            merge=table.merge,
            plane=_plane(table),
            sha256=table.sha256,
        ),
        fields=[item.name for item in fields(MeshFile)],
    )


def _plane(table: MeshFileTable) -> PlaneState | None:
    if table.plane_strain is not None and table.axisymmetric is not None:
        raise TurgorError("plane_strain and axisymmetric exclude each other; a plane mesh stands for one of them.")
    if table.plane_strain is not None:
        return PlaneStrain(thickness=table.plane_strain)
    return None if table.axisymmetric is None else Axisymmetric(axis=table.axisymmetric)


def _turn(stated: Mapping[str, float] | None) -> tuple[str, float] | None:
    if stated is None:
        return None
    wrong = [axis for axis in stated if axis not in ("x", "y", "z")]
    if wrong:
        raise unknown("axis of turn", wrong[0], ("x", "y", "z"))
    if len(stated) != 1:
        raise TurgorError(f"turn is about {' and '.join(stated)}; one axis is needed, and axes state any other turn.")
    ((axis, angle),) = stated.items()
    return axis, angle


def _selectors(
    choice: SelectorTable | Sequence[SelectorTable], folder: Path
) -> SideSelector | tuple[SideSelector, ...]:
    if isinstance(choice, SideTable):
        return choice.selector_in(folder)
    if isinstance(choice, SelectorTable):
        return choice.selector()
    return tuple(table.selector_in(folder) if isinstance(table, SideTable) else table.selector() for table in choice)


def mesh_file_table(actuator: MeshFile) -> dict[str, Any]:
    """Write an actuator that comes from a mesh file as `read_mesh_file` reads it, without its type."""
    values: dict[str, Any] = {
        "file": Path(actuator.file).as_posix(),
        **({"unit": actuator.unit} if actuator.unit else {}),
        "axes": axes_table(actuator.axes),
        "sha256": actuator.sha256,
    }
    for key, choices in (("regions", actuator.regions), ("faces", actuator.faces)):
        if choices:
            values[key] = {name: _written(choice) for name, choice in choices.items()}
    if actuator.turn is not None:
        values["turn"] = {actuator.turn[0]: format_quantity(actuator.turn[1], "deg")}
    if actuator.move is not None:
        values["move"] = [format_quantity(part, "mm") for part in actuator.move]
    if actuator.mirror:
        values["mirror"] = list(actuator.mirror)
    if not actuator.merge:
        values["merge"] = False
    match actuator.plane:
        case PlaneStrain(thickness=thickness):
            values["plane_strain"] = format_quantity(thickness, "mm")
        case Axisymmetric(axis=letter):
            values["axisymmetric"] = letter
    if actuator.cavities:
        values["cavities"] = {name: Path(file).as_posix() for name, file in actuator.cavities.items()}
    return values


def _written(choice: Choice) -> Any:
    match choice:
        case str():
            return selector_table(ByName(choice))
        case ByNodes():
            return {"nodes": list(choice.listed)}
        case BySides():
            return {"sides": [list(row) for row in choice.rows]}
        case ByName() | ByColor() | NearestTo() | InBox() | WithNormal():
            return selector_table(choice)
    return [_written(part) for part in choice]
