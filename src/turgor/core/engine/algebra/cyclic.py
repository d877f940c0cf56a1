"""Cyclic constraints: the higher cut face of a wedge moves as the lower one does, turned by the angle of the wedge.

A node of the higher face gets the directions of its partner, turned. Its components along them are then equal to those
of its partner, and it follows with weights of one (`turgor.core.engine.algebra.multipoint`). A node on the axis is its
own partner: u = R u leaves only the component along the axis.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.multipoint import MultiPoint
from turgor.core.engine.algebra.node_frames import NodeFrames
from turgor.core.engine.algebra.sections import Section
from turgor.core.engine.points.point_unknowns import Carrier
from turgor.core.geometry.wedge import HIGH, LOW, Wedge
from turgor.core.meshing.mesh import Mesh
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CyclicPairs:
    """Nodes of the cut faces of a wedge.

    Parameters
    ----------
    wedge : Wedge
    low, high : (k,) int arrays
        Partners off the axis.
    on_axis : (m,) int array
        Nodes on the axis, those of reference points among them.
    """

    wedge: Wedge
    low: Ints
    high: Ints
    on_axis: Ints

    @staticmethod
    def of(mesh: Mesh, carriers: Sequence[Carrier]) -> "CyclicPairs":
        """Pair the nodes of a mesh with a wedge; those of rigid faces follow their reference points instead."""
        assert mesh.wedge is not None
        rigid = np.concatenate([np.zeros(0, dtype=np.int64), *(each.nodes for each in carriers if each.rigid)])
        points = np.array([each.node for each in carriers], dtype=np.int64)
        leaders = mesh.leaders
        high = np.flatnonzero(leaders != np.arange(len(leaders)))
        high = high[~np.isin(high, rigid)]
        axis = np.intersect1d(mesh.face_nodes(LOW), mesh.face_nodes(HIGH))
        return CyclicPairs(
            wedge=mesh.wedge, low=leaders[high], high=high, on_axis=np.append(np.setdiff1d(axis, rigid), points)
        )

    def check_alike(self, mask: Bools) -> None:
        """Refuse supports (n, 3) that hold one of the two directions across the axis where a cut face meets them."""
        across = list(self.wedge.across)
        for nodes in (self.low, self.high):
            if (mask[nodes][:, across].sum(axis=1) == 1).any():
                b, c = ("xyz"[i] for i in across)
                raise TurgorError(
                    f"a support holds a face along {b} or {c} alone, which is not the same after a turn about "
                    f"{self.wedge.axis}; hold both, hold neither, or model the whole part."
                )

    def check_sections(self, sections: tuple[Section, ...]) -> None:
        """Refuse plane sections that are not across the axis."""
        for section in sections:
            if section.axis != self.wedge.number:
                raise TurgorError(
                    f"PlaneSection of '{section.face}': its normal must be the axis {self.wedge.axis} of the wedge."
                )

    def frames(self, frames: NodeFrames, normals: Array, count: int) -> tuple[NodeFrames, Array]:
        """Directions of the nodes with those of the higher face, and the normals (k, 3) that are prescribed there.

        Parameters
        ----------
        frames : NodeFrames
            Those without the wedge.
        normals : (j, 3) array
            Directions that are prescribed besides the axes, at the nodes of ``frames``.
        count : int
            Number of nodes.
        """
        turn = self.wedge.turn()
        axes, directions = np.tile(np.eye(3), (count, 1, 1)), np.zeros((count, 3))
        axes[frames.nodes], directions[frames.nodes] = frames.axes, normals
        axes[self.high] = axes[self.low] @ turn.T
        directions[self.high] = directions[self.low] @ turn.T
        nodes = np.union1d(frames.nodes, self.high)
        return NodeFrames(nodes, axes[nodes]), directions[nodes]

    def ties(self, extra: MultiPoint, count: int) -> MultiPoint:
        """Tie the components of the higher face to those of the lower one, on top of other ties of weight one."""
        to = np.arange(3 * count)
        to[extra.followers] = extra.leaders
        components = np.arange(3)
        to[3 * self.high[:, None] + components] = to[3 * self.low[:, None] + components]
        followers = np.flatnonzero(to != np.arange(3 * count))
        return MultiPoint(followers, to[followers], np.ones(len(followers)))

    def check_moved(self, values: Array, moved: Ints, face: str) -> None:
        """Refuse prescribed components (n, 3) along the directions of the nodes that the two faces do not share."""
        largest = float(np.abs(values[moved]).max(initial=0.0))
        chosen = np.isin(self.high, moved)
        apart = np.abs(values[self.high[chosen]] - values[self.low[chosen]]).max(initial=0.0)
        off_axis = np.abs(values[np.intersect1d(self.on_axis, moved)][:, list(self.wedge.across)]).max(initial=0.0)
        if max(float(apart), float(off_axis)) > 1e-6 * largest:
            raise TurgorError(
                f"Displacement of '{face}': it is not the same after a turn about {self.wedge.axis} by 1/"
                f"{self.wedge.fold}, as it must be of a wedge; move the face along that axis or turn it about it, or "
                "model the whole part."
            )
