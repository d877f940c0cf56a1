"""Assembly: several bodies, each built, meshed and put in its place, as one actuator of a job."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import isfinite
from typing import Any

import numpy as np

from turgor.core.geometry.directions import AXES
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.bodies.combine import combined
from turgor.core.meshing.bodies.placing import placed
from turgor.core.meshing.default_settings import chosen_cells
from turgor.core.meshing.exchange.mesh_file import MeshedShape, meshed_geometry
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.surface import outer_triangles
from turgor.foundation.errors import TurgorError, unknown
from turgor.units import format_quantity

Vector = tuple[float, float, float]

#: A rigid body is tied to its point by all of its surface, and a plate joins two faces of bodies: names of these faces.
SURFACE, JOINT = "surface", "joint"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlacedBody:
    """One body of an assembly, or several equal ones.

    Parameters
    ----------
    part : Actuator
        What is built and meshed: a family, a plain solid, a CAD file or a mesh file.
    origin : (3,) floats [m]
        Where the origin of the part is, after the rotation.
    rotation : (3,) floats [rad]
        How it is turned about the origin of the part, as axis times angle.
    size : float [m], optional
        Size of its cells; that of the assembly by default.
    copies : int
        How many there are.
    around : str, optional
        Axis through the origin, x, y or z, around which copies stand at equal angles.
    step : (3,) floats [m], optional
        From each copy to the next.
    on : str, optional
        Body and face, such as ``"lower.tip"``, to which a rigid plate joins its face ``fixed``. Copies with a step are
        joined to the one before where it is ``"tip"`` alone.
    mass : float [kg], optional
        Makes it a rigid body of this mass, evenly spread, which is free to move and to turn.

    Examples
    --------
    >>> from turgor.core.geometry.solids import Block
    >>> PlacedBody(part=Block(), copies=3, around="z").angle(1)
    2.0943951023931953
    """

    part: Any
    origin: Vector = (0.0, 0.0, 0.0)
    rotation: Vector = (0.0, 0.0, 0.0)
    size: float | None = None
    copies: int = 1
    around: str | None = None
    step: Vector | None = None
    on: str | None = None
    mass: float | None = None

    def __post_init__(self) -> None:
        if not 1 <= self.copies <= 100:
            raise TurgorError(f"copies is {self.copies}; allowed are 1 to 100.")
        if self.around is not None and self.around not in AXES:
            raise unknown("axis of around", self.around, "xyz")
        if (self.copies > 1) != ((self.around is None) != (self.step is None)):
            raise TurgorError(
                f"copies is {self.copies}; several need either around, such as 'z', or step, and a single one neither."
            )
        if self.mass is not None and not (isfinite(self.mass) and self.mass > 0):
            raise TurgorError(f"mass is {self.mass:g} kg; allowed is more than 0.")
        if self.size is not None and not (isfinite(self.size) and self.size > 0):
            raise TurgorError(f"size is {format_quantity(self.size, 'mm')}; allowed is more than 0.")
        if self.mass is not None and self.on is not None:
            raise TurgorError(
                f"on is '{self.on}'; a body with a mass is free, so no plate joins it. Leave out mass, and give it "
                "to the plate: a reference point at its face joint_NAME."
            )
        if self.on is not None and self.step is None and not self.on.rpartition(".")[0]:
            raise TurgorError(
                f"on is '{self.on}'; name a body and its face, such as 'palm.tip'. "
                "A face alone is for copies with a step."
            )

    def angle(self, number: int) -> float:
        """Angle [rad] by which copy ``number``, from 0, is turned around the axis."""
        return 0.0 if self.around is None else 2 * np.pi * number / self.copies

    def place(self, mesh: Mesh, number: int) -> Mesh:
        """Put the mesh of the part into the place of copy ``number``, from 0."""
        step = np.array(self.step or (0.0, 0.0, 0.0))
        angle = float(np.linalg.norm(self.rotation))
        x, y, z = (float(each) for each in np.array(self.origin) + number * step)
        mesh = placed(mesh, axis=self.rotation if angle else AXES["z"], angle=angle, shift=(x, y, z))
        return (
            mesh
            if not number or self.around is None
            else placed(mesh, axis=AXES[self.around], angle=self.angle(number))
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Assembly:
    """Several bodies as one actuator: the fingers of a hand, the segments of an arm, and objects.

    Parameters
    ----------
    bodies : mapping of str to PlacedBody
    mesh : MeshSettings
        Size, quality and kind of the cells of all bodies; a body may have a size of its own.

    Examples
    --------
    >>> from turgor.core.geometry.solids import Block
    >>> pair = Assembly(bodies={"leg": PlacedBody(part=Block(), copies=2, step=(0.05, 0, 0))})
    >>> list(pair.members)
    ['leg_1', 'leg_2']
    >>> pair.build().regions
    ('body_leg_1', 'body_leg_2')
    """

    bodies: Mapping[str, PlacedBody]
    mesh: MeshSettings = field(default_factory=MeshSettings)

    def __post_init__(self) -> None:
        if not self.bodies:
            raise TurgorError("bodies is empty; at least one body is needed.")
        names = [name for each in self.groups.values() for name in each]
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            raise TurgorError(f"two bodies are called '{twice}'; give one of them another name.")

    @property
    def groups(self) -> dict[str, tuple[str, ...]]:
        """Names of the bodies by the name of their table."""
        return {name: _copies(name, body) for name, body in self.bodies.items()}

    @property
    def members(self) -> dict[str, tuple[PlacedBody, int]]:
        """The bodies by their names, with the number of the copy, from 0."""
        return {
            name: (self.bodies[group], number)
            for group, names in self.groups.items()
            for number, name in enumerate(names)
        }

    @property
    def rigid(self) -> dict[str, float]:
        """Masses [kg] of the rigid bodies by their names."""
        return {name: body.mass for name, (body, _) in self.members.items() if body.mass is not None}

    @property
    def joints(self) -> dict[str, tuple[str, str]]:
        """Of each body that a plate joins to another one: that body, and its face."""
        out = {}
        for group, names in self.groups.items():
            on = self.bodies[group].on
            for before, name in zip(("", *names), names, strict=False):
                body, _, face = (on or "").rpartition(".")
                target = before if before and self.bodies[group].step is not None else body
                if on is not None and target:
                    out[name] = (target, face)
        return out

    def build(self) -> Geometry:
        """Build and mesh all bodies, put them in their places, and name them.

        Returns
        -------
        Geometry
            Regions and faces have the name of their body behind them, as `together` names them.
        """
        shapes = {name: body.part.build() for name, body in self.bodies.items()}
        meshes = self._meshes(shapes)
        bodies = {}
        for name, (body, number) in self.members.items():
            group = next(key for key, names in self.groups.items() if name in names)
            try:
                bodies[name] = body.place(meshes[group], number)
            except TurgorError as error:
                hint = "; symmetric = false models the whole of a family" if "mirror plane" in str(error) else ""
                raise TurgorError(f"body '{name}': {error}{hint}") from None
        mesh = combined(bodies)
        names = {
            name: {own: f"{own}_{name}" for own in (*each.regions, *each.faces) if not own.startswith("symmetry_")}
            for name, each in bodies.items()
        }
        shape = MeshedShape(self._tied(mesh, bodies, names), names, self.groups)
        return meshed_geometry(shape, min(each.smallest_wall for each in shapes.values()))

    def _meshes(self, shapes: Mapping[str, Geometry]) -> dict[str, Mesh]:
        """Mesh each part once, all with the same kind of cells."""
        from turgor.core.meshing.generate import mesh_with  # here: it loads all ways to mesh, and every job this file

        meshed = {name: shape.shape.mesh for name, shape in shapes.items() if isinstance(shape.shape, MeshedShape)}
        settings = {name: self._settings(name, shape) for name, shape in shapes.items() if name not in meshed}
        called = {name: self._called(name) for name in shapes}
        known = {f"{face}_{each}" for name, shape in shapes.items() for face in shape.faces for each in called[name]}
        wrong = next((face for face in self.mesh.face_sizes if face not in known), None)
        if wrong is not None:
            raise unknown("face of face_sizes", wrong, known)
        kinds = {chosen_cells(shapes[name], each) for name, each in settings.items()}
        kinds |= {"tetrahedra" if mesh.cell_type.corners == 4 else "hexahedra" for mesh in meshed.values()}
        cells = self.mesh.cells or (kinds.pop() if len(kinds) == 1 else "tetrahedra")
        return meshed | {name: mesh_with(shapes[name], replace(each, cells=cells)) for name, each in settings.items()}

    def _settings(self, name: str, shape: Geometry) -> MeshSettings:
        """Settings of the mesh of one part."""
        size = self.bodies[name].size or self.mesh.size
        faces = {
            face: length
            for face in shape.faces
            for each in self._called(name)
            if (length := self.mesh.face_sizes.get(f"{face}_{each}")) is not None
        }
        return replace(self.mesh, size=size, face_sizes=faces)

    def _called(self, name: str) -> tuple[str, ...]:
        """Name of a table, and those of its copies: all of them have one mesh."""
        return (name, *self.groups[name])

    def _tied(self, mesh: Mesh, bodies: Mapping[str, Mesh], names: Mapping[str, Mapping[str, str]]) -> Mesh:
        """Add the surfaces of rigid bodies, and pairs of faces that plates join, as faces."""
        faces = dict(mesh.faces)
        outer = outer_triangles(mesh)
        mirrors = [mesh.face_nodes(name) for name in mesh.symmetry_faces]
        for name in self.rigid:
            rows = np.concatenate([mesh.regions[names[name][region]] for region in bodies[name].regions])
            nodes = np.unique(mesh.cells[rows])
            own = outer[np.isin(outer, nodes).all(axis=1)]
            for plane in mirrors:
                own = own[~np.isin(own, plane).all(axis=1)]
            faces[f"{SURFACE}_{name}"] = own
        for name, (other, face) in self.joints.items():
            if other not in names:
                raise unknown("body that on names", other, names)
            known = [own for own, full in names[other].items() if full in mesh.faces]
            if face not in known:
                raise unknown(f"face of the body '{other}' that on names", face, known)
            if "fixed" not in names[name]:
                raise TurgorError(f"body '{name}': on joins its face 'fixed', and it has none.")
            both = (names[other][face], names[name]["fixed"])
            faces[f"{JOINT}_{name}"] = np.concatenate([faces[each] for each in both])
        return replace(mesh, faces=faces)


def _copies(name: str, body: PlacedBody) -> tuple[str, ...]:
    return (name,) if body.copies == 1 else tuple(f"{name}_{number}" for number in range(1, body.copies + 1))
