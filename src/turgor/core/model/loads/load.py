"""Load: the base of all loads, with everything that follows from one.

A load is a frozen dataclass that inherits `Load`, in a file of its own. It answers what the equations, half models,
stages, reports and other programs need to know; nothing else asks for its class. What it leaves out has the default
that stands here.
"""

import re
from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import RAMP, History, fading, share_at, with_history
from turgor.core.model.history_text import shares_text
from turgor.core.model.loads.images import check_images
from turgor.core.model.places import NodesAt, name_of
from turgor.foundation.errors import TurgorError, unknown

Array = NDArray[np.float64]
Vector = tuple[float, float, float]


class NodalForces(Protocol):
    """Nodal forces of what acts on the modeled part: arrays (n, 3), scaled as the equations are.

    Arguments are in SI units. A force on the whole actuator is divided among the modeled part and its images.
    """

    def on_face(self, face: str, traction: ArrayLike) -> Array:
        """Forces of a constant traction (3,) [Pa] on the reference area of a face."""

    def of_total(self, place: str | NodesAt, force: ArrayLike) -> Array:
        """Forces of a total (3,) [N] on the whole actuator, spread over a face or place, or at a reference point."""

    def per_volume(self, value: Callable[[Array], Array]) -> Array:
        """Forces of ``value(points) -> (n, 3) force per reference volume [N/m³]``."""

    def per_mass(self, value: Callable[[Array], Array]) -> Array:
        """Forces of ``value(points) -> (n, 3) acceleration [m/s²]`` of all regions and sheets."""

    def of_weight(self, acceleration: ArrayLike) -> Array:
        """Forces of one acceleration (3,) [m/s²] of all regions, sheets and reference points."""

    def at_point(self, at: Vector, force: Vector) -> Array:
        """Forces of a force (3,) [N] at a point of the surface."""

    def along_edge(self, faces: tuple[str, str], force: Vector) -> Array:
        """Forces of a force per length (3,) [N/m] along the edge between two faces."""


@dataclass(frozen=True, slots=True)
class Turning:
    """A moment on a reference point, or a force that turns with it; neither has a potential.

    Parameters
    ----------
    point : str
        Name of the reference point.
    vector : (3,) floats [N m] or [N]
        Moment or force on the whole actuator.
    is_moment : bool
    follower : bool
        Whether the vector turns with the point.
    """

    point: str
    vector: Vector
    is_moment: bool
    follower: bool


@dataclass(frozen=True, slots=True)
class DeckRows:
    """Rows of an .inp file that share a keyword and a history.

    Parameters
    ----------
    keyword : str
        ``"*CLOAD"``, ``"*DSLOAD"`` and the like.
    history : History
    rows : tuple of str
    """

    keyword: str
    history: History
    rows: tuple[str, ...]


class Deck(Protocol):
    """Names and numbers of a model in an .inp file; lengths are in mm, forces in N, stresses in MPa."""

    @property
    def masses(self) -> Mapping[str, float]:
        """Masses of the reference points by name [kg]."""

    def name(self, face: str) -> str:
        """Name of a face in the file."""

    def force(self, point: str, vector: ArrayLike) -> tuple[str, ...]:
        """Rows of a force [N] on a reference point, that on the whole actuator."""

    def spread(self, place: str | NodesAt, vector: ArrayLike, per_area: bool = False) -> tuple[str, ...]:
        """Rows of a force [N] on the whole, or per area [Pa] of a face, on the nodes of a face or place."""

    def moment(self, point: str, vector: ArrayLike) -> tuple[str, ...]:
        """Rows of a moment [N m] on a reference point, that on the whole actuator."""

    def fixed(self, face: Any, directions: str) -> tuple[str, ...]:
        """Rows by which a face, or the nodes of a `NodesAt`, does not move in directions."""

    def mirror_plane(self, face: str) -> tuple[str, ...]:
        """Rows by which a face does not move along its normal."""

    def displaced(self, place: str | NodesAt, axis: int, value: float) -> tuple[str, ...]:
        """Rows by which a face, the nodes of a place or a reference point moves along an axis [m]."""

    def rotated(self, point: str, vector: ArrayLike) -> tuple[str, ...]:
        """Rows of a rotation vector [rad] of a reference point."""


class Load:
    """A load on an actuator, and all that follows from it; `Pressure`, `Force` and the like inherit it.

    A load has a field ``history``, the share of it that acts at a load factor.

    Examples
    --------
    >>> from turgor.core.model.loads import Force
    >>> load = Force("tip", (0, 0, -1))
    >>> load.kind, load.place, load.mirrored(1), load.text()
    ('force', 'tip', True, 'Force (0, 0, -1) N on tip, fixed in direction.')
    """

    __slots__ = ()

    history: History = RAMP

    #: Key of a list of tables below ``[loads]`` in job files; empty where a function of its own reads the tables.
    job_key: ClassVar[str] = ""
    #: Whether the load is a state of bodies and pulls at nothing.
    of_bodies: ClassVar[bool] = False
    #: Whether it acts on a body at rest; if not, it is no load that has an equilibrium of its own at the start.
    acts_at_rest: ClassVar[bool] = True
    #: Whether its face may be a `NodesAt` or the name of a node set.
    at_places: ClassVar[bool] = False
    #: Whether the load needs the density of every region.
    needs_density: ClassVar[bool] = False
    #: Whether the load is spread over the faces that it names, so that the mean stress may jump there.
    spread: ClassVar[bool] = True

    #: Whether it stays in later stages at a share of zero: it is part of the actuator, as a wire is.
    lasting: ClassVar[bool] = False

    #: Displacement at which a network that it adds has no stress; None is the shape of the mesh.
    shape: Array | None = None

    @property
    def hardens(self) -> bool:
        """Whether it adds a network to its body."""
        return False

    @property
    def kind(self) -> str:
        """Name of the class in words, such as ``"point force"``."""
        return re.sub(r"(?<!^)(?=[A-Z])", " ", type(self).__name__).lower()

    @property
    def place(self) -> str:
        """Name of the face, point or body on which it acts; one of the same kind and place replaces it in a stage."""
        return name_of(getattr(self, "face", getattr(self, "point", getattr(self, "body", ""))))

    @property
    def named_faces(self) -> tuple[str, ...]:
        """Faces that the mesh must have."""
        face = getattr(self, "face", None)
        return (face,) if isinstance(face, str) else ()

    @property
    def label(self) -> str:
        """The load in a few letters, such as ``"Force(tip)"``."""
        return f"{type(self).__name__}({self.place})" if self.place else type(self).__name__

    @property
    def words(self) -> str:
        """The load at a share of one in words, without a full stop."""
        return f"{self.kind.capitalize()} on {self.place}" if self.place else self.kind.capitalize()

    def text(self) -> str:
        """Return the sentence of a report."""
        return f"{self.words}{shares_text(self.history)}."

    def share(self, load_factor: float) -> float:
        """Return the share of the load that acts at a load factor."""
        return share_at(self.history, load_factor)

    def mirrored(self, axis: int) -> bool:
        """Whether a plane normal to an axis may cut the actuator: the load is the same on both sides of it."""
        return True

    def turned(self, axis: int) -> bool:
        """Whether the load is the same after any turn about an axis."""
        return all(self.mirrored(across) for across in range(3) if across != axis)

    def check(self, mesh: Mesh, points: Container[str]) -> None:
        """Refuse a place that the mesh lacks, and a load that a half model or a wedge cannot have.

        Parameters
        ----------
        mesh : Mesh
        points : container of str
            Names of the reference points.
        """
        point = getattr(self, "point", None)
        if point is not None and point not in points:
            raise unknown(f"reference point of a {self.kind} load", point, points)  # type: ignore[arg-type]
        for name in self.named_faces:
            mesh.face(name)
        check_images(mesh, f"{self.kind} on '{self.place}'" if self.place else self.kind, self.mirrored, self.turned)

    def log_stretch(self, points: Array, load_factor: float) -> Array | None:
        """Return the logarithm of the stretch at which its body is free of stress; None of loads that state none.

        Parameters
        ----------
        points : (c, q, 3) array [m]
            Points of the body at rest.
        load_factor : float

        Returns
        -------
        (c, q, 3, 3) array, or one that broadcasts to it, or None
        """
        size = self.log_length(load_factor)
        return None if size is None else size * np.eye(3)

    def log_length(self, load_factor: float) -> float | None:
        """Return the logarithm of the length at which a thread is free of stress over that in the mesh.

        It is that of any length in a body that grows alike in all directions; None of loads that state none.
        """
        return None

    @property
    def growth(self) -> float | None:
        """Linear strain of its free body at a share of one, alike in all directions; None of any other load."""
        return None

    def stiffness(self, load_factor: float) -> float:
        """Return the factor on the shear stiffness of its body, which is larger than 0."""
        return 1.0

    def network(self, load_factor: float) -> float:
        """Return the stiffness over that of the law of a network that it adds to its body."""
        return 0.0

    def of_materials(self, materials: Mapping[str, Any]) -> "Load":
        """Return the load with what it takes from the materials of a model by default; most take nothing."""
        return self

    def begun(self, displacement: Array) -> "Load":
        """Return the load of a stage that begins at a displacement (n, 3) [m]; most do not depend on it."""
        return self

    def dead_forces(self, nodal: NodalForces) -> Array | None:
        """Return nodal forces (n, 3) at a share of one that do not change with the deformation; None without any."""
        return None

    @property
    def spot(self) -> str | NodesAt | Vector:
        """The face, place, reference point or point [m] at which it acts; empty of a load on all of a body."""
        spot: str | NodesAt = getattr(self, "face", getattr(self, "point", ""))
        return spot

    @property
    def arrow(self) -> Vector | None:
        """Force, moment or traction at its spot, whose arrow pictures show; None of a load without such a vector."""
        return getattr(self, "vector", None)

    @property
    def turning(self) -> Turning | None:
        """The moment or follower force on a reference point; None of other loads."""
        return None

    @property
    def cable(self) -> Any:
        """The load, if it is a cable or a wire through guides; None of other loads."""
        return None

    @property
    def path_dependent(self) -> str:
        """What depends on all states before, such as the friction of a cable; empty where nothing does."""
        return ""

    @property
    def channel(self) -> Any:
        """The load, if it is a channel between cavities; None of other loads."""
        return None

    @property
    def liquid(self) -> Any:
        """The load, if it is the weight of a liquid; None of other loads."""
        return None

    @property
    def spinning(self) -> Any:
        """The load, if it is a centrifugal force; None of other loads."""
        return None

    @property
    def strips(self) -> Any:
        """The load, if it is the liquid around a slender body in motion; None of other loads."""
        return None

    def terms(self, setting: Any) -> Sequence[Any]:
        """Return terms of its own, where its forces change with the deformation: see `turgor.core.engine.term`."""
        return ()

    @property
    def attached_mass(self) -> float:
        """Mass that moves with the reference point on which it acts [kg]."""
        return 0.0

    @property
    def outside(self) -> bool:
        """Whether the actuator does work on something outside by moving against its dead forces."""
        return not self.of_bodies

    def continued(self, share: float, new: "Load | None") -> "Load":
        """Return the load of the next stage: the share that acts stays, or gives way to a new load."""
        return with_history(self, fading(share, None if new is None else new.history))

    def deck_rows(self, deck: Deck) -> tuple[DeckRows, ...]:
        """Return its rows in the first step of an .inp file.

        Raises
        ------
        TurgorError
            If it has no form there.
        """
        if self.growth is not None:
            return (DeckRows("*TEMPERATURE", self.history, ("Nall, 1.",)),)
        raise TurgorError(f"a load of kind {type(self).__name__} has no form in .inp files; leave it out.")
