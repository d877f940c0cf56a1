"""Support: the base of all supports, with everything that follows from one.

A support is a frozen dataclass that inherits `Support`, in a file of its own. As a load does, it answers what the
equations, models, stages, measures, reports, job files and other programs need to know; nothing else asks for its
class. What it leaves out has the default that stands here.
"""

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import outer_triangles
from turgor.core.model.history import History
from turgor.core.model.loads.load import Deck, DeckRows
from turgor.core.model.places import NodesAt, name_of
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


class Support:
    """A support of an actuator, and all that follows from it; `Fixed`, `ReferencePoint` and the like inherit it.

    Examples
    --------
    >>> from turgor.core.model.supports import Fixed
    >>> support = Fixed("fixed", "xz")
    >>> support.place, support.prescribed, support.text()
    ('fixed', ('fixed', 'xz'), 'fixed does not move in x, z.')
    """

    __slots__ = ()

    #: Whether its face may be a `NodesAt`, or the name of a node set of the mesh.
    at_places: ClassVar[bool] = False
    #: Whether the traction may jump across its face.
    jumps: ClassVar[bool] = True
    #: Whether it may move an actuator, which then works on what moves it.
    moves: ClassVar[bool] = False
    #: Whether it is a mirror plane, in which reference points and rigid faces may lie.
    mirror: ClassVar[bool] = False
    #: Whether a section takes it; what is no mirror plane fixes the place of the section.
    in_sections: ClassVar[bool] = False
    #: Texts that state it in ``[supports]`` of a job file, with the values of its fields besides the face.
    job_texts: ClassVar[Mapping[str, Mapping[str, Any]]] = {}

    @property
    def place(self) -> str:
        """Name of the fixed face, place or point."""
        return name_of(getattr(self, "face", getattr(self, "point", "")))

    @property
    def label(self) -> str:
        """The support in a few letters, such as ``"Fixed(fixed)"``."""
        return f"{type(self).__name__}({self.place})"

    @property
    def named_faces(self) -> tuple[str, ...]:
        """Faces that the mesh must have."""
        face = getattr(self, "face", None)
        return (face,) if isinstance(face, str) else ()

    @property
    def prescribed(self) -> tuple[str, str]:
        """Face or point whose displacement it prescribes, and the directions; empty of other supports."""
        return "", ""

    @property
    def turned_point(self) -> str:
        """Reference point whose rotation it prescribes; empty of other supports."""
        return ""

    @property
    def way(self) -> History | None:
        """History of what it prescribes; None where nothing is moved, or a function says where."""
        return None

    @property
    def tied(self) -> tuple[str, str] | None:
        """Face whose nodes follow, and the one that they follow, where it is a tie; None of other supports."""
        return None

    @property
    def bedding(self) -> tuple[float, float]:
        """Stiffness per area of springs under its face, along the normal and across it [Pa/m]."""
        return 0.0, 0.0

    @property
    def push(self) -> tuple[float, float, float] | None:
        """Unit vector along which a tip pushes on what measures its force; None of other supports."""
        return None

    @property
    def measures(self) -> tuple[str, ...]:
        """Names of the measures of contact and blocked tips that a response has by itself."""
        return ()

    def nodes(self, mesh: Mesh) -> Ints:
        """Return the nodes of its face, of the whole surface for ``"*"``, or of its place."""
        face = getattr(self, "face", "")
        if isinstance(face, NodesAt):
            return face.nodes(mesh)
        return np.unique(outer_triangles(mesh)) if face == "*" else mesh.face_nodes(face)

    def check(self, mesh: Mesh) -> None:
        """Raise an error if it cannot act on a mesh that has all faces which it names."""
        if isinstance(getattr(self, "face", None), NodesAt):
            self.nodes(mesh)

    def text(self) -> str:
        """Return the sentence of a report."""
        return f"{type(self).__name__} of {self.place}."

    def components(self, mesh: Mesh) -> list[int]:
        """Return the axes along which the displacement of its face or point is prescribed."""
        return ["xyz".index(letter) for letter in self.prescribed[1]]

    def displacement(self, points: Array, load_factor: float) -> Array:
        """Return the prescribed displacement (n, 3) [m] of points at rest; its components count. Only if it `moves`."""
        return np.zeros_like(points)

    def normals(self, mesh: Mesh) -> tuple[Ints, Array] | None:
        """Return nodes (k,) and the unit vectors (k, 3) along which they do not move; None where there are none."""
        return None

    def equations(self, mesh: Mesh) -> tuple[Ints, Array] | None:
        """Return linear equations between displacements; None where there are none.

        Returns
        -------
        nodes : (k, m) int array
            Nodes of each equation, one for each of its terms.
        vectors : (k, m, 3) array
            The sum over the terms of the displacement times this vector is zero.
        """
        return None

    def section_axis(self, mesh: Mesh) -> int | None:
        """Return the axis along which all nodes of its face move by the same free amount; None of other supports."""
        return None

    def as_moved(self) -> "Support":
        """Return a support that later stages can move: a displacement of zero for a face that is fixed."""
        return self

    def continued(self, factor: float, new: Any) -> "Support":
        """Return the support of the next stage, which begins at a load factor of this one.

        Parameters
        ----------
        factor : float
            Load factor at which this stage ended.
        new : Displacement or None
            What replaces it.
        """
        return self

    def boundary_rows(self, deck: Deck) -> tuple[str, ...]:
        """Return the rows of ``*BOUNDARY`` in an .inp file by which a face stays fixed; not called for points.

        Raises
        ------
        TurgorError
            If it has no form there.
        """
        raise TurgorError(f"{self.label} has no form in .inp files; leave it out.")

    def deck_rows(self, deck: Deck) -> tuple[DeckRows, ...]:
        """Return the rows in the first step of an .inp file by which it moves a reference point."""
        return ()

    def job_text(self) -> str | dict[str, object]:
        """Return how ``[supports]`` of a job file states it."""
        kind: Any = type(self)
        for text, values in self.job_texts.items():
            if kind(self.place, **values) == self:
                return text
        raise TurgorError(f"{self.text().rstrip('.')}: this has no form in a job file.")


def coordinate_plane(mesh: Mesh, face: str, what: str) -> int:
    """Return the number of the axis along the normal of a face that must be a coordinate plane."""
    extent = np.ptp(mesh.points[mesh.face_nodes(face)], axis=0)
    axis = mesh.normal_axis(face)
    if extent[axis] > ROUND_OFF.mesh_digits * extent.max():
        raise TurgorError(f"face '{face}' is not a coordinate plane; {what} must be one.")
    return axis


def check_directions(directions: object, what: str) -> None:
    """Refuse directions that are not some of x, y and z."""
    if not isinstance(directions, str) or not set(directions) <= set("xyz") or not directions:
        raise TurgorError(f"{what}: directions is {directions!r}; some of x, y and z are needed, such as 'xz'.")
