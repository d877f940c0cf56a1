"""Call every kernel of contact once on two sides, so that it is compiled at a known time."""

from dataclasses import replace

import numpy as np

from turgor.core.engine.algebra.pattern import Pattern
from turgor.core.engine.cells.reference import reference_nodes, side_tables
from turgor.core.engine.contact.couplings import Layout
from turgor.core.engine.contact.pair_part import PairPart, Partners
from turgor.core.engine.contact.surface import Surface, overhangs, rims, strangers
from turgor.core.meshing.cells import side_type
from turgor.core.model.obstacles.pose import Pose


def compile_search(nodes: int) -> None:
    """Compile the kernels that search for contact, which a model needs from its first step on."""
    points, part = _pressed(nodes)
    gaps = part.look(points, Pose(np.zeros(3)))
    gaps = part.look(points, Pose(np.zeros(3)), gaps)
    part.passed(points, gaps, gaps)


def compile_press(nodes: int) -> None:
    """Compile the kernels of contact forces, which a model needs once walls meet, after those that search."""
    points, part = _pressed(nodes)
    gaps = part.look(points, Pose(np.zeros(3)))
    gaps = replace(gaps, friction=part.anchored(points, gaps))
    part.forces(points, gaps)
    part.fading(points, gaps)
    size = 3 * len(points)
    diagonal = Pattern(size, np.arange(size + 1, dtype=np.int64), np.arange(size, dtype=np.int32))
    layout = Layout(diagonal, np.zeros(size, dtype=bool))
    keys = part.ready_keys(gaps)
    layout.renew(keys, [part.tied_unknowns(keys)])
    data = layout.spread(np.zeros(size))
    for ties in part.tangents(points, gaps):
        ties.add_to(data, layout.pattern)


def _pressed(nodes: int) -> tuple[np.ndarray, PairPart]:
    """Return two sides of ``nodes`` nodes that face each other and are pressed together."""
    kind, r = side_type(nodes), side_tables(nodes)
    flat = np.zeros((nodes, 3))
    flat[:, :2] = reference_nodes(nodes)
    turned = flat[:, [1, 0, 2]] - [0, 0, 0.05]  # pressed in, and it looks the other way
    points = np.vstack([flat, turned])
    sides = np.arange(2 * nodes, dtype=np.int64).reshape(2, nodes)
    weights = np.ones((2, 1)) * r.weights
    surface = Surface(sides, r.N, r.dN, weights, np.ones(2), np.ones(2))
    none = np.zeros(len(points), dtype=bool)
    around = (np.arange(3, dtype=np.int64), np.arange(2, dtype=np.int64))
    partners = Partners(
        sides=sides,
        corners=kind.corners,
        overhang=overhangs(points, sides, none),
        depth=np.ones(2),
        strangers=strangers(points, sides),
        around=around,
        reach=1.0,
        rims=rims(points, sides, borders=True),
    )
    return points, PairPart("self", surface, partners, 0.5, 0.5)
