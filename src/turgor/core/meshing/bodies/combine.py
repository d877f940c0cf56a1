"""Several bodies in one mesh: their names, their mirror planes, and the meshes that cannot be put together."""

import re
from collections.abc import Mapping
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.bodies.bodies import find_overlap
from turgor.core.meshing.bodies.placing import refuse_wedge, with_origin
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.openings import mirror_planes
from turgor.foundation.errors import TurgorError
from turgor.units import mm

AXES = "xyz"


def together(bodies: Mapping[str, Mesh]) -> Mesh:
    """Put several meshes into one, so that they can touch each other in one model.

    The name of the body is appended to each region and face: the cavity of ``upper`` becomes ``cavity_upper``. Mirror
    planes keep their names, because all bodies share them. A body is cut there, or lies wholly on the modeled side;
    its mirror image counts in volumes and forces of the whole actuator.

    Parameters
    ----------
    bodies : mapping of str to Mesh
        At least two meshes in their places; names hold letters, digits and underscores. Nodes are not joined: bodies
        meet by contact only.

    Returns
    -------
    Mesh

    Raises
    ------
    TurgorError
        If a name does not fit or is taken, kinds of cells differ, bodies overlap, or a mirror plane cuts another body.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.generate import mesh
    >>> from turgor.core.meshing.bodies.placing import mirrored, placed
    >>> finger = mesh(FastPneuNet(chambers=1, length=10e-3).build(), size=4e-3)
    >>> pair = together({"upper": placed(finger, shift=(0, 0, 2e-3)), "lower": mirrored(finger)})
    >>> list(pair.regions)
    ['body_upper', 'base_upper', 'body_lower', 'base_lower']
    >>> pair.cavities, pair.symmetry_faces
    (('cavity_lower', 'cavity_upper'), ('symmetry_y',))
    """
    if len(bodies) < 2:
        raise TurgorError(f"together: {len(bodies)} body given; at least two are needed.")
    return combined(bodies)


def combined(bodies: Mapping[str, Mesh]) -> Mesh:
    """Put meshes into one as `together` does; there may be one only, which gets its name in the same way.

    Parameters
    ----------
    bodies : mapping of str to Mesh

    Returns
    -------
    Mesh
    """
    for mesh in bodies.values():
        refuse_wedge(mesh)
    _check_bodies(bodies)
    _check_apart(bodies)
    mirrors = _shared_mirrors(bodies)
    numbers = _node_numbers(list(bodies.values()))
    points, cells, first_cell = np.empty((sum(map(len, numbers)), 3)), [], 0
    regions: dict[str, NDArray[np.int64]] = {}
    faces: dict[str, NDArray[np.int64]] = {}
    sets: dict[str, NDArray[np.int64]] = {}
    for number, (body, mesh) in zip(numbers, bodies.items(), strict=True):
        points[number] = mesh.points
        cells.append(number[mesh.cells])
        for name, rows in mesh.regions.items():
            regions[_free(f"{name}_{body}", regions)] = first_cell + rows
        for name, sides in mesh.faces.items():
            key = mirrors.get((body, name)) or _free(f"{name}_{body}", faces)
            faces[key] = np.concatenate([faces.get(key, sides[:0]), number[sides]])
        sets |= {_free(f"{name}_{body}", {**faces, **sets}): number[nodes] for name, nodes in mesh.node_sets.items()}
        first_cell += len(mesh.cells)
    return Mesh(
        points=points,
        cells=np.concatenate(cells),
        serendipity=all(mesh.serendipity for mesh in bodies.values()),
        regions=regions,
        faces=faces,
        node_sets=sets,
        name="; ".join(f"{body}: {mesh.name}" for body, mesh in bodies.items()),
        findings=tuple(
            with_origin(f"Body '{body}'", finding) for body, mesh in bodies.items() for finding in mesh.findings
        ),
    )


def _node_numbers(meshes: list[Mesh]) -> list[NDArray[np.int64]]:
    """Number of each node of each mesh in the common one, where the vertices of all meshes come first."""
    vertices = np.cumsum([0, *(mesh.vertex_count for mesh in meshes)])
    middles = vertices[-1] + np.cumsum([0, *(len(mesh.points) - mesh.vertex_count for mesh in meshes)])
    numbers = []
    for i, mesh in enumerate(meshes):
        number = np.arange(len(mesh.points))
        numbers.append(number + np.where(number < mesh.vertex_count, vertices[i], middles[i] - mesh.vertex_count))
    return numbers


def _check_bodies(bodies: Mapping[str, Mesh]) -> None:
    for body in bodies:
        if not re.fullmatch("[A-Za-z0-9_]+", body):
            raise TurgorError(f"body '{body}': a name holds letters, digits and underscores only.")
    first, *others = bodies
    for body in others:
        kind, expected = bodies[body].cell_type.name, bodies[first].cell_type.name
        if kind != expected:
            raise TurgorError(
                f"body '{body}' has {kind.replace('hedron', 'hedra')}, '{first}' has "
                f"{expected.replace('hedron', 'hedra')}; all bodies need the same kind of cells."
            )


def _check_apart(bodies: Mapping[str, Mesh]) -> None:
    for (first, one), (second, other) in combinations(bodies.items(), 2):
        place = find_overlap(one, other)
        if place is not None:
            x, y, z = place / mm
            raise TurgorError(
                f"bodies '{first}' and '{second}' overlap, at ({x:.3g}, {y:.3g}, {z:.3g}) mm for example; "
                "shift one of them, so that they are apart or just touch."
            )


def _shared_mirrors(bodies: Mapping[str, Mesh]) -> dict[tuple[str, str], str]:
    """Common name of each mirror plane (body, face); refuse bodies that do not fit the mirrors of the others."""
    near = 1e-6 * max(float(np.ptp(mesh.points, axis=0).max()) for mesh in bodies.values())
    known: dict[int, tuple[str, str, float]] = {}
    names: dict[tuple[str, str], str] = {}
    for body, mesh in bodies.items():
        for face, (axis, position) in mirror_planes(mesh).items():
            name, owner, place = known.setdefault(axis, (face, body, position))
            if abs(place - position) > near:
                raise TurgorError(
                    f"the mirror plane {face} of body '{body}' is at {AXES[axis]} = {position / mm:.6g} mm, that of "
                    f"'{owner}' at {place / mm:.6g} mm; bodies that mirror planes cut must share them."
                )
            names[body, face] = name
    used = [name for name, _, _ in known.values()]
    twice = next((name for name in used if used.count(name) > 1), None)
    if twice is not None:
        raise TurgorError(f"together: two different mirror planes are called '{twice}'; name each after its normal.")
    _check_sides(bodies, known, near)
    return names


def _check_sides(bodies: Mapping[str, Mesh], known: Mapping[int, tuple[str, str, float]], near: float) -> None:
    """Refuse a body that is not on the modeled side of a mirror plane, or reaches it without being cut there."""
    for axis, (name, owner, place) in known.items():
        positive = bodies[owner].points[:, axis].max() > place + near
        for body, mesh in bodies.items():
            beyond = (mesh.points[:, axis] - place) * (-1 if positive else 1)
            is_cut = axis in {at for at, _ in mirror_planes(mesh).values()}
            if beyond.max() > (near if is_cut else -near):
                raise TurgorError(
                    f"body '{body}' does not stay on the side of the mirror plane {name} on which '{owner}' is "
                    "modeled; cut it there too, shift it clear of the plane, or model all bodies whole."
                )


def _free(name: str, taken: Mapping[str, object]) -> str:
    if name in taken:
        raise TurgorError(f"together: two bodies would have the name '{name}'; give one of them another name.")
    return name
