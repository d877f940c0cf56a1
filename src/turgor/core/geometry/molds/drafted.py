"""The part that is cast in a mold with draft, and how it differs from what was drawn."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry import occ
from turgor.core.geometry.cad.cavities import find_hollows
from turgor.core.geometry.cad.facets import find_facets
from turgor.core.geometry.cad.read import read_cad
from turgor.core.geometry.cad.walls import smallest_wall
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.molds.mold import Mold, MoldSettings
from turgor.core.geometry.molds.taper.allowed import allowed, with_draft
from turgor.core.geometry.molds.taper.pull import Pull
from turgor.core.geometry.shapes.solids import cut, union, volume
from turgor.core.geometry.silenced_output import captured_output
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.units import deg, mm

Array = NDArray[np.float64]

#: Change of a volume above which the drawn part no longer answers for the cast one.
MATTERS = 0.02


@dataclass(frozen=True, slots=True, kw_only=True)
class Cast:
    """What is cast: the outside of the part, and what fills its cavities.

    Parameters
    ----------
    filled : CAD shape
        The part with its cavities filled.
    fillings : sequence of CAD shapes
        What fills each cavity, up to its opening.
    """

    filled: Any
    fillings: Sequence[Any]

    @property
    def body(self) -> Any:
        """The part."""
        return cut(self.filled, list(self.fillings))


def filled_part(body: Any, fillings: Sequence[Any]) -> Any:
    """Return a part with its cavities filled, whose faces have the names of those of the part."""
    filled = union([body, *fillings]).UnifySameDomain() if fillings else body
    for face in filled.faces:
        if not face.name:
            mine = [each for each in body.faces if each.name and each.Distance(face) < 1e-6]
            middle = occ.Vertex(face.center)
            face.name = min(mine, key=lambda each: float(each.Distance(middle))).name if mine else ""
    return filled


def with_drafts(cast: Cast, pull: Pull, cores: Sequence[Pull | None], upright: Sequence[Array] = ()) -> Cast:
    """Return what is cast with draft: outside to both sides of the parting plane, and cores from their openings.

    Parameters
    ----------
    cast : Cast
    pull : Pull
        The way of a half, from the parting plane.
    cores : sequence of (Pull or None)
        The way from the opening of each core to its end; None for cores that are not pulled, which stay.
    upright : sequence of (3,) arrays [CAD units]
        Points of plane walls outside that stay.

    Raises
    ------
    TurgorError
        If the draft closes an end of the part or of a core, or cuts through a wall of a cavity.
    """
    made = _tapered(cast, pull, cores, upright)
    if _openings(made) == _openings(cast):
        return made

    def closed(draft: float) -> bool:
        ways = [None if way is None else replace(way, draft=draft) for way in cores]
        return _openings(_tapered(cast, replace(pull, draft=draft), ways, upright)) == _openings(cast)

    raise TurgorError(
        f"draft is {pull.draft / deg:.4g} deg; allowed for this part is {allowed(closed, pull.draft)}: with more, it "
        "cuts through a wall of a cavity. Draw the wall thicker."
    )


def _tapered(cast: Cast, pull: Pull, cores: Sequence[Pull | None], upright: Sequence[Array]) -> Cast:
    halves = []
    for way in (pull, replace(pull, side=-pull.side)):
        half = cast.filled * _side(cast.filled, way)
        if list(half.solids):
            halves.append(with_draft("part", half, way, upright))
    ways = zip(cast.fillings, cores, strict=True)
    fillings = [filling if way is None else with_draft("core", filling, way) for filling, way in ways]
    return Cast(filled=union(halves).UnifySameDomain(), fillings=fillings)


def _openings(cast: Cast) -> list[int]:
    """Number of bodies, and the numbers of openings of their cavities."""
    body = cast.body
    hollows = find_hollows(find_facets(body, list(dict.fromkeys(body.faces))))[0]
    return [len(list(body.solids)), *sorted(len(each.openings) for each in hollows)]


def _side(shape: Any, pull: Pull) -> Any:
    """All of a shape that lies on one side of a plane, in a block."""
    low, high = (np.array([corner[i] for i in range(3)]) for corner in shape.bounding_box)
    low, high = low - 1, high + 1
    (low if pull.side > 0 else high)[pull.axis] = pull.height
    return occ.Box(occ.Pnt(*map(float, low)), occ.Pnt(*map(float, high)))


def _with_regions(cast: Any, geometry: Geometry) -> Any:
    """Divide what is cast into the regions of the part; where a core has become thinner, the first region grows."""
    solids = list(geometry._cad.solids)
    shapes = [solid * cast for solid in solids]
    grown = cut(cast, solids)
    if list(grown.solids):
        shapes[0] = shapes[0] + grown
    for solid, shape in zip(solids, shapes, strict=True):
        shape.mat(solid.name or "body")
    return occ.Glue(shapes) if len(shapes) > 1 else shapes[0]


def with_casting(mold: Mold, geometry: Geometry, drawn: Cast, cast: Cast, settings: MoldSettings) -> Mold:
    """Add the drafted part to a mold, as one that can be computed, and how it differs from the drawn one.

    Parameters
    ----------
    mold : Mold
    geometry : Geometry
        The part with its regions.
    drawn, cast : Cast
        It without and with draft.
    settings : MoldSettings
    """
    shape = _with_regions(cast.body, geometry)
    with TemporaryDirectory() as folder:
        file = Path(folder) / "casting.step"
        with captured_output():  # the kernel reports the transfer on the terminal
            shape.WriteStep(str(file))
        casting = read_cad(file, axes=("x", "y", "z"))
    title = f"{geometry.name} with a draft of {settings.draft / deg:.4g}°"
    lines, findings = _compared(drawn, cast, settings)
    return replace(mold, notes=(*mold.notes, *lines), casting=replace(casting, name=title, file=""), findings=findings)


def _compared(drawn: Cast, cast: Cast, settings: MoldSettings) -> tuple[list[str], tuple[Finding, ...]]:
    """Say how the cast part differs from the drawn one, and find walls that have become too thin (D09)."""
    angle = f"{settings.draft / deg:.4g}°"
    bodies = drawn.body, cast.body
    facets = [find_facets(body, list(dict.fromkeys(body.faces))) for body in bodies]
    walls = [smallest_wall(each) * METERS_PER_CAD_UNIT for each in facets]
    volumes = [volume(body) for body in bodies]
    cavities = [sum(volume(filling) for filling in each.fillings) for each in (drawn, cast)]
    changes = ["the part has " + _change(volumes), *(["its cavities have " + _change(cavities)] if cavities[0] else [])]
    lines = [
        f"With a draft of {angle} {' and '.join(changes)}; "
        f"its thinnest wall has {walls[1] / mm:.3g} mm instead of {walls[0] / mm:.3g} mm."
    ]
    pairs = [pair for pair in (volumes, cavities, walls) if pair[0] > 0]
    if max(abs(after / before - 1) for before, after in pairs) > MATTERS:
        lines.append(f"A volume or a wall changes by more than {MATTERS:.0%}: compute the casting, too.")
    return lines, _thin(walls, settings, angle)


def _change(volumes: list[float]) -> str:
    before, after = (each / mm**3 for each in volumes)
    return f"{after:.5g} mm³ instead of {before:.5g} mm³ ({after / before - 1:+.1%})"


def _thin(walls: list[float], settings: MoldSettings, angle: str) -> tuple[Finding, ...]:
    before, after = walls
    if after >= settings.smallest_wall or after >= before * (1 - MATTERS):
        return ()
    return (
        Finding(
            code="D09",
            severity=Severity.WARNING,
            message=f"A draft of {angle} leaves a wall of {after / mm:.3g} mm where {before / mm:.3g} mm were "
            f"drawn; smallest_wall is {settings.smallest_wall / mm:.3g} mm.",
            advice="Draw the wall thicker at its thin end, or state a smaller draft.",
        ),
    )
