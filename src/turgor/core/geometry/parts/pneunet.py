"""Common parts of all PneuNets: rules for their ends, clamped block, air inlet, and names of their faces."""

from collections.abc import Callable, Mapping, Sequence
from math import pi
from typing import Any, Protocol

from turgor.core.geometry import occ
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.geometry import Geometry, check_volume
from turgor.core.geometry.parts.plates import wire
from turgor.core.geometry.rules import MOST_CHAMBERS, SMALLEST_LENGTH, check_count, check_fields, check_length, in_mm
from turgor.core.geometry.shapes.solids import (
    Range,
    box,
    cut,
    face_names,
    in_plane,
    name_plane,
    name_rest,
    region_names,
    volume,
)
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.units import m, mm

_OPEN = Finding(
    code="G12",
    severity=Severity.NOTE,
    message="The chambers are open at the bottom, where the base closes them; the face 'strain_limiting_layer' ends at "
    "their walls.",
    advice="A sheet on that face does not reach over the chambers: give the base the material of the sheet and its "
    "thickness, or a floor of 0.01 mm or more.",
)


class Part(Protocol):
    """Interface of a part for the air inlet and the mirror plane."""

    @property
    def inlet_diameter(self) -> float:
        """Diameter of the air inlet [m]."""

    @property
    def symmetric(self) -> bool:
        """Whether only the half with y >= 0 is modeled."""


class PneuNet(Part, Protocol):
    """Interface of a family for names and checks."""

    @property
    def chambers(self) -> int:
        """Number of chambers."""

    @property
    def length(self) -> float:
        """Length without the clamped block [m]."""

    @property
    def clamp_length(self) -> float:
        """Length of the clamped block before the chambers [m]."""

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of each cavity of the modeled part [m³]."""

    @property
    def solid_volume(self) -> float:
        """Volume of the silicone of the modeled part [m³]."""


def check_envelope(actuator: PneuNet, sizes: tuple[str, ...] = ("length", "width", "height")) -> None:
    """Raise an error for fields that are not numbers, or a number of chambers or outer dimensions out of range."""
    check_count("chambers", actuator.chambers, low=1, high=MOST_CHAMBERS)
    check_fields(actuator)
    for name in sizes:
        check_length(name, getattr(actuator, name), low=1 * mm, high=2 * m)
    check_length("clamp_length", actuator.clamp_length, low=0.0, high=2 * m)


def check_inlet(part: Part, width: float, height: float) -> None:
    """Raise an error for an air inlet that does not fit into the first chamber, of inner ``width`` and ``height`` [m].

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> check_inlet(FastPneuNet(inlet_diameter=5e-3), width=8e-3, height=4e-3)
    Traceback (most recent call last):
    turgor.TurgorError: inlet_diameter is 5 mm; allowed is 0 mm to 3.99 mm, less than the chamber, \
8 mm x 4 mm inside.
    """
    high, why = min(width, height) - SMALLEST_LENGTH, f"less than the chamber, {in_mm(width)} x {in_mm(height)} inside"
    check_length("inlet_diameter", part.inlet_diameter, low=0.0, high=high, why=why)


def check_base(base: float, *, high: float, why: str) -> None:
    """Raise an error for a base that is neither left out (0) nor between the smallest length and ``high`` [m].

    Examples
    --------
    >>> check_base(0.0, high=1e-3, why="")
    >>> check_base(2e-3, high=1e-3, why="0 leaves it out")
    Traceback (most recent call last):
    turgor.TurgorError: base is 2 mm; allowed is 0.01 mm to 1 mm, 0 leaves it out.
    """
    if base:
        check_length("base", base, high=high, why=why)


def check_floor(floor: float, base: float | None, *, high: float, why: str) -> None:
    """Raise an error for a floor out of range [m]; 0 leaves the chambers open at the bottom, and a base closes them.

    Examples
    --------
    >>> check_floor(0.0, 1e-3, high=1e-3, why="")
    >>> check_floor(0.0, 0.0, high=1e-3, why="")
    Traceback (most recent call last):
    turgor.TurgorError: floor is 0 mm and base is 0 mm: nothing closes the chambers at the bottom. Give a \
base, which may be as thin as a film and of another material, or a floor.
    """
    if floor == 0 and base:
        return
    if floor == 0 and base is not None:
        raise TurgorError(
            "floor is 0 mm and base is 0 mm: nothing closes the chambers at the bottom. Give a base, which may be as "
            "thin as a film and of another material, or a floor."
        )
    check_length("floor", floor, high=high, why=why)


def with_base(body: Any, base: float, slab: Callable[[Range], Any]) -> list[tuple[str, Any]]:
    """Return the body, and below it the base, made by ``slab`` from its range along z [m], with their regions."""
    return [("body", body), *([("base", slab((0.0, base)))] if base else [])]


def across(part: Part, width: float) -> Range:
    """Range along y of a part as wide as ``width`` [m] in the middle of the modeled part.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> across(FastPneuNet(), 2e-3), across(FastPneuNet(symmetric=False), 2e-3)
    ((0.0, 0.001), (-0.001, 0.001))
    """
    return (0.0 if part.symmetric else -width / 2, width / 2)


def copies(part: Part) -> int:
    """Return how often the modeled part is contained in the whole."""
    return 2 if part.symmetric else 1


def inlet(diameter: float, end: float, height: float, half: bool) -> Any:
    """The air duct along x from the plane x = 0 to ``end``, in the middle at ``height`` [m]."""
    scale = METERS_PER_CAD_UNIT
    duct = occ.Cylinder(occ.Pnt(0, 0, height / scale), occ.X, r=diameter / 2 / scale, h=end / scale)
    return duct * box((0, end), (0, diameter), (height - diameter, height + diameter)) if half else duct


def inlet_volume(part: Part, end: float) -> float:
    """Volume of the air duct from the plane x = 0 to ``end`` [m³], of the modeled part.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> round(inlet_volume(FastPneuNet(inlet_diameter=2e-3), 10e-3) * 1e9, 3)  # mm³, of the half
    15.708
    """
    return pi / 4 * part.inlet_diameter**2 * end / copies(part)


def finished(
    actuator: PneuNet, title: str, blocks: Sequence[tuple[str, Any]], cavities: Mapping[str, Any], layer: float
) -> Geometry:
    """Cut the cavities out of the blocks, join these, check their volumes and name regions and faces.

    Parameters
    ----------
    actuator : PneuNet
        The dimensions.
    title : str
        Title of the geometry.
    blocks : sequence of (str, shape)
        Solids with their regions, the cavities still filled; a region may have several.
    cavities : mapping of str to shape
        The insides by the name of their walls; a duct reaches the plane x = 0.
    layer : float [m]
        Height of the strain-limiting layer.

    Raises
    ------
    TurgorError
        If the CAD volumes are not those of the dimensions.
    """
    for name, inside in cavities.items():
        inside.faces.name = name
        check_volume(name, volume(inside), actuator.cavity_volumes[name])
    solids = []
    for region, block in blocks:
        for solid in cut(block, list(cavities.values())).solids:
            solid.mat(region)
            solids.append(solid)
    is_open = any(in_plane(face, 2, layer) for inside in cavities.values() for face in inside.faces)
    shape = occ.Glue([*solids, *_end_of_clamp(actuator, blocks)])
    check_volume("solid", volume(shape), actuator.solid_volume)
    _name_faces(actuator, shape, layer)
    return Geometry(
        name=f"{title}, {actuator.chambers} chamber{'s' * (actuator.chambers > 1)}{', half' * actuator.symmetric}",
        smallest_wall=actuator.smallest_wall,
        cavity_volumes=actuator.cavity_volumes,
        solid_volume=actuator.solid_volume,
        regions=region_names(shape),
        faces=face_names(shape),
        findings=(_OPEN,) if is_open else (),
        shape=shape,
    )


def _end_of_clamp(actuator: PneuNet, blocks: Sequence[tuple[str, Any]]) -> list[Any]:
    """The line around the outside where the clamped block ends, so that its sides are faces of their own."""
    if not actuator.clamp_length:
        return []
    x, scale = actuator.clamp_length, METERS_PER_CAD_UNIT
    slices = [block * box((x / 4, x / 2), (-10 * m, 10 * m), (-10 * m, 10 * m)) for _, block in blocks]
    corners = [vertex.p for piece in slices for vertex in piece.vertices]  # exact, which bounding boxes are not
    y = max(corner[1] for corner in corners) * scale
    low, high = min(corner[2] for corner in corners) * scale, max(corner[2] for corner in corners) * scale
    if actuator.symmetric:
        return [wire([(x, 0, low), (x, y, low), (x, y, high), (x, 0, high)])]
    return [wire([(x, -y, low), (x, y, low), (x, y, high), (x, -y, high), (x, -y, low)])]


def _name_faces(actuator: PneuNet, shape: Any, layer: float) -> None:
    end = actuator.clamp_length
    name_plane(shape, 0, 0.0, "fixed")
    name_plane(shape, 0, end + actuator.length, "tip")
    # a base that only touches the cavity of open chambers got its name there when the cavity was cut out of it
    name_plane(shape, 2, layer, "strain_limiting_layer", keep=actuator.cavity_volumes)
    if actuator.symmetric:
        name_plane(shape, 1, 0.0, "symmetry_y")
    for face in shape.faces:
        if not face.name and face.bounding_box[1][0] <= end / METERS_PER_CAD_UNIT + TOLERANCE.length:
            face.name = "fixed"
    name_rest(shape, "outside")
