"""blocked_force: a model whose tip is stopped, by a plate before it or a gauge that holds it."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.engine.algebra.tangent import Tangent
from turgor.engine.faces import surfaces
from turgor.engine.runtime import EngineOptions
from turgor.engine.system import System
from turgor.errors import TurgorError
from turgor.geometry.directions import DIRECTIONS
from turgor.given import one
from turgor.meshing.mesh import Mesh
from turgor.meshing.surface import outer_triangles
from turgor.model.model import Model
from turgor.model.obstacles import Obstacle, Plane, Vector
from turgor.model.supports import Fixed
from turgor.setups.directions import check_unmirrored, unmirrored
from turgor.setups.values import FREE, PLATE, BlockedForce
from turgor.solvers.checks.supports import check_supports

#: Face of the amended mesh that may touch the plate.
NEAR_TIP = "near_tip"

#: It reaches back from the tip over this share of the actuator's length.
REACH = 0.25

#: Load factor of the linear response that tells where the tip sets out; any small one does.
FIRST_LOAD = 1e-3

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class HeldTip(Fixed):
    """The tip held by a gauge that measures its force.

    Parameters
    ----------
    push : (3,) floats
        Unit vector along which the tip pushes.
    """

    push: Vector = (0.0, 0.0, -1.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Plate(Obstacle):
    """The plate that stops a tip, and by which measures know that its force is the blocked force."""


def blocked_force(
    model: Model,
    *,
    hold: str = PLATE,
    distance: float = 0.0,
    direction: str = FREE,
    face: str = "tip",
    friction: float = 0.0,
) -> Model:
    """Return a model whose tip is stopped: by a rigid plate, as on a load cell, or held by a gauge.

    The plate is plane and rigid, and square to the direction. It is endless, but only the quarter of the actuator
    nearest the tip can touch it, as where a load cell stands under the tip: an actuator that lies flat on a table
    would push on it all along. Its force is the measure ``blocked_force``, of the whole actuator where a half is
    modeled. A tip that is held pushes and pulls; the force is that of the held face, sideways forces included in
    ``blocked_force_x``, ``_y`` and ``_z``.

    Parameters
    ----------
    model : Model
        The actuator, free at its tip.
    hold : str
        What stops the tip: ``"plate"``, or the directions in which its face is held, ``"x"``, ``"z"``, ``"xz"`` …
        ``"xyz"``.
    distance : float [m]
        How far the tip can move before it meets the plate, 0 or more.
    direction : str
        Where the tip pushes, and on which side of it the plate stands: ``"-z"``, ``"+x"`` and the like. ``"free"`` is
        the direction along an axis in which the free tip would set out: -z of benders, +x of what extends.
    face : str
        The face that is the tip.
    friction : float [-]
        Coulomb's coefficient on the plate, 0 to 2.

    Returns
    -------
    Model
        With an obstacle ``plate`` and a face ``near_tip`` that may touch it, or with a `HeldTip` among its supports.
        Any procedure solves it, `Static` as a rule.

    Raises
    ------
    TurgorError
        If a value is out of its range, the values do not go together, the mesh lacks the face, the direction points
        back into the actuator or across a mirror plane, or the model has a ``plate`` already.
    """
    one(model, Model, "model", "a Model is needed")
    return blocked(model, BlockedForce(hold=hold, distance=distance, direction=direction, face=face, friction=friction))


def blocked(model: Model, setup: BlockedForce) -> Model:
    """Return a model whose tip is stopped as a setup says; see `blocked_force`.

    Parameters
    ----------
    model : Model
    setup : BlockedForce

    Returns
    -------
    Model
    """
    mesh = model.mesh
    outward = _outward(mesh, setup.face)
    direction = setup.direction
    if direction == FREE:
        direction = first_direction(model, setup.face, "xyz" if setup.hold == PLATE else setup.hold)
    check_unmirrored(mesh, "blocked_force: direction", direction)
    if setup.hold != PLATE:
        held = HeldTip(setup.face, setup.hold, DIRECTIONS[direction])
        return replace(model, supports=(*model.supports, held))
    push = np.array(DIRECTIONS[direction])
    if outward @ push < -0.5:
        raise TurgorError(
            f"blocked_force: direction is '{direction}', so the plate would stand behind the tip, in the actuator; "
            f"hold the tip instead (hold = '{direction[1]}'), or choose a direction away from it."
        )
    if any(obstacle.name == PLATE for obstacle in model.contact.obstacles):
        raise TurgorError(f"blocked_force adds an obstacle '{PLATE}', but the model has one; rename that one.")
    sides = _near(mesh, setup.face, outward)
    reached = float((mesh.points[np.unique(sides)] @ push).max()) + setup.distance
    plane = Plane(point=_vector(reached * push), normal=_vector(-push))
    plate = Plate(name=PLATE, shape=plane, friction=setup.friction, face=NEAR_TIP)
    contact = model.contact.with_obstacles((*model.contact.obstacles, plate))
    return replace(model, mesh=replace(mesh, faces={**mesh.faces, NEAR_TIP: sides}), contact=contact)


def first_direction(model: Model, face: str, axes: str) -> str:
    """Find the direction along one of some axes in which a face sets out under a small load.

    Parameters
    ----------
    model : Model
        The free actuator.
    face : str
        The face that moves.
    axes : str
        Axes that count, any of x, y, z.

    Returns
    -------
    str
        Such as ``"-z"``.

    Raises
    ------
    TurgorError
        If the face does not move, or the supports leave a rigid motion free.
    """
    check_supports(model)
    system = System(model)
    rest = system.evaluate(np.zeros(system.size), FIRST_LOAD)
    assert rest is not None  # the undeformed actuator
    tangent = Tangent(system, EngineOptions().linear_solver, 1)
    tangent.factor(rest)
    right = np.where(system.held, 0.0, -rest.residual)
    displacement, _ = system.physical(tangent.solve(right))
    weights = surfaces.nodal_weights(model.mesh.points, model.mesh.face(face))
    moved = unmirrored(model.mesh, weights @ displacement / weights.sum())
    moved[["xyz".index(axis) for axis in "xyz" if axis not in axes]] = 0.0
    axis = int(np.abs(moved).argmax())
    if not abs(moved[axis]) > 1e-9 * FIRST_LOAD * np.ptp(model.mesh.points):
        raise TurgorError(
            f"blocked_force: direction is 'free', but the face '{face}' does not set out along "
            f"{' or '.join(axes)} under the first of the load; state the direction, such as '-z'."
        )
    return f"{'+' if moved[axis] > 0 else '-'}{'xyz'[axis]}"


def _outward(mesh: Mesh, face: str) -> Array:
    """Unit vector out of the tip of the whole actuator, (3,)."""
    area = unmirrored(mesh, surfaces.vector_area(mesh.points, mesh.face(face)))
    size = float(np.linalg.norm(area))
    if not size > 1e-6 * surfaces.area(mesh.points, mesh.face(face)):
        raise TurgorError(f"the face '{face}' looks nowhere, for its normals cancel; a tip needs an end face.")
    return area / size


def _near(mesh: Mesh, face: str, outward: Array) -> NDArray[np.int64]:
    """Sides of the surface outside cavities and mirror planes that lie near the tip, (f, k)."""
    inner = [name for name in mesh.faces if name in (*mesh.cavities, *mesh.cut_faces)]
    corners = mesh.cell_type.side.corners
    taken = {tuple(sorted(side)) for name in inner for side in mesh.faces[name][:, :corners].tolist()}
    sides = outer_triangles(mesh)
    outside = np.array([tuple(sorted(side)) not in taken for side in sides[:, :corners].tolist()])
    along = mesh.points @ outward
    tip = float(along[mesh.face_nodes(face)].mean())
    near = along[sides[:, :corners]].mean(axis=1) >= tip - REACH * float(np.ptp(along))
    return sides[outside & near]


def _vector(values: Array) -> Vector:
    x, y, z = (float(value) + 0.0 for value in values)
    return x, y, z
