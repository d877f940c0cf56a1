"""Smeared fibers: the threads of a winding as pieces at the integration points of their face."""

from dataclasses import dataclass
from math import atan, cos, pi, sin

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import reference_cell, side_tables
from turgor.core.engine.faces.membranes import MEMBRANE_QUADRATURE_DEGREE, surface_frames
from turgor.core.engine.fibers.fiber_kernels import Pieces
from turgor.core.engine.fibers.settings import FIBERS
from turgor.core.meshing.cells import side_type
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.fibers import Fibers, Winding
from turgor.foundation.errors import TurgorError
from turgor.units import mm

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Course:
    """How the threads of a winding run on the face that they lie on.

    Parameters
    ----------
    angle : float [rad]
        Angle from the axis, 0 to π/2.
    spacing : float [m]
        Distance between neighbors of one hand, across them.
    perimeter, length : float [m]
        Circumference of the whole face, and its length along the axis.
    turning : tuple of floats
        +1 for a right-handed family of threads, −1 for a left-handed one.
    copies : int
        How many copies of the face, mirrored at planes along the axis or turned about it, go all around.
    """

    angle: float
    spacing: float
    perimeter: float
    length: float
    turning: tuple[float, ...]
    copies: int = 1


def course_of(mesh: Mesh, fibers: Fibers) -> Course:
    """Find how the threads of a winding run on their face.

    Raises
    ------
    TurgorError
        If the face is not like a cylinder around the axis, the threads overlap, or a mirror plane would turn a helix
        into one of the other hand.
    """
    winding = fibers.wound
    axis = unit_axis(winding)
    sides = wound_sides(mesh, fibers)
    frames = surface_frames(mesh.points, sides)
    if float(np.abs(frames.normal @ axis).max()) > FIBERS.cylinder_like:
        raise TurgorError(
            f"fibers on '{fibers.place}': parts of this face look along the axis {winding.axis}; fibers can be wound "
            "on a face that runs along the axis all around, such as the outside of a tube."
        )
    along = mesh.points[np.unique(sides)] @ axis
    length = float(np.ptp(along))
    tables = side_tables(sides.shape[1])
    tangents = np.einsum("qad,fai->fqid", tables.dN, mesh.points[sides])
    area = float(
        np.einsum("q,fq->", tables.weights, np.linalg.norm(np.cross(tangents[..., 0], tangents[..., 1]), axis=2))
    )
    around = [name for name in mesh.symmetry_faces if not _across(mesh, name, axis)]
    copies = int(2 ** len(around)) * (1 if mesh.wedge is None else mesh.wedge.fold)
    perimeter = area / length * copies
    angle = _angle(winding, perimeter, length)
    if mesh.symmetry_faces and winding.hand != "both" and 1e-9 < angle < pi / 2 - 1e-9:
        raise TurgorError(
            f"fibers on '{fibers.place}': the mirror plane {mesh.symmetry_faces[0]} turns a {winding.hand}-handed "
            "helix into one of the other hand; model the whole actuator (symmetric = false), or wind both hands."
        )
    spacing = _spacing(winding, angle, perimeter)
    if spacing < fibers.diameter * (1 - 1e-9):
        raise TurgorError(
            f"fibers on '{fibers.place}': neighboring threads are {spacing / mm:.4g} mm apart, less than their "
            f"diameter of {fibers.diameter / mm:.4g} mm; wind them farther apart."
        )
    hands = {"right": (1.0,), "left": (-1.0,), "both": (1.0, -1.0)}[winding.hand]
    return Course(angle, spacing, perimeter, length, hands if 1e-9 < angle < pi / 2 - 1e-9 else (1.0,), copies)


def wound_sides(mesh: Mesh, fibers: Fibers) -> NDArray[np.int64]:
    """Sides of the faces that fibers are wound on, (f, n)."""
    return np.concatenate([mesh.face(name) for name in fibers.faces])


def unit_axis(winding: Winding) -> Array:
    """Direction of the axis, of length one."""
    axis = np.asarray(winding.axis, dtype=np.float64)
    size = float(np.linalg.norm(axis))
    if not size > 0:
        raise TurgorError("the axis of a winding is a zero vector; give for example (1, 0, 0).")
    return axis / size


def _across(mesh: Mesh, name: str, axis: Array) -> bool:
    """Whether a mirror plane is perpendicular to the axis."""
    points = mesh.points[mesh.face_nodes(name)]
    return bool(np.ptp(points @ axis) < 1e-6 * np.ptp(mesh.points @ axis))


def _angle(winding: Winding, perimeter: float, length: float) -> float:
    if winding.angle_from_axis is not None:
        return winding.angle_from_axis
    if winding.angle_from_circumference is not None:
        return pi / 2 - winding.angle_from_circumference
    pitch = winding.pitch if winding.pitch is not None else length / winding.turns  # type: ignore[operator]
    return atan(perimeter / pitch)


def _spacing(winding: Winding, angle: float, perimeter: float) -> float:
    if winding.spacing is not None:
        _check_pitch(winding, angle, perimeter)
        return winding.spacing
    assert winding.starts is not None
    if angle > pi / 2 - 1e-9:
        raise TurgorError(
            f"winding starts is {winding.starts}, but hoops do not start at an end; give their spacing instead."
        )
    return perimeter * cos(angle) / winding.starts


def _check_pitch(winding: Winding, angle: float, perimeter: float) -> None:
    """Refuse a spacing that contradicts the pitch: a whole number of threads advances by the pitch in one turn."""
    if winding.pitch is None and winding.turns is None:
        return
    assert winding.spacing is not None
    alone = perimeter * cos(angle)  # distance of neighboring turns of a single thread
    count = max(1, round(alone / winding.spacing))
    if abs(alone / count - winding.spacing) > FIBERS.contradiction * winding.spacing:
        given = f"pitch of {winding.pitch / mm:.4g} mm" if winding.pitch is not None else f"{winding.turns:.4g} turns"
        many = "a single thread" if count == 1 else f"{count} threads"
        raise TurgorError(
            f"spacing is {winding.spacing / mm:.4g} mm, which contradicts the {given}: turns of {many} are then "
            f"{alone / count / mm:.4g} mm apart; give starts, the number of threads, instead of spacing."
        )


def smeared_pieces(mesh: Mesh, fibers: Fibers) -> Pieces:
    """Spread the threads of a winding over the integration points of their face."""
    course = course_of(mesh, fibers)
    axis = unit_axis(fibers.wound)
    sides = wound_sides(mesh, fibers)
    frames = surface_frames(mesh.points, sides)
    parts = np.split(frames.normal, np.cumsum([len(mesh.face(name)) for name in fibers.faces])[:-1])
    outward = np.concatenate(
        [_outward(mesh, mesh.face(name), part, axis) for name, part in zip(fibers.faces, parts, strict=True)]
    )
    lengthwise = axis - (frames.normal @ axis)[..., None] * frames.normal
    lengthwise /= np.linalg.norm(lengthwise, axis=-1)[..., None]
    around = np.cross(axis, outward)
    around -= np.einsum("fqi,fqi->fq", around, frames.normal)[..., None] * frames.normal
    around -= np.einsum("fqi,fqi->fq", around, lengthwise)[..., None] * lengthwise
    around /= np.linalg.norm(around, axis=-1)[..., None]
    along = []
    for turn in course.turning:
        direction = cos(course.angle) * lengthwise + turn * sin(course.angle) * around
        local = np.stack([(direction * frames.e1).sum(-1), (direction * frames.e2).sum(-1)], axis=-1)
        along.append(np.einsum("fqad,fqd->fqa", frames.gradients, local).reshape(-1, sides.shape[1]))
    points = frames.areas.shape[1]
    count = len(along)
    N = reference_cell(sides.shape[1], MEMBRANE_QUADRATURE_DEGREE[side_type(sides.shape[1]).corners]).N
    chosen = np.flatnonzero(np.tile(_within_box(mesh, fibers, sides).ravel(), count))
    if not len(chosen):
        raise TurgorError(f"fibers on '{fibers.place}': nothing of this face lies{fibers.box}.")
    return Pieces(
        sides=np.tile(np.repeat(sides, points, axis=0), (count, 1))[chosen],
        along=np.concatenate(along)[chosen],
        weights=np.tile(frames.areas.ravel(), count)[chosen],
        stiffness=np.full(len(chosen), fibers.stretching_stiffness / course.spacing),
        pushed=np.full(len(chosen), fibers.compression),
        middle=np.tile(N, (len(sides) * count, 1))[chosen],
        hand=np.repeat(np.arange(count), len(sides) * points)[chosen],
    )


def _within_box(mesh: Mesh, fibers: Fibers, sides: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Whether the integration points of each side lie within the box of the fibers, (f, q)."""
    nodes = sides.shape[1]
    N = reference_cell(nodes, MEMBRANE_QUADRATURE_DEGREE[side_type(nodes).corners]).N
    return fibers.holds(np.einsum("qa,fai->fqi", N, mesh.points[sides]))


def _outward(mesh: Mesh, sides: NDArray[np.int64], normal: Array, axis: Array) -> Array:
    """Normals, turned away from the middle of the body: faces between regions may point either way."""
    middle = mesh.points.mean(axis=0)
    arm = mesh.points[sides].mean(axis=1) - middle
    arm -= np.outer(arm @ axis, axis)
    return normal * (1.0 if float(np.einsum("fi,fqi->", arm, normal)) >= 0 else -1.0)
