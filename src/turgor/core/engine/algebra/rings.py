"""Rings: nodes of a body of revolution at the same place of its meridian, which move alike.

With a radial, a tangential and an axial direction at every node, a state is axisymmetric if the tangential displacement
is zero, and the radial and the axial one are the same all around each ring. What is left are the degrees of freedom
of an axisymmetric model: two for each node of the meridian.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.multipoint import MultiPoint
from turgor.core.engine.algebra.node_frames import NodeFrames
from turgor.core.meshing.coinciding_points import same_places
from turgor.core.meshing.mesh import Mesh
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Directions of a node off the axis: radial, tangential, axial.
RADIAL, TANGENTIAL, AXIAL = 0, 1, 2


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Rings:
    """Rings of nodes about an axis.

    Parameters
    ----------
    axis : int
        Number of the axis.
    leader : (n,) int array
        The node of each node's ring that stands for all.
    axes : (n, 3, 3) array
        Radial, tangential and axial unit vector of each node, in rows.
    on_axis : (n,) bool array
        Nodes that stand for the axis: their radius is fixed.
    """

    axis: int
    leader: Ints
    axes: Array
    on_axis: NDArray[np.bool_]

    @property
    def frames(self) -> NodeFrames:
        """The directions of the nodes."""
        return NodeFrames(np.arange(len(self.leader)), self.axes)

    def local_mask(self, mask: NDArray[np.bool_], radial: Ints) -> NDArray[np.bool_]:
        """Which components (n, 3) along the directions of the nodes are prescribed.

        Parameters
        ----------
        mask : (n, 3) bool array
            Prescribed components along x, y and z.
        radial : (m,) int array
            Nodes whose radius is fixed.

        Raises
        ------
        TurgorError
            If one of the two directions across the axis is fixed and the other is free.
        """
        across = [i for i in range(3) if i != self.axis]
        one = mask[:, across].sum(axis=1) == 1
        one &= ~(mask & (np.abs(self.axes[:, TANGENTIAL]) > 1 - 1e-9)).any(axis=1)  # fixed by a mirror plane
        if one.any():
            raise TurgorError(
                f"a support holds a face along {'xyz'[across[0]]} or {'xyz'[across[1]]} alone, which is not the same "
                f"around the axis {'xyz'[self.axis]}; hold both, hold neither, or model the part with tetrahedra."
            )
        out = np.empty_like(mask)
        out[:, RADIAL] = mask[:, across].all(axis=1) | self.on_axis
        out[:, TANGENTIAL] = True
        out[:, AXIAL] = mask[:, self.axis]
        out[radial, RADIAL] = True
        np.logical_or.at(out, self.leader, out.copy())  # what is fixed at any node of a ring is fixed at its leader
        return np.asarray(out[self.leader])

    def ties(self, together: Sequence[tuple[Ints, int]], node_count: int) -> MultiPoint:
        """Tie the radial and axial components of each ring, and then the axial ones of some nodes.

        Parameters
        ----------
        together : sequence of ((k,) int array, int)
            Nodes that move along the axis alike, and the degree of freedom that they follow.
        node_count : int
            All nodes, those of reference points included.
        """
        count = 3 * node_count
        to = np.arange(count)
        nodes = np.flatnonzero(self.leader != np.arange(len(self.leader)))
        for component in (RADIAL, AXIAL):
            to[3 * nodes + component] = 3 * self.leader[nodes] + component
        followed = np.arange(count)
        for alike, leader in together:
            followed[to[3 * alike + AXIAL]] = to[leader]
        to = followed[to]
        followers = np.flatnonzero(to != np.arange(count))
        return MultiPoint(followers, to[followers], np.ones(len(followers)))


def rings_of(mesh: Mesh) -> Rings:
    """Find the rings of a quarter of a body of revolution.

    Parameters
    ----------
    mesh : Mesh
        With ``revolved``; the axis is where two of its mirror planes meet.

    Raises
    ------
    TurgorError
        If it lacks one of these planes.
    """
    axis, radius = "xyz".index(mesh.revolved), mesh.radii
    planes = dict(mesh.mirror_planes)
    b, c = (axis + 1) % 3, (axis + 2) % 3
    number, first = same_places(np.stack([mesh.points[:, axis], radius, _layers(mesh)], axis=1))
    axes = np.zeros((len(radius), 3, 3))
    axes[:, RADIAL, [b, c]] = (mesh.points[:, [b, c]] - [planes[b], planes[c]]) / radius[:, None]
    axes[:, AXIAL, axis] = 1.0
    axes[:, TANGENTIAL] = np.cross(axes[:, AXIAL], axes[:, RADIAL])
    return Rings(axis=axis, leader=first[number], axes=axes, on_axis=mesh.on_axis)


def _layers(mesh: Mesh) -> Array:
    """A length that tells doubled nodes apart: those on the second face of a bond lie in another layer."""
    out, far = np.zeros(len(mesh.points)), float(np.ptp(mesh.points, axis=0).max())
    for place, faces in enumerate(mesh.parted, start=1):
        first, second = (mesh.face_nodes(face) for face in faces)
        out[np.setdiff1d(second, first)] = place * far
    return out


def shared_numbers(rings: Rings, cells: Ints, numbers: Ints) -> Ints:
    """Give the places of a ring one mean stress: numbers (c, m) of the corners of cells, for each ring the same.

    Cells that are images of each other around the axis have nodes of the same rings. A corner of one and the same
    corner of the other share a number, on each side of a border.
    """
    at = rings.leader[cells[:, : numbers.shape[1]]]
    _, image = np.unique(np.sort(at, axis=1), axis=0, return_inverse=True)
    key = np.asarray(image).reshape(-1, 1) * (int(at.max()) + 1) + at
    _, place = np.unique(key, return_inverse=True)
    place = np.asarray(place).reshape(numbers.shape)
    out = numbers
    while True:  # a number of one key may be that of another key, too: the smallest wins until nothing changes
        least = np.full(int(place.max()) + 1, int(numbers.max()))
        np.minimum.at(least, place.ravel(), out.ravel())
        smaller = least[place]
        by_number = np.arange(int(numbers.max()) + 1)
        np.minimum.at(by_number, out.ravel(), smaller.ravel())
        if (by_number[out] == out).all():
            return np.ascontiguousarray(out)
        out = by_number[out]
