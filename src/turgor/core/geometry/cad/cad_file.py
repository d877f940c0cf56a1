"""CadFile: an actuator from a CAD file, as a value of a job."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path

from turgor.core.geometry.cad.parametric.drawn import check_dimensions, checksum, is_parametric, part_file
from turgor.core.geometry.cad.parametric.parameter import Stated, shown_dimensions
from turgor.core.geometry.cad.parametric.script import BUILD
from turgor.core.geometry.cad.selectors import Selector
from turgor.core.geometry.cad.split import SplitPlane
from turgor.core.geometry.cad.symmetry.requested import NONE, RequestedSymmetry
from turgor.core.geometry.directions import FileAxes, rotation_to
from turgor.core.geometry.geometry import Geometry
from turgor.foundation.errors import TurgorError

#: What breaks the symmetry: pairs of an axis and a reason.
Reasons = tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class CadFile:
    """An actuator from a CAD file, with the arguments of `read_cad`.

    Parameters
    ----------
    file : Path
        STEP, BREP or STL; a script (.py) whose function draws the part; or a table (.csv) of such files.
    function : str
        Function of the script.
    dimensions : mapping of str to float, int, str or bool
        Arguments of the function, or what picks a row of the table: text with a unit, or plain numbers.
    unit : str or float, optional
        Unit of the numbers in the file; it overrides that of the file. A script gets lengths in it, in millimeters by
        default, and angles in degrees.
    faces : mapping of str to Selector
        Names for faces.
    regions : mapping of str to Selector
        Names for bodies.
    split : SplitPlane, optional
        A plane that cuts off the bottom as a region of its own.
    symmetry : str or RequestedSymmetry
        Where to cut the part, as for `read_cad`.
    axes : tuple of three str or (3,) floats, optional
        Directions in the file of our x, y and z, as for `read_cad`; found where they are not given.
    sha256 : str
        Checksum of the file, as a lock file states it; computed if it is empty.

    Raises
    ------
    TurgorError
        If the file is missing, or its checksum is another one.

    Examples
    --------
    >>> CadFile(file=Path("missing.step"))
    Traceback (most recent call last):
    turgor.TurgorError: file is missing.step, and there is no such file.
    """

    file: Path
    function: str = BUILD
    dimensions: Mapping[str, Stated] = field(default_factory=dict)
    unit: str | float | None = None
    faces: Mapping[str, Selector] = field(default_factory=dict)
    regions: Mapping[str, Selector] = field(default_factory=dict)
    split: SplitPlane | None = None
    symmetry: str | RequestedSymmetry = NONE
    axes: FileAxes | None = None
    sha256: str = ""

    def __post_init__(self) -> None:
        if not Path(self.file).is_file():
            raise TurgorError(f"file is {self.file}, and there is no such file.")
        content = checksum(Path(self.file))
        if self.sha256 and self.sha256 != content:
            raise TurgorError(
                f"sha256 is {self.sha256[:12]}…, but the content of '{self.file}' has {content[:12]}…: the file has "
                "changed since; take the old one, or remove the key to go on with the new one."
            )
        check_dimensions(Path(self.file), self.function, self.dimensions, self.unit)
        object.__setattr__(self, "sha256", content)
        object.__setattr__(self, "symmetry", self.requested_symmetry)
        if self.axes is not None:
            rotation_to(self.axes)  # refuses what are none

    def build(self) -> Geometry:
        """Read the file with `read_cad`, once: a job builds its actuator several times."""
        names = tuple(self.faces.items()), tuple(self.regions.items())
        requested = self.requested_symmetry
        broken = tuple(sorted(requested.broken.items())), tuple(sorted(requested.broken_turns.items()))
        placing = (requested.planes, *broken, self.axes)
        drawn = (self.function, tuple(self.dimensions.items()))
        return _built(self.file, self.sha256, drawn, self.unit, *names, self.split, placing)

    @property
    def requested_symmetry(self) -> RequestedSymmetry:
        """The requested symmetry, with the reasons against planes and wedges."""
        return self.symmetry if isinstance(self.symmetry, RequestedSymmetry) else RequestedSymmetry(self.symmetry)


@lru_cache(maxsize=8)
def _built(
    file: Path,
    sha256: str,
    drawn: tuple[str, tuple[tuple[str, Stated], ...]],
    unit: str | float | None,
    faces: tuple[tuple[str, Selector], ...],
    regions: tuple[tuple[str, Selector], ...],
    split: SplitPlane | None,
    placing: tuple[str, Reasons, Reasons, FileAxes | None],
) -> Geometry:
    """Read a file, or the part that a script draws; the checksum makes another call of it when its content changes."""
    from turgor.core.geometry.cad.read import read_cad  # here: it loads much, and every job loads this file

    planes, broken, turns, axes = placing
    requested = RequestedSymmetry(planes, dict(broken), dict(turns))
    named = {"faces": dict(faces), "regions": dict(regions)}
    function, dimensions = drawn[0], dict(drawn[1])
    with part_file(Path(file), function, dimensions, unit) as path:
        try:
            geometry = read_cad(path, unit=unit, **named, split=split, symmetry=requested, axes=axes)
        except TurgorError as error:
            if not is_parametric(Path(file)):
                raise
            shown = shown_dimensions(dimensions)
            sentence = str(error).replace(str(path), path.name)  # the folder is gone
            raise TurgorError(f"the part of '{Path(file).name}' with {shown} is refused: {sentence}") from None
    return replace(geometry, file=str(file))
