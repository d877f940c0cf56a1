"""Plane sections: faces whose nodes move along the normal by the same amount."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Section:
    """A face that stays plane.

    Parameters
    ----------
    face : str
    nodes : (k,) int array
        Its nodes. The first one leads.
    axis : int
        Number of the axis along its normal.
    """

    face: str
    nodes: Ints
    axis: int

    @property
    def leader(self) -> int:
        """The node whose component along the normal is that of all."""
        return int(self.nodes[0])

    def check(self, mask: NDArray[np.bool_]) -> None:
        """Refuse a section of which some nodes are fixed along its normal already."""
        count = int(mask[self.nodes, self.axis].sum())
        if count:
            raise TurgorError(
                f"PlaneSection of '{self.face}': {count} of its {len(self.nodes)} nodes are fixed along "
                f"{'xyz'[self.axis]} by another support, so that it cannot move; remove one of both."
            )

    def check_across(self, nodes: Ints, normals: Array) -> None:
        """Refuse a section that meets a face whose radius is fixed along an axis other than the section's normal."""
        meet = np.isin(nodes, self.nodes)
        if (np.abs(normals[meet, self.axis]) > ROUND_OFF.mesh_digits).any():
            raise TurgorError(
                f"PlaneSection of '{self.face}': it meets a face that Radial holds; the axis of the cylinder must be "
                f"{'xyz'[self.axis]}, the normal of the section."
            )


def plane_sections(model: Model) -> tuple[Section, ...]:
    """Find the plane sections of a model.

    Raises
    ------
    TurgorError
        If a face is no coordinate plane, or two sections with the same normal share nodes.
    """
    sections: list[Section] = []
    for support in model.supports:
        axis = support.section_axis(model.mesh)
        if axis is None:
            continue
        section = Section(support.place, model.mesh.face_nodes(support.place), axis)
        for other in sections:
            if other.axis == axis and np.intersect1d(other.nodes, section.nodes).size:
                raise TurgorError(f"PlaneSection of '{section.face}': it shares nodes with '{other.face}'; keep one.")
        sections.append(section)
    return tuple(sections)
