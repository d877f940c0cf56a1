"""Meshes turned, shifted and mirrored: where bodies stand before they are put together."""

from collections.abc import Sequence
from dataclasses import replace
from math import pi

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.rules import check_angle, check_length
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.meshing.cells import CellType, SideType
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.openings import mirror_planes
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding
from turgor.units import m

Array = NDArray[np.float64]
Vector = tuple[float, float, float]

AXES = "xyz"


def placed(mesh: Mesh, *, shift: Vector = (0, 0, 0), axis: Vector = (0, 0, 1), angle: float = 0.0) -> Mesh:
    """Turn a mesh about an axis through the origin, then shift it.

    Parameters
    ----------
    mesh : Mesh
    shift : (3,) floats [m]
        How far to move it, after the turn; up to 2 m along each axis.
    axis : (3,) floats
        Direction of the axis; any length but zero.
    angle : float [rad]
        How far to turn it, by the right-hand rule; up to a full turn either way.

    Returns
    -------
    Mesh
        The same cells elsewhere. A mirror plane named after its normal, such as ``symmetry_y``, is renamed when it
        becomes another coordinate plane.

    Raises
    ------
    TurgorError
        If a mirror plane would not be a coordinate plane any more, or a number is not allowed.

    Examples
    --------
    >>> from math import pi
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.generate import mesh
    >>> finger = mesh(FastPneuNet(chambers=1, length=10e-3).build(), size=4e-3)
    >>> placed(finger, axis=(1, 0, 0), angle=pi / 2, shift=(0, 0, 5e-3)).symmetry_faces
    ('symmetry_z',)
    >>> placed(finger, axis=(1, 0, 0), angle=pi / 6)
    Traceback (most recent call last):
    turgor.TurgorError: 'fast PneuNet, 1 chamber, half' cannot be turned like this: its mirror plane \
symmetry_y would not be a coordinate plane any more; turn it about y or by quarter turns, or model the whole of it.
    """
    check_angle("angle", angle, low=-2 * pi, high=2 * pi)
    if len(shift) != 3:
        raise TurgorError(f"shift is {shift!r}; three lengths are needed.")
    for letter, length in zip(AXES, shift, strict=True):
        check_length(f"shift along {letter}", length, low=-2 * m, high=2 * m)
    x, y, z = _unit("axis", axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turn = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross  # Rodrigues
    return _moved(mesh, turn, np.array(shift, dtype=np.float64))


def mirrored(mesh: Mesh, normal: Vector = (0, 0, 1)) -> Mesh:
    """Mirror a mesh in a plane through the origin.

    Parameters
    ----------
    mesh : Mesh
    normal : (3,) floats
        Normal of the plane; any length but zero.

    Returns
    -------
    Mesh
        The mirror image; its cells and faces are numbered so that they are right side out again.

    Raises
    ------
    TurgorError
        If a mirror plane of the mesh would not be a coordinate plane any more.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.generate import mesh
    >>> finger = mesh(FastPneuNet(chambers=1, length=10e-3).build(), size=4e-3)
    >>> bool(mirrored(finger).points[:, 2].max() == -finger.points[:, 2].min())
    True
    """
    n = _unit("normal", normal)
    image = _moved(mesh, np.eye(3) - 2 * np.outer(n, n), np.zeros(3))
    cell, side = _turned_cell(mesh.cell_type), _turned_side(mesh.cell_type.side)
    faces = {name: sides[:, side] for name, sides in image.faces.items()}
    return replace(image, cells=mesh.cells[:, cell], faces=faces)


def with_origin(prefix: str, finding: Finding) -> Finding:
    """Put where a finding is from in front of it, once."""
    stated = finding.message.startswith(f"{prefix}: ")
    return finding if stated else replace(finding, message=f"{prefix}: {finding.message}")


def refuse_wedge(mesh: Mesh) -> None:
    """Refuse one sector of a whole, whose images would not follow it."""
    if mesh.wedge is not None:
        raise TurgorError(
            f"mesh '{mesh.name}' is a wedge of 1/{mesh.wedge.fold} about {mesh.wedge.axis}, which cannot be moved or "
            'combined with other bodies; model the whole of it (symmetry = "none").'
        )


def _moved(mesh: Mesh, matrix: Array, shift: Array) -> Mesh:
    """Map the points of a mesh by a rotation or a reflection and a shift; mirror planes stay exactly plane."""
    refuse_wedge(mesh)
    matrix = np.round(matrix, 15)  # a quarter turn is meant exactly
    points = mesh.points @ matrix.T + shift
    faces, names = dict(mesh.faces), {}
    for name, (before, _) in mirror_planes(mesh).items():
        normal = np.abs(matrix[:, before])
        after = int(normal.argmax())
        if np.delete(normal, after).max() > TOLERANCE.round_off:
            raise TurgorError(
                f"'{mesh.name}' cannot be turned like this: its mirror plane {name} would not be a coordinate plane "
                f"any more; turn it about {AXES[before]} or by quarter turns, or model the whole of it."
            )
        nodes = mesh.face_nodes(name)
        points[nodes, after] = np.median(points[nodes, after])
        if name == f"symmetry_{AXES[before]}":
            names[name] = f"symmetry_{AXES[after]}"
    renamed = [names.get(name, name) for name in faces]
    if len(set(renamed)) < len(renamed):
        raise TurgorError(f"'{mesh.name}': two mirror planes would get the same name; name each after its normal.")
    return replace(
        mesh,
        points=points,
        faces=dict(zip(renamed, faces.values(), strict=True)),
        findings=tuple(with_origin("Before it was moved", finding) for finding in mesh.findings),
    )


def _turned_cell(kind: CellType) -> list[int]:
    """Order of nodes that turns a cell inside out: two corners of a tetrahedron, bottom and top of a hexahedron."""
    corners = [0, 2, 1, 3] if kind.corners == 4 else [4, 5, 6, 7, 0, 1, 2, 3]
    order = [*corners, *_middles(kind.edges, corners, kind.corners)]
    if kind.nodes == 27:  # middles of sides, then that of the cell
        sides = [frozenset(side[:4]) for side in kind.sides]
        order += [20 + sides.index(frozenset(corners[i] for i in side)) for side in sides]
        order.append(26)
    return order


def _turned_side(kind: SideType) -> list[int]:
    """Order of nodes in which a side points the other way."""
    corners = [0, *range(kind.corners - 1, 0, -1)]
    order = [*corners, *_middles(kind.edges, corners, kind.corners)]
    return [*order, *range(len(order), kind.nodes)]


def _middles(edges: Sequence[tuple[int, int]], corners: list[int], first: int) -> list[int]:
    """Mid-side nodes in the order of the edges between renumbered corners."""
    known = [frozenset(edge) for edge in edges]
    return [first + known.index(frozenset(corners[i] for i in edge)) for edge in edges]


def _unit(what: str, vector: Vector) -> Array:
    values = np.array(vector, dtype=np.float64)
    length = float(np.linalg.norm(values))
    if values.shape != (3,) or not (np.isfinite(length) and length > 0):
        raise TurgorError(f"{what} is {vector!r}; a direction such as (0, 0, 1) is needed.")
    return values / length
