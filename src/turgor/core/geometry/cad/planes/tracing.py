"""Tracing: outlines of straight edges and arcs from the edges of CAD faces."""

from collections.abc import Sequence
from math import atan2, hypot
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.shapes.sections import Outline
from turgor.core.geometry.shapes.tolerances import TOLERANCE

Array = NDArray[np.float64]

#: Arcs that stand for a free-form edge.
PIECES = 16

#: Points of each edge, from which the sides of cells find it again.
SAMPLES = 400


def samples(edge: Any) -> Array:
    """Points of a CAD edge (SAMPLES + 1, 3), in the order of its parameter and in CAD units."""
    low, high = edge.parameter_interval
    return np.array([(p.x, p.y, p.z) for p in (edge.Value(t) for t in np.linspace(low, high, SAMPLES + 1))])


def loops_of(face: Any) -> list[list[Any]]:
    """The loops of edges of a face, the outer one first."""
    wires = [[edge for edge in wire.edges if edge.mass > TOLERANCE.length] for wire in face.wires]
    size = [sum(float(edge.mass) for edge in wire) for wire in wires]
    return [wires[i] for i in np.argsort(size)[::-1]]


def outline_of(lines: Sequence[Array]) -> Outline:
    """Chain edges into an outline, counterclockwise."""
    remaining = list(lines)
    chain = [remaining.pop(0)]
    size = max(float(np.ptp(line, axis=0).max()) for line in lines)
    while remaining:
        end = chain[-1][-1]
        gaps = [min(hypot(*(line[0] - end)), hypot(*(line[-1] - end))) for line in remaining]
        line = remaining.pop(int(np.argmin(gaps)))
        chain.append(line if hypot(*(line[0] - end)) <= hypot(*(line[-1] - end)) else line[::-1])
    if hypot(*(chain[-1][-1] - chain[0][0])) > 1e-4 * size:  # the first edge was taken backwards
        chain[0] = chain[0][::-1]
    pieces = [piece for line in chain for piece in _pieces(line)]
    outline = Outline(corners=tuple(p for p, _ in pieces), arcs=tuple(arc for _, arc in pieces))
    if outline.area >= 0:
        return outline
    corners = tuple(reversed(outline.corners))
    return Outline(corners=corners, arcs=tuple(-arc for arc in (*reversed(outline.arcs[:-1]), outline.arcs[-1])))


def _pieces(line: Array) -> list[tuple[tuple[float, float], float]]:
    """An edge as straight pieces and arcs: the start of each, and the angle through which it turns."""
    length = float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum())
    turn = _turn(line[0], line[SAMPLES // 2], line[-1])
    if _off(line, turn) <= TOLERANCE.round_off * length:
        return [(_pair(line[0]), turn)]
    step = SAMPLES // PIECES
    starts = range(0, SAMPLES, step)
    return [(_pair(line[i]), _turn(line[i], line[i + step // 2], line[i + step])) for i in starts]


def _pair(point: Array) -> tuple[float, float]:
    return float(point[0]), float(point[1])


def _turn(start: Array, middle: Array, end: Array) -> float:
    """Angle through which an arc from start through middle to end turns, 0 for a straight line."""
    first, second = middle - start, end - middle
    cross, dot = first[0] * second[1] - first[1] * second[0], float(first @ second)
    angle = 2 * atan2(cross, dot)
    return 0.0 if abs(angle) < TOLERANCE.round_off else angle


def _off(line: Array, turn: float) -> float:
    """Largest distance of the points of an edge from the straight line or arc between its ends."""
    start, end = line[0], line[-1]
    span = end - start
    chord = hypot(*span)
    if not turn:
        return float(np.abs(span[0] * (line[:, 1] - start[1]) - span[1] * (line[:, 0] - start[0])).max() / chord)
    radius = chord / 2 / abs(np.sin(turn / 2))
    apothem = chord / 2 / np.tan(turn / 2)
    center = (start + end) / 2 + apothem * np.array([-span[1], span[0]]) / chord
    return float(np.abs(np.hypot(*(line - center).T) - radius).max())
