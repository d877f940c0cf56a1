"""Slices: one layer of hexahedra across an actuator, from its sweep or from a mesh of hexahedra."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.extrusion import Along, Layer, PlaneName, RangeName, Sweep
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.sweeping.hexahedra import fill
from turgor.core.meshing.sweeping.naming import assemble
from turgor.core.meshing.sweeping.section import Fineness, is_solid, names_at
from turgor.core.meshing.sweeping.swept import section_of
from turgor.fast_models.section.shapes.corners import sharp_corners
from turgor.fast_models.section.shapes.settings import SECTION_MESH
from turgor.foundation.errors import TurgorError
from turgor.units import mm

Ints = NDArray[np.int64]

#: What to do about an actuator without a uniform section.
ADVICE = (
    "a section analysis is for actuators with the same cross-section over most of their length: tubes, benders and "
    "cylinders with fibers. Solve the whole actuator instead, or give a Sketch of the part that is uniform."
)


def slice_of_geometry(geometry: Geometry, size: float | None) -> Mesh:
    """Mesh one layer of the uniform part of a geometry.

    Parameters
    ----------
    geometry : Geometry
        Swept along x, with one cross-section over most of its length.
    size : float or None [m]
        Longest edge of a cell; by default that of some sixty cells in the solids.

    Raises
    ------
    TurgorError
        If it has no uniform cross-section.
    """
    sweep = geometry._sweep
    if sweep is None or not isinstance(sweep.path, Along) or sweep.path.axis != 0:
        raise TurgorError(f"'{geometry.name}' is not built as a cross-section along x; {ADVICE}")
    return meshed(geometry.name, geometry.regions, sweep, _uniform(geometry, sweep), size)


def meshed(name: str, regions: tuple[str, ...], sweep: Sweep, layer: Layer, size: float | None) -> Mesh:
    """Mesh one layer of hexahedra of a section.

    Parameters
    ----------
    name : str
        What it is a section of.
    regions : tuple of str
        Regions in their order.
    sweep : Sweep
        Its rules name the faces.
    layer : Layer
        What fills the section.
    size : float or None [m]
    """
    chosen = size if size is not None else default_size(layer)
    # the slice lies within the layer, so that boxes of fibers keep their meaning; nothing depends on its thickness
    middle, half = (layer.start + layer.end) / 2, min(layer.end - layer.start, chosen) / 4
    rules = tuple(rule for rule in sweep.names if not (isinstance(rule, PlaneName | RangeName) and rule.axis == 0))
    thin = Sweep(layers=(replace(layer, start=middle - half, end=middle + half),), names=rules)
    mirrors = [rule.axis for rule in rules if isinstance(rule, PlaneName) and rule.name.startswith("symmetry")]
    corners = tuple((float(y), float(z)) for y, z in sharp_corners(layer, mirrors))
    fine = Fineness(size=chosen, edge=SECTION_MESH.corner_edge * chosen if corners else None, corners=corners)
    flat = Geometry(
        name=name, smallest_wall=chosen, cavity_volumes={}, solid_volume=0.0, regions=regions, faces=(), shape=None
    )
    mesh = assemble(fill(thin, section_of(thin, thin.outlines, fine), fine), flat, thin)
    filled_regions = {region: cells for region, cells in mesh.regions.items() if len(cells)}
    return replace(mesh, regions=filled_regions, faces=along_x(mesh.points, mesh.faces), name=f"section of {name}")


def along_x(points: NDArray[np.float64], faces: Mapping[str, Ints]) -> dict[str, Ints]:
    """Faces of a slice without the sides in its two ends."""
    thickness = np.ptp(points[:, 0])
    side_walls = {name: sides[np.ptp(points[sides, 0], axis=1) > thickness / 2] for name, sides in faces.items()}
    return {name: sides for name, sides in side_walls.items() if len(sides)}


def default_size(layer: Layer) -> float:
    """Longest edge of a cell [m] by default: the solids get some sixty cells.

    Their area is counted on a lattice of points.
    """
    corners = np.array([corner for _, outline in layer.fill for corner in outline.corners])
    reach = max(float(np.linalg.norm(corners - corners.mean(axis=0), axis=1).max()), 1e-9)
    ticks = (np.arange(SECTION_MESH.lattice) + 0.5) / SECTION_MESH.lattice * 4 * reach - 2 * reach
    points = np.stack([axis.ravel() for axis in np.meshgrid(ticks, ticks)], axis=1) + corners.mean(axis=0)
    solid = [is_solid(name) for name in names_at([layer], points)[0]]
    return float(np.sqrt(np.mean(solid) * (4 * reach) ** 2 / SECTION_MESH.cells))


def _uniform(geometry: Geometry, sweep: Sweep) -> Layer:
    """The longest layers of one cross-section, joined, if they are long enough."""
    joined: list[Layer] = []
    for layer in sweep.layers:
        if joined and joined[-1].fill == layer.fill:
            joined[-1] = replace(joined[-1], end=layer.end)
        else:
            joined.append(layer)
    longest = max(joined, key=lambda layer: layer.end - layer.start)
    whole = sweep.layers[-1].end - sweep.layers[0].start
    share = (longest.end - longest.start) / whole
    if share < SECTION_MESH.uniform_share:
        raise TurgorError(
            f"'{geometry.name}' has no uniform cross-section: the longest piece of one is "
            f"{(longest.end - longest.start) / mm:.4g} mm of {whole / mm:.4g} mm ({share:.0%}); {ADVICE}"
        )
    return longest


def slice_of_mesh(mesh: Mesh, at: float | None) -> Mesh:
    """Take one layer of a swept mesh of hexahedra along x.

    Parameters
    ----------
    mesh : Mesh
        27-node hexahedra in layers across x.
    at : float or None [m]
        Where along x; the middle by default.

    Raises
    ------
    TurgorError
        If the cells around that place are not a layer across x.
    """
    if mesh.cell_type is not HEXAHEDRON:
        raise TurgorError(
            f"mesh '{mesh.name}' has {mesh.cell_type.name}s; a section is read from 27-node hexahedra in layers along "
            'x. Mesh with cells = "hexahedra", or give the actuator, the CAD part or a Sketch.'
        )
    x = mesh.points[mesh.cells, 0]
    low, high = x.min(axis=1), x.max(axis=1)
    place = float((low.min() + high.max()) / 2) if at is None else at
    cells = np.flatnonzero((low < place) & (place <= high))
    if not len(cells):
        raise TurgorError(
            f"a section at x = {place / mm:.4g} mm; mesh '{mesh.name}' reaches from {low.min() / mm:.4g} mm to "
            f"{high.max() / mm:.4g} mm."
        )
    used = np.unique(mesh.cells[cells])  # vertices stay first
    number = np.full(len(mesh.points), -1)
    number[used] = np.arange(len(used))
    sides = {name: number[each] for name, each in mesh.faces.items()}
    sides = {name: each[(each >= 0).all(axis=1)] for name, each in sides.items()}
    where = np.full(len(mesh.cells), -1)
    where[cells] = np.arange(len(cells))
    regions = {name: where[rows][where[rows] >= 0] for name, rows in mesh.regions.items()}
    return Mesh(
        points=mesh.points[used],
        cells=number[mesh.cells[cells]],
        regions={name: rows for name, rows in regions.items() if len(rows)},
        faces=along_x(mesh.points[used], sides),
        name=f"section of {mesh.name}",
    )
