"""Casting mold of a PneuNet, as parts for 3-D printing."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import pi
from typing import Any

from turgor.core.geometry import occ
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.actuators.slow_pneunet import SlowPneuNet
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.geometry import Geometry, check_volume
from turgor.core.geometry.molds.drafted import Cast, filled_part, with_casting, with_drafts
from turgor.core.geometry.molds.mold import Mold, MoldSettings, mold_part
from turgor.core.geometry.molds.taper.pull import Pull
from turgor.core.geometry.shapes.solids import box, cut, union, volume

#: How it is cast.
NOTES = (
    "Cup and core part at the floor of the cavity and are pulled along z. Fill the cup and press the core in.",
    "Cast the floor and the base in the tray, with the paper in it, and glue them on; a tube makes the air inlet.",
)

#: What is said of walls without draft.
UPRIGHT = (
    "The walls of the cup and of the core lie along the pull and have no draft: use a release agent, or state one."
)


@dataclass(frozen=True, slots=True)
class _Sizes:
    """Outer dimensions of the casting [m]."""

    length: float
    width: float
    floor_top: float
    height: float


def pneunet_mold(actuator: FastPneuNet | SlowPneuNet, mold: MoldSettings) -> Mold:
    """Make the mold of a PneuNet: two parts for the chambers, and a tray for the layer that closes them.

    The parting plane is the floor of the cavity, the only plane from which both the chambers and the gaps between them
    can be pulled. The cup forms the outside of the chambers, the core plate the inside; both come off along z without
    an undercut. The floor and the base with the strain-limiting layer are cast in the tray and glued on. A tube forms
    the air inlet and the hole of the clamped block.

    Parameters
    ----------
    actuator : FastPneuNet or SlowPneuNet
        Actuator to cast; a half model is cast as a whole.
    mold : MoldSettings
        Dimensions of the mold.

    Returns
    -------
    Mold
        ``cup``, ``core`` and ``tray``.
    """
    whole = replace(actuator, symmetric=False, inlet_diameter=0.0)
    built = whole.build()
    sizes = _Sizes(
        length=whole.clamp_length + whole.length,
        width=whole.width,
        floor_top=whole.base + whole.floor,
        height=whole.height,
    )
    cavity, gaps = _air(built, sizes)
    check_volume("core", volume(cavity), built.cavity_volume)
    filled = _envelope(sizes, sizes.floor_top, sizes.height)
    casting = cut(filled, gaps) if gaps else filled
    drawn = _Cast(casting, cavity, _envelope(sizes, 0.0, sizes.floor_top))
    if not mold.draft:
        return Mold(parts=_parts(built, sizes, mold, drawn), notes=(*NOTES, UPRIGHT))
    height = sizes.floor_top / METERS_PER_CAD_UNIT
    as_drawn = Cast(filled=filled_part(union(list(built.shape.solids)), [cavity]), fillings=[cavity])
    pull = Pull(axis=2, side=1, height=height, draft=mold.draft)
    cast = with_drafts(as_drawn, pull, [pull])
    above = _envelope(sizes, sizes.floor_top, sizes.height)
    tapered = _Cast(cast.filled * above, cast.fillings[0], cast.filled - above)
    made = Mold(parts=_parts(built, sizes, mold, tapered), notes=NOTES)
    return with_casting(made, built, as_drawn, cast, mold)


@dataclass(frozen=True, slots=True)
class _Cast:
    """What is cast above the floor with its chambers filled, what fills them, and what is cast in the tray."""

    filled: Any
    cavity: Any
    slab: Any


def _parts(built: Geometry, sizes: _Sizes, mold: MoldSettings, cast: _Cast) -> dict[str, Geometry]:
    parts = {
        "cup": _cup(sizes, mold, cast.filled),
        "core": _core(sizes, mold, cast.cavity),
        "tray": _tray(sizes, mold, cast.slab),
    }
    _check(parts, sizes, mold, cast)
    titles = {name: f"{name} of the mold of a {built.name}" for name in parts}
    return {name: mold_part(titles[name], name, shape) for name, shape in parts.items()}


def _envelope(sizes: _Sizes, low: float, high: float, around: float = 0.0) -> Any:
    half = sizes.width / 2 + around
    return box((-around, sizes.length + around), (-half, half), (low, high))


def _air(built: Geometry, sizes: _Sizes) -> tuple[Any, list[Any]]:
    """Split the air above the floor into the cavity, which touches no side of the envelope, and the gaps."""
    air = _envelope(sizes, sizes.floor_top, sizes.height) - union(list(built.shape.solids))
    inside: list[Any] = []
    gaps: list[Any] = []
    for solid in air.solids:
        low, high = solid.bounding_box
        across = sizes.width / METERS_PER_CAD_UNIT / 2
        touches = min(high[1] - across, -across - low[1], key=abs)
        (gaps if abs(touches) < 1e-6 else inside).append(solid)
    return union(inside), gaps


def _pins(sizes: _Sizes, mold: MoldSettings, radius: float, height: float) -> list[Any]:
    """Four cylinders below the parting plane, in the corners of the rim."""
    scale, half = METERS_PER_CAD_UNIT, sizes.width / 2 + mold.wall / 2
    ends = (-mold.wall / 2, sizes.length + mold.wall / 2)
    low = (sizes.floor_top - height) / scale
    return [
        occ.Cylinder(occ.Pnt(x / scale, y / scale, low), occ.Z, r=radius / scale, h=height / scale)
        for x in ends
        for y in (-half, half)
    ]


def _cup(sizes: _Sizes, mold: MoldSettings, casting: Any) -> Any:
    block = _envelope(sizes, sizes.floor_top, sizes.height + mold.wall, mold.wall)
    return union([block - casting, *_pins(sizes, mold, mold.pin_diameter / 2, mold.pin_height)])


def _core(sizes: _Sizes, mold: MoldSettings, cavity: Any) -> Any:
    """A plate below the parting plane with the inside of the chambers on it."""
    plate = _envelope(sizes, sizes.floor_top - mold.wall, sizes.floor_top, mold.wall)
    deep = mold.pin_height + mold.clearance
    holes = _pins(sizes, mold, mold.pin_diameter / 2 + mold.clearance, deep)
    return union([cut(plate, holes), cavity])


def _tray(sizes: _Sizes, mold: MoldSettings, slab: Any) -> Any:
    """A flat tray for the floor and the base."""
    return _envelope(sizes, -mold.wall, sizes.floor_top, mold.wall) - slab


def _check(parts: Mapping[str, Any], sizes: _Sizes, mold: MoldSettings, cast: _Cast) -> None:
    """Compare the CAD volumes with those of the dimensions."""
    outer = (sizes.length + 2 * mold.wall) * (sizes.width + 2 * mold.wall)
    pins = pi * mold.pin_diameter**2 * mold.pin_height
    holes = pi * (mold.pin_diameter + 2 * mold.clearance) ** 2 * (mold.pin_height + mold.clearance)
    expected = {
        "cup": outer * (sizes.height + mold.wall - sizes.floor_top) - volume(cast.filled) + pins,
        "core": outer * mold.wall - holes + volume(cast.cavity),
        "tray": outer * (sizes.floor_top + mold.wall) - volume(cast.slab),
    }
    for name, shape in parts.items():
        check_volume(f"{name} of the mold", volume(shape), expected[name])
