"""Contact in .inp files: surfaces, interactions and pairs, and obstacles as rigid bodies of wedges."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.contact.build import outer_sides
from turgor.core.engine.contact.surface import Surface, of_face, whole_surface
from turgor.core.engine.mass import cell_volumes
from turgor.core.inp.cells import faces_of_sides, node_lines, surface_lines
from turgor.core.inp.context import Context
from turgor.core.meshing.quality.mirror_gap import faces_its_image
from turgor.core.meshing.quality.proximity import find_facing_walls
from turgor.core.model.drive import pressed_together
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Obstacle, Plane, SelfContact
from turgor.foundation.errors import TurgorError
from turgor.units import MPa, N, mm

Array = NDArray[np.float64]

#: Friction of Abaqus sticks up to this share of the size of a cell by default, as turgor's does.
SLIP = 0.005


@dataclass(frozen=True, slots=True)
class RigidNode:
    """The reference node of an obstacle in a file.

    Parameters
    ----------
    name : str
    node : int
        Moves with the obstacle.
    turning, first : int
        The node that has its rotation, and the degree of freedom of the rotation about x.
    place, turn : (3,) arrays [m], [rad]
        How far the obstacle is moved and turned already where the file has it at rest.
    """

    name: str
    node: int
    turning: int
    first: int
    place: Array
    turn: Array


def contact_lines(context: Context, models: Sequence[Model]) -> tuple[list[str], tuple[RigidNode, ...]]:
    """Write the contact of a model: the lines, and the reference nodes of its obstacles.

    Parameters
    ----------
    context : Context
    models : sequence of Model
        Those of the stages, any of which may press the walls of a cavity together.

    Raises
    ------
    TurgorError
        If an obstacle begins turned about another axis, or the mesh has no contact.
    """
    model, lines, nodes = context.model, list[str](), list[RigidNode]()
    own = model.contact.self_contact
    alone = own is not None and model.contact.for_mesh(model.mesh) is not None
    pressed = (name for each in models for name in pressed_together(each) if own is not None)
    cavities = tuple(dict.fromkeys(pressed))
    if not (alone or cavities or model.contact.obstacles):
        return [], ()
    if model.mesh.cell_type.side.nodes == 8:
        raise TurgorError("contact needs tetrahedra or 27-node hexahedra; this mesh has 20-node hexahedra.")
    surface = whole_surface(model, model.mesh.points, cell_volumes(model.mesh), 1.0)
    outside = surface.chosen(outer_sides(model, surface))
    lines += surface_lines("contact_outside", faces_of_sides(model.mesh, outside.sides) or [])
    if own is not None:
        inner = {name: surface.chosen(of_face(model.mesh, surface, name)) for name in cavities}
        walls = ({"outside": outside} if alone else {}) | inner
        for name, each in walls.items():
            lines += _with_itself(context, name, own, each)
        for plane in _mirrors(model):
            rigid, node = _rigid(context, plane)
            lines += [*rigid, *_interaction(context, plane.name, own, outside)]
            lines += [line for name in walls for line in _pair(plane.name, f"contact_{name}", f"rigid_{plane.name}")]
            nodes.append(node)
    for obstacle in model.contact.obstacles:
        rigid, node = _rigid(context, obstacle)
        touching, chosen = "contact_outside", outside
        if obstacle.face is not None:
            touching, chosen = f"contact_{obstacle.name}", surface.chosen(of_face(model.mesh, surface, obstacle.face))
            lines += surface_lines(touching, faces_of_sides(model.mesh, chosen.sides) or [])
        lines += [*rigid, *_interaction(context, obstacle.name, obstacle, chosen)]
        lines += [*_pair(obstacle.name, touching, f"rigid_{obstacle.name}"), *_spring(context, obstacle, node)]
        _account(context, f"obstacles.{obstacle.name}", obstacle, chosen, "a rigid body of flat sides")
        nodes.append(node)
    return lines, tuple(nodes)


def _with_itself(context: Context, name: str, own: SelfContact, walls: Surface) -> list[str]:
    """Walls with each other: one surface in Abaqus, pairs of facing walls in CalculiX, which crawls with one."""
    mesh, what = context.model.mesh, "contact.self_contact"
    lines = [] if name == "outside" else surface_lines(f"contact_{name}", faces_of_sides(mesh, walls.sides) or [])
    lines += _interaction(context, name, own, walls)
    if context.for_abaqus:
        _account(context, what, own, walls, f"the surface {name} as a pair with itself")
        return [*lines, *_pair(name, f"contact_{name}", f"contact_{name}")]
    facing = find_facing_walls(mesh, cavity=None if name == "outside" else name)
    corners = walls.sides[:, : walls.corners]
    for number, wall in enumerate(facing.walls):
        sides = walls.sides[np.isin(corners, wall).all(axis=1)]
        lines += surface_lines(f"wall_{name}_{number + 1}", faces_of_sides(mesh, sides) or [])
    for one, other in facing.pairs.tolist():
        lines += _pair(name, f"wall_{name}_{one + 1}", f"wall_{name}_{other + 1}")
    if len(facing.pairs):
        _account(context, what, own, walls, f"pairs of walls that face each other at rest: {len(facing.pairs)}")
    context.left_out(what, f"contact of parts of {name} that do not face each other at rest")
    return lines


def _mirrors(model: Model) -> Iterator[Obstacle]:
    """Rigid planes in the mirror planes that walls face, where a wall meets its image."""
    if not faces_its_image(model.mesh):
        return
    for name, (axis, level) in zip(model.mesh.symmetry_faces, model.mesh.mirror_planes, strict=True):
        normal, point = np.zeros(3), np.zeros(3)
        normal[axis], point[axis] = np.sign(model.mesh.points[:, axis].mean() - level), level
        shape = Plane(point=(point[0], point[1], point[2]), normal=(normal[0], normal[1], normal[2]))
        yield Obstacle(name=f"mirror_{name}", shape=shape)


def _interaction(context: Context, name: str, own: Obstacle | SelfContact, walls: Surface) -> list[str]:
    """The behavior of a pair: hard in Abaqus where no penalty is stated."""
    lines = [f"*SURFACE INTERACTION, NAME=touch_{name}"]
    slope = _slope(own, walls)
    if own.stiffness is None and context.for_abaqus:
        lines.append("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD")
    elif context.for_abaqus:
        lines += ["*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{slope:.6g}"]
    else:
        lines += ["*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{slope:.6g}"]
    if not own.friction:
        return lines
    if context.for_abaqus:
        slip = f"ELASTIC SLIP={own.elastic_slip / mm:.6g}" if own.elastic_slip else f"SLIP TOLERANCE={SLIP:g}"
        return [*lines, f"*FRICTION, {slip}", f"{own.friction:.12g}"]
    return [*lines, "*FRICTION", f"{own.friction:.12g}, {slope:.6g}"]  # as stiff along the wall


def _slope(own: Obstacle | SelfContact, walls: Surface) -> float:
    """Penalty [MPa/mm]: the stated one, else the mean of those with which turgor begins."""
    return (own.stiffness or float(walls.spring.mean())) * mm / MPa


def _account(context: Context, what: str, own: Obstacle | SelfContact, walls: Surface, form: str) -> None:
    if context.for_abaqus and own.stiffness is None:
        text = f"{form}, in hard contact"
    elif own.stiffness is None:
        text = f"{form}; penalty of {_slope(own, walls):.4g} MPa/mm everywhere, which CalculiX does not raise"
    else:
        text = f"{form}, with its penalty"
    context.approximated(what, text)


def _pair(interaction: str, slave: str, master: str) -> list[str]:
    kind = "TYPE=SURFACE TO SURFACE"
    return [f"*CONTACT PAIR, INTERACTION=touch_{interaction}, {kind}", f"{slave}, {master}"]


def _rigid(context: Context, obstacle: Obstacle) -> tuple[list[str], RigidNode]:
    """An obstacle as wedges behind its triangles where its path begins, tied to a reference node."""
    pose, turn = obstacle.pose(0.0), _first_turn(obstacle)
    points, triangles = obstacle.outline(pose, _room(context.model))
    behind = _behind(points, triangles)
    label = f"rigid_{obstacle.name}"
    first = next(context.nodes)
    for _ in range(2 * len(points) - 1):
        next(context.nodes)
    both = np.concatenate([points, behind])
    lines = [f"** obstacle {obstacle.name}", f"*NODE, NSET={label}"]
    lines += node_lines(both, np.arange(len(both)), first)
    lines.append(f"*ELEMENT, TYPE=C3D6, ELSET={label}")
    cells = [next(context.elements) for _ in triangles]
    for cell, (a, b, c) in zip(cells, (triangles + first).tolist(), strict=True):
        back = [node + len(points) for node in (a, b, c)]
        lines.append(", ".join(map(str, (cell, *back, a, b, c))))
    lines += [f"*SURFACE, NAME={label}, TYPE=ELEMENT", *(f"{cell}, S2" for cell in cells)]
    lines += [f"*MATERIAL, NAME={label}", "*ELASTIC", "1., 0."]  # of a rigid body, without an effect
    lines += [f"*SOLID SECTION, ELSET={label}, MATERIAL={label}"]
    middle = points.mean(axis=0) if obstacle.rotation == () else pose.pivot
    node = next(context.nodes)
    turning = node if context.for_abaqus else next(context.nodes)
    place = ", ".join(f"{value:.12g}" for value in np.asarray(middle) / mm)
    lines += ["*NODE", *(f"{each}, {place}" for each in sorted({node, turning}))]
    turns = "" if context.for_abaqus else f", ROT NODE={turning}"
    lines.append(f"*RIGID BODY, ELSET={label}, REF NODE={node}{turns}")
    return lines, RigidNode(obstacle.name, node, turning, 4 if context.for_abaqus else 1, pose.place, turn)


def _first_turn(obstacle: Obstacle) -> Array:
    """The rotation (3,) [rad] with which an obstacle begins; later ones less this one are those from there on."""
    turns = np.array([vector for _, vector in obstacle.rotation] or [(0.0, 0.0, 0.0)])
    if turns[0].any() and np.linalg.matrix_rank(turns) > 1:
        raise TurgorError(
            f"the obstacle '{obstacle.name}' begins turned and turns on about another axis, which has no form in .inp "
            "files; state its shape as it is turned at first."
        )
    return np.asarray(turns[0])


def _room(model: Model) -> Array:
    """The box around the actuator with its size on every side, into which it may move."""
    low, high = model.mesh.points.min(axis=0), model.mesh.points.max(axis=0)
    size = float((high - low).max())
    return np.stack([low - size, high + size])


def _behind(points: Array, triangles: NDArray[np.int64]) -> Array:
    """Points a little within a body, so little that no wedge is turned over."""
    corners = points[triangles]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(points)
    for k in range(3):
        np.add.at(normals, triangles[:, k], across)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    least = (np.linalg.norm(across, axis=1) / edges.max(axis=1)).min()  # height of the flattest triangle
    return np.asarray(points - 0.1 * least * normals)


def _spring(context: Context, obstacle: Obstacle, node: RigidNode) -> list[str]:
    """Springs at the reference node, in the directions in which it may move."""
    if obstacle.spring is None:
        return []
    lines, model = list[str](), context.model
    for axis in _free(model):
        label = f"spring_{obstacle.name}_{'xyz'[axis]}"
        lines += [f"*ELEMENT, TYPE=SPRING1, ELSET={label}", f"{next(context.elements)}, {node.node}"]
        stiffness = obstacle.spring * mm / N / model.mesh.symmetry_factor
        lines += [f"*SPRING, ELSET={label}", f"{axis + 1}", f"{stiffness:.12g}"]
    return lines


def _free(model: Model) -> list[int]:
    """Directions along all mirror planes."""
    across = {axis for axis, _ in model.mesh.mirror_planes}
    return [axis for axis in range(3) if axis not in across]


def rigid_rows(model: Model, nodes: Sequence[RigidNode]) -> Iterator[tuple[str, tuple[tuple[float, float], ...]]]:
    """Yield rows of ``*BOUNDARY`` of the reference nodes, with ``1`` for the value, and the values over a stage.

    Raises
    ------
    TurgorError
        If the end of a spring moves.
    """
    obstacles = {each.name: each for each in model.contact.obstacles}
    for node in nodes:
        obstacle = obstacles.get(node.name)
        free = _free(model) if obstacle is not None and obstacle.spring is not None else []
        if free and obstacle is not None and any((np.array(to) != node.place).any() for _, to in obstacle.path):
            raise TurgorError(
                f"the obstacle '{obstacle.name}' has a spring whose end moves, which has no form in .inp files; leave "
                "out the path, the moves or the spring."
            )
        for axis in range(3):
            if axis not in free:
                way = () if obstacle is None else obstacle.path
                yield f"{node.node}, {axis + 1}, {axis + 1}", _component(way, axis, node.place, mm)
            turn = () if obstacle is None else obstacle.rotation
            yield f"{node.turning}, {node.first + axis}, {node.first + axis}", _component(turn, axis, node.turn, 1.0)


def _component(
    way: Sequence[tuple[float, Sequence[float]]], axis: int, first: Array, unit: float
) -> tuple[tuple[float, float], ...]:
    return tuple((s, (value[axis] - float(first[axis])) / unit) for s, value in way) or ((0.0, 0.0), (1.0, 0.0))
