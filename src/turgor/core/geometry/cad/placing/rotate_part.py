"""Turn shapes, parts and the names of their faces."""

from collections.abc import Collection
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.facets import find_facets
from turgor.core.geometry.cad.naming import Naming, called_cavities, in_order, mirrors_of
from turgor.core.geometry.cad.part import Part, with_shape
from turgor.core.geometry.cad.placing.rotate import turned_shape
from turgor.core.geometry.cad.surface.part import surface_facets, surface_items
from turgor.core.geometry.cad.surface.shape import SurfaceShape

Array = NDArray[np.float64]


def turned_part(part: Part, rotation: Array) -> Part:
    """Return a part in axes that are the rows of a rotation (3, 3); its faces keep their order."""
    shape = turned_shape(part.shape, rotation)
    if isinstance(shape, SurfaceShape):
        return replace(part, shape=shape, facets=surface_facets(shape), items=surface_items(shape))
    faces: list[Any] = list(dict.fromkeys(shape.faces))
    return with_shape(part, shape, faces, find_facets(shape, faces))


def turned_naming(part: Part, naming: Naming, given: Collection[str]) -> Naming:
    """Return the names of the faces of a part after it was turned: cavities that were found are numbered along x again.

    Parameters
    ----------
    part : Part
        The turned part.
    naming : Naming
        Its names before.
    given : collection of str
        Names that the caller or the file has given, which stay.
    """
    unnamed = {name: hollow for name, hollow in naming.cavities.items() if name not in given}
    places = {id(hollow): name for name, hollow in unnamed.items()}
    ordered = [places[id(hollow)] for hollow in in_order([*unnamed.values()], part)]
    renamed = dict(zip(ordered, sorted(unnamed, key=lambda name: (len(name), name)), strict=True))
    names = [renamed.get(name, name) for name in naming.names]
    return replace(naming, names=tuple(names), cavities=called_cavities(part, names, mirrors_of(part, names, {})[0])[0])
