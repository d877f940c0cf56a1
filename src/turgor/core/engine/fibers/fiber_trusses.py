"""Discrete threads: every thread of a winding as a chain of trusses, cut where it passes from side to side.

Each truss lies in one side of a cell, so that it adds nothing to the sparsity of the tangent. It stretches like the
surface in its middle, as interpolated from the integration points of membranes: elsewhere the strains of a quadratic
side are too noisy for threads that hardly stretch, which would go slack and tight at random. A thread that crosses a
side is two trusses, one that cuts off a corner is one. With one truss per crossing the side could bulge between the
threads without stretching any truss, and with ten sides around the tube of V20 it would twist 4 % too little.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.fibers.cutting import Cuts, cut
from turgor.core.engine.fibers.embedded import embedded_pieces
from turgor.core.engine.fibers.fiber_kernels import Pieces
from turgor.core.engine.fibers.lines import Lines, thread_lines
from turgor.core.engine.fibers.settings import FIBERS
from turgor.core.engine.fibers.smeared import course_of, smeared_pieces, unit_axis, wound_sides
from turgor.core.engine.fibers.surface_unrolling import UnrolledSurface, shape_values, unroll
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.embedded import EmbeddedThreads
from turgor.core.model.fibers import DISCRETE, Fibers
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class FiberTrusses:
    """Discrete threads: their trusses in order along each thread, and where these begin and end.

    Parameters
    ----------
    pieces : Pieces
        The trusses, thread after thread.
    begin, end : (k, n) arrays
        Shape values of the nodes of the sides, or of the cells, at the two ends of each truss.
    thread : (k,) int array
        Thread that each truss belongs to; a thread that leaves the face and comes back counts as two.
    """

    pieces: Pieces
    begin: Array
    end: Array
    thread: Ints

    __repr__ = brief

    @property
    def count(self) -> int:
        """Number of threads."""
        return int(self.thread[-1]) + 1 if len(self.thread) else 0

    @property
    def lengths(self) -> Array:
        """Length of each thread at rest, (count,) [m]."""
        return np.bincount(self.thread, self.pieces.weights, minlength=self.count).astype(np.float64)

    def ends(self, points: Array) -> Array:
        """First and last point of each truss, (k, 2, 3), from nodal positions (n, 3) at rest or deformed."""
        nodes = points[self.pieces.sides]
        return np.stack([np.einsum("ka,kai->ki", values, nodes) for values in (self.begin, self.end)], axis=1)

    def polylines(self, points: Array) -> list[Array]:
        """Points (k, 3) along each thread, from nodal positions (n, 3) at rest or deformed."""
        borders = np.flatnonzero(np.diff(self.thread)) + 1
        return [np.concatenate([part[:, 0], part[-1:, 1]]) for part in np.split(self.ends(points), borders)]


def discrete_threads(mesh: Mesh, fibers: Fibers) -> FiberTrusses:
    """Lay the threads of a winding on their face, or inside the body, and cut them into trusses.

    Parameters
    ----------
    mesh : Mesh
    fibers : Fibers

    Raises
    ------
    TurgorError
        If the winding does not fit the face, or no thread lies on it.
    """
    if isinstance(fibers.winding, EmbeddedThreads):
        return FiberTrusses(*embedded_pieces(mesh, fibers, fibers.winding))
    course = course_of(mesh, fibers)
    axis = unit_axis(fibers.wound)
    face = unroll(mesh.points, wound_sides(mesh, fibers), axis, fibers.place)
    lines = thread_lines(course, face, fibers)
    cuts = _parted(face, lines, cut(lines, face.fineness, _Where(mesh, face, fibers)))
    if not len(cuts.side):
        raise TurgorError(f"fibers on '{fibers.place}': no thread lies on this face{fibers.box}.")
    return _trusses(mesh, face, fibers, lines, cuts)


def lay(mesh: Mesh, fibers: Fibers) -> FiberTrusses | Pieces:
    """The threads of a discrete winding, or the pieces of a smeared one."""
    return discrete_threads(mesh, fibers) if fibers.form == DISCRETE else smeared_pieces(mesh, fibers)


@dataclass(frozen=True, slots=True, eq=False)
class _Where:
    """Finds the side under points of the unrolled face, −1 outside the face or the box of the winding."""

    mesh: Mesh
    face: UnrolledSurface
    fibers: Fibers

    def sides(self, points: Array) -> Ints:
        side, place = self.face.find(points)
        if self.fibers.within is None:
            return side
        values, _ = shape_values(self.face.sides.shape[1], place)
        at = np.einsum("ka,kai->ki", values, self.mesh.points[self.face.sides[side]])
        return np.where(self.fibers.holds(at), side, -1)


def _parted(face: UnrolledSurface, lines: Lines, cuts: Cuts) -> Cuts:
    """Cut each part in equal shares, as many as its share of a whole crossing of its side needs."""
    extent = np.ptp(face.flat, axis=1)[cuts.side]
    crossing = (extent / np.maximum(np.abs(lines.direction[cuts.line]), 1e-12)).min(axis=1)
    parts = np.maximum(1, np.ceil(FIBERS.trusses_of_side * (cuts.end - cuts.begin) / crossing - 1e-6)).astype(np.int64)
    old = np.repeat(np.arange(len(parts)), parts)
    number = np.arange(len(old)) - np.repeat(np.cumsum(parts) - parts, parts)
    step = ((cuts.end - cuts.begin) / parts)[old]
    begin = cuts.begin[old] + number * step
    return Cuts(cuts.line[old], begin, begin + step, cuts.side[old])


def _trusses(mesh: Mesh, face: UnrolledSurface, fibers: Fibers, lines: Lines, cuts: Cuts) -> FiberTrusses:
    sides = face.sides[cuts.side]
    middle = lines.at(cuts.line, (cuts.begin + cuts.end) / 2)  # its ends must not be folded apart
    half = (cuts.end - cuts.begin)[:, None] / 2 * lines.direction[cuts.line]
    values = [shape_values(sides.shape[1], face.place(cuts.side, at))[0] for at in (middle - half, middle + half)]
    slopes = face.slopes(cuts.side, middle, lines.direction[cuts.line])
    stretch = np.linalg.norm(np.einsum("ka,kai->ki", slopes, mesh.points[sides]), axis=1)
    gap = FIBERS.shortest_truss * face.fineness * 2
    apart = (cuts.line[1:] != cuts.line[:-1]) | (np.abs(cuts.begin[1:] - cuts.end[:-1]) > gap)
    pieces = Pieces(
        sides=np.ascontiguousarray(sides),
        along=slopes / stretch[:, None],
        weights=cuts.end - cuts.begin,
        stiffness=np.full(len(sides), fibers.stretching_stiffness),
        pushed=np.full(len(sides), fibers.compression),
        middle=shape_values(sides.shape[1], face.place(cuts.side, middle))[0],
        hand=(lines.direction[cuts.line].prod(axis=1) < 0).astype(np.int64),
    )
    return FiberTrusses(pieces, values[0], values[1], np.concatenate([[0], np.cumsum(apart)]))
