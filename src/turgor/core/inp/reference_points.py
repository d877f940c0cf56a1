"""Reference points in .inp files: nodes of their own, couplings to their faces, springs, supports and forces."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.core.inp.context import Context
from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.nodes.node_shares import areas, node_shares, side_shares
from turgor.core.model.model import Model
from turgor.core.model.places import NodesAt
from turgor.core.model.points import RIGID, Hinge, ReferencePoint, Rotation
from turgor.foundation.errors import TurgorError
from turgor.units import N, mm

Array = NDArray[np.float64]

#: Triangles that fill a side of six, eight or nine nodes; those of eight are split at the middles of their edges.
_FANS = {
    6: [(0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)],
    8: [(0, 4, 7), (4, 1, 5), (5, 2, 6), (6, 3, 7), (4, 5, 6), (4, 6, 7)],
    9: [(0, 4, 8), (4, 1, 8), (1, 5, 8), (5, 2, 8), (2, 6, 8), (6, 3, 8), (3, 7, 8), (7, 0, 8)],
}


@dataclass(frozen=True, slots=True, kw_only=True)
class InpPoint:
    """The nodes of a reference point in a file, counted from 1.

    Parameters
    ----------
    point : ReferencePoint
    at : (3,) array [m]
    node : int
        Carries the displacement.
    turning : int
        Carries the rotation: a node of its own in CalculiX where the face is rigid, the same one elsewhere.
    first : int
        Degree of freedom of the rotation about x on that node.
    mirrored : tuple of int
        Axes across the mirror planes that cut its face.
    """

    point: ReferencePoint
    at: Array
    node: int
    turning: int
    first: int
    mirrored: tuple[int, ...]


def inp_points(model: Model, program: str) -> dict[str, InpPoint]:
    """Lay out the nodes of the reference points of a model, after those of its mesh.

    Raises
    ------
    TurgorError
        If a point has something that has no form in the file.
    """
    points, mesh = {}, model.mesh
    for number, point in enumerate(model.points.values()):
        _check(point, program)
        own = program == "calculix" and point.coupling == RIGID
        node = len(mesh.points) + 2 * number + 1
        mirrored = _mirrored(model, point.face)
        at = _middle(mesh, point.face) if point.at is None else np.array(point.at)
        for axis, position in mirrored.items():
            at[axis] = position
        points[point.name] = InpPoint(
            point=point, at=at, node=node, turning=node + own, first=1 if own else 4, mirrored=tuple(mirrored)
        )
    return points


def _check(point: ReferencePoint, program: str) -> None:
    if program == "calculix" and point.coupling != RIGID:
        raise TurgorError(
            f"reference point '{point.name}': the couplings of CalculiX that average a face cannot be fixed or moved, "
            "and are linear in the rotation (5 % off at half a radian); take rigid, or the program abaqus."
        )
    if point.rotational_spring:
        raise TurgorError(
            f"reference point '{point.name}': its rotational spring has no form in .inp files; leave it out."
        )
    if point.mass and point.center is not None:
        raise TurgorError(
            f"reference point '{point.name}': a center of mass away from the point has no form in .inp files; put the "
            "point there with at."
        )


def _mirrored(model: Model, face: str) -> dict[int, float]:
    planes, nodes = {}, model.mesh.face_nodes(face)
    for support in model.supports:
        if support.mirror and np.isin(nodes, model.mesh.face_nodes(support.place)).any():
            points = model.mesh.points[model.mesh.face_nodes(support.place)]
            axis = int(np.ptp(points, axis=0).argmin())
            planes[axis] = float(points[:, axis].mean())
    return planes


def _middle(mesh: Mesh, face: str) -> Array:
    """Center of the area of a face [m]."""
    sides = mesh.face(face)
    triangles = np.concatenate([sides[:, list(fan)] for fan in _FANS[sides.shape[1]]])
    corners = mesh.points[triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return np.asarray(area @ corners.mean(axis=1) / area.sum())


def point_lines(context: Context, points: Mapping[str, InpPoint], plain: Mapping[str, str]) -> Iterator[str]:
    """Nodes, couplings and springs; ``plain`` has the names of the faces in the file."""
    model = context.model
    for name, each in points.items():
        face = plain[each.point.face]
        place = ", ".join(f"{value:.12g}" for value in each.at / mm)
        yield f"** reference point {name}"
        yield from ("*NODE", *(f"{node}, {place}" for node in sorted({each.node, each.turning})))
        if each.turning != each.node:
            yield f"*RIGID BODY, NSET={face}, REF NODE={each.node}, ROT NODE={each.turning}"
        else:
            yield f"*COUPLING, CONSTRAINT NAME=tie_{name}, REF NODE={each.node}, SURFACE={face}"
            yield from ("*KINEMATIC", "1, 3") if each.point.coupling == RIGID else ("*DISTRIBUTING", "1, 6")
        for axis, stiffness in enumerate(each.point.stiffness):
            if stiffness and axis not in each.mirrored:
                label = f"spring_{name}_{'xyz'[axis]}"
                yield from (f"*ELEMENT, TYPE=SPRING1, ELSET={label}", f"{next(context.elements)}, {each.node}")
                share = stiffness * mm / N / model.mesh.symmetry_factor
                yield from (f"*SPRING, ELSET={label}", f"{axis + 1}", f"{share:.12g}")


def fixed_lines(model: Model, points: Mapping[str, InpPoint]) -> Iterator[str]:
    """Rows of ``*BOUNDARY``: what stays zero all along."""
    for each in points.values():
        fixed, still = set(each.mirrored), set[int]()
        for axis in each.mirrored:
            still |= {k for k in range(3) if k != axis}
        for support in model.supports:
            if support.prescribed[0] == each.point.name and not support.moves:
                fixed |= {"xyz".index(letter) for letter in support.prescribed[1]}
            elif isinstance(support, Hinge) and support.point == each.point.name:
                still |= _across(support)
            elif isinstance(support, Rotation) and support.point == each.point.name:
                still |= {k for k in range(3) if not support.angle * support.axis[k]}
                if support.tilts:
                    raise TurgorError(f"the rotation of '{support.point}' tilts, which .inp files cannot say.")
        yield from (f"{each.node}, {axis + 1}" for axis in sorted(fixed))
        yield from (f"{each.turning}, {each.first + axis}" for axis in sorted(still))


def _across(hinge: Hinge) -> set[int]:
    across = {k for k in range(3) if not hinge.direction[k]}
    if len(across) != 2:
        raise TurgorError(
            f"hinge of '{hinge.point}': its axis is {hinge.axis}; .inp files have hinges about x, y and z."
        )
    return across


@dataclass(frozen=True, slots=True)
class InpDeck:
    """Names and numbers of a model in a file; see `turgor.core.model.loads.load.Deck`.

    Parameters
    ----------
    mesh : Mesh
    points : mapping of str to InpPoint
    plain : mapping of str to str
        Names of the faces in the file.
    share : float
        Share of a force on the whole actuator that the modeled part carries.
    """

    mesh: Mesh
    points: Mapping[str, InpPoint]
    plain: Mapping[str, str]
    share: float

    @property
    def masses(self) -> dict[str, float]:
        """Masses of the reference points by name [kg]."""
        return {name: each.point.mass for name, each in self.points.items()}

    def name(self, face: str) -> str:
        """Name of a face in the file."""
        return self.plain[face]

    def force(self, point: str, vector: ArrayLike) -> tuple[str, ...]:
        """Rows of a force [N] on a reference point, that on the whole actuator."""
        return _rows(self.points[point].node, 1, self.share * np.asarray(vector) / N)

    def spread(self, place: str | NodesAt, vector: ArrayLike, per_area: bool = False) -> tuple[str, ...]:
        """Rows of a force [N] on the whole, or per area [Pa] of a face, on the nodes of a face or place."""
        part = self.share
        if isinstance(place, NodesAt):
            nodes = np.intersect1d(place.nodes(self.mesh), self.mesh.cells[:, :20])
            shares = node_shares(self.mesh, nodes, middles=False)
        else:
            sides = self.mesh.face(place)
            shares = side_shares(self.mesh, sides, middles=False)
            part = float(areas(self.mesh.points, sides).sum()) if per_area else part
        whole = part * np.asarray(vector) / N
        return tuple(row for node in np.flatnonzero(shares) for row in _rows(int(node) + 1, 1, shares[node] * whole))

    def moment(self, point: str, vector: ArrayLike) -> tuple[str, ...]:
        """Rows of a moment [N m] on a reference point, that on the whole actuator."""
        each = self.points[point]
        return _rows(each.turning, each.first, self.share * np.asarray(vector) / mm)

    def fixed(self, face: str | NodesAt, directions: str) -> tuple[str, ...]:
        """Rows by which a face, or the nodes of a place, does not move in directions."""
        return tuple(f"{each}, {'xyz'.index(axis) + 1}" for each in self._named(face) for axis in sorted(directions))

    def _named(self, place: str | NodesAt) -> list[str]:
        """What rows of a face, a place or a reference point begin with."""
        if isinstance(place, NodesAt):
            return self._written(place.nodes(self.mesh))
        return [str(self.points[place].node) if place in self.points else self.plain[place]]

    def _written(self, nodes: NDArray[np.int64]) -> list[str]:
        """Numbers of nodes in the file, which has hexahedra of 20 nodes."""
        return [str(node + 1) for node in np.intersect1d(nodes, self.mesh.cells[:, :20]).tolist()]

    def mirror_plane(self, face: str) -> tuple[str, ...]:
        """Rows of a mirror plane, without the nodes of rigid faces, which follow their points and are not fixed too."""
        mesh = self.mesh
        direction = int(np.ptp(mesh.points[mesh.face_nodes(face)], axis=0).argmin()) + 1
        rigid = [mesh.face_nodes(each.point.face) for each in self.points.values() if each.point.coupling == RIGID]
        nodes = np.unique(mesh.face(face)[:, : 6 if mesh.cell_type is TETRAHEDRON else 8])
        free = nodes[~np.isin(nodes, np.concatenate([np.zeros(0, dtype=np.int64), *rigid]))]
        if len(free) == len(nodes):
            return (f"{self.plain[face]}, {direction}",)
        return tuple(f"{node + 1}, {direction}" for node in free.tolist())

    def displaced(self, place: str | NodesAt, axis: int, value: float) -> tuple[str, ...]:
        """Rows by which a face, the nodes of a place or a reference point moves along an axis [m]."""
        return tuple(f"{each}, {axis + 1}, {axis + 1}, {value / mm:.12g}" for each in self._named(place))

    def rotated(self, point: str, vector: ArrayLike) -> tuple[str, ...]:
        """Rows of a rotation vector [rad] of a reference point."""
        each, turn = self.points[point], np.asarray(vector)
        axes = [(k, each.first + k) for k in range(3) if turn[k]]
        return tuple(f"{each.turning}, {number}, {number}, {turn[k]:.12g}" for k, number in axes)


def _rows(node: int, first: int, values: Array) -> tuple[str, ...]:
    return tuple(f"{node}, {first + k}, {value:.12g}" for k, value in enumerate(values) if value)
