"""Carriers: the unknowns of reference points, as further nodes of the equations.

A reference point with its rotation is carried by four nodes: its place P, and three arrows yᵢ = r R eᵢ that turn with
it, r the gyration radius of its face. Whatever is rigid with the point is then linear in the unknowns, x = P + Σ Dᵢ yᵢ
/ r, at rotations of any size: a rigid face is eliminated by constant weights, masses are constant, and no angle has a
range (Betsch and Leyendecker 2006, doi 10.1002/nme.1639). Six multipliers keep the arrows
orthonormal (`rigid_term`), six more tie an averaging point to its face (`average_term`); they stand in the three
components of two further nodes each. A bearing (`bearing_term`) adds a node of three multipliers, and one for its
angle.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import TypeGuard

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import side_tables
from turgor.core.geometry.wedge import Wedge
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.model import Model
from turgor.core.model.points import RIGID, Hinge, ReferencePoint, Rotation
from turgor.core.model.supports import Support
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Carrier:
    """Nodes and geometry of one reference point.

    Parameters
    ----------
    point : ReferencePoint
    node : int
        The first of its nodes: the place; three arrows follow, and then the nodes of multipliers.
    at : (3,) array [m]
        Where the point is at rest.
    nodes : (k,) int array
        Nodes of its face.
    weights : (k,) array
        Shares of the area of the face, ∫ N da / A; their sum is 1.
    arms : (k, 3) array [m]
        From the point to the nodes at rest, D.
    moments : (k, 3) array [m]
        ∫ N (X − X̄) da / A, with the center X̄ of the face; their sum is zero.
    center : (3,) array [m]
        From the point to the center of the face.
    radius : float [m]
        Length r of the arrows.
    mirrored : tuple of int
        Axes along the normals of the mirror planes that cut the face.
    bearing : Hinge, Rotation or None
        A hinge, or a rotation whose axis may tilt; None where a mirror plane or a wedge leaves one way to turn at most.
    wedge : Wedge, optional
        The sector of which the face is a share: the point moves along its axis, and turns about it.
    """

    point: ReferencePoint
    node: int
    at: Array
    nodes: Ints
    weights: Array
    arms: Array
    moments: Array
    center: Array
    radius: float
    mirrored: tuple[int, ...]
    bearing: Hinge | Rotation | None = None
    wedge: Wedge | None = None

    @property
    def blocked(self) -> tuple[int, ...]:
        """Axes along which the point cannot move: its displacement there is zero by symmetry."""
        return (*self.mirrored, *(() if self.wedge is None else self.wedge.across))

    @property
    def turning(self) -> tuple[int, ...]:
        """Axes about which it may turn."""
        free = {0, 1, 2} if self.wedge is None else {self.wedge.number}
        for axis in self.mirrored:
            free &= {axis}
        return tuple(sorted(free))

    @property
    def unturned(self) -> tuple[int, ...]:
        """Axes whose arrows keep their direction, and along which the other arrows do not turn."""
        return (*self.mirrored, *(() if self.wedge is None else (self.wedge.number,)))

    @property
    def rigid(self) -> bool:
        """Whether the face moves as a rigid body with the point."""
        return self.point.coupling == RIGID

    @property
    def arrows(self) -> Ints:
        """Nodes of the three arrows."""
        return self.node + 1 + np.arange(3)

    @property
    def stress(self) -> Ints:
        """Nodes of the multipliers of the lengths of the arrows, and of the angles between them."""
        return self.node + 4 + np.arange(2)

    @property
    def ties(self) -> Ints:
        """Nodes of the multipliers of displacement and rotation of an averaging point."""
        return self.node + 6 + np.arange(0 if self.rigid else 2)

    @property
    def bolts(self) -> Ints:
        """Node of the multipliers of a bearing, and node of its angle."""
        return self.node + (6 if self.rigid else 8) + np.arange(0 if self.bearing is None else 2)

    @property
    def multipliers(self) -> Ints:
        """Nodes of all multipliers."""
        return np.concatenate([self.stress, self.ties, self.bolts[:1]])

    @property
    def count(self) -> int:
        """How many nodes it has."""
        return 4 + len(self.stress) + len(self.ties) + len(self.bolts)


def carriers_of(model: Model) -> tuple[Carrier, ...]:
    """Lay out the nodes of all reference points of a model, after those of its mesh.

    Parameters
    ----------
    model : Model

    Returns
    -------
    tuple of Carrier

    Raises
    ------
    TurgorError
        If a point lies off a mirror plane that cuts its face, or the face has no size.
    """
    mirrors = tuple(each.place for each in model.supports if each.mirror)
    bearings = {each.point: each for each in model.supports if _is_bearing(each)}
    carriers, node = [], len(model.mesh.points)
    for point in model.points.values():
        carriers.append(_carrier(model.mesh, point, node, mirrors, bearings.get(point.name)))
        node += carriers[-1].count
    return tuple(carriers)


def with_carrier_points(points: Array, carriers: tuple[Carrier, ...]) -> Array:
    """Positions at rest (n + e, 3) [m]: those of the mesh, then of the points' nodes, all where their point is."""
    return np.concatenate([points, *(np.tile(each.at, (each.count, 1)) for each in carriers)])


def _is_bearing(support: Support) -> TypeGuard[Hinge | Rotation]:
    return isinstance(support, Hinge) or (isinstance(support, Rotation) and support.tilts)


@lru_cache(maxsize=32)
def _carrier(
    mesh: Mesh, point: ReferencePoint, node: int, mirrors: tuple[str, ...], bearing: Hinge | Rotation | None
) -> Carrier:
    sides = mesh.face(point.face)
    nodes, areas, firsts = _moments(mesh.points, sides)
    whole = float(areas.sum())
    middle = firsts.sum(axis=0) / whole
    mirrored = _cuts(mesh, nodes, mirrors)
    cut = mirrored | ({} if mesh.wedge is None else {i: mesh.wedge.center[i] for i in mesh.wedge.across})
    for axis, level in cut.items():
        middle[axis] = level
    at = middle if point.at is None else np.array(point.at)
    size = float(np.ptp(mesh.points, axis=0).max())
    for axis, level in cut.items():
        if abs(at[axis] - level) > ROUND_OFF.same * size:
            raise TurgorError(
                f"reference point '{point.name}': at is {at[axis] / mm:.4g} mm along {'xyz'[axis]}, but its face is "
                f"cut by a {'mirror plane' if axis in mirrored else 'wedge whose axis is'} at {level / mm:.4g} mm; put "
                "the point there, or model the whole actuator."
            )
    weights = areas / whole
    about = mesh.points[nodes] - middle
    spread = float(np.sqrt(np.abs(weights) @ (about**2).sum(axis=1)))
    if not spread > ROUND_OFF.same * size:
        raise TurgorError(f"reference point '{point.name}': the face '{point.face}' has no size.")
    return Carrier(
        point=point, node=node, at=at, nodes=nodes, weights=weights, arms=mesh.points[nodes] - at,
        moments=firsts / whole - weights[:, None] * middle, center=middle - at, radius=spread,
        mirrored=tuple(mirrored), bearing=None if cut else bearing, wedge=mesh.wedge,
    )  # fmt: skip


def _moments(points: Array, sides: Ints) -> tuple[Ints, Array, Array]:
    """Nodes (k,) of sides, their shares of the area ∫ N da, (k,), and of its first moment ∫ N X da, (k, 3)."""
    reference = side_tables(sides.shape[1])
    corners = points[sides]
    tangents = np.einsum("qad,fai->fqid", reference.dN, corners)
    area = np.linalg.norm(np.cross(tangents[..., 0], tangents[..., 1]), axis=2) * reference.weights
    x = np.einsum("qa,fai->fqi", reference.N, corners)
    nodes, place = np.unique(sides, return_inverse=True)
    place = place.ravel()
    by_side = np.einsum("fq,qa,fqi->fai", area, reference.N, np.insert(x, 3, 1.0, axis=2)).reshape(-1, 4)
    sums = np.zeros((len(nodes), 4))
    np.add.at(sums, place, by_side)
    return nodes, sums[:, 3], sums[:, :3]


def _cuts(mesh: Mesh, nodes: Ints, mirrors: tuple[str, ...]) -> dict[int, float]:
    """Axis and position [m] of each mirror plane that a face meets."""
    planes: dict[int, float] = {}
    for name in mirrors:
        on = mesh.face_nodes(name)
        if np.isin(nodes, on).any():
            points = mesh.points[on]
            axis = int(np.ptp(points, axis=0).argmin())
            planes[axis] = float(points[:, axis].mean())
    return planes
