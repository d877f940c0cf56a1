"""Build the parts of contact that a model asks for."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.contact.closest import centers_of
from turgor.core.engine.contact.films import film_exceptions
from turgor.core.engine.contact.pair_part import PairPart, Partners, Rigid
from turgor.core.engine.contact.rigid_triangles import refined, six_nodes
from turgor.core.engine.contact.settings import CONTACT_SEARCH
from turgor.core.engine.contact.shape_part import ShapePart
from turgor.core.engine.contact.surface import Surface, listed, neighbors, of_face, overhangs, rims, strangers
from turgor.core.engine.ties import tied_sides
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import corner_keys
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
    films, outer = surface.outward is not None, outer_sides(model, surface)
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


def outer_sides(model: Model, surface: Surface) -> NDArray[np.bool_]:
    """Which sides of a surface lie outside: on no cavity and no cut, and not tied or bonded, which bears pressing."""
    mesh, ties = model.mesh, [each.tied for each in model.supports if each.tied is not None]
    mirrors = of_face(mesh, surface, *mesh.cut_faces, *(face for faces in mesh.parted for face in faces))
    for sides in (sides for tie in ties for sides in tied_sides(mesh, *tie)):  # what is left of both faces may touch
        keys, tied = (corner_keys(each, len(mesh.points)) for each in (surface.sides, sides))
        mirrors |= np.isin(keys, tied)
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
        return _films_with_themselves(model, surface, sizes, like)
    alone = [surface.chosen(of_face(mesh, surface, cavity)) for cavity in pressed_together(model)]
    if model.contact.for_mesh(mesh) is not None:
        alone.insert(0, outside)
    parts: list[PairPart | ShapePart] = []
    for one in alone:
        if chosen.stiffness is not None:
            one = _stiff(one, chosen.stiffness * stiffness)
        parts.append(_pairs(model, one, points, like))
        for name in mesh.symmetry_faces:
            parts += _mirror(mesh, name, one, points)
    return parts


def _films_with_themselves(
    model: Model, surface: Surface, sizes: tuple[Array, float], like: Sequence[PairPart | ShapePart]
) -> list[PairPart | ShapePart]:
    """Films meet each other; those around a cavity that is pressed together, their images in mirror planes."""
    mesh, chosen, (points, stiffness) = model.mesh, model.contact.self_contact, sizes
    outward = surface.outward
    assert outward is not None and chosen is not None
    if chosen.stiffness is not None:
        surface = _stiff(surface, chosen.stiffness * stiffness)
    parts: list[PairPart | ShapePart] = []
    if model.contact.for_mesh(mesh) is not None:
        parts.append(_pairs(model, surface, points, like))
    for cavity in pressed_together(model) if model.contact.automatic else mesh.cavities:
        inner = surface.chosen(of_face(mesh, surface, cavity) & ~outward)
        parts += [part for name in mesh.symmetry_faces for part in _mirror(mesh, name, inner, points)]
    return parts


def _pairs(model: Model, surface: Surface, points: Array, like: Sequence[PairPart | ShapePart]) -> PairPart:
    """Contact of a surface with itself; what never touches is that of a part like it."""
    mesh, films, own = model.mesh, surface.outward is not None, model.contact.self_contact
    friction = 0.0 if own is None else own.friction
    sides, mirrored = surface.sides, np.zeros(len(points), dtype=bool)
    for name in mesh.cut_faces:
        mirrored[mesh.face_nodes(name)] = True
    alike = (one for one in like if isinstance(one, PairPart) and one.rigid is None)
    known = next((one.partners for one in alike if np.array_equal(one.surface.sides, sides)), None)
    over = np.concatenate([overhangs(points, layer, mirrored) for layer in surface.layers])
    inside = CONTACT_SEARCH.behind * model.contact.tolerance if films else CONTACT_SEARCH.depth
    depth, reach = inside * surface.height, _reach(surface.weights)
    if known is not None:
        partners = replace(known, sides=sides, overhang=over, depth=depth, reach=reach)
        return PairPart(SELF, surface, partners, friction, 0.5)
    partners = Partners(
        sides=sides,
        corners=surface.corners,
        overhang=over,
        depth=depth,
        strangers=film_exceptions(mesh, surface, points) if films else strangers(points, sides),
        around=_around(surface.layers, surface.corners),
        reach=reach,
        rims=rims(points, sides, borders=False) if friction and not films else None,
        open=surface.outward,
    )
    return PairPart(SELF, surface, _settled(surface, partners, points), friction, 0.5)


def _reach(weights: Array) -> float:
    return CONTACT_SEARCH.reach * float(np.sqrt(weights.sum(axis=1)).mean())


def _settled(surface: Surface, partners: Partners, points: Array) -> Partners:
    """Sides that lie in each other at rest, at an acute edge or a flaw of the mesh, never touch."""
    while True:
        contact = PairPart(SELF, surface, partners, 0.0, 0.5).look(points, Pose(np.zeros(3)))
        inside = np.argwhere(contact.gap < -ROUND_OFF.mesh_digits * surface.height[:, None])
        if not len(inside):
            return partners
        side, partner = inside[:, 0], contact.partner[inside[:, 0], inside[:, 1]]
        start, never = partners.strangers
        count = len(start) - 1
        keys = np.repeat(np.arange(count), np.diff(start)) * count + never
        changed = np.setxor1d(keys, np.unique(side * count + partner))
        rows, exceptions = np.divmod(changed, count)
        partners = replace(partners, strangers=listed(rows, exceptions, count))


def _around(layers: Sequence[Ints], corners: int) -> tuple[Ints, Ints]:
    """Sides that share a corner with each side of their layer, itself included."""
    pairs, start = [], 0
    for layer in layers:
        pairs.append(start + np.array(neighbors(layer, corners)))
        start += len(layer)
    rows, values = np.concatenate(pairs, axis=1)
    return listed(rows, values, start)


def _mirror(mesh: Mesh, name: str, surface: Surface, points: Array) -> list[PairPart | ShapePart]:
    """A rigid plane in a mirror plane: a wall meets its mirror image there, with the stiffness of both."""
    axis = mesh.normal_axis(name)
    level = float(points[mesh.face_nodes(name)][:, axis].mean())
    side = float(np.sign(points[:, axis].mean() - level))
    if surface.outward is not None and np.ptp(points[:, axis]) == 0:  # flat films in the plane, which look into it
        side = -float(np.sign(centers_of(points, surface.sides, surface.corners)[2][:, axis].sum()))
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
        around=_around((sides,), 3),
        reach=CONTACT_SEARCH.reach * size,
        rigid=Rigid(obstacle, nodes, unknown),
        rims=rims(nodes, sides, borders=True),
    )
    return PairPart(obstacle.name, surface, partners, obstacle.friction, 1.0)
