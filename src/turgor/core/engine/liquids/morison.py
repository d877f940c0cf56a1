"""Added mass and drag of slender bodies in a liquid: Morison's equation for the sections of a body, by strip theory."""

from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import ReferenceCell, side_tables
from turgor.core.engine.faces.openings import mirror_point
from turgor.core.engine.system import System
from turgor.core.engine.term import add_at_nodes
from turgor.core.meshing.mesh import Mesh
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class MorisonSettings:
    """Settings of strip theory.

    Parameters
    ----------
    strips : int
        Sections along the body, each with an area and a perimeter of its own: enough for a taper, and more than most
        meshes have elements along.
    apart : float
        Shift of the strips, in their height, by more than round-off: points at one height are in one strip.
    """

    strips: int = 20
    apart: float = 1e-6


MORISON = MorisonSettings()


@dataclass(frozen=True, slots=True, eq=False)
class Strips:
    """The sides around one body, with what each integration point carries, scaled.

    Parameters
    ----------
    sides : (f, n) int array
    inertia : (f, q) array
        Added mass.
    drag : (f, q) array
        Force of drag at a scaled speed of one.
    along : (f, q, 2) array
        Direction of the body in the coordinates of the side.
    load : Morison
    """

    sides: Ints
    inertia: Array
    drag: Array
    along: Array
    load: Any

    @property
    def tables(self) -> ReferenceCell:
        """Shape functions of a side."""
        return side_tables(self.sides.shape[1])

    def across(self, position: Array) -> Array:
        """Projection (f, q, 3, 3) onto the section in a state; the direction of the body moves with its surface."""
        tangents = _tangents(position, self.sides, self.tables)
        along = np.einsum("fqdi,fqd->fqi", tangents, self.along)
        size = np.linalg.norm(along, axis=2, keepdims=True)
        along = along / np.where(size > 0, size, 1.0)
        return np.asarray(np.eye(3) - along[..., :, None] * along[..., None, :])

    def local(self, matrices: Array) -> Array:
        """Matrices (f, n, 3, n, 3) of the nodes from those of the points (f, q, 3, 3)."""
        N = self.tables.N
        return np.asarray(np.einsum("qa,qb,fqij->faibj", N, N, matrices, optimize=True))


def strips_of(system: System) -> list[Strips]:
    """Return the strips of each body in a liquid."""
    loads = (load.strips for load in system.model.loads)
    return [_strips(system, load) for load in loads if load is not None]


def added_mass(system: System, strips: list[Strips], position: Array, load_factor: float) -> Array:
    """Lower triangle (nnz,) of the scaled added mass of bodies at positions (n, 3), on the pattern of the tangent."""
    out = np.zeros(len(system.layout.base.indices))
    for each in strips:
        weight = each.load.share(load_factor) * each.inertia
        out += system.scattered_sides(each.sides, each.local(weight[..., None, None] * each.across(position)))
    return out


@dataclass(frozen=True, slots=True, eq=False)
class MorisonForces:
    """Added mass times acceleration, and drag, as an `Addition` of a time step.

    Parameters
    ----------
    system : System
    strips : list of Strips
    position : (n, 3) array
        Scaled positions that say which way the bodies lie; those predicted for the end of the step.
    load_factor : float
    velocity, acceleration : (float, (size,) array)
        Each is the first times the unknowns, plus the second.
    """

    system: System
    strips: list[Strips]
    position: Array
    load_factor: float
    velocity: tuple[float, Array]
    acceleration: tuple[float, Array]

    def forces(self, unknowns: Array) -> Array:
        """Forces (size,) against the motion."""
        out = np.zeros_like(self.position)
        for each in self.strips:
            across, share, N = each.across(self.position), each.load.share(self.load_factor), each.tables.N
            v, a = (
                np.einsum("fqij,qa,faj->fqi", across, N, self._nodal(of, unknowns)[each.sides], optimize=True)
                for of in (self.velocity, self.acceleration)
            )
            speed = np.linalg.norm(v, axis=2)
            force = each.inertia[..., None] * a + (each.drag * speed)[..., None] * v
            add_at_nodes(out, each.sides, share * np.einsum("qa,fqi->fai", N, force))
        return self.system.joined(out)

    def data(self, unknowns: Array) -> Array:
        """Derivative of the forces."""
        out = np.zeros(len(self.system.layout.base.indices))
        for each in self.strips:
            across, share, N = each.across(self.position), each.load.share(self.load_factor), each.tables.N
            nodal = self._nodal(self.velocity, unknowns)[each.sides]
            v = np.einsum("fqij,qa,faj->fqi", across, N, nodal, optimize=True)
            speed = np.linalg.norm(v, axis=2)[..., None, None]
            turned = v[..., :, None] * v[..., None, :] / np.where(speed > 0, speed, 1.0)
            by_speed = each.drag[..., None, None] * (speed * across + turned)
            total = self.acceleration[0] * each.inertia[..., None, None] * across + self.velocity[0] * by_speed
            out += self.system.scattered_sides(each.sides, each.local(share * total))
        return out

    def _nodal(self, affine: tuple[float, Array], unknowns: Array) -> Array:
        return self.system.split(affine[0] * unknowns + affine[1])[0]


def _tangents(points: Array, sides: Ints, tables: ReferenceCell) -> Array:
    return np.asarray(np.einsum("qad,fai->fqdi", tables.dN, points[sides]))


def _strips(system: System, load: Any) -> Strips:
    """Sections of a body at rest: the area and the perimeter of each strip, shared by its integration points."""
    mesh, sides = system.model.mesh, np.ascontiguousarray(system.model.mesh.carrying_sides(load.face))
    tables, axis = side_tables(sides.shape[1]), np.array(load.axis) / np.linalg.norm(load.axis)
    tangents = _tangents(system.points, sides, tables)
    normals = tables.weights[:, None] * np.cross(tangents[:, :, 0], tangents[:, :, 1])
    normals -= (normals @ axis)[..., None] * axis
    lateral = np.linalg.norm(normals, axis=2)
    places = np.einsum("qa,fai->fqi", tables.N, system.points[sides])
    height = places @ axis
    level = (height - height.min()) / np.ptp(height) * MORISON.strips + MORISON.apart  # one ring, one strip
    strip = level.astype(int).clip(0, MORISON.strips - 1)
    outward = ((places - _center(mesh, places, lateral, system.length)) * normals).sum(axis=2)
    displaced, around = (np.bincount(strip.ravel(), of.ravel(), MORISON.strips) for of in (0.5 * outward, lateral))
    if displaced.sum() <= 0:
        raise TurgorError(f"morison: '{load.face}' does not surround a body; name the face around it, as 'outside'.")
    scale = load.density * system.length**2 / system.stress_scale
    depth = displaced / np.where(around > 0, around, 1.0)
    gram = np.einsum("fqdi,fqei->fqde", tangents, tangents)
    along = np.linalg.solve(gram, (tangents @ axis)[..., None])[..., 0]
    return Strips(
        sides=sides,
        inertia=scale * load.added_mass * depth[strip] * lateral,
        drag=scale * 0.5 * load.drag / pi * lateral,
        along=along,
        load=load,
    )


def _center(mesh: Mesh, places: Array, weights: Array, length: float) -> Array:
    """Center of the sides, on the mirror planes and the axis of a wedge where there are any."""
    center, cut = np.einsum("fq,fqi->i", weights, places) / weights.sum(), mirror_point(mesh) / length
    fixed = [axis for axis, _ in mesh.mirror_planes] + ([] if mesh.wedge is None else list(mesh.wedge.across))
    center[fixed] = cut[fixed]
    return np.asarray(center)
