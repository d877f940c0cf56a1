"""Build the parts of contact that a model asks for."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.contact.pair_part import PairPart, Partners, Rigid
from turgor.core.engine.contact.rigid_triangles import refined, six_nodes
from turgor.core.engine.contact.settings import CONTACT_SEARCH
from turgor.core.engine.contact.shape_part import ShapePart
from turgor.core.engine.contact.surface import Surface, listed, neighbors, of_face, overhangs, strangers
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.contact import SELF
from turgor.core.model.drive import pressed_together
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Obstacle, Plane
from turgor.core.model.obstacles.pose import Pose
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Bodies:
    """Obstacles on springs.

    Parameters
    ----------
    names : tuple of str
    springs : (b,) array
        Scaled stiffness, of the modeled part.
    unknowns : tuple of int
        First unknown of each.
    prescribed : (3 b,) bool array
        Directions across mirror planes, in which they cannot move.
    """

    names: tuple[str, ...]
    springs: Array
    unknowns: tuple[int, ...]
    prescribed: NDArray[np.bool_]

    @staticmethod
    def of(model: Model, scales: tuple[float, float], first_unknown: int) -> "Bodies":
        """Collect the sprung obstacles of a model."""
        length, stress = scales
        sprung = [o for o in model.contact.obstacles if o.spring is not None]
        springs = np.array([o.spring for o in sprung], dtype=np.float64) / (stress * length)
        across = np.zeros(3, dtype=bool)
        for name in model.mesh.symmetry_faces:
            across[model.mesh.normal_axis(name)] = True
        return Bodies(
            tuple(o.name for o in sprung),
            springs / model.mesh.symmetry_factor,
            tuple(first_unknown + 3 * k for k in range(len(sprung))),
            np.tile(across, len(sprung)),
        )


def may_touch(model: Model) -> bool:
    """Whether a model has any contact."""
    contact = model.contact
    if model.mesh.cell_type.side.nodes == 8:
        return False
    if contact.obstacles:
        return True
    return contact.self_contact is not None and (
        bool(pressed_together(model)) or contact.for_mesh(model.mesh) is not None
    )


def build_parts(
    model: Model,
    surface: Surface,
    points: Array,
    scales: tuple[float, float],
    bodies: Bodies,
    like: Sequence[PairPart | ShapePart] = (),
) -> list[PairPart | ShapePart]:
    """Make a part for every obstacle, and those of the contact of the body with itself.

    ``like`` are those of a mesh with the same cells whose nodes are elsewhere by little.
    """
    mesh, (length, stress) = model.mesh, scales
    if mesh.cell_type.side.nodes == 8:
        if model.contact.obstacles:
            raise TurgorError("contact needs tetrahedra or 27-node hexahedra; this mesh has 20-node hexahedra.")
        return []
    films, outer = surface.outward is not None, outer_sides(mesh, surface)
    outside = surface.chosen(outer)
    parts = _with_itself(model, surface, outside, (points, length / stress), like)
    own = model.contact.self_contact
    for part in parts:
        part.elastic_slip = _over(None if own is None else own.elastic_slip, length)
    for obstacle in model.contact.obstacles:
        chosen = outside
        if obstacle.face is not None:
            chosen = surface.chosen(of_face(mesh, surface, obstacle.face) & (outer if films else True))
        if obstacle.stiffness is not None:
            chosen = _stiff(chosen, obstacle.stiffness * length / stress)
        unknown = bodies.unknowns[bodies.names.index(obstacle.name)] if obstacle.name in bodies.names else -1
        triangles = obstacle.shape.surface()
        if triangles is not None:
            parts.append(_triangles(obstacle, (triangles[0] / length, triangles[1]), chosen, points, unknown))
        else:
            parts.append(ShapePart(obstacle.name, chosen, obstacle.shape.scaled(length), obstacle, unknown))
        parts[-1].elastic_slip = _over(obstacle.elastic_slip, length)
    return parts


def outer_sides(mesh: Mesh, surface: Surface) -> NDArray[np.bool_]:
    """Which sides of a surface lie outside: on no cavity, cut or bond, which bears what presses its sides together."""
    bonded = [face for faces in mesh.parted for face in faces]
    mirrors = of_face(mesh, surface, *mesh.cut_faces, *bonded)
    cavities = of_face(mesh, surface, *mesh.cavities)
    return ~mirrors & (surface.outward if surface.outward is not None else ~cavities & ~_pinhole(mesh, surface))


def _over(stated: float | None, length: float) -> float | None:
    """A stated length over the unit of length."""
    return None if stated is None else stated / length


def _pinhole(mesh: Mesh, surface: Surface) -> NDArray[np.bool_]:
    """Sides around the axis of a revolved mesh, which is within the body: the wall of the pinhole touches nothing."""
    if not mesh.revolved:
        return np.zeros(len(surface.sides), dtype=bool)
    return np.asarray(mesh.on_axis[surface.sides].all(axis=1))


def _stiff(surface: Surface, stiffness: float) -> Surface:
    """A surface with a scaled stiffness of its own."""
    return replace(surface, spring=np.full(len(surface.sides), stiffness))


def _with_itself(
    model: Model,
    surface: Surface,
    outside: Surface,
    sizes: tuple[Array, float],
    like: Sequence[PairPart | ShapePart],
) -> list[PairPart | ShapePart]:
    """Walls outside, walls of cavities that are pressed together, and walls against their mirror images.

    ``sizes`` are the scaled points, and the stiffness of 1 Pa/m.
    """
    mesh, chosen, (points, stiffness) = model.mesh, model.contact.self_contact, sizes
    if chosen is None:
        return []
    if surface.outward is not None:
        return _films_with_themselves(model, surface, points)
    alone = [surface.chosen(of_face(mesh, surface, cavity)) for cavity in pressed_together(model)]
    if model.contact.for_mesh(mesh) is not None:
        alone.insert(0, outside)
    mirrored = np.zeros(len(points), dtype=bool)
    for name in mesh.cut_faces:
        mirrored[mesh.face_nodes(name)] = True
    parts: list[PairPart | ShapePart] = []
    for one in alone:
        if chosen.stiffness is not None:
            one = _stiff(one, chosen.stiffness * stiffness)
        parts.append(_pairs(one, points, mirrored, chosen.friction, like))
        for name in mesh.symmetry_faces:
            parts += _mirror(mesh, name, one, points)
    return parts


def _films_with_themselves(model: Model, surface: Surface, points: Array) -> list[PairPart | ShapePart]:
    """Films around a cavity that is pressed together, or all where it is requested, meet their images in mirror planes.

    One film does not meet another one: both sides of a film may be met, and what is near a film may be on either.
    """
    mesh = model.mesh
    parts: list[PairPart | ShapePart] = []
    assert surface.outward is not None
    for cavity in pressed_together(model) if model.contact.automatic else mesh.cavities:
        inner = surface.chosen(of_face(mesh, surface, cavity) & ~surface.outward)
        parts += [part for name in mesh.symmetry_faces for part in _mirror(mesh, name, inner, points)]
    return parts


def _pairs(
    surface: Surface,
    points: Array,
    mirrored: NDArray[np.bool_],
    friction: float,
    like: Sequence[PairPart | ShapePart],
) -> PairPart:
    sides, weights, height = surface.sides, surface.weights, surface.height
    alike = (one for one in like if isinstance(one, PairPart) and one.rigid is None)
    known = next((one.partners for one in alike if np.array_equal(one.surface.sides, sides)), None)
    if known is None:
        partners = replace(_partners(sides, (surface.N, surface.dN, weights, height), points, mirrored), sides=sides)
    else:  # what never touches is the same
        over = overhangs(points, sides, mirrored)
        partners = replace(
            known, sides=sides, overhang=over, depth=CONTACT_SEARCH.depth * height, reach=_reach(weights)
        )
    return PairPart(SELF, surface, partners, friction, 0.5)


def _reach(weights: Array) -> float:
    return CONTACT_SEARCH.reach * float(np.sqrt(weights.sum(axis=1)).mean())


def _partners(
    sides: Ints, tables: tuple[Array, Array, Array, Array], points: Array, mirrored: NDArray[np.bool_]
) -> Partners:
    """Sides of a surface that its own points may touch; ``tables`` are N, dN, weights and heights of the surface."""
    N, dN, weights, height = tables
    surface = Surface(sides, N, dN, weights, np.ones(len(sides)), height)  # stiffness does not matter to a search
    partners = Partners(
        sides=sides,
        corners=surface.corners,
        overhang=overhangs(points, sides, mirrored),
        depth=CONTACT_SEARCH.depth * height,
        strangers=strangers(points, sides),
        around=_around(sides, surface.corners),
        reach=_reach(weights),
    )
    while True:
        contact = PairPart(SELF, surface, partners, 0.0, 0.5).look(points, Pose(np.zeros(3)))
        inside = np.argwhere(contact.gap < -ROUND_OFF.mesh_digits * height[:, None])
        if not len(inside):
            return partners
        partners = _apart(partners, inside[:, 0], contact.partner[inside[:, 0], inside[:, 1]])


def _apart(partners: Partners, side: Ints, partner: Ints) -> Partners:
    """Sides that lie in each other at rest, at an acute edge or a flaw of the mesh, never touch."""
    start, never = partners.strangers
    rows = np.concatenate([np.repeat(np.arange(len(start) - 1), np.diff(start)), side])
    return replace(partners, strangers=listed(rows, np.concatenate([never, partner]), len(start) - 1))


def _around(sides: Ints, corners: int) -> tuple[Ints, Ints]:
    """Sides that share a corner with each side, itself included."""
    return listed(*neighbors(sides, corners), len(sides))


def _mirror(mesh: Mesh, name: str, surface: Surface, points: Array) -> list[PairPart | ShapePart]:
    """A rigid plane in a mirror plane: a wall meets its mirror image there, with the stiffness of both."""
    axis = mesh.normal_axis(name)
    level = float(points[mesh.face_nodes(name)][:, axis].mean())
    side = float(np.sign(points[:, axis].mean() - level))
    normal, point = np.zeros(3), np.zeros(3)
    normal[axis], point[axis] = side, level
    plane = Plane(point=(point[0], point[1], point[2]), normal=(normal[0], normal[1], normal[2]))
    stiff = replace(surface, spring=2 * surface.spring)
    return [ShapePart(SELF, stiff, plane, None, -1)]


def _triangles(
    obstacle: Obstacle, shape: tuple[Array, Ints], surface: Surface, points: Array, unknown: int
) -> PairPart:
    """A rigid body of triangles, cut to the size of the sides that it meets."""
    size = float(np.sqrt(surface.weights.sum(axis=1)).mean())
    corners, triangles = refined(*shape, 2 * size)
    sides, nodes = six_nodes(corners, triangles)
    if len(sides) > CONTACT_SEARCH.most_triangles:
        raise TurgorError(
            f"obstacle '{obstacle.name}': it has {len(sides)} triangles of the size that the mesh of the actuator "
            "needs; cut away what cannot be touched."
        )
    count = len(points)
    nothing = (np.zeros(len(surface.sides) + 1, dtype=np.int64), np.zeros(0, dtype=np.int64))
    partners = Partners(
        sides=sides + count,
        corners=3,
        overhang=overhangs(nodes, sides, np.zeros(len(nodes), dtype=bool)),
        depth=np.full(len(sides), CONTACT_SEARCH.near * size),
        strangers=nothing,
        around=_around(sides, 3),
        reach=CONTACT_SEARCH.reach * size,
        rigid=Rigid(obstacle, nodes, unknown),
    )
    return PairPart(obstacle.name, surface, partners, obstacle.friction, 1.0)
