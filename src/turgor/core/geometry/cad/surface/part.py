"""Part from an STL file whose walls are curved or rough: its facets, grouped into faces."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.facets import Facets
from turgor.core.geometry.cad.selectors import Item
from turgor.core.geometry.cad.surface.settings import SURFACE
from turgor.core.geometry.cad.surface.shape import SurfaceShape
from turgor.core.geometry.directions import Vector
from turgor.units import mm

Array = NDArray[np.float64]


def surface_items(shape: SurfaceShape) -> tuple[Item, ...]:
    """Return the properties of each face for selectors."""
    return tuple(_item(shape, place) for place in range(len(shape.faces)))


def surface_facets(shape: SurfaceShape) -> Facets:
    """Return the facets of the surface, all of which look outside."""
    return Facets(
        points=shape.points,
        triangles=shape.triangles,
        face=shape.face,
        outer=np.ones(len(shape.triangles), dtype=bool),
    )


def is_flat(item: Item) -> bool:
    """Whether a face leaves its plane by less than a thousandth of its size."""
    if item.normal is None:
        return False
    corners = item.triangles.reshape(-1, 3)
    off = float(np.ptp(corners @ np.array(item.normal)))
    return off <= 1e-3 * float(np.ptp(corners, axis=0).max())


def _item(shape: SurfaceShape, place: int) -> Item:
    own = shape.face == place
    triangles, areas = shape.corners[own] * mm, shape.vector_areas[own]
    weight = np.linalg.norm(areas, axis=1)
    mean = areas.sum(axis=0) / weight.sum()
    length = float(np.linalg.norm(mean))
    return Item(
        name="",
        color=None,
        normal=_vector(mean / length) if length > SURFACE.plane_group else None,
        center=_vector(weight @ triangles.mean(axis=1) / weight.sum()),
        low=_vector(triangles.min(axis=(0, 1))),
        high=_vector(triangles.max(axis=(0, 1))),
        triangles=triangles,
    )


def _vector(values: Array) -> Vector:
    return float(values[0]), float(values[1]), float(values[2])


def body_item(shape: SurfaceShape) -> Item:
    """Return the properties of the whole body for selectors."""
    corners = shape.corners * mm
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    center = _vector((low + high) / 2)
    return Item(
        name="", color=None, normal=None, center=center, low=_vector(low), high=_vector(high), triangles=corners
    )
