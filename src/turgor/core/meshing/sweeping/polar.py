"""Sections of rings, discs and their sectors: cells between circles and rays, around a core of squares."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from math import atan2, ceil, hypot, pi

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.extrusion import Layer
from turgor.core.geometry.shapes.sections import Outline, Point
from turgor.core.meshing.sweeping.section import (
    SAME_LINE,
    Fineness,
    SectionMesh,
    circle_of,
    divided,
    divided_turn,
    feature_lines,
    is_solid,
    joined,
    lattice_quads,
    names_at,
)
from turgor.core.meshing.sweeping.settings import SECTION

Array = NDArray[np.float64]

EIGHTH = pi / 4


def center_of(outlines: Sequence[Outline]) -> Point | None:
    """Common center of all arcs, where all straight edges point to it; None if there is none."""
    arcs = [circle_of(a, b, arc)[0] for outline in outlines for a, b, arc in outline.edges if arc]
    if not arcs:
        return None
    y, z = arcs[0]
    scale = max(hypot(*corner) for outline in outlines for corner in outline.corners)
    if any(hypot(a - y, b - z) > SAME_LINE * scale for a, b in arcs):
        return None
    for outline in outlines:
        for a, b, arc in outline.edges:
            off = (a[0] - y) * (b[1] - z) - (a[1] - z) * (b[0] - y)
            if not arc and abs(off) > SAME_LINE * scale**2:
                return None
    return y, z


def polar_section(layers: Sequence[Layer], outlines: Sequence[Outline], fine: Fineness) -> SectionMesh | None:
    """Mesh the disc around outlines of circles and rays about one center.

    Parameters
    ----------
    layers : sequence of Layer
        What the outlines are filled with: a core is made where the center is solid.
    outlines : sequence of Outline
        What circles and rays must follow.
    fine : Fineness
        A single wall of several materials gets two cells at least: stresses change along it and through it.

    Returns
    -------
    SectionMesh or None
        None where the outlines are of another kind, or rays meet in a solid center at other angles than 45°.
    """
    center = center_of(outlines)
    if center is None:
        return None
    radii, angles = _features(outlines, center)
    middles = np.array([(a + b) / 2 for a, b in pairwise(angles)])
    origin, outward = np.array(center), np.stack([np.cos(middles), np.sin(middles)], axis=1)
    solid = any(is_solid(name) for name in names_at(layers, origin + radii[0] / 2 * outward).ravel())
    if len(radii) == 2:
        wall = names_at(layers, origin + radii.mean() * outward)
        if any(len({name for name in row if is_solid(name)}) > 1 for row in wall):
            fine = replace(fine, wall_cells=max(fine.wall_cells, SECTION.wall_of_several))
    if not solid:
        lines = np.concatenate([[0.0, radii[0] / 2], divided(radii, fine)])
        return _moved(_ring(lines, divided_turn(angles, radii[-1], fine)), center)
    if (np.abs(angles / EIGHTH - np.round(angles / EIGHTH)) > 1e-9).any():
        return None
    around = divided_turn(np.linspace(0, 2 * pi, 9), radii[-1], fine)
    core = core_section(float(radii[0]), (len(around) - 1) // 16, fine)
    parts = [core] if len(radii) == 1 else [core, _ring(divided(radii, fine), around)]
    return _moved(joined(parts), center)


def _features(outlines: Sequence[Outline], center: Point) -> tuple[Array, Array]:
    """Radii of the arcs, and angles of the rays with the first one again after a full turn."""
    radii, angles = [], []
    for outline in outlines:
        for a, b, arc in outline.edges:
            ends = [(p[0] - center[0], p[1] - center[1]) for p in (a, b)]
            scale = max(hypot(*end) for end in ends)
            if arc:
                radii.append(scale)
            else:
                angles += [atan2(z, y) % (2 * pi) for y, z in ends if hypot(y, z) > SAME_LINE * scale]
    turn = np.array(angles or [0.0])
    turn[turn > 2 * pi * (1 - SAME_LINE)] = 0.0
    turn = feature_lines(turn, 2 * pi)
    return feature_lines(np.array(radii), max(radii)), np.append(turn, turn[0] + 2 * pi)


def _ring(radii: Array, around: Array) -> SectionMesh:
    """Cells between circles; the last ray is the first one again."""
    r, turn = np.meshgrid(radii, around[:-1], indexing="ij")
    points = np.stack([(r * np.cos(turn)).ravel(), (r * np.sin(turn)).ravel()], axis=1)
    return SectionMesh(points=points, quads=lattice_quads(len(radii), len(around) - 1, wrap=True))


def core_section(radius: float, count: int, fine: Fineness, quadrants: Sequence[int] = (0, 1, 2, 3)) -> SectionMesh:
    """Mesh a disc about the origin, or quarters of it, without cells that collapse in its center.

    Parameters
    ----------
    radius : float [m]
        Radius of the disc.
    count : int
        Cells along an eighth of its rim.
    fine : Fineness
    quadrants : sequence of int
        Which quarters; 0 is the one between the first and the second axis.

    Examples
    --------
    >>> len(core_section(1.0, 2, Fineness(size=1.0)).quads)  # four squares of 2 x 2 and a ring of 16
    32
    """
    a, b = SECTION.along_axes * radius, SECTION.along_diagonal * radius
    share = np.linspace(0, 1, 2 * count + 1)
    s, t = (grid.ravel()[:, None] for grid in np.meshgrid(share, share, indexing="ij"))
    square = s * (1 - t) * np.array([a, 0]) + s * t * np.array([b, b]) + (1 - s) * t * np.array([0, a])
    turn = np.linspace(0, pi / 2, 4 * count + 1)
    first = np.stack([a + (b - a) * share, b * share], axis=1)
    rim = np.concatenate([first, first[-2::-1, ::-1]])
    outward = np.linspace(0, 1, 2 * ceil((radius - a) / fine.size - 1e-6) + 1)[:, None, None]
    circle = radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    ring = ((1 - outward) * rim + outward * circle).reshape(-1, 2)
    quarter = [
        SectionMesh(points=square, quads=lattice_quads(len(share), len(share))),
        SectionMesh(points=ring, quads=lattice_quads(len(outward), len(turn))),
    ]
    parts = []
    for quadrant in quadrants:
        c, s_ = np.cos(quadrant * pi / 2), np.sin(quadrant * pi / 2)
        turned = np.array([[c, s_], [-s_, c]])
        parts += [SectionMesh(points=part.points @ turned, quads=part.quads) for part in quarter]
    return joined(parts)


def _moved(mesh: SectionMesh, center: Point) -> SectionMesh:
    return SectionMesh(points=mesh.points + np.array(center), quads=mesh.quads)
