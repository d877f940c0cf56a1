"""What the procedure BlockedForce adds to a model: the plate before the tip, or the gauge that holds it."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.engine.algebra.tangent import Tangent
from turgor.engine.faces import surfaces
from turgor.engine.runtime import EngineOptions
from turgor.engine.system import System
from turgor.errors import TurgorError
from turgor.meshing.mesh import Mesh
from turgor.meshing.surface import outer_triangles
from turgor.model.model import Model
from turgor.model.obstacles import Obstacle, Plane, Vector
from turgor.model.supports import Fixed
from turgor.solvers.checks.supports import check_supports
from turgor.solvers.procedures.blocked_force import FREE, PLATE, BlockedForce
from turgor.solvers.procedures.directions import DIRECTIONS, check_unmirrored, unmirrored, with_obstacles

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


def blocked(model: Model, procedure: BlockedForce) -> Model:
    """Return a model whose tip is stopped as a procedure says.

    Parameters
    ----------
    model : Model
        The actuator, free at its tip.
    procedure : BlockedForce

    Returns
    -------
    Model
        With an obstacle ``plate`` and a face ``near_tip`` that may touch it, or with a `HeldTip` among its supports.

    Raises
    ------
    TurgorError
        If the mesh lacks the face, the direction cannot be, or a name is taken.
    """
    mesh = model.mesh
    outward = _outward(mesh, procedure.face)
    direction = procedure.direction
    if direction == FREE:
        direction = first_direction(model, procedure.face, "xyz" if procedure.hold == PLATE else procedure.hold)
    check_unmirrored(mesh, "procedure.direction", direction)
    if procedure.hold != PLATE:
        held = HeldTip(procedure.face, procedure.hold, DIRECTIONS[direction])
        return _with(model, mesh, supports=(*model.supports, held))
    push = np.array(DIRECTIONS[direction])
    if outward @ push < -0.5:
        raise TurgorError(
            f"procedure.direction is '{direction}', so the plate would stand behind the tip, in the actuator; hold the "
            f"tip instead (hold = '{direction[1]}'), or choose a direction away from it."
        )
    sides = _near(mesh, procedure.face, outward)
    reached = float((mesh.points[np.unique(sides)] @ push).max()) + procedure.distance
    plane = Plane(point=_vector(reached * push), normal=_vector(-push))
    plate = Obstacle(name=PLATE, shape=plane, friction=procedure.friction, face=NEAR_TIP)
    return _with(model, replace(mesh, faces={**mesh.faces, NEAR_TIP: sides}), plate=plate)


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
            f"procedure.direction is 'free', but the face '{face}' does not set out along "
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
    inner = [name for name in mesh.faces if name in (*mesh.cavities, *mesh.symmetry_faces)]
    corners = mesh.cell_type.side.corners
    taken = {tuple(sorted(side)) for name in inner for side in mesh.faces[name][:, :corners].tolist()}
    sides = outer_triangles(mesh)
    outside = np.array([tuple(sorted(side)) not in taken for side in sides[:, :corners].tolist()])
    along = mesh.points @ outward
    tip = float(along[mesh.face_nodes(face)].mean())
    near = along[sides[:, :corners]].mean(axis=1) >= tip - REACH * float(np.ptp(along))
    return sides[outside & near]


def _with(model: Model, mesh: Mesh, supports: tuple = (), plate: Obstacle | None = None) -> Model:
    added = () if plate is None else (plate,)
    return Model(
        mesh,
        materials=model.materials,
        supports=supports or model.supports,
        loads=model.loads,
        formulation=model.formulation,
        reinforcements=model.reinforcements,
        contact=with_obstacles(model.contact, "procedure 'blocked_force'", added),
    )


def _vector(values: Array) -> Vector:
    x, y, z = (float(value) + 0.0 for value in values)
    return x, y, z
