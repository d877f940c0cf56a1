"""NodesAt: the nodes of an edge, a corner or a box, where a support or a force acts on no whole face."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.mesh import Mesh
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.given import Quantities, name, shown, vector
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import format_quantity, mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]
Point: TypeAlias = tuple[float, float, float]

#: Fields that say where the nodes are.
PLACES = ("edge", "near", "box", "node_set")


@dataclass(frozen=True, slots=True)
class NodesAt:
    """Nodes that a support or a `Force` acts on where that is no whole face: one of the four keys says where.

    A support of one node or of an edge fits what keeps a body from drifting and carries hardly any force. Stress has no
    bound there, and what a large force moves depends on the mesh.

    A force is spread by area over the sides of the surface whose nodes are all in the place. Where there are none, it
    is spread by length along the edges of cells in it; nodes without such an edge get equal shares.

    Parameters
    ----------
    name : str
        By which stages and reports call it.
    edge : (str, str), optional
        Two faces: the nodes that both have.
    near : (3,) floats [m], optional
        The node nearest to this point, at rest.
    box : two (3,) floats [m], optional
        Two opposite corners: all nodes within, at rest.
    node_set : str, optional
        A set of nodes of a mesh file, such as an edge or a point that has a name there.

    Raises
    ------
    TurgorError
        If not exactly one of the four is given, or it has another form.

    Examples
    --------
    >>> NodesAt("rim", edge=("fixed", "outside")).text
    'the edge between fixed and outside'
    >>> NodesAt("corner", near=("5 mm", 0, 0)).near
    (0.005, 0.0, 0.0)
    """

    name: str
    edge: tuple[str, str] | None = None
    near: Point | None = None
    box: tuple[Point, Point] | None = None
    node_set: str | None = None

    if TYPE_CHECKING:

        def __init__(
            self,
            name: str,
            edge: tuple[str, str] | None = None,
            near: Quantities | None = None,
            box: tuple[Quantities, Quantities] | None = None,
            node_set: str | None = None,
        ) -> None: ...

    def __post_init__(self) -> None:
        what = f"place '{name(self.name, 'name of a place', 'corner')}'"
        given = [key for key in PLACES if getattr(self, key) is not None]
        if len(given) != 1:
            raise TurgorError(
                f"{what} has {' and '.join(given) or 'none'} of edge, near, box and node_set; one is needed."
            )
        if self.edge is not None:
            object.__setattr__(self, "edge", _two_faces(self.edge, what))
        if self.near is not None:
            object.__setattr__(self, "near", vector(self.near, f"{what}: near", "length"))
        if self.box is not None:
            object.__setattr__(self, "box", _corners(self.box, what))
        if self.node_set is not None:
            name(self.node_set, f"{what}: node_set", "rim")

    @property
    def text(self) -> str:
        """Where it is, in words."""
        if self.edge is not None:
            return f"the edge between {self.edge[0]} and {self.edge[1]}"
        if self.near is not None:
            return f"the node nearest to {_millimeters(self.near)} mm"
        if self.node_set is not None:
            return f"the nodes of the set '{self.node_set}'"
        assert self.box is not None
        return f"the box from {_millimeters(self.box[0])} to {_millimeters(self.box[1])} mm"

    def nodes(self, mesh: Mesh) -> Ints:
        """Return its nodes in a mesh, sorted.

        Raises
        ------
        TurgorError
            If the mesh has none there.
        """
        points = mesh.points
        slack = ROUND_OFF.mesh_digits * float(np.ptp(points, axis=0).max())
        if self.edge is not None:
            nodes = np.intersect1d(mesh.face_nodes(self.edge[0]), mesh.face_nodes(self.edge[1]))
        elif self.near is not None:
            carrying = np.unique(mesh.carrying_cells if len(mesh.cells) else mesh.film_sides)
            nodes = carrying[[np.linalg.norm(points[carrying] - self.near, axis=1).argmin()]]
        elif self.node_set is not None:
            if self.node_set not in mesh.node_sets:
                raise unknown(f"node set of the place '{self.name}'", self.node_set, mesh.node_sets)
            nodes = mesh.node_sets[self.node_set]
        else:
            low, high = np.array(self.box)
            nodes = np.flatnonzero(((points >= low - slack) & (points <= high + slack)).all(axis=1))
        if not len(nodes):
            low, high = points.min(axis=0), points.max(axis=0)
            raise TurgorError(
                f"place '{self.name}', {self.text}, has no node of the mesh, which reaches from "
                f"{_millimeters(low)} to {_millimeters(high)} mm."
            )
        return np.asarray(nodes, dtype=np.int64)

    def at_node(self, mesh: Mesh) -> bool:
        """Whether the point of ``near`` is that of its node, which is then the same on finer cells."""
        away = np.linalg.norm(mesh.points[self.nodes(mesh)] - np.array(self.near), axis=1)
        return bool(away.max() <= ROUND_OFF.mesh_digits * float(np.ptp(mesh.points, axis=0).max()))

    def table(self) -> dict[str, object]:
        """Return its keys in a job file."""
        if self.edge is not None:
            return {"edge": list(self.edge)}
        if self.near is not None:
            return {"near": [format_quantity(part, "mm") for part in self.near]}
        if self.node_set is not None:
            return {"node_set": self.node_set}
        assert self.box is not None
        return {"box": [[format_quantity(part, "mm") for part in corner] for corner in self.box]}


def checked_face(face: object, what: str, example: str) -> str:
    """Return the name of a face or of a `NodesAt`; refuse everything else."""
    return face.name if isinstance(face, NodesAt) else name(face, what, example)


def name_of(face: object) -> str:
    """Return the name of a face or of a place."""
    return face.name if isinstance(face, NodesAt) else str(face)


def described(face: str | NodesAt) -> str:
    """Return a face or a place in the words of a report."""
    return f"{face.name} ({face.text})" if isinstance(face, NodesAt) else face


def _two_faces(faces: object, what: str) -> tuple[str, str]:
    if isinstance(faces, str) or not isinstance(faces, list | tuple) or len(set(faces)) != 2 or len(faces) != 2:
        raise TurgorError(f"{what}: edge is {shown(faces)}; the names of two faces that meet along it are needed.")
    one, other = (name(face, f"{what}: edge", "tip") for face in faces)
    return one, other


def _corners(box: object, what: str) -> tuple[Point, Point]:
    if isinstance(box, str) or not isinstance(box, list | tuple) or len(box) != 2:
        raise TurgorError(f"{what}: box is {shown(box)}; two opposite corners are needed.")
    one, other = (vector(corner, f"{what}: corner of box", "length") for corner in box)
    low, high = zip(*((min(a, b), max(a, b)) for a, b in zip(one, other, strict=True)), strict=True)
    return low, high


def _millimeters(point: Point | Array) -> str:
    return f"({', '.join(f'{part / mm:.4g}' for part in point)})"
