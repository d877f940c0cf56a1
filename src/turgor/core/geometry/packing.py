"""CAD shapes as bytes, so that they can travel from one process to another."""

from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from turgor.core.geometry import occ


@dataclass(frozen=True, slots=True, kw_only=True)
class PackedShape:
    """A CAD shape as text of the kernel's own format, which keeps no names, and the names.

    Parameters
    ----------
    brep : bytes
        The shape.
    faces, solids : tuple of str
        Name of each, in the order of the shape.
    """

    brep: bytes
    faces: tuple[str | None, ...]
    solids: tuple[str | None, ...]

    def shape(self) -> Any:
        """Make the shape with its names."""
        with TemporaryDirectory() as folder:
            path = Path(folder) / "shape.brep"
            path.write_bytes(self.brep)
            shape = occ.OCCGeometry(str(path)).shape
        for parts, names in ((shape.faces, self.faces), (shape.solids, self.solids)):
            for part, name in zip(parts, names, strict=True):
                if name is not None:
                    part.name = name
        return shape


def packed(shape: Any) -> PackedShape:
    """Pack a CAD shape.

    Parameters
    ----------
    shape : CAD shape

    Returns
    -------
    PackedShape

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> finger = FastPneuNet(chambers=2, length=20e-3).build()
    >>> again = packed(finger.shape).shape()
    >>> [face.name for face in again.faces] == [face.name for face in finger.shape.faces]
    True
    """
    with TemporaryDirectory() as folder:
        path = Path(folder) / "shape.brep"
        shape.WriteBrep(str(path))
        brep = path.read_bytes()
    return PackedShape(
        brep=brep,
        faces=tuple(face.name for face in shape.faces),
        solids=tuple(solid.name for solid in shape.solids),
    )
