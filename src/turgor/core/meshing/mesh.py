"""Mesh: curved quadratic cells with named regions and faces."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.names import cavity_names
from turgor.core.geometry.wedge import HIGH, LOW, Wedge
from turgor.core.meshing.bodies.enclosing import encloses_cavity
from turgor.core.meshing.cells import (
    HEXAHEDRON,
    HEXAHEDRON_20,
    QUADRILATERAL_8,
    TETRAHEDRON,
    TRIANGLE,
    CellType,
    cell_type,
)
from turgor.core.meshing.middles import middles_of
from turgor.foundation.display import Shown, listed
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.finding import Finding
from turgor.foundation.round_off import ROUND_OFF

#: Mid-side nodes 4..9 of a ten-node tetrahedron lie on these pairs of its vertices (VTK and Abaqus order).
TETRAHEDRON_EDGES = TETRAHEDRON.edges

#: Mid-side nodes 3..5 of a six-node triangle lie on these pairs of its vertices.
TRIANGLE_EDGES = TRIANGLE.edges

#: A revolved mesh that reaches its axis has a hole there of this share of its largest radius, so that no cell
#: collapses. What is missing has 1e-8 of the section, and its wall cannot move away from the axis.
PINHOLE = 1e-4


def has_area(sides: NDArray[np.int64]) -> bool:
    """Whether the sides of a face have an area: those that stand for edges of films have equal corners."""
    corners = np.sort(sides[:, : 3 if sides.shape[1] == TRIANGLE.nodes else 4], axis=1)
    return bool((np.diff(corners, axis=1) > 0).all())


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Mesh(Shown):
    """Quadratic cells of one kind with the names of the geometry: tetrahedra, or hexahedra where a section was swept.

    Vertices come first among the points, mid-side nodes after them. Faces on the surface of the body point out of
    the solid, so a cavity's normals point into the cavity; faces inside the body (a strain-limiting layer between
    two regions) may point either way. A face name that begins with ``symmetry_`` marks a mirror plane.

    Parameters
    ----------
    points : (n, 3) float array [m]
        Reference positions of all nodes, vertices first.
    cells : (c, 10), (c, 20) or (c, 27) int array
        Nodes of each cell in the order of `turgor.core.meshing.cells`: corners, mid-side nodes, then middles.
    regions : dict of str to (k,) int array
        Cells of each named region; together they hold every cell once.
    faces : dict of str to (f, 6), (f, 8) or (f, 9) int array
        Sides of cells that make each named face: six-node triangles or quadrilaterals, corners first.
    name : str
        What the mesh shows, for reports.
    findings : tuple of Finding
        What was noticed while it was made.
    revolved : str
        ``"x"``, ``"y"`` or ``"z"`` where it is a quarter of a body of revolution about a line along that axis, whose
        states are axisymmetric: all nodes of a ring move alike (`turgor.core.engine.algebra.rings`). The line is where
        the two mirror planes along the axis meet. Empty for any other mesh.
    wedge : Wedge, optional
        The sector of the whole that it is, where it is one; its cut faces are ``cyclic_low`` and ``cyclic_high``, and
        the nodes of the one are those of the other, turned.
    serendipity : bool
        Whether the middles of sides and cells of 27-node hexahedra follow the other 20 nodes (`turgor.core.meshing.
        middles`), which halves the unknowns. Their places follow, too.
    node_sets : dict of str to (k,) int array
        Nodes of each named edge or point of a file, which holds no whole side. `Fixed`, `Displacement` and `Force` take
        these names as those of faces.
    parted : tuple of (str, str)
        Faces of a bond, one on each body, whose nodes were one (`turgor.core.meshing.bodies.parted`).

    Raises
    ------
    TurgorError
        If an index is out of range, vertices do not come first, a cell belongs to no region or to two, or the cut faces
        of a wedge do not match.
    """

    points: NDArray[np.float64]
    cells: NDArray[np.int64]
    regions: dict[str, NDArray[np.int64]]
    faces: dict[str, NDArray[np.int64]]
    name: str = "mesh"
    findings: tuple[Finding, ...] = ()
    revolved: str = ""
    wedge: Wedge | None = None
    serendipity: bool = False
    node_sets: dict[str, NDArray[np.int64]] = field(default_factory=dict)
    parted: tuple[tuple[str, str], ...] = ()
    vertex_count: int = field(init=False)
    cavities: tuple[str, ...] = field(init=False)
    """Names of the faces that enclose a cavity: those that begin with ``cavity`` and are no open surface."""

    def __post_init__(self) -> None:
        if self.cells.ndim != 2 or self.cells.shape[1] not in (10, 20, 27) or not (len(self.cells) or self.faces):
            raise TurgorError(
                f"mesh '{self.name}': cells have shape {self.cells.shape}; (c, 10), (c, 20) or (c, 27) is needed."
            )
        corners = self.cell_type.corners
        outside = np.argwhere((self.cells < 0) | (self.cells >= len(self.points)))
        if len(outside):
            cell, place = outside[0]
            raise TurgorError(
                f"mesh '{self.name}': cell {cell} names node {self.cells[cell, place]}, outside "
                f"0..{len(self.points) - 1}."
            )
        if not np.isfinite(self.points).all():
            node = int(np.argmin(np.isfinite(self.points).all(axis=1)))
            raise TurgorError(
                f"mesh '{self.name}': node {node} lies at {self.points[node].tolist()}, which is no place."
            )
        sides = self.cell_type.side
        for name, face in self.faces.items():
            if face.ndim != 2 or face.shape[1] != sides.nodes:
                raise TurgorError(
                    f"mesh '{self.name}': face '{name}' has shape {face.shape}; the sides of a {self.cell_type.name} "
                    f"are {sides.name}s, (f, {sides.nodes})."
                )
        pieces, corners = self.pieces, corners if len(self.cells) else sides.corners
        vertices = np.unique(pieces[:, :corners])
        if vertices[-1] != len(vertices) - 1 or pieces[:, corners:].min() < len(vertices):
            raise TurgorError(f"mesh '{self.name}': vertices must be numbered first and mid-side nodes after them.")
        owner = np.zeros(len(self.cells), dtype=np.int64)
        for cells in self.regions.values():
            owner[cells] += 1
        if (owner != 1).any():
            raise TurgorError(
                f"mesh '{self.name}': {int((owner != 1).sum())} cells do not belong to exactly one region."
            )
        object.__setattr__(self, "vertex_count", len(vertices))
        if self.serendipity:
            self._check_middles()
            object.__setattr__(self, "points", middles_of(self.cells).values(self.points))
        object.__setattr__(self, "cavities", self._enclosing(cavity_names(self.faces)))
        if self.wedge is not None and (self.leaders[: len(vertices)] >= len(vertices)).any():
            raise TurgorError(f"mesh '{self.name}': a vertex of '{HIGH}' lies on a mid-side node of '{LOW}'.")

    def _check_middles(self) -> None:
        if self.cell_type is not HEXAHEDRON or self.revolved or self.wedge is not None:
            raise TurgorError(
                f"mesh '{self.name}': middles follow in meshes of 27-node hexahedra that are neither revolved nor a "
                "wedge."
            )

    def __repr__(self) -> str:
        return f"Mesh('{self.name}', {self.counts}, regions: {listed(self.regions)}, faces: {listed(self.faces)})"

    @property
    def counts(self) -> str:
        """Number of cells and nodes in words."""
        if not len(self.cells):
            return f"{len(self.film_sides):,} {self.cell_type.side.name}s, {len(self.points):,} nodes"
        return f"{len(self.cells):,} {self.cell_type.name.replace('hedron', 'hedra')}, {len(self.points):,} nodes"

    @property
    def pieces(self) -> NDArray[np.int64]:
        """Nodes of what the mesh consists of, a row each: its cells, or the sides of its films where it has none."""
        return self.cells if len(self.cells) else self.film_sides

    @property
    def film_sides(self) -> NDArray[np.int64]:
        """Sides of the films that a mesh without cells consists of, (f, n), each once; edges have no area."""
        corners = self.cell_type.side.corners
        every = np.concatenate([sides for sides in self.faces.values() if has_area(sides)])
        _, first = np.unique(np.sort(every[:, :corners], axis=1), axis=0, return_index=True)
        return np.asarray(every[np.sort(first)])

    def face(self, name: str) -> NDArray[np.int64]:
        """Return the sides of a named face, a row each; unknown names fail with the list of known ones."""
        if name in self.node_sets and name not in self.faces:
            raise TurgorError(
                f"'{name}' is a set of {len(self.node_sets[name])} nodes that holds no whole side; supports in "
                "directions, displacements and forces take it, and this needs a face."
            )
        if name not in self.faces:
            raise unknown("face", name, self.faces)
        return self.faces[name]

    def region(self, name: str) -> NDArray[np.int64]:
        """Return the cell indices of a named region; unknown names fail with the list of known ones."""
        if name not in self.regions:
            raise unknown("region", name, self.regions)
        return self.regions[name]

    def face_nodes(self, name: str) -> NDArray[np.int64]:
        """Return the sorted nodes of a named face."""
        return np.unique(self.face(name))

    @property
    def cell_type(self) -> CellType:
        """Kind of the cells."""
        return cell_type(self.cells.shape[1])

    @property
    def symmetry_faces(self) -> tuple[str, ...]:
        """Names of the faces that lie on a mirror plane."""
        return tuple(name for name in self.faces if name.startswith("symmetry_"))

    @property
    def cut_faces(self) -> tuple[str, ...]:
        """Names of the faces that are no surface of the whole actuator: mirror planes, and cuts of a wedge."""
        return (*self.symmetry_faces, *(() if self.wedge is None else (LOW, HIGH)))

    @property
    def leaders(self) -> NDArray[np.int64]:
        """The node whose motion each node has, (n,): itself, but for the higher cut face of a wedge."""
        out = np.arange(len(self.points))
        if self.wedge is not None:
            high = self.face_nodes(HIGH)
            out[high] = self.wedge.partners(self.points, self.face_nodes(LOW), high)
        return out

    @property
    def mirror_planes(self) -> tuple[tuple[int, float], ...]:
        """Axis along the normal and position [m] of the mirror plane of each of `symmetry_faces`."""
        planes = []
        for name in self.symmetry_faces:
            axis = self.normal_axis(name)
            planes.append((axis, float(self.points[self.face_nodes(name)][:, axis].mean())))
        return tuple(planes)

    def normal_axis(self, name: str) -> int:
        """Axis along the normal of a flat face; an edge of a flat film has two, and ``symmetry_y`` means y."""
        extent = np.ptp(self.points[self.face_nodes(name)], axis=0)
        named = "xyz".find(name.removeprefix("symmetry_"))
        flat = named >= 0 and extent[named] <= ROUND_OFF.mesh_digits * extent.max()
        return named if flat else int(extent.argmin())

    @property
    def radii(self) -> NDArray[np.float64]:
        """Distance of each node from the axis of a revolved mesh, (n,) [m]."""
        planes = dict(self.mirror_planes)
        across = [i for i in range(3) if "xyz"[i] != self.revolved]
        if not set(across) <= set(planes):
            raise TurgorError(
                f"mesh '{self.name}' is revolved about {self.revolved}, but has no two mirror planes along that axis."
            )
        arms = self.points[:, across] - np.array([planes[i] for i in across])
        return np.asarray(np.hypot(*arms.T))

    @property
    def on_axis(self) -> NDArray[np.bool_]:
        """Which nodes of a revolved mesh stand for its axis, (n,): those around its pinhole."""
        radii = self.radii
        return np.asarray(radii <= 2 * PINHOLE * radii.max())

    def _enclosing(self, names: tuple[str, ...]) -> tuple[str, ...]:
        """Names of those faces that enclose a cavity; all in a wedge or a body of revolution, whose cuts close them."""
        if not names or self.wedge is not None or self.revolved:
            return names
        at_mirror = np.zeros(len(self.points), dtype=bool)
        for name in self.symmetry_faces:
            at_mirror[self.faces[name]] = True
        mirrors = dict(self.mirror_planes)
        return tuple(name for name in names if encloses_cavity(self.points, self.faces[name], mirrors, at_mirror))

    @property
    def symmetry_factor(self) -> int:
        """How many copies of this mesh make the whole actuator: 1, 2 or 4, or the number of sectors of a wedge."""
        return int(2 ** len(self.symmetry_faces)) * (1 if self.wedge is None else self.wedge.fold)

    @property
    def carrying_cells(self) -> NDArray[np.int64]:
        """Nodes of each cell that carry its displacement, (c, n): all but the middles that follow."""
        return np.ascontiguousarray(self.cells[:, : HEXAHEDRON_20.nodes]) if self.serendipity else self.cells

    def carrying_sides(self, name: str) -> NDArray[np.int64]:
        """Nodes of each side of a named face that carry its displacement, (f, n): all but middles that follow."""
        sides = self.face(name)
        return np.ascontiguousarray(sides[:, : QUADRILATERAL_8.nodes] if self.serendipity else sides)

    @property
    def _middle_count(self) -> int:
        return len(np.unique(self.cells[:, HEXAHEDRON_20.nodes :])) if self.serendipity else 0

    @property
    def unknown_count(self) -> int:
        """Displacement components plus mean stresses, before supports are applied.

        Of a revolved mesh per ring, of a wedge without those that follow.
        """
        if self.wedge is not None:
            own = self.leaders == np.arange(len(self.points))
            return int(3 * own.sum() + own[: self.vertex_count].sum())
        if not self.revolved:
            return 3 * (len(self.points) - self._middle_count) + self.vertex_count
        axis = "xyz".index(self.revolved)
        places = np.stack([self.points[:, axis], self.radii], axis=1) / (1e-6 * np.ptp(self.points, axis=0).max())
        rings = [len(np.unique(part.round(), axis=0)) for part in (places, places[: self.vertex_count])]
        return 2 * rings[0] + rings[1]
