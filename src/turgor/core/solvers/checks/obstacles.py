"""Checks of obstacles: those that overlap the actuator before anything moves, and those that never act."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import corner_keys, outer_triangles
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Obstacle
from turgor.core.solvers.checks.settings import OBSTACLES
from turgor.foundation.finding import Finding, Severity
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def overlapping_obstacles(model: Model) -> tuple[Finding, ...]:
    """Say which obstacles reach into the actuator at rest (B08).

    Parameters
    ----------
    model : Model

    Returns
    -------
    tuple of Finding
        One for each such obstacle.
    """
    return tuple(finding for each in model.contact.obstacles if (finding := _overlap(model.mesh, each)) is not None)


def enclosed_obstacles(model: Model) -> tuple[Finding, ...]:
    """Say which obstacles lie in a cavity, whose walls may not touch them (B29).

    Parameters
    ----------
    model : Model

    Returns
    -------
    tuple of Finding
        One for each such obstacle.
    """
    if not len(model.mesh.cells):  # films meet obstacles with their outer side
        return ()
    around = ((each, _cavity_around(model.mesh, each)) for each in model.contact.obstacles)
    return tuple(
        Finding(
            code="B29",
            severity=Severity.WARNING,
            message=f"The obstacle '{each.name}' lies in '{cavity}', and {_allowed(each)} may touch it: it never acts.",
            advice=f"Name the face that it touches: face = {cavity}.",
        )
        for each, cavity in around
        if cavity is not None
    )


def _allowed(obstacle: Obstacle) -> str:
    return "no wall of a cavity" if obstacle.face is None else f"only '{obstacle.face}'"


def _cavity_around(mesh: Mesh, obstacle: Obstacle) -> str | None:
    """The cavity whose wall is nearest to an obstacle all along its path, if that may not touch it."""
    may = _outside(mesh) if obstacle.face is None else mesh.face_nodes(obstacle.face)
    nodes = np.unique(outer_triangles(mesh))
    nearest = {int(nodes[_nearest(obstacle, mesh.points[nodes], factor)]) for factor in obstacle.stops or (0.0,)}
    for name in mesh.cavities:
        if nearest <= set(np.setdiff1d(mesh.face_nodes(name), may).tolist()):
            return name
    return None


def _nearest(obstacle: Obstacle, points: Array, load_factor: float) -> int:
    """Which of some points is nearest to an obstacle at a load factor."""
    return obstacle.shape.nearest(obstacle.pose(load_factor).at_first(points))


def _overlap(mesh: Mesh, obstacle: Obstacle) -> Finding | None:
    nodes = mesh.face_nodes(obstacle.face) if obstacle.face is not None else _outside(mesh)
    allowed = OBSTACLES.touching * float(np.ptp(mesh.points, axis=0).max())
    places = mesh.points[nodes]
    depth = obstacle.shape.depths(obstacle.pose(0.0).at_first(places), allowed)
    inside = depth > allowed
    if not inside.any():
        return None
    deepest = int(depth.argmax())
    x, y, z = places[deepest] / mm
    deep = f", up to {depth[deepest] / mm:.3g} mm deep," if np.isfinite(depth[deepest]) else ","
    return Finding(
        code="B08",
        severity=Severity.WARNING,
        message=f"The obstacle '{obstacle.name}' reaches into the actuator at rest: {int(inside.sum())} nodes lie in "
        f"it{deep} at ({x:.3g}, {y:.3g}, {z:.3g}) mm; the first step pushes them out.",
        advice="Let it begin clear of the actuator and move it in along a path, or name the face that may touch it.",
    )


def _outside(mesh: Mesh) -> Ints:
    """Nodes of the surface without cavities and mirror planes."""
    count, outer = len(mesh.points), outer_triangles(mesh)
    hidden = [corner_keys(mesh.faces[name], count) for name in (*mesh.cavities, *mesh.cut_faces)]
    keys = np.concatenate([np.zeros(0, dtype=np.int64), *hidden])
    return np.unique(outer[~np.isin(corner_keys(outer, count), keys)])
