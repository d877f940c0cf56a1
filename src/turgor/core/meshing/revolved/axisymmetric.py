"""Meshes of bodies of revolution with the degrees of freedom of their meridian.

The meridian is filled with quadrilaterals and turned by a quarter in a few hexahedra. All nodes of a ring move alike
(`turgor.core.engine.algebra.rings`), so that two displacements are left for each node of the meridian, as in a plane
element with hoop stretch. Laws, pressure, membranes, contact, volumes and pictures are those of any quarter.
"""

from dataclasses import replace
from math import pi

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from turgor.core.geometry.extrusion import Layer, PlaneName, Sweep, Turned
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.mesh import PINHOLE, Mesh
from turgor.core.meshing.revolved.meridian import Meridian, meridian_of
from turgor.core.meshing.surface import cell_sides, corner_keys
from turgor.core.meshing.sweeping.hexahedra import fill
from turgor.core.meshing.sweeping.naming import assemble
from turgor.core.meshing.sweeping.section import Fineness, SectionMesh
from turgor.core.meshing.sweeping.swept import section_of

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Hexahedra around the quarter. Their sides are parabolas; `rounded` makes up for what these miss of a circle.
AROUND = 2


def axisymmetric_mesh(geometry: Geometry, fine: Fineness) -> Mesh:
    """Fill a quarter of a body of revolution with hexahedra whose rings of nodes move alike.

    Parameters
    ----------
    geometry : Geometry
        A quarter between two mirror planes; the axis is their line.
    fine : Fineness
        How fine the cells of the meridian are.

    Returns
    -------
    Mesh
        With ``revolved`` set. Its quarter of every circle has the area of the true one.

    Raises
    ------
    TurgorError
        If the geometry is no such quarter, or no body of revolution.
    """
    meridian = meridian_of(geometry)
    names = [PlaneName(name="symmetry_y", axis=1, position=0.0), PlaneName(name="symmetry_z", axis=2, position=0.0)]
    if meridian.cut is not None:
        names.append(PlaneName(name="symmetry_x", axis=0, position=meridian.cut))
    layer = Layer(start=0.0, end=pi / 2, fill=meridian.fill)
    sweep = Sweep(layers=(layer,), path=Turned(), names=tuple(names))
    section = _off_axis(section_of(sweep, sweep.outlines, fine))
    mesh = assemble(fill(sweep, section, replace(fine, quarter_cells=AROUND)), geometry, sweep)
    named = replace(mesh, faces=_named(mesh, meridian))
    return _placed(rounded(named), meridian)


def _off_axis(section: SectionMesh) -> SectionMesh:
    """Move the nodes on the axis to the rim of a pinhole."""
    x, r = section.points.T
    return replace(section, points=np.stack([x, np.maximum(r, PINHOLE * r.max())], axis=1))


def rounded(mesh: Mesh) -> Mesh:
    """Stretch a quarter across its axis so that its parabolas enclose the area of the circles through their ends."""
    return replace(mesh, points=mesh.points * np.array([1.0, roundness(), roundness()]))


def roundness() -> float:
    """By how much the nodes around a quarter must lie outside of a circle to enclose its area.

    Examples
    --------
    >>> round(roundness(), 6)
    1.000389
    """
    angle = pi / 2 / AROUND
    ends = np.array([[1.0, 0.0], [np.cos(angle / 2), np.sin(angle / 2)], [np.cos(angle), np.sin(angle)]])
    a, m, b = ends
    # the area between a parabola and its chord is two thirds of the box around it
    chord = (a[0] * b[1] - a[1] * b[0]) / 2
    sag = np.linalg.norm(m - (a + b) / 2) * np.linalg.norm(b - a) * 2 / 3
    return float(np.sqrt(angle / 2 / (chord + sag)))


def _named(mesh: Mesh, meridian: Meridian) -> dict[str, Ints]:
    """Faces by the edges of the meridian that lie nearest to the middles of the sides."""
    points = np.concatenate([line for _, line in meridian.edges])
    owner = np.repeat([name for name, _ in meridian.edges], [len(line) for _, line in meridian.edges])
    tree = cKDTree(points)
    sides = cell_sides(mesh.cells)
    keys = corner_keys(sides, len(mesh.points))
    cut = np.concatenate([corner_keys(mesh.faces[name], len(mesh.points)) for name in mesh.symmetry_faces])
    _, first, count = np.unique(keys, return_index=True, return_counts=True)
    region = np.empty(len(mesh.cells), dtype=np.int64)
    for number, cells in enumerate(mesh.regions.values()):
        region[cells] = number
    per_cell = len(mesh.cell_type.sides)
    last = _last_of(keys)
    between = (count == 2) & (region[first // per_cell] != region[last // per_cell])
    chosen = first[((count == 1) & ~np.isin(keys[first], cut)) | between]
    radius = np.hypot(*mesh.points[:, 1:].T)
    chosen = chosen[~(radius[sides[chosen]] <= 2 * PINHOLE * radius.max()).all(axis=1)]
    middle = mesh.points[sides[chosen, -1]]
    _, nearest = tree.query(np.stack([middle[:, 0], np.hypot(middle[:, 1], middle[:, 2])], axis=1))
    sides_of = {name: sides[chosen[owner[nearest] == name]] for name in sorted(set(owner.tolist()))}
    faces = {name: face for name, face in sides_of.items() if len(face)}
    return faces | {name: mesh.faces[name] for name in mesh.symmetry_faces}


def _last_of(keys: Ints) -> Ints:
    """Index of the last of equal keys, in the order of `numpy.unique`."""
    _, last = np.unique(keys[::-1], return_index=True)
    return len(keys) - 1 - last


def _placed(mesh: Mesh, meridian: Meridian) -> Mesh:
    """Turn a mesh about x into the place of the part, by a cyclic change of the coordinates."""
    axis = meridian.axis
    points = np.roll(mesh.points, axis, axis=1) + meridian.center
    letters = {f"symmetry_{'xyz'[i]}": f"symmetry_{'xyz'[(axis + i) % 3]}" for i in range(3)}
    faces = {letters.get(name, name): face for name, face in mesh.faces.items()}
    return replace(mesh, points=points, faces=dict(sorted(faces.items())), revolved="xyz"[axis])
