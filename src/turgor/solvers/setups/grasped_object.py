"""What the procedure Grasp adds to a model: held pressures, the pull of the object, planes between the fingers."""

from dataclasses import dataclass, replace
from math import cos, pi, sin

import numpy as np

from turgor.errors import TurgorError, unknown
from turgor.model.loads import RAMP, Pressure
from turgor.model.model import Model
from turgor.model.obstacles import Cylinder, Obstacle, Plane, RigidSurface, Vector
from turgor.solvers.procedures.directions import DIRECTIONS, check_unmirrored, with_contact
from turgor.solvers.procedures.grasp import Grasp
from turgor.units import mm

#: Begin of the names of the mirror planes between the fingers.
BETWEEN = "between_fingers"

#: Share of the finger's length by which it may reach across a mirror plane at rest: round-off.
TOUCHING = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class Grasped(Obstacle):
    """The object of a grasp: an obstacle that knows who holds it and where it is pulled.

    Parameters
    ----------
    fingers : int
        How many equal fingers hold it.
    pull : (3,) floats
        Unit vector of the pull.
    """

    fingers: int = 2
    pull: Vector = (1.0, 0.0, 0.0)


def grasped(model: Model, procedure: Grasp) -> Model:
    """Return the model with its pressures held after closing, the pull of the object and the planes between.

    Parameters
    ----------
    model : Model
        One finger, or the half of one, with the object among the obstacles of its contact.
    procedure : Grasp

    Returns
    -------
    Model
        Its object is a `Grasped`.

    Raises
    ------
    TurgorError
        If the model and the grasp do not fit together.
    """
    check_unmirrored(model.mesh, "procedure.pull", procedure.pull)
    obstacle = _object_of(model, procedure)
    x, y, z = DIRECTIONS[procedure.pull]
    rest, end = (0.0, 0.0, 0.0), (procedure.pull_distance * x, procedure.pull_distance * y, procedure.pull_distance * z)
    grasped = Grasped(
        name=obstacle.name, shape=obstacle.shape, friction=obstacle.friction, face=obstacle.face,
        stiffness=obstacle.stiffness, path=((0.0, rest), (procedure.closing, rest), (1.0, end)),
        fingers=procedure.fingers, pull=(x, y, z),
    )  # fmt: skip
    others = tuple(each for each in model.contact.obstacles if each is not obstacle)
    planes = _planes(model, procedure, _middle(obstacle))
    return Model(
        model.mesh,
        materials=model.materials,
        supports=model.supports,
        loads=_loads(model, procedure),
        formulation=model.formulation,
        reinforcements=model.reinforcements,
        contact=with_contact(model.contact, (grasped, *others, *planes)),
    )


def _object_of(model: Model, procedure: Grasp) -> Obstacle:
    """The obstacle that is grasped, if it can be."""
    obstacles = {obstacle.name: obstacle for obstacle in model.contact.obstacles}
    if procedure.object not in obstacles:
        if not obstacles:
            raise TurgorError(f"a grasp needs an obstacle '{procedure.object}' to grasp; the model has no obstacles.")
        raise unknown("obstacle", procedure.object, obstacles)
    found = obstacles[procedure.object]
    said = f"a grasp of the obstacle '{procedure.object}'"
    for key in ("path", "spring"):
        if getattr(found, key):
            raise TurgorError(f"{said}: it is held rigidly and pulled by the grasp; leave its {key} out.")
    if isinstance(found.shape, Plane):
        raise TurgorError(f"{said}: it is a plane, which has no far side; take a cylinder, sphere, box or STL file.")
    if isinstance(found.shape, Cylinder):
        _check_axis(said, found.shape, procedure.fingers)
    return found


def _loads(model: Model, procedure: Grasp) -> tuple[Pressure, ...]:
    """The pressures, full from closing on."""
    if not model.pressures:
        raise TurgorError("a grasp needs a pressure that closes the finger; the model has none.")
    held = []
    for load in model.loads:
        if not isinstance(load, Pressure):
            raise TurgorError(
                f"a grasp cannot hold {type(load).__name__}, which grows with the load factor to the end of the "
                "pull; only pressures can act."
            )
        if load.history != RAMP:
            raise TurgorError(
                f"pressure on '{load.face}' has a history of its own, but a grasp says when it acts: it is full at "
                f"the load factor {procedure.closing:g} and held; leave the history out."
            )
        held.append(replace(load, history=((0.0, 0.0), (procedure.closing, 1.0), (1.0, 1.0))))
    return tuple(held)


def _planes(model: Model, procedure: Grasp, middle: Vector) -> tuple[Obstacle, ...]:
    """Mirror planes between the finger and its neighbors, as obstacles."""
    half = pi / procedure.fingers  # from the middle of the finger to the plane, about the line along x
    sides = (1,) if procedure.fingers == 2 or model.mesh.symmetry_faces else (1, -1)
    planes = []
    for number, side in enumerate(sides, start=1):
        across = 0.0 if procedure.fingers == 2 else -side * cos(half)
        plane = Plane(point=middle, normal=(0.0, across, sin(half)))
        below = float(((np.array(middle) - model.mesh.points) @ np.array(plane.normal)).max())
        if below > TOUCHING * float(np.ptp(model.mesh.points)):
            place = ", ".join(f"{part / mm:g}" for part in middle)
            raise TurgorError(
                f"the finger reaches {below / mm:.3g} mm across the mirror plane to the next of {procedure.fingers} "
                f"fingers around ({place}) mm; move the object '{procedure.object}' further down."
            )
        name = BETWEEN if len(sides) == 1 else f"{BETWEEN}_{number}"
        planes.append(Obstacle(name=name, shape=plane))
    return tuple(planes)


def _check_axis(said: str, bar: Cylinder, fingers: int) -> None:
    along = np.abs(bar.axis)
    if fingers > 2 and along[0] < 1 - 1e-9:
        raise TurgorError(f"{said}: {fingers} fingers stand around the line along x, and so must the cylinder's axis.")
    if 1e-9 < along[2] < 1 - 1e-9:
        raise TurgorError(f"{said}: the cylinder is inclined to the mid-plane, so that two fingers would differ.")


def _middle(obstacle: Obstacle) -> Vector:
    """Middle of an object, through which the line along x goes that fingers stand around."""
    shape = obstacle.shape
    if isinstance(shape, RigidSurface):
        low, high = shape.points.min(axis=0), shape.points.max(axis=0)
        x, y, z = (float(value) for value in (low + high) / 2)
        return x, y, z
    assert not isinstance(shape, Plane)
    return shape.center
