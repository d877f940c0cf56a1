"""Shapes that are hard to mesh with curved cells: fillets and an inlet, narrow slots, thin curved walls."""

from typing import Any

from netgen.occ import Box, Cylinder, Pnt, X, Z

from turgor.core.geometry.geometry import Geometry
from turgor.units import mm


def named(shape: Any, name: str, wall: float) -> Geometry:
    """A body whose faces without a name are outside."""
    shape.mat("body")
    for face in shape.faces:
        if not face.name:
            face.name = "outside"
    shape.faces.Min(X).name = "fixed"
    return Geometry(
        name=name,
        smallest_wall=wall * mm,
        cavity_volumes={},
        solid_volume=shape.mass * mm**3,
        regions=("body",),
        faces=tuple(sorted({face.name for face in shape.faces})),
        shape=shape,
    )


def filleted_pneunet(fillet: float = 1.0) -> Geometry:
    """Two chambers with a gap, rounded upper edges and an air inlet of 3 mm that meets the floor of the cavity."""
    body = Box(Pnt(0, 0, 0), Pnt(22, 18, 18)) - Box(Pnt(10, -1, 4), Pnt(12, 19, 19))
    cavity = Box(Pnt(2, 2, 2), Pnt(8, 16, 16)) + Box(Pnt(14, 2, 2), Pnt(20, 16, 16)) + Box(Pnt(3, 8, 2), Pnt(19, 10, 4))
    cavity += Cylinder(Pnt(-1, 9, 3.6), X, 1.5, 5)
    cavity.faces.name = "cavity"
    shape = body - cavity
    across = [e for e in shape.edges if abs(e.center.z - 18) < 1e-6 and abs(e.center.y - 9) < 1e-6]
    return named(shape.MakeFillet(across, fillet), "PneuNet with fillets", 2)


def slotted_block() -> Geometry:
    """A block with a round-ended slot 1 mm wide."""
    slot = (
        Box(Pnt(5, 4.5, -1), Pnt(15, 5.5, 7)) + Cylinder(Pnt(5, 5, -1), Z, 0.5, 8) + Cylinder(Pnt(15, 5, -1), Z, 0.5, 8)
    )
    return named(Box(Pnt(0, 0, 0), Pnt(20, 10, 6)) - slot, "slotted block", 4)


def thin_tube() -> Geometry:
    """Half a tube of 5 mm radius with a wall of 0.5 mm."""
    ring = Cylinder(Pnt(0, 0, 0), X, 5, 8) - Cylinder(Pnt(0, 0, 0), X, 4.5, 8)
    shape = ring - Box(Pnt(-1, -9, -9), Pnt(9, 0, 9))
    for face in shape.faces:
        if abs(face.center.y) < 1e-6:
            face.name = "symmetry_y"
    return named(shape, "thin tube", 0.5)


def thin_roof() -> Geometry:
    """A box with walls of 5 mm whose roof is 0.5 mm thin over a part."""
    inside = Box(Pnt(10, 5, 5), Pnt(50, 15, 15)) + Box(Pnt(20, 5, 14), Pnt(30, 15, 19.5))
    inside.faces.name = "cavity"
    return named(Box(Pnt(0, 0, 0), Pnt(60, 20, 20)) - inside, "thin roof", 0.5)
