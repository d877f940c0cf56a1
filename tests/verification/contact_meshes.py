"""Meshes of the contact cases: several bodies in one, balls and bars refined where they touch, walls with a gap."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

import meshes
from meshes import Block
from turgor.core.meshing.cells import HEXAHEDRON, CellType
from turgor.core.meshing.mesh import Mesh

Array = NDArray[np.float64]


def together(bodies: Mapping[str, Mesh]) -> Mesh:
    """Several bodies in one mesh, a region ``body``; the face z0 of the body ``lower`` is called ``lower_z0``.

    Faces named ``symmetry_*`` lie in one plane for all bodies and keep their names.
    """
    vertices = sum(body.vertex_count for body in bodies.values())
    points, middles, cells = [], [], []
    faces: dict[str, list[NDArray[np.int64]]] = {}
    first, middle = 0, vertices
    for name, body in bodies.items():
        own = body.vertex_count
        number = np.concatenate([first + np.arange(own), middle + np.arange(len(body.points) - own)])
        points.append(body.points[:own])
        middles.append(body.points[own:])
        cells.append(number[body.cells])
        for face, sides in body.faces.items():
            key = face if face.startswith("symmetry_") else f"{name}_{face}"
            faces.setdefault(key, []).append(number[sides])
        first, middle = first + own, middle + len(body.points) - own
    joined = np.concatenate(cells)
    return Mesh(
        points=np.concatenate([*points, *middles]),
        cells=joined,
        regions={"body": np.arange(len(joined))},
        faces={name: np.concatenate(sides) for name, sides in faces.items()},
    )


def moved(mesh: Mesh, shift: tuple[float, float, float]) -> Mesh:
    """The mesh somewhere else."""
    return meshes.with_points(mesh, mesh.points + np.array(shift))


def upside_down(mesh: Mesh) -> Mesh:
    """A hexahedral or tetrahedral slice between y0 and y1 turned by 180° about the line y = half its width, z = 0.

    Its faces y0 and y1 change places in space, not in name; symmetry_x stays in its plane.
    """
    width = np.ptp(mesh.points[:, 1])
    return meshes.with_points(mesh, mesh.points * [1, -1, -1] + [0, width, 0])


def finer(parameter: Array, growth: float) -> Array:
    """Spread parameters 0..1 so that the last interval would be e^growth times as long as the first."""
    return np.asarray(np.expm1(growth * parameter) / np.expm1(growth)) if growth else parameter


def ball(radius: float, counts: tuple[int, int, int], growth: float = 2.5, kind: CellType = HEXAHEDRON) -> Mesh:
    """Eighth of a solid ball, refined towards its pole on +z. Faces symmetry_x, symmetry_y, middle (z = 0), outside.

    ``counts``: cells from the pole half way to the equator, from there to the equator, and from the core outwards.
    The inside is a cube whose three far sides look along x, y and z through shells that are cubes, too.
    """
    core, (near, far, through) = 0.5 * radius, counts
    count, growths = (near, near, far), (growth, growth, 0.0)

    def tangent(parameter: Array, axis: int) -> Array:
        return np.asarray(np.tan(np.pi / 4 * finer(parameter, growths[axis])))

    def inside(p: Array) -> Array:
        return core * np.column_stack([tangent(p[:, k], k) for k in range(3)])

    planes = ("symmetry_x", "symmetry_y", "middle")
    blocks = [Block(count, inside, {"x0": planes[0], "y0": planes[1], "z0": planes[2]})]
    for axis in range(3):
        s, t = (axis + 1) % 3, (axis + 2) % 3

        def shell(p: Array, s: int = s, t: int = t) -> Array:
            direction = np.ones((len(p), 3))
            direction[:, s], direction[:, t] = tangent(p[:, 0], s), tangent(p[:, 1], t)
            outward = 1 - finer(1 - p[:, 2:], growth * 2 / 3)
            surface = radius * direction / np.linalg.norm(direction, axis=1)[:, None]
            return np.asarray((1 - outward) * core * direction + outward * surface)

        names = {"x0": planes[s], "y0": planes[t], "z1": "outside"}
        blocks.append(Block((count[s], count[t], through), shell, names))
    return meshes.glued(blocks, kind=kind)


def bar(radius: float, counts: tuple[int, int, int], growth: float = 2.5, kind: CellType = HEXAHEDRON) -> Mesh:
    """Quarter of a slice of a round bar along y, refined towards +z; 1 mm thick.

    Faces symmetry_x, middle (z = 0), outside, y0, y1; counts as those of `ball`.
    """
    core, thick, (near, far, through) = 0.5 * radius, 1e-3, counts

    def tangent(parameter: Array, rate: float) -> Array:
        return np.asarray(np.tan(np.pi / 4 * finer(parameter, rate)))

    def inside(p: Array) -> Array:
        return np.column_stack([core * tangent(p[:, 0], growth), thick * p[:, 1], core * tangent(p[:, 2], 0.0)])

    def shell(along: Array, across: int, rate: float, p: Array) -> Array:
        direction = np.zeros((len(p), 3))
        direction[:, 2 - across], direction[:, across] = 1.0, tangent(along, rate)
        outward = 1 - finer(1 - p[:, 2 - across, None], growth * 2 / 3)
        surface = radius * direction / np.linalg.norm(direction, axis=1)[:, None]
        return np.asarray((1 - outward) * core * direction + outward * surface + thick * p[:, 1:2] * [0, 1, 0])

    ends, mirror = {"y0": "y0", "y1": "y1"}, "symmetry_x"
    return meshes.glued(
        [
            Block((near, 1, far), inside, {"x0": mirror, "z0": "middle", **ends}),
            Block((near, 1, through), lambda p: shell(p[:, 0], 0, growth, p), {"x0": mirror, "z1": "outside"} | ends),
            Block((through, 1, far), lambda p: shell(p[:, 2], 2, 0.0, p), {"z0": "middle", "x1": "outside"} | ends),
        ],
        kind=kind,
    )


#: The cell of `gap_cell`: half span, rim, wall, half gap and thickness of the slice [m].
SPAN, RIM, WALL, HALF_GAP, SLICE = 8e-3, 2e-3, 1.5e-3, 0.5e-3, 1e-3


def gap_cell(walls: int = 1, seat: str = "seat", kind: CellType = HEXAHEDRON, along: int = 8) -> Mesh:
    """Slice of a wall that bulges into a gap from below, or of two that meet in its middle, z = 0.

    Faces symmetry_x at midspan, rim at the far end, y0 and y1, cavity_1 below the lower wall and its rim, cavity_2
    above the upper one, gap_1 and gap_2 where they face each other. A single wall ends at the face ``seat`` in mid-gap.
    """
    ends, middle, blocks = {"y0": "y0", "y1": "y1"}, {"z1": seat} if walls == 1 else {}, []
    for side in range(walls):
        sign = (1, -1)[side]
        pressed, free = f"cavity_{side + 1}", f"gap_{side + 1}"

        def wall(p: Array, sign: int = sign) -> Array:
            z = -sign * (HALF_GAP + WALL * (1 - p[:, 2]))
            return np.column_stack([SPAN * p[:, 0], SLICE * p[:, 1], z])

        def rim(p: Array, sign: int = sign) -> Array:
            z = -sign * (HALF_GAP + WALL * (1 - p[:, 2]))
            return np.column_stack([SPAN + RIM * p[:, 0], SLICE * p[:, 1], z])

        def spacer(p: Array, sign: int = sign) -> Array:
            return np.column_stack([SPAN + RIM * p[:, 0], SLICE * p[:, 1], -sign * HALF_GAP * (1 - p[:, 2])])

        turn = sign < 0
        blocks += [
            Block((along, 1, 2), wall, {"x0": "symmetry_x", "z0": pressed, "z1": free} | ends, turn),
            Block((2, 1, 2), rim, {"x1": "rim", "z0": pressed} | ends, turn),
            Block((2, 1, 1), spacer, {"x0": free, "x1": "rim"} | ends | middle, turn),
        ]
    return meshes.glued(blocks, kind=kind)
