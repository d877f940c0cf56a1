"""Layout: an actuator as prisms of silicone and air along x, for all tubes and benders."""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

from turgor.core.geometry import occ
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.extrusion import FaceName, PlaneName, RangeName
from turgor.core.geometry.geometry import Geometry, check_volume
from turgor.core.geometry.names import INTERFACE
from turgor.core.geometry.parts.ducts import Duct, top
from turgor.core.geometry.parts.prism import Prism as Prism
from turgor.core.geometry.rules import SMALLEST_LENGTH, as_length, check_length, check_option, in_mm
from turgor.core.geometry.shapes.sections import Outline, disc
from turgor.core.geometry.shapes.solids import (
    cut,
    face_names,
    name_plane,
    region_names,
    union,
    volume,
)
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.geometry.sweeps.prisms import layout_sweep
from turgor.foundation.errors import TurgorError


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """Prisms of silicone and of air that make an actuator.

    Parameters
    ----------
    title : str
        Name of the geometry, for reports.
    pieces : tuple of Prism
        Solids with filled cavities; they do not overlap.
    air : tuple of Prism
        The cavities, inside the pieces; they do not overlap.
    length : float [m]
        Position of the plane of the tip; the fixed end is at x = 0.
    clamp_length : float [m]
        Length of the solid block before the fixed end: the pieces that begin at x = 0 go on to x = −clamp_length.
    inlet_diameter : float [m]
        Diameter of the air inlet of each cavity; 0 for none.
    inlet_side : str
        ``"fixed"``: from the center of each cavity through the fixed end (and the block); ``"top"``: from the first
        cavity, close to the fixed end, straight up.
    layer : float or None [m]
        Height z of the face ``strain_limiting_layer``; None where there is none.
    mirrors : str
        Mirror planes that cut the modeled part: ``""``, ``"y"`` or ``"yz"``.
    smallest_wall : float [m]
        Thickness of the thinnest wall.
    """

    title: str
    pieces: tuple[Prism, ...]
    air: tuple[Prism, ...]
    length: float
    clamp_length: float = 0.0
    inlet_diameter: float = 0.0
    inlet_side: str = "fixed"
    layer: float | None = None
    mirrors: str = ""
    smallest_wall: float

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of each cavity of the modeled part [m³], up to the opening of the inlet, from the dimensions."""
        volumes: dict[str, float] = {}
        for part in self._air():
            volumes[part.name] = volumes.get(part.name, 0.0) + part.volume
        for duct in self._ducts():
            volumes[duct.name] += duct.volume / (2 if "y" in self.mirrors else 1)
        return volumes

    @property
    def solid_volume(self) -> float:
        """Volume of all regions of the modeled part [m³], from the dimensions."""
        return sum(piece.volume for piece in self._pieces()) - sum(self.cavity_volumes.values())

    def build(self) -> Geometry:
        """Build the solids, check their volumes and name regions and faces.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        shape = self._shape()
        self._name(shape)
        copies = {"": "", "y": ", half", "yz": ", quarter"}
        return Geometry(
            name=f"{self.title}{copies[self.mirrors]}",
            smallest_wall=self.smallest_wall,
            cavity_volumes=self.cavity_volumes,
            solid_volume=self.solid_volume,
            regions=region_names(shape),
            faces=face_names(shape),
            shape=shape,
            _sweep=None if self._ducts() else layout_sweep(self._pieces(), self._air(), self._face_names()),
        )

    def _shape(self) -> Any:
        """All regions, glued to each other; the faces that the air touches carry the name of its cavity."""
        filled = [piece.solid() for piece in self._pieces()]
        air = [(part.name, part.solid()) for part in self._air()]
        air += [(duct.name, duct.solid(filled, union([space for _, space in air]))) for duct in self._ducts()]
        for name, expected in self.cavity_volumes.items():
            check_volume(name, volume(union([solid for owner, solid in air if owner == name])), expected)
        solids = []
        for group in self._groups():
            solid = occ.Fuse([piece.solid() for piece in group]) if len(group) > 1 else group[0].solid()
            solid = cut(solid, [space for _, space in air])
            solid.mat(group[0].name)
            solids.append(solid)
        for name, solid in air:
            solid.mat(name)
        glued = occ.Glue([*solids, *(solid for _, solid in air)])
        for solid in glued.solids:
            if solid.name in self.cavity_volumes:
                solid.faces.name = solid.name
        shape = occ.Compound([solid for solid in glued.solids if solid.name not in self.cavity_volumes])
        check_volume("solid", volume(shape), self.solid_volume)
        return shape

    def _name(self, shape: Any) -> None:
        shared = [face for solid in shape.solids for face in solid.faces]
        for axis, plane in ((1, "symmetry_y"), (2, "symmetry_z")):
            if plane[-1] in self.mirrors:
                name_plane(shape, axis, 0.0, plane)
        for face in shape.faces:
            inner = shared.count(face) > 1
            low, high = face.bounding_box
            if not inner and (face.name or "").startswith(("cavity", "symmetry")):
                continue
            if inner and self.layer is not None and _in_plane(low[2], high[2], self.layer):
                face.name = "strain_limiting_layer"
            elif inner:
                face.name = face.name or INTERFACE
            elif _in_plane(low[0], high[0], self.length):
                face.name = "tip"
            elif high[0] <= TOLERANCE.length:
                face.name = "fixed"
            elif self.layer is not None and _in_plane(low[2], high[2], self.layer):
                face.name = "strain_limiting_layer"
            else:
                face.name = "outside"

    def _face_names(self) -> tuple[FaceName, ...]:
        """Rules for the names of faces of the sweep; the last rule that fits counts."""
        names: list[FaceName] = []
        if self.layer is not None:  # a layer that is the bottom ends at the block, which is fixed all around
            names.append(PlaneName(name="strain_limiting_layer", axis=2, position=self.layer, within=True))
        names.append(RangeName(name="fixed", axis=0, low=-self.clamp_length, high=0.0))
        names.append(PlaneName(name="tip", axis=0, position=self.length))
        for axis, letter in ((1, "y"), (2, "z")):
            if letter in self.mirrors:
                names.append(PlaneName(name=f"symmetry_{letter}", axis=axis, position=0.0))
        return tuple(names)

    def _groups(self) -> list[list[Prism]]:
        """The pieces, each with its continuation into the block."""
        pieces = self._pieces()
        ahead = [piece for piece in pieces if piece.along[1] <= 0.0]
        return [
            [piece, *(more for more in ahead if piece.along[0] == 0.0 and more.outline == piece.outline)]
            for piece in pieces
            if piece.along[1] > 0.0
        ]

    def _pieces(self) -> list[Prism]:
        pieces = list(self.pieces)
        if self.clamp_length:
            pieces += [
                replace(piece, along=(-self.clamp_length, 0.0)) for piece in self.pieces if piece.along[0] == 0.0
            ]
        return [self._cut(piece) for piece in pieces]

    def _air(self) -> list[Prism]:
        air = list(self.air)
        if self.inlet_diameter and self.inlet_side == "fixed":
            for part in self.air:
                duct = disc(self.inlet_diameter / 2, part.outline.centroid)
                air.append(Prism(name=part.name, outline=duct, along=(-self.clamp_length, part.along[0])))
        return [self._cut(part) for part in air]

    def _ducts(self) -> list[Duct]:
        """The inlet on top, its axis one diameter away from the fixed end of the cavity."""
        if not self.inlet_diameter or self.inlet_side != "top":
            return []
        first = self.air[0]
        x = first.along[0] + self.inlet_diameter
        above = max(
            (piece.outline for piece in self.pieces if piece.along[0] < x), key=lambda outline: top(outline, 0.0)
        )
        return [Duct(name=first.name, x=x, diameter=self.inlet_diameter, below=first.outline, above=above)]

    def _cut(self, part: Prism) -> Prism:
        return replace(part, outline=self._mirrored(part.outline), hole=part.hole and self._mirrored(part.hole))

    def _mirrored(self, outline: Outline) -> Outline:
        outline = outline.cut_y() if "y" in self.mirrors else outline
        return outline.cut_z() if "z" in self.mirrors else outline


def check_fields(actuator: Any) -> None:
    """Raise an error for a field that is not a length, a wrong ``length``, or a ``symmetric`` other than True or False.

    Parameters
    ----------
    actuator : dataclass
        An actuator with the field ``length``, and perhaps ``symmetric``.
    """
    symmetric = getattr(actuator, "symmetric", False)
    if not isinstance(symmetric, bool):
        raise TurgorError(f"symmetric is {symmetric!r}; allowed is True or False.")
    for item in fields(actuator):
        if item.type is float:
            as_length(item.name, getattr(actuator, item.name))
    check_length("length", actuator.length, low=1e-3, high=2.0)


def check_ends(actuator: Any, name: str) -> None:
    """Raise an error for end walls or a block that do not fit an actuator.

    Parameters
    ----------
    actuator : dataclass
        An actuator with the fields ``length``, ``clamp_length`` and the one named.
    name : str
        Field with the thickness of the ends: ``end_wall`` or ``cap``.
    """
    high = (actuator.length - SMALLEST_LENGTH) / 2
    check_length(name, getattr(actuator, name), high=high, why=f"so that a cavity remains in {in_mm(actuator.length)}")
    check_option("clamp_length", actuator.clamp_length, high=2.0)


def _in_plane(low: float, high: float, position: float) -> bool:
    """Whether a range of a coordinate [CAD units] is one position [m]."""
    return (
        max(abs(low - position / METERS_PER_CAD_UNIT), abs(high - position / METERS_PER_CAD_UNIT)) <= TOLERANCE.length
    )
