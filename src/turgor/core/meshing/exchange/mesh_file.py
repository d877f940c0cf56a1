"""MeshFile: an actuator that comes as a mesh, as a job names it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from hashlib import sha256
from math import pi, sin
from pathlib import Path

import numpy as np

from turgor.core.geometry.cad.walls import WALLS, thinnest_wall
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.directions import AXES, FileAxes
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.cells import TETRAHEDRON, six_node_triangles
from turgor.core.meshing.exchange.formats.raw import Ints
from turgor.core.meshing.exchange.selectors import Choice
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.revolved.plane_state import PlaneState
from turgor.core.meshing.surface import outer_triangles
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity

Corner = tuple[float, float, float]

#: Share of a quarter of a circle that its two flat sides enclose.
FLAT_QUARTER = sin(pi / 4) / (pi / 4)


@dataclass(frozen=True, slots=True, eq=False)
class MeshedShape:
    """A mesh in the place of a CAD shape.

    Parameters
    ----------
    mesh : Mesh
    bodies : mapping of str to mapping
        Of a mesh of several bodies: for each of them its own names of regions and faces, with those in the mesh.
    groups : mapping of str to tuple of str
        Bodies that are copies of one, by its name.
    """

    mesh: Mesh
    bodies: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    groups: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    @property
    def bounding_box(self) -> tuple[Corner, Corner]:
        """Lowest and highest corner of the box around it, in CAD units."""
        points = self.mesh.points / METERS_PER_CAD_UNIT
        low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        return (low[0], low[1], low[2]), (high[0], high[1], high[2])


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshFile:
    """An actuator from a mesh file, with the arguments of `read_mesh`; an STL file is filled by `mesh_surfaces`.

    Parameters
    ----------
    file : Path
        The file.
    unit : str or float, optional
        Unit of length of the file; as for `read_mesh`.
    axes : tuple of three str or (3,) floats
        Directions in the file of our x, y and z.
    regions, faces : mapping of str to Choice
        Names with what they mean.
    cavities : mapping of str to Path
        Names of cavities with the STL files of their surfaces.
    turn : (str, float [rad]), optional
        The coordinate axis about which the mesh is turned by an angle, after all names are given.
    move : (3,) floats [m], optional
        How far it is moved, after the turn.
    mirror : tuple of str
        Normals of mirror planes through the origin, after the move: the half at positive x, y or z is taken.
    merge : bool
        Whether nodes at the same place become one, as for `read_mesh`.
    plane : PlaneStrain or Axisymmetric, optional
        What a plane mesh stands for; None for a volume mesh.
    sha256 : str
        Content of the file that is meant, as a lock file notes it; taken from the file where it is empty.

    Raises
    ------
    TurgorError
        If there is no such file, or its content is another one.

    Examples
    --------
    >>> MeshFile(file=Path("missing.msh"))
    Traceback (most recent call last):
    turgor.TurgorError: file is missing.msh, and there is no such file.
    """

    file: Path
    unit: str | float | None = None
    axes: FileAxes = ("x", "y", "z")
    regions: Mapping[str, Choice] = field(default_factory=dict)
    faces: Mapping[str, Choice] = field(default_factory=dict)
    cavities: Mapping[str, Path] = field(default_factory=dict)
    turn: tuple[str, float] | None = None
    move: Corner | None = None
    mirror: tuple[str, ...] = ()
    merge: bool = True
    plane: PlaneState | None = None
    sha256: str = ""

    def __post_init__(self) -> None:
        without = [name for name in ("cavities", "turn", "mirror") if self.plane is not None and getattr(self, name)]
        if without:
            raise TurgorError(f"{without[0]} is for volume meshes; a plane mesh is cut where its file is made.")
        if not self.merge and (self.plane is not None or Path(self.file).suffix.lower() == ".stl"):
            raise TurgorError("merge = false is for files of volume meshes; nodes of others are merged.")
        if not Path(self.file).is_file():
            raise TurgorError(f"file is {self.file}, and there is no such file.")
        checksum = sha256(Path(self.file).read_bytes()).hexdigest()
        if self.sha256 and self.sha256 != checksum:
            raise TurgorError(
                f"sha256 is {self.sha256[:12]}…, but the content of '{self.file}' has {checksum[:12]}…: the file has "
                "changed since; take the old one, or remove the key to go on with the new one."
            )
        object.__setattr__(self, "sha256", checksum)

    def read(self) -> Mesh:
        """Read the mesh, turn and move it, and take its half or quarter; hexahedra across its plane are split first."""
        from turgor.core.meshing.bodies.half import half_of, reach_across

        mesh = self._placed(self._whole())
        for number, normal in enumerate(self.mirror):
            if mesh.cell_type is not TETRAHEDRON and reach_across(mesh, normal):
                mesh = self._placed(self._tetrahedra())
                for earlier in self.mirror[:number]:
                    mesh = half_of(mesh, earlier)
            mesh = half_of(mesh, normal)
        return mesh

    def _whole(self) -> Mesh:
        """The mesh as the file has it."""
        from turgor.core.meshing.exchange.read import read_mesh
        from turgor.core.meshing.exchange.surface_filling import (
            mesh_surfaces,  # here: readers load much, and every job loads this file
        )

        if self.plane is not None:
            from turgor.core.meshing.revolved.read_plane import read_plane_mesh  # here: as the readers above

            return read_plane_mesh(
                self.file, self.plane, unit=self.unit, regions=self.regions, faces=self.faces, axes=self.axes
            )
        surface = Path(self.file).suffix.lower() == ".stl"
        reader: Callable[..., Mesh] = mesh_surfaces if surface else partial(read_mesh, merge=self.merge)
        return reader(
            self.file,
            unit=self.unit,
            regions=self.regions,
            faces=self.faces,
            cavities=self.cavities,
            axes=self.axes,
        )

    def _tetrahedra(self) -> Mesh:
        """The mesh with all cells split into tetrahedra, with a finding that says so."""
        from turgor.core.meshing.exchange.names import Wishes
        from turgor.core.meshing.exchange.read import named_mesh, read_in
        from turgor.core.meshing.exchange.splitting import as_tetrahedra

        raw, frame = read_in(Path(self.file), self.unit, self.axes)
        raw, _ = as_tetrahedra(raw)
        wishes = Wishes(regions=self.regions, faces=self.faces, cavities=self.cavities, frame=frame, merge=self.merge)
        mesh = named_mesh(raw, wishes)
        finding = Finding(
            code="G27",
            severity=Severity.NOTE,
            message=f"Hexahedra of '{mesh.name}' reach across its mirror plane, and all were split into "
            f"{len(mesh.cells)} tetrahedra.",
            advice="A mesh with sides of hexahedra on the plane keeps them; its half has fewer unknowns.",
        )
        return replace(mesh, findings=(*mesh.findings, finding))

    def _placed(self, mesh: Mesh) -> Mesh:
        """A mesh turned and moved."""
        if self.turn is None and self.move is None:
            return mesh
        from turgor.core.meshing.bodies.placing import placed

        axis, angle = self.turn or ("z", 0.0)
        return placed(mesh, shift=self.move or (0.0, 0.0, 0.0), axis=AXES[axis], angle=angle)

    def build(self) -> Geometry:
        """Read the mesh and give it the form of a geometry, whose names and volumes are those of the mesh."""
        mesh = self.read()
        corners = six_node_triangles(outer_triangles(mesh))[:, :3]
        extent = float(np.ptp(mesh.points, axis=0).max())
        wall = min(thinnest_wall(mesh.points[corners], most=WALLS.fewest)[0], extent)
        return meshed_geometry(MeshedShape(mesh), wall)


def meshed_geometry(shape: MeshedShape, smallest_wall: float) -> Geometry:
    """Give a mesh the form of a geometry, whose names and volumes are those of the mesh.

    Parameters
    ----------
    shape : MeshedShape
    smallest_wall : float [m]

    Returns
    -------
    Geometry
    """
    mesh = shape.mesh
    return Geometry(
        name=mesh.name,
        smallest_wall=smallest_wall,
        cavity_volumes={name: -_enclosed(mesh, mesh.faces[name]) for name in mesh.cavities},
        solid_volume=_enclosed(mesh, outer_triangles(mesh)),
        regions=tuple(mesh.regions),
        faces=tuple(sorted(mesh.faces)),
        node_sets=tuple(sorted(mesh.node_sets)),
        shape=shape,
    )


def _enclosed(mesh: Mesh, sides: Ints) -> float:
    """Volume behind flat sides [m³], seen from a point on all mirror planes.

    Between two parallel mirror planes, components across them do not count: no point is on both.
    """
    origin, planes = mesh.points.mean(axis=0), np.zeros(3, dtype=np.int64)
    for axis, level in mesh.mirror_planes:
        origin[axis] = level
        planes[axis] += 1
    along = planes < 2
    p = mesh.points[sides[:, : mesh.cell_type.side.corners]] - origin
    first, second = (
        (p[:, 2] - p[:, 0], p[:, 3] - p[:, 1]) if p.shape[1] == 4 else (p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    )
    normals = np.cross(first, second) / 2
    flat = 1.0 if not mesh.revolved else FLAT_QUARTER
    return float((p.mean(axis=1) * normals)[:, along].sum() / along.sum()) / flat
