"""Generate a mesh: curved ten-node tetrahedra from a geometry, with its names."""

from dataclasses import dataclass
from itertools import permutations
from math import ceil, floor, isfinite
from numbers import Real
from typing import Any

import numpy as np
from netgen.meshing import NgException, SetMessageImportance
from numpy.typing import NDArray

from turgor.errors import TurgorError
from turgor.geometry.geometry import Geometry
from turgor.meshing.mesh import TETRAHEDRON_EDGES, Mesh
from turgor.meshing.quality import cell_volumes, refuse_inverted
from turgor.meshing.quiet import captured_output
from turgor.meshing.surface import cell_sides, corner_keys
from turgor.units import mm

Ints = NDArray[np.int64]

#: Cells up to this many times longer than the thinnest wall is thick are accepted: one quadratic cell through a
#: wall, four times as long as thick, still bends well; beyond that bulging walls are lost.
LARGEST_SIZE_PER_WALL = 4.0

#: Largest mesh that one machine can be expected to solve.
MOST_UNKNOWNS = 3e6

#: Unknowns per volume over size cubed, measured on the fast PneuNet from 1.5 to 1 mm: 40 to 35.
UNKNOWNS_PER_SIZE_CUBED = 40.0

#: Cells along an arc as long as its radius. With 1, curved cells turn inside out where a fillet or a tube is coarse
#: (a slot of 1 mm radius at 1 mm size: 3 cells); with 2, none did on slots, tubes, half tubes and spheres.
CELLS_PER_RADIUS = 2.0

#: A finished mesh fills the geometry; quadratic cells may miss this share of it at curved faces.
LOST_VOLUME = 0.01


def mesh(geometry: Geometry, *, size: float, grading: float = 0.5) -> Mesh:
    """Generate ten-node tetrahedra that fill the geometry and carry its names.

    Mid-side nodes lie on the true surface, so curved faces stay curved. The same geometry and size give the same
    mesh, node for node, on the same version of the mesh generator.

    Parameters
    ----------
    geometry : Geometry
        What to mesh.
    size : float [m]
        Largest edge length aimed at; cells get smaller near short edges. At most four times the thinnest wall.
    grading : float [-]
        How fast cells may grow away from small ones: 0.1 slowly (more cells), 1 at once.

    Returns
    -------
    Mesh

    Raises
    ------
    TurgorError
        If the size is no positive length, too coarse for the walls or so small that nothing could solve the mesh,
        or if the generator fails.

    Examples
    --------
    >>> from turgor.geometry import FastPneuNet
    >>> finger = FastPneuNet(chambers=2, length=20e-3).build()
    >>> sorted(mesh(finger, size=3e-3).faces)
    ['cavity', 'fixed', 'outside', 'strain_limiting_layer', 'symmetry_y', 'tip']
    >>> mesh(finger, size=0)
    Traceback (most recent call last):
    turgor.errors.TurgorError: mesh size is 0 mm; allowed is 0.291 mm to 4 mm (four times the thinnest wall, 1 mm).
    """
    _check_size(geometry, size)
    _check_grading(grading)
    raw = _generate(geometry, float(size), float(grading))
    result = _assemble(raw, geometry)
    _check_result(result, geometry)
    refuse_inverted(result)
    return result


def size_range(geometry: Geometry) -> tuple[float, float]:
    """Smallest and largest mesh size that `mesh` accepts for a geometry [m].

    The smallest makes about 3 million unknowns; the largest is four times the thinnest wall, or the part itself.
    """
    low = float((UNKNOWNS_PER_SIZE_CUBED * geometry.solid_volume / MOST_UNKNOWNS) ** (1 / 3))
    return low, min(LARGEST_SIZE_PER_WALL * geometry.smallest_wall, geometry.extent)


def _check_size(geometry: Geometry, size: object) -> None:
    if isinstance(size, bool) or not isinstance(size, Real) or not isfinite(size):
        raise TurgorError(f"mesh size is {size!r}; a finite length in meters is needed, such as 3*mm.")
    length, (low, high), wall = float(size), size_range(geometry), geometry.smallest_wall
    if low <= length <= high:
        return
    limit = f"(four times the thinnest wall, {wall / mm:.4g} mm)" if high < geometry.extent else "(the whole part)"
    # rounded inwards, so that both numbers shown are themselves allowed
    allowed = f"allowed is {ceil(low / mm * 1000) / 1000} mm to {floor(high / mm * 1000 + 1e-6) / 1000:g} mm {limit}"
    given = f"mesh size is {length / mm:.6g} mm"
    if length <= 0:
        raise TurgorError(f"{given}; {allowed}.")
    if length < low:
        millions = UNKNOWNS_PER_SIZE_CUBED * geometry.solid_volume / length**3 / 1e6
        raise TurgorError(f"{given}, which makes about {millions:.3g} million unknowns; {allowed}.")
    what = "larger than the part" if length > geometry.extent else f"too coarse for the wall of {wall / mm:.4g} mm"
    hint = "; is the unit right?" if low <= length * mm <= high else "."
    raise TurgorError(f"{given}, {what}; {allowed}{hint}")


def _check_grading(grading: object) -> None:
    if isinstance(grading, bool) or not isinstance(grading, Real) or not 0.1 <= float(grading) <= 1:
        raise TurgorError(f"mesh grading is {grading!r}; allowed is 0.1 to 1.")


@dataclass(frozen=True, slots=True)
class _Raw:
    """What the generator returns, as arrays: positions [m], ten nodes a cell in its own order, corners of faces."""

    points: NDArray[np.float64]
    cells: Ints
    cell_region: Ints
    regions: tuple[str, ...]
    corners: Ints
    corner_face: Ints
    faces: tuple[str, ...]


def _generate(geometry: Geometry, size: float, grading: float) -> _Raw:
    before = SetMessageImportance(0)
    with captured_output() as text:  # at level 0 its warnings and errors still go to stdout, line after line
        try:
            netgen_mesh = geometry._shape.GenerateMesh(
                maxh=size / geometry.length_scale,
                grading=grading,
                curvaturesafety=CELLS_PER_RADIUS,
                parallel_meshing=False,  # the same mesh for half the work: its threads spin where a machine is busy
                ngs_mesh=False,
            )
            netgen_mesh.SecondOrder()
        except NgException as error:
            causes = [line.strip() for line in text().splitlines() if " error: " in line.lower()]
            raise TurgorError(
                f"'{geometry.name}' could not be meshed at size {size / mm:.4g} mm; use a smaller one. "
                f"The mesh generator says: {causes[-1] if causes else error}"
            ) from error
        finally:
            SetMessageImportance(before)
    return _read(netgen_mesh, geometry.length_scale)


def _read(netgen_mesh: Any, scale: float) -> _Raw:
    cells, triangles = netgen_mesh.Elements3D().NumPy(), netgen_mesh.Elements2D().NumPy()
    descriptors = netgen_mesh.FaceDescriptors()
    return _Raw(
        points=np.array(netgen_mesh.Coordinates(), dtype=np.float64) * scale,
        cells=cells["nodes"][:, :10].astype(np.int64) - 1,
        cell_region=cells["index"].astype(np.int64) - 1,
        regions=tuple(netgen_mesh.GetMaterial(i + 1) for i in range(int(cells["index"].max(initial=0)))),
        corners=triangles["nodes"][:, :3].astype(np.int64) - 1,
        corner_face=triangles["index"].astype(np.int64) - 1,
        faces=tuple(descriptor.bcname for descriptor in descriptors),
    )


def _mid_side_order(points: NDArray[np.float64], cells: Ints) -> list[int]:
    """Which of the generator's mid-side nodes lies on which of our edges, found from where they are."""
    mids = points[cells[:, 4:]]
    off = np.empty((6, 6))
    for i, (a, b) in enumerate(TETRAHEDRON_EDGES):
        middle = (points[cells[:, a]] + points[cells[:, b]]) / 2
        off[i] = np.linalg.norm(mids - middle[:, None], axis=2).mean(axis=0)
    return list(min(permutations(range(6)), key=lambda order: sum(off[i, j] for i, j in enumerate(order))))


def _turned(points: NDArray[np.float64], cells: Ints) -> Ints:
    """Swap two corners of each cell of negative volume, with the mid-side nodes between them."""
    a, b, c = (points[cells[:, i]] - points[cells[:, 0]] for i in (1, 2, 3))
    negative = np.einsum("ci,ci->c", a, np.cross(b, c)) < 0
    return np.where(negative[:, None], cells[:, [0, 2, 1, 3, 6, 5, 4, 7, 9, 8]], cells)


def _assemble(raw: _Raw, geometry: Geometry) -> Mesh:
    """Bring the arrays into the order and orientation that `Mesh` promises."""
    if not len(raw.cells):
        raise TurgorError(f"'{geometry.name}' could not be meshed: the generator made no cells; try another size.")
    order = _mid_side_order(raw.points, raw.cells)
    by_region = np.argsort(raw.cell_region, kind="stable")
    cell_region = raw.cell_region[by_region]
    cells = _turned(raw.points, np.hstack([raw.cells[:, :4], raw.cells[:, 4:][:, order]])[by_region])
    nodes = np.concatenate([np.unique(cells[:, :4]), np.unique(cells[:, 4:])])
    number = np.full(len(raw.points), -1, dtype=np.int64)
    number[nodes] = np.arange(len(nodes))
    cells, corners = number[cells], number[raw.corners]
    sides = cell_sides(cells)
    # where two cells share a side, the first one is kept: a face between regions points out of the one named first
    keys, index = np.unique(corner_keys(sides, len(nodes)), return_index=True)
    wanted = corner_keys(corners, len(nodes))
    place = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
    if (keys[place] != wanted).any():
        raise TurgorError(f"'{geometry.name}': the generator returned faces that are not sides of its cells.")
    triangles = sides[index[place]]
    faces = {
        name: triangles[np.isin(raw.corner_face, [i for i, n in enumerate(raw.faces) if n == name])]
        for name in sorted(set(raw.faces) & set(geometry.faces))
    }
    regions = {
        name: np.flatnonzero(np.isin(cell_region, [i for i, n in enumerate(raw.regions) if n == name]))
        for name in dict.fromkeys(raw.regions)
    }
    return Mesh(points=raw.points[nodes], cells=cells, regions=regions, faces=faces, name=geometry.name)


def _check_result(result: Mesh, geometry: Geometry) -> None:
    """Refuse a mesh that lost names or volume on the way."""
    for kind, wanted, found in (
        ("region", geometry.regions, result.regions),
        ("face", geometry.faces, result.faces),
    ):
        lost = [name for name in wanted if name not in found or not len(found[name])]
        if lost:
            raise TurgorError(f"the mesh of '{geometry.name}' lost the {kind} {', '.join(lost)}; try a smaller size.")
    volume = float(cell_volumes(result).sum())
    if abs(volume - geometry.solid_volume) > LOST_VOLUME * geometry.solid_volume:
        raise TurgorError(
            f"the mesh of '{geometry.name}' fills {volume * 1e9:.6g} mm³ of {geometry.solid_volume * 1e9:.6g} mm³; "
            "try a smaller size."
        )
