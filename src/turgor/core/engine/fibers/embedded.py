"""Embedded threads: trusses between points of cells, cut where they pass from cell to cell.

The ends of a truss follow the shape functions of its cell, and it stretches like the chord between them. So it adds
nothing to the sparsity of the tangent.
"""

from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.fibers.cell_finder import CellFinder
from turgor.core.engine.fibers.cutting import Cuts, cut
from turgor.core.engine.fibers.fiber_kernels import Pieces
from turgor.core.engine.fibers.lines import Lines
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.embedded import EmbeddedThreads
from turgor.core.model.fibers import Fibers
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def embedded_pieces(mesh: Mesh, fibers: Fibers, threads: EmbeddedThreads) -> tuple[Pieces, Array, Array, Ints]:
    """Cut threads inside the body into trusses that lie in one cell each.

    Returns
    -------
    pieces : Pieces
        Trusses, thread after thread.
    begin, end : (k, n) arrays
        Shape values of the nodes of the cells at the ends of each truss.
    thread : (k,) int array
        Thread of each.

    Raises
    ------
    TurgorError
        If a point is outside the body, a thread leaves it, or it lies in a mirror plane.
    """
    if mesh.revolved:
        raise TurgorError(
            f"fibers '{fibers.name}': threads through points do not run around an axisymmetric mesh; take another "
            "kind of cells."
        )
    finder, points = CellFinder(mesh), [np.array(each) for each in threads.through]
    _check_points(finder, fibers, points)
    _check_planes(mesh, fibers, points)
    begin, end = (np.concatenate([each[part] for each in points]) for part in (slice(None, -1), slice(1, None)))
    thread = np.repeat(np.arange(len(points)), [len(each) - 1 for each in points])
    length = np.linalg.norm(end - begin, axis=1)
    lines = Lines(begin, (end - begin) / length[:, None], length, inf)
    cuts = cut(lines, finder.size, finder)
    _check_inside(finder, fibers, lines, cuts)
    values = [finder.values(finder.places(cuts.side, lines.at(cuts.line, t))) for t in (cuts.begin, cuts.end)]
    nodes = mesh.cells[cuts.side]
    weights = np.linalg.norm(np.einsum("ka,kai->ki", values[1] - values[0], mesh.points[nodes]), axis=1)
    pieces = Pieces(
        sides=np.ascontiguousarray(nodes),
        along=np.ascontiguousarray((values[1] - values[0]) / weights[:, None]),
        weights=weights,
        stiffness=np.full(len(nodes), fibers.stretching_stiffness),
        pushed=np.full(len(nodes), fibers.compression),
        middle=(values[0] + values[1]) / 2,
        hand=thread[cuts.line],
    )
    return pieces, values[0], values[1], thread[cuts.line]


def _check_points(finder: CellFinder, fibers: Fibers, points: list[Array]) -> None:
    for number, each in enumerate(points, start=1):
        _, distance = finder.find(each)
        if (distance > finder.limit).any():
            k = int(distance.argmax())
            raise TurgorError(
                f"fibers '{fibers.name}': point {k + 1} of thread {number} is {distance[k] / mm:.4g} mm outside the "
                f"body; it must be inside, or within {finder.limit / mm:.3g} mm of it."
            )


def _check_planes(mesh: Mesh, fibers: Fibers, points: list[Array]) -> None:
    size = float(np.ptp(mesh.points, axis=0).max())
    for axis, position in mesh.mirror_planes:
        for number, each in enumerate(points, start=1):
            on = np.abs(each[:, axis] - position) <= ROUND_OFF.mesh_digits * size
            if (on[1:] & on[:-1]).any():
                raise TurgorError(
                    f"fibers '{fibers.name}': thread {number} lies in the mirror plane normal to {'xyz'[axis]}, which "
                    "cuts it in halves; model the whole part (symmetric = false)."
                )


def _check_inside(finder: CellFinder, fibers: Fibers, lines: Lines, cuts: Cuts) -> None:
    """Refuse threads that pass through what is no body; they would be loose there."""
    missing = lines.length - np.bincount(cuts.line, cuts.end - cuts.begin, minlength=len(lines.length))
    if (missing > finder.limit).any():
        k = int(missing.argmax())
        ends = lines.at(np.array([k, k]), np.array([0.0, lines.length[k]])) / mm
        first, last = (", ".join(f"{x:.4g}" for x in point) for point in ends.tolist())
        raise TurgorError(
            f"fibers '{fibers.name}': the thread from ({first}) to ({last}) mm is outside the body over "
            f"{missing[k] / mm:.3g} mm; give it points by which it stays inside."
        )
