"""Radial: a cylindrical face that keeps its radius."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from turgor.core.geometry.directions import AXES
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.loads.load import Deck
from turgor.core.model.supports.support import Array, Ints, Support
from turgor.foundation.errors import TurgorError
from turgor.units import mm

#: Largest distance of a node from the cylinder that its face should be, as a share of the radius.
ROUND = 1e-3


@dataclass(frozen=True, slots=True)
class Radial(Support):
    """Hold the radius of a cylindrical face: no displacement normal to the face; it may slide in the face.

    A dense winding of inextensible hoops does the same: the face keeps its radius, whatever the pressure, and is free
    to stretch along the axis and to turn about it.

    Parameters
    ----------
    face : str
        Name of a face that lies on one cylinder, or on a half or a quarter of it.
    axis : (3,) floats
        Direction of the axis of the cylinder; where it lies is found from the face.
    """

    face: str
    axis: tuple[float, float, float] = (1.0, 0.0, 0.0)

    in_sections = True
    job_texts: ClassVar[Mapping[str, Mapping[str, Any]]] = {
        "radial": {"axis": AXES["x"]},
        "radial about y": {"axis": AXES["y"]},
        "radial about z": {"axis": AXES["z"]},
    }

    def text(self) -> str:
        """Return the sentence of a report."""
        return f"{self.face} does not move radially, around the axis {self.axis}."

    def boundary_rows(self, deck: Deck) -> tuple[str, ...]:
        """No row: the directions of all radii are equations in the file."""
        return ()

    def normals(self, mesh: Mesh) -> tuple[Ints, Array]:
        """Return the normals of the cylinder on which the face lies; its center comes from a fit of a circle."""
        nodes = mesh.face_nodes(self.face)
        points = mesh.points[nodes]
        axis = np.asarray(self.axis, dtype=np.float64)
        if not np.linalg.norm(axis) > 0:
            raise TurgorError(f"Radial of '{self.face}': axis is a zero vector; give for example (1, 0, 0).")
        axis /= np.linalg.norm(axis)
        across = np.linalg.svd(axis[None])[2][1:]  # two unit vectors across the axis
        flat = points @ across.T
        middle = flat.mean(axis=0)
        terms = np.column_stack([2 * (flat - middle), np.ones(len(flat))])
        solved = np.linalg.lstsq(terms, ((flat - middle) ** 2).sum(axis=1), rcond=None)[0]
        arm = flat - middle - solved[:2]
        radii = np.linalg.norm(arm, axis=1)
        radius = float(radii.mean())
        off = float(np.abs(radii - radius).max())
        if off > ROUND * radius:
            raise TurgorError(
                f"Radial of '{self.face}': a node lies {off / mm:.3g} mm off the cylinder around {self.axis} "
                f"that fits best, of radius {radius / mm:.4g} mm; the face must be that of one cylinder."
            )
        return nodes, np.asarray((arm / radii[:, None]) @ across)
