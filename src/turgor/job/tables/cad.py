"""CAD files in a job: ``[actuator]`` with ``type = "cad_file"``, both ways."""

from collections.abc import Mapping
from dataclasses import fields
from math import isfinite
from pathlib import Path
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, model_validator

from turgor.core.geometry.cad.cad_file import CadFile
from turgor.core.geometry.cad.parametric.drawn import PARAMETRIC, check_dimensions, dimensions_of, is_parametric
from turgor.core.geometry.cad.parametric.parameter import Stated
from turgor.core.geometry.cad.parametric.script import BUILD
from turgor.core.geometry.cad.selectors import ByColor, ByName, InBox, NearestTo, Selector, WithNormal
from turgor.core.geometry.cad.split import SplitPlane
from turgor.core.geometry.cad.symmetry.requested import NONE
from turgor.core.geometry.directions import FileAxes
from turgor.foundation.errors import TurgorError, near_file
from turgor.job.text.lines import Key
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Coordinate, Length, Says, Table, read_table, shown
from turgor.units import format_quantity

#: The type of an actuator that comes from a CAD file.
CAD_FILE = "cad_file"


class SelectorTable(Table):
    """Selector of faces or bodies: exactly one of the keys, such as ``{near = [0, 0, "5 mm"]}``.

    Keys
    ----
    name : str
        Name in the file.
    color : str
        Color in the file, such as ``"#ff0000"``.
    near : (3,) lengths
        The face or body nearest to this point.
    box : two points
        Those that lie inside the box between two corners.
    normal : str or (3,) floats
        Plane faces with this outward normal, such as ``"+z"``.
    """

    name: str | None = Field(default=None, examples=['"grip"'])
    color: str | None = Field(default=None, examples=['"#ff0000"'])
    near: list[Coordinate] | None = Field(default=None, examples=['[0, 0, "5 mm"]'])
    box: list[list[Coordinate]] | None = Field(default=None, examples=['[[0, 0, 0], ["10 mm", "10 mm", "2 mm"]]'])
    normal: str | list[float] | None = Field(default=None, examples=['"+z"'])

    @model_validator(mode="after")
    def _one(self) -> "SelectorTable":
        self.selector()  # so that an error is reported at the key
        return self

    @property
    def given(self) -> list[str]:
        """The keys that are there."""
        return [key for key in type(self).model_fields if getattr(self, key) is not None]

    def selector(self) -> Selector:
        """Return the selector of the table."""
        given = self.given
        if len(given) != 1:
            known = ", ".join(type(self).model_fields)
            raise TurgorError(f"a selector has one of the keys {known}; this one has {', '.join(given) or 'none'}.")
        if self.name is not None:
            return ByName(self.name)
        if self.color is not None:
            return ByColor(self.color)
        if self.near is not None:
            return NearestTo(tuple(self.near))  # type: ignore[arg-type]
        if self.box is not None:
            if len(self.box) != 2:
                raise TurgorError(
                    f"box has {len(self.box)} corners; two are needed, such as [[0, 0, 0], ['10 mm', '10 mm', '2 mm']]."
                )
            return InBox(*(tuple(corner) for corner in self.box))  # type: ignore[arg-type]
        normal = self.normal
        return WithNormal(tuple(normal) if isinstance(normal, list) else normal)  # type: ignore[arg-type]


class SplitTable(Table):
    """``[actuator.split]``: a plane that cuts a CAD part into two regions; it needs a position or a thickness.

    Keys
    ----
    normal : str or (3,) floats
        Upward normal of the plane: ``"+z"`` cuts off the bottom, ``"-z"`` the top.
    """

    normal: str | list[float] = "+z"
    position: Length | None = None
    thickness: Length | None = None
    below: str = "base"
    interface: str = "strain_limiting_layer"


def _stated(value: object) -> object:
    """Refuse what is no value of a dimension."""
    if isinstance(value, bool | int | str) or (isinstance(value, float) and isfinite(value)):
        return value
    raise TurgorError(f"{shown(value)} is neither a quantity such as '1.5 mm' nor a number, a text, true or false.")


Dimension = Annotated[Any, BeforeValidator(_stated), Says("quantity, number, text, true or false", '"1.5 mm"')]


class CadFileTable(Table):
    """``[actuator]``: an actuator from a CAD file.

    Keys
    ----
    file : str
        STEP, BREP or STL file; a script (.py) whose function draws the part; or a table (.csv) of such files with their
        dimensions. Its path counts from the folder of the job file.
    function : str
        Function of the script: it takes the dimensions and returns the part, or the path of a CAD file.
    dimensions : table of quantities, numbers or texts
        Arguments of the function, or what picks a row of the table.
    unit : str or float
        Unit of the numbers in the file, or its length in meters. A script gets lengths in it, in millimeters by
        default, and angles in degrees.
    symmetry : str
        ``"automatic"`` models a half or a quarter where the part and its loads are the same on both sides of a plane
        across x, y or z, or a wedge with cyclic faces where that is a smaller share. ``"y"`` or ``"yz"`` names the
        planes; ``"wedge"`` models one of n equal sectors, ``"wedge 6"`` says how many. ``"none"`` models the whole.
    axes : list of str or (3,) floats
        Directions in the file of our x (from the fixed end to the tip), y (across) and z (up); three numbers for one
        that is askew. By default the part is turned where the faces fixed and tip show that it does not lie along x.
    """

    type: str
    file: str = Field(examples=['"finger.step"'])
    function: str = Field(default=BUILD, examples=['"build"'])
    dimensions: dict[str, Dimension] = Field(default_factory=dict, examples=['{ wall = "1.5 mm", chambers = 3 }'])
    unit: str | float | None = Field(default=None, examples=['"mm"'])
    sha256: str = ""
    faces: dict[str, SelectorTable] = Field(default_factory=dict, examples=['{ fixed = { normal = "-x" } }'])
    regions: dict[str, SelectorTable] = Field(default_factory=dict, examples=['{ body = { near = [0, 0, "5 mm"] } }'])
    split: SplitTable | None = Field(default=None, examples=['{ thickness = "1 mm" }'])
    symmetry: str = Field(default=NONE, examples=['"automatic"'])
    axes: list[str | list[float]] | None = Field(default=None, examples=['["z", "x", "y"]'])


def read_cad_file(values: Mapping[str, Any], problems: Problems, key: Key = ("actuator",)) -> CadFile | None:
    """Read an actuator that comes from a CAD file; its path counts from the folder of the job file."""
    table: CadFileTable | None = read_table(CadFileTable, values, key, problems)
    if table is None:
        return None
    file = Path(problems.file).parent / table.file
    if not file.is_file():
        from turgor.core.geometry.cad.files import SUFFIXES  # here: it loads the CAD kernel

        there = sorted(p.name for p in file.parent.glob("*") if p.suffix.lower() in (*SUFFIXES, *PARAMETRIC))
        listed = f" CAD files there: {', '.join(there)}." if there else ""
        problems.add((*key, "file"), f"there is no file '{file}'{near_file(file, there)}{listed}")
        return None
    if file.suffix.lower() in PARAMETRIC and not _dimensions_fit(table, file, problems, key):
        return None
    split = None
    if table.split is not None:
        given = {name: getattr(table.split, name) for name in SplitTable.model_fields}
        if isinstance(given["normal"], list):
            given["normal"] = tuple(given["normal"])
        split = problems.attempt((*key, "split"), lambda: SplitPlane(**given), fields=given)
        if split is None:
            return None
    return problems.attempt(
        key,
        lambda: CadFile(
            file=file.resolve(),
            function=table.function,
            dimensions=_with_defaults(table, file),
            unit=table.unit,
            faces={name: choice.selector() for name, choice in table.faces.items()},
            regions={name: choice.selector() for name, choice in table.regions.items()},
            split=split,
            symmetry=table.symmetry,
            axes=file_axes(table.axes),
            sha256=table.sha256,
        ),
        fields=[item.name for item in fields(CadFile)],
    )


def _dimensions_fit(table: CadFileTable, file: Path, problems: Problems, key: Key) -> bool:
    """Note what is wrong with the script or the table of files, and then with the dimensions."""
    known = problems.attempt(key, lambda: dimensions_of(file, table.function), fields=("function",))
    if known is None:
        return False
    given, where = table.dimensions, (*key, "dimensions")
    checked = problems.attempt(where, lambda: check_dimensions(file, table.function, given, table.unit), fields=given)
    return checked is not None


def _with_defaults(table: CadFileTable, file: Path) -> dict[str, Stated]:
    """The dimensions of a part with the defaults of its script, so that a lock file states all of them."""
    known = dimensions_of(file, table.function)
    defaults = {each.name: each.with_unit for each in known if each.with_unit is not None}
    return {**defaults, **table.dimensions}


def file_axes(axes: list[str | list[float]] | None) -> FileAxes | None:
    """Return axes of a table as `read_cad` takes them."""
    rows = None if axes is None else tuple(axis if isinstance(axis, str) else tuple(axis) for axis in axes)
    return rows  # type: ignore[return-value]


def axes_table(axes: FileAxes) -> list[str | list[float]]:
    """Write axes as `file_axes` reads them."""
    return [axis if isinstance(axis, str) else list(axis) for axis in axes]


def cad_file_table(actuator: CadFile) -> dict[str, Any]:
    """Write an actuator that comes from a CAD file as `read_cad_file` reads it, without its type."""
    values: dict[str, Any] = {"file": Path(actuator.file).as_posix(), "sha256": actuator.sha256}
    if is_parametric(Path(actuator.file)):
        values |= {"function": actuator.function, "dimensions": dict(actuator.dimensions)}
    if actuator.unit is not None:
        values["unit"] = actuator.unit
    for key, selectors in (("faces", actuator.faces), ("regions", actuator.regions)):
        if selectors:
            values[key] = {name: selector_table(selector) for name, selector in selectors.items()}
    if actuator.requested_symmetry.planes != NONE:
        values["symmetry"] = actuator.requested_symmetry.planes
    if actuator.axes is not None:
        values["axes"] = axes_table(actuator.axes)
    split = actuator.split
    if split is not None:
        place = "position" if split.position is not None else "thickness"
        values["split"] = {
            "normal": list(split.normal),
            place: format_quantity(getattr(split, place), "mm"),
            "below": split.below,
            "interface": split.interface,
        }
    return values


def selector_table(selector: Selector) -> dict[str, Any]:
    """Write a selector as `SelectorTable` reads it."""
    match selector:
        case ByName(name):
            return {"name": name}
        case ByColor(color):
            return {"color": color}
        case NearestTo(point):
            return {"near": [format_quantity(value, "mm") for value in point]}
        case InBox(low, high):
            return {"box": [[format_quantity(value, "mm") for value in corner] for corner in (low, high)]}
        case WithNormal(normal):
            return {"normal": list(normal)}
