"""Contact pressure on the deformed surface, at nodes, and the contact area."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import side_tables
from turgor.core.engine.contact.pair_part import PairPart
from turgor.core.engine.contact.part import Gaps
from turgor.core.engine.contact.shape_part import ShapePart
from turgor.core.meshing.cells import side_type

Array = NDArray[np.float64]


def nodal_pressure(part: PairPart | ShapePart, gaps: Gaps, count: int) -> Array:
    """Scaled contact pressure per deformed area at ``count`` nodes, zero where nothing touches."""
    surface = part.surface
    nodes = surface.sides.shape[1]
    kind, r = side_type(nodes), side_tables(nodes)
    touches = gaps.inside.any(axis=1)  # the others would dilute the pressure at a sharp rim
    deformed = (gaps.growth * r.weights)[touches]
    force = part.pressures(gaps)[touches] * surface.weights[touches]
    corners = surface.sides[touches][:, : kind.corners].ravel()
    total = np.bincount(corners, (force @ r.M).ravel(), minlength=count)
    area = np.bincount(corners, (deformed @ r.M).ravel(), minlength=count)
    out = np.divide(total, area, out=np.zeros(count), where=area > 0)
    for i, (a, b) in enumerate(kind.edges):
        out[surface.sides[:, kind.corners + i]] = (out[surface.sides[:, a]] + out[surface.sides[:, b]]) / 2
    if nodes == 9:
        out[surface.sides[:, 8]] = out[surface.sides[:, :4]].mean(axis=1)
    return np.asarray(out)


def contact_area(part: PairPart | ShapePart, gaps: Gaps) -> float:
    """Scaled contact area on the deformed surface."""
    nodes = part.surface.sides.shape[1]
    return float((gaps.growth * side_tables(nodes).weights)[gaps.inside].sum())
