"""Geometry: solids with named regions and faces."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from typing import Any

from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.extrusion import Sweep
from turgor.core.geometry.names import cavity_names
from turgor.core.geometry.packing import PackedShape, packed
from turgor.core.geometry.shapes.lazy_shape import LateShape
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.geometry.wedge import Wedge
from turgor.foundation.display import Shown, listed
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding
from turgor.units import mL, mm


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Geometry(Shown):
    """The modeled part as a CAD shape with named regions and faces.

    The volumes are computed from the dimensions, not from the CAD shape, so that each can check the other. All of them
    are those of the modeled part, such as one half of a symmetric actuator.

    Parameters
    ----------
    name : str
        Title of the geometry, for reports.
    smallest_wall : float [m]
        Thickness of the thinnest wall; it limits the mesh size.
    cavity_volumes : mapping of str to float [m³]
        Volume of each cavity by the name of its face, from the dimensions; empty without cavities.
    solid_volume : float [m³]
        Volume of all solids, from the dimensions.
    regions : tuple of str
        Names of the solids.
    faces : tuple of str
        Names of the faces.
    length_scale : float [m]
        Length of one CAD unit: 1 mm, because CAD tolerances are absolute. Everything public is in meters.
    findings : tuple of Finding
        Findings of the import of a CAD file.
    file : str
        CAD file that the shape comes from, if it comes from one: such a shape is meshed in a child process
        (`turgor.core.geometry.child_process`), because it may crash the mesh generator.
    node_sets : tuple of str
        Names of the sets of nodes of a mesh file that are no faces.
    wedge : Wedge, optional
        The sector of the whole that it is, where it is one; its cut faces are ``cyclic_low`` and ``cyclic_high``.
    shape : netgen.occ.TopoDS_Shape
        CAD shape, whose solids and faces bear the names of regions and faces.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> part = FastPneuNet(chambers=2, length=20e-3).build()
    >>> part
    Geometry('fast PneuNet, 2 chambers, half', 20 × 10 × 15 mm, thinnest wall 1 mm, cavity 1.049 mL, \
regions: body, base, faces: cavity, fixed, outside, strain_limiting_layer, symmetry_y, tip)
    >>> part.regions
    ('body', 'base')
    >>> round(part.cavity_volume * 1e9, 1)  # mm³, of the half with y >= 0
    1049.0
    """

    name: str
    smallest_wall: float
    cavity_volumes: Mapping[str, float]
    solid_volume: float
    regions: tuple[str, ...]
    faces: tuple[str, ...]
    length_scale: float = METERS_PER_CAD_UNIT
    findings: tuple[Finding, ...] = ()
    file: str = ""
    node_sets: tuple[str, ...] = ()
    wedge: Wedge | None = None
    shape: Any = field(repr=False)
    _sweep: Sweep | None = field(default=None, repr=False)

    def __repr__(self) -> str:
        size = " × ".join(f"{(b - a) / mm:.4g}" for a, b in zip(*self.bounds, strict=True))
        cavities = "".join(f", {name} {volume / mL:.4g} mL" for name, volume in self.cavity_volumes.items())
        return (
            f"Geometry('{self.name}', {size} mm, thinnest wall {self.smallest_wall / mm:.4g} mm{cavities}, "
            f"regions: {listed(self.regions)}, faces: {listed(self.faces)})"
        )

    @property
    def cavities(self) -> tuple[str, ...]:
        """Names of the faces that enclose a cavity, in the order of their numbers."""
        return cavity_names(self.cavity_volumes)

    @property
    def cavity_volume(self) -> float:
        """Volume of all cavities together [m³]."""
        return sum(self.cavity_volumes.values())

    @property
    def _cad(self) -> Any:
        """The CAD shape; it is made now where the geometry was found on disk."""
        return self.shape.shape() if isinstance(self.shape, LateShape) else self.shape

    @property
    def bounds(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """Lowest and highest corner of the bounding box [m]."""
        low, high = self.shape.bounding_box
        scale = self.length_scale
        return (low[0] * scale, low[1] * scale, low[2] * scale), (high[0] * scale, high[1] * scale, high[2] * scale)

    @property
    def extent(self) -> float:
        """Longest side of the bounding box [m]."""
        low, high = self.bounds
        return max(b - a for a, b in zip(low, high, strict=True))

    def __reduce__(self) -> tuple[Callable[..., "Geometry"], tuple[dict[str, Any]]]:
        values = {item.name: getattr(self, item.name) for item in fields(self)}
        if hasattr(self.shape, "WriteBrep"):  # what comes from a mesh file has no CAD shape
            values["shape"] = packed(self.shape)
        return _unpacked, (values | {"cavity_volumes": dict(self.cavity_volumes)},)


def _unpacked(values: dict[str, Any]) -> Geometry:
    shape = values["shape"]
    return Geometry(**(values | {"shape": shape.shape() if isinstance(shape, PackedShape) else shape}))


def check_volume(what: str, measured: float, expected: float) -> None:
    """Raise an error for a CAD volume that differs from the one of the dimensions.

    Parameters
    ----------
    what : str
        Name of the volume, for the message.
    measured : float [m³]
        Volume of the CAD shape.
    expected : float [m³]
        Volume computed from the dimensions.

    Raises
    ------
    TurgorError
        If they differ by more than round-off and the kernel leave.

    Examples
    --------
    >>> check_volume("cavity", 1.1e-6, 1.0e-6)
    Traceback (most recent call last):
    turgor.TurgorError: the CAD volume of the cavity is 1100 mm³, but the dimensions give 1000 mm³; \
this is a mistake in building the shape, please report it with the dimensions.
    """
    if not abs(measured - expected) <= TOLERANCE.built_volume * expected:
        raise TurgorError(
            f"the CAD volume of the {what} is {measured * 1e9:.12g} mm³, but the dimensions give "
            f"{expected * 1e9:.12g} mm³; this is a mistake in building the shape, please report it with the dimensions."
        )
