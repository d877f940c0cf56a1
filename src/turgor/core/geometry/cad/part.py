"""Part: the glued bodies of a CAD file, with the properties of their faces."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry import occ
from turgor.core.geometry.cad.colors import shown_color
from turgor.core.geometry.cad.facets import Facets, find_facets
from turgor.core.geometry.cad.files import FileContents, load_file
from turgor.core.geometry.cad.placing.rotate import turned_shape
from turgor.core.geometry.cad.selectors import Item, Selector
from turgor.core.geometry.cad.split import SplitPlane, split_bodies
from turgor.core.geometry.cad.surface.part import body_item, surface_facets, surface_items
from turgor.core.geometry.cad.surface.shape import SurfaceShape
from turgor.core.geometry.directions import FileAxes, Vector, rotation_to
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.foundation.errors import TurgorError
from turgor.units import mm

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Part:
    """Bodies that share the faces where they touch.

    Parameters
    ----------
    path : Path
        Path of the file.
    file : FileContents
        Content of the file.
    shape : CAD shape or SurfaceShape
        The glued bodies, in millimeters.
    regions : tuple of str
        Region of each body.
    faces : list of CAD faces or SurfaceFace
        Each once.
    facets : Facets
        Their triangles.
    items : tuple of Item
        Properties of each face for selectors.
    owners : tuple of tuple of str
        Regions of the bodies on each face: two where it lies between two bodies.
    """

    path: Path
    file: FileContents
    shape: Any
    regions: tuple[str, ...]
    faces: list[Any]
    facets: Facets
    items: tuple[Item, ...]
    owners: tuple[tuple[str, ...], ...]

    @property
    def between(self) -> NDArray[np.bool_]:
        """Whether each face lies between two bodies (f,)."""
        return np.array([len(each) > 1 for each in self.owners])


def load_part(
    path: str | Path,
    unit: str | float | None = None,
    regions: Mapping[str, Selector] | None = None,
    split: SplitPlane | None = None,
    axes: FileAxes | None = None,
) -> Part:
    """Read a CAD file, name its bodies, split and glue them.

    Parameters
    ----------
    path, unit
        As for `load_file`.
    regions : mapping of str to Selector, optional
        Region of the bodies that each selector picks; the others keep their name in the file.
    split : SplitPlane, optional
        A plane that cuts the bodies.
    axes : tuple of three str or (3,) floats, optional
        Directions in the file of our x, y and z; those of the file where it is not given.

    Raises
    ------
    TurgorError
        If the file cannot be read, or its bodies overlap or do not touch.
    """
    file = load_file(path, unit)
    if axes is not None:
        rotation = rotation_to(axes)
        file = replace(file, bodies=[turned_shape(body, rotation) for body in file.bodies])
    bodies, names = file.bodies, _region_names(file, regions or {})
    if isinstance(bodies[0], SurfaceShape):
        return _surface_part(Path(path), file, names[0], split)
    before = sum(body.mass for body in bodies)
    if split is not None:
        bodies, names = split_bodies(bodies, names, split)
    for body, name in zip(bodies, names, strict=True):
        body.name = name
    shape = occ.Glue(bodies)
    solids = list(shape.solids)
    if len(solids) != len(bodies) or abs(sum(s.mass for s in solids) - before) > TOLERANCE.round_off * before:
        lost = before - sum(solid.mass for solid in solids)
        raise TurgorError(
            f"the bodies of '{path}' ({', '.join(names)}) overlap by {abs(lost):.4g} mm³; cut one out of the other in "
            "the CAD program, or join them."
        )
    faces = list(dict.fromkeys(shape.faces))
    _check_touching(path, solids)
    facets = find_facets(shape, faces)
    return Part(
        path=Path(path),
        file=file,
        shape=shape,
        regions=tuple(str(solid.name) for solid in solids),
        faces=faces,
        facets=facets,
        items=tuple(shape_item(face, facets.corners(np.array([i])) * mm) for i, face in enumerate(faces)),
        owners=owners(solids, faces),
    )


def _surface_part(path: Path, file: FileContents, region: str, split: SplitPlane | None) -> Part:
    """Part of one body that is given by facets."""
    if split is not None:
        raise TurgorError(
            f"split: the walls of '{path}' are curved or rough, and such a part cannot be cut into regions; export the "
            "regions as bodies of one STEP file."
        )
    (shape,) = file.bodies
    return Part(
        path=path,
        file=file,
        shape=shape,
        regions=(region,),
        faces=list(shape.faces),
        facets=surface_facets(shape),
        items=surface_items(shape),
        owners=((region,),) * len(shape.faces),
    )


def body_items(bodies: list[Any], names: list[str]) -> tuple[Item, ...]:
    """Return the properties of each body for selectors."""
    if isinstance(bodies[0], SurfaceShape):
        return (body_item(bodies[0]),)
    return tuple(
        shape_item(body, find_facets(body, list(dict.fromkeys(body.faces))).corners() * mm, name)
        for body, name in zip(bodies, names, strict=True)
    )


def _region_names(file: FileContents, regions: Mapping[str, Selector]) -> list[str]:
    """Region of each body: the selected name, the name in the file, or body, body_1, body_2, the largest first."""
    unnamed = [i for i, name in enumerate(file.names) if not name]
    order = sorted(unnamed, key=lambda i: -file.bodies[i].mass)
    alone = len(unnamed) == 1
    names = [name or ("body" if alone else f"body_{order.index(i) + 1}") for i, name in enumerate(file.names)]
    if regions:
        items = body_items(file.bodies, file.names)
        for region, selector in regions.items():
            for place in _attempt(f"region '{region}'", selector, items):
                names[place] = region
    return names


def _attempt(what: str, selector: Selector, items: tuple[Item, ...]) -> list[int]:
    try:
        return selector.pick(items)
    except TurgorError as error:
        raise TurgorError(f"{what}: {error}") from error


def shape_item(shape: Any, triangles: Array, name: str | None = None) -> Item:
    """Return the properties of a face or a body for selectors; its triangles are in meters."""
    color = shape.col if str(shape.type).endswith("FACE") else _body_color(shape)
    low, high = triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))
    area = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]) / 2
    size = np.linalg.norm(area, axis=1)
    mean = area.sum(axis=0) / size.sum()
    plane = 1 - float(np.linalg.norm(mean)) < TOLERANCE.round_off
    center = shape.center
    return Item(
        name=(shape.name or "") if name is None else name,
        color=shown_color(color) if color is not None else None,
        normal=as_vector(mean / np.linalg.norm(mean)) if plane else None,
        center=(center.x * mm, center.y * mm, center.z * mm),
        low=as_vector(low),
        high=as_vector(high),
        triangles=triangles,
    )


def _body_color(body: Any) -> Any:
    """Most frequent color of the faces of a body."""
    colors = Counter(tuple(face.col) if face.col is not None else None for face in body.faces)
    return colors.most_common(1)[0][0]


def as_vector(values: Array) -> Vector:
    """Return three numbers of an array as a tuple."""
    return float(values[0]), float(values[1]), float(values[2])


def with_shape(part: Part, shape: Any, faces: list[Any], facets: Facets) -> Part:
    """Return a part with another shape, such as a share of it, whose faces have their names already."""
    solids = list(shape.solids)
    return replace(
        part,
        shape=shape,
        regions=tuple(str(solid.name) for solid in solids),
        faces=faces,
        facets=facets,
        items=tuple(shape_item(face, facets.corners(np.array([i])) * mm) for i, face in enumerate(faces)),
        owners=owners(solids, faces),
    )


def owners(solids: list[Any], faces: list[Any]) -> tuple[tuple[str, ...], ...]:
    """Return the regions of the bodies of each face, as their names: two where it lies between them."""
    solids_of: dict[Any, tuple[str, ...]] = dict.fromkeys(faces, ())
    for solid in solids:
        for face in dict.fromkeys(solid.faces):
            solids_of[face] += (str(solid.name),)
    return tuple(solids_of[face] for face in faces)


def _check_touching(path: str | Path, solids: list[Any]) -> None:
    """Raise an error for bodies that share no face with the others, because supports would not hold them."""
    reached, apart = set(solids[0].faces), list(solids[1:])
    while apart:
        nearer = [solid for solid in apart if reached & set(solid.faces)]
        if not nearer:
            break
        for solid in nearer:
            reached |= set(solid.faces)
            apart.remove(solid)
    if apart:
        rest = [solid for solid in solids if solid not in apart]
        gap, lone, other = min(((a.Distance(b), a.name, b.name) for a in apart for b in rest), key=lambda item: item[0])
        how = f"there are {gap:.4g} mm between it and" if gap > 0 else "it shares no face, an edge at most, with"
        raise TurgorError(
            f"the body '{lone}' of '{path}' is not joined to the others: {how} '{other}', so a cavity between them "
            "would leak and nothing would hold it; move the bodies together in the CAD program until their faces touch."
        )
