"""grasp: a model of fingers that close around an object, which is then pulled out of them."""

from dataclasses import dataclass, replace
from math import cos, pi, sin

import numpy as np

from turgor.core.geometry.directions import DIRECTIONS
from turgor.core.model.history import RAMP
from turgor.core.model.loads import Pressure
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Obstacle, Plane, Vector
from turgor.core.setups.directions import check_unmirrored
from turgor.core.setups.setup_values import Grasp
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.given import one
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm

#: Begin of the names of the planes between the fingers.
BETWEEN = "between_fingers"


@dataclass(frozen=True, slots=True, kw_only=True)
class Grasped(Obstacle):
    """The object of a grasp: an obstacle with the finger that grasps it and the direction of the pull.

    Parameters
    ----------
    fingers : int
        How many equal fingers hold it.
    pull : (3,) floats
        Unit vector of the pull.
    """

    fingers: int = 2
    pull: Vector = (1.0, 0.0, 0.0)

    measures = ("pull_distance", "grip_force", "holding_force")


@dataclass(frozen=True, slots=True, kw_only=True)
class BetweenFingers(Obstacle):
    """The mirror plane between two fingers, which stands for a neighbor and is no body."""

    drawn = False
    measures = ()


def grasp(
    model: Model,
    *,
    pull_distance: float,
    object: str = "object",
    pull: str = "+x",
    fingers: int = 2,
    closing: float = 0.5,
) -> Model:
    """Return a model of fingers that close around a rigid object, which is pulled out under constant pressure.

    One finger is modeled, as it is: along x from the palm to the tip, its base below. The object is an obstacle of
    the model and lies below the finger. The other fingers are images of the first one, turned about the line along x
    through the middle of the object. Rigid planes without friction stand where neighboring fingers meet: for two
    fingers the mid-plane, which keeps a finger from passing its mirror image.

    Up to the load factor ``closing`` the pressures rise to their full value, then the object moves. Measures:
    ``grip_force`` with which one finger presses the object towards the middle, ``holding_force`` with which all of them
    resist the pull, and ``pull_distance``. Friction is that of the obstacle, which is frictionless unless it says
    otherwise; 0.5 suits silicone on many dry things. Solve it in small steps, such as ``Static(max_step=0.1)``: where
    things slide with friction the result depends on the path.

    Parameters
    ----------
    model : Model
        One finger, or the half of one, with the object among the obstacles of its contact.
    pull_distance : float [m]
        How far it is pulled, more than 0.
    object : str
        Name of the obstacle that is grasped. For two fingers it looks the same in the mid-plane's mirror, for three or
        more it looks the same from each of them: a sphere, or a cylinder along x.
    pull : str
        Where it is pulled: ``"+x"``, out of the palm; ``"-x"``, ``"+y"`` or ``"-y"``.
    fingers : int
        How many equal fingers hold it, 2 to 12.
    closing : float [-]
        Load factor at which the pressure is full and the pull begins, within (0, 1).

    Returns
    -------
    Model
        With histories of its pressures, the object as a `Grasped`, and planes between the fingers.

    Raises
    ------
    TurgorError
        If a value is out of its range, the model lacks the obstacle, its loads do not fit, a finger reaches across a
        mirror plane, or the object breaks the symmetry.
    """
    one(model, Model, "model", "a Model is needed")
    return grasped(
        model, Grasp(pull_distance=pull_distance, object=object, pull=pull, fingers=fingers, closing=closing)
    )


def grasped(model: Model, setup: Grasp) -> Model:
    """Return a model in which an object is grasped and pulled as a setup says; see `grasp`.

    Parameters
    ----------
    model : Model
    setup : Grasp

    Returns
    -------
    Model
    """
    check_unmirrored(model.mesh, "grasp: pull", setup.pull)
    obstacle = _object_of(model, setup)
    x, y, z = DIRECTIONS[setup.pull]
    rest, end = (0.0, 0.0, 0.0), (setup.pull_distance * x, setup.pull_distance * y, setup.pull_distance * z)
    grasped = Grasped(
        name=obstacle.name, shape=obstacle.shape, friction=obstacle.friction, face=obstacle.face,
        stiffness=obstacle.stiffness, elastic_slip=obstacle.elastic_slip,
        path=((0.0, rest), (setup.closing, rest), (1.0, end)), fingers=setup.fingers, pull=(x, y, z),
    )  # fmt: skip
    others = tuple(each for each in model.contact.obstacles if each is not obstacle)
    planes = _planes(model, setup, obstacle.shape.middle)
    contact = model.contact.with_obstacles((grasped, *others, *planes))
    return replace(model, loads=_loads(model, setup), contact=contact)


def _object_of(model: Model, setup: Grasp) -> Obstacle:
    """The obstacle that is grasped, if it can be."""
    obstacles = {obstacle.name: obstacle for obstacle in model.contact.obstacles}
    if setup.object not in obstacles:
        if not obstacles:
            raise TurgorError(f"a grasp needs an obstacle '{setup.object}' to grasp; the model has no obstacles.")
        raise unknown("obstacle", setup.object, obstacles)
    target = obstacles[setup.object]
    subject = f"a grasp of the obstacle '{setup.object}'"
    for key in ("path", "rotation", "spring"):
        if getattr(target, key):
            raise TurgorError(f"{subject}: it is rigid and pulled by the grasp; leave its {key} out.")
    why = target.shape.not_graspable(setup.fingers)
    if why:
        raise TurgorError(f"{subject}: {why}")
    return target


def _loads(model: Model, setup: Grasp) -> tuple[Pressure, ...]:
    """The pressures, full from closing on."""
    if not model.pressures:
        raise TurgorError("a grasp needs a pressure that closes the finger; the model has none.")
    loads = []
    for load in model.loads:
        if load not in model.pressures:
            raise TurgorError(
                f"a grasp cannot hold {type(load).__name__}, which grows with the load factor to the end of the "
                "pull; only pressures can act."
            )
        if load.history != RAMP:
            raise TurgorError(
                f"pressure on '{load.face}' has a history of its own, but a grasp says when it acts: it is full at "
                f"the load factor {setup.closing:g} and constant after it; leave the history out."
            )
        loads.append(replace(load, history=((0.0, 0.0), (setup.closing, 1.0), (1.0, 1.0))))
    return tuple(loads)


def _planes(model: Model, setup: Grasp, middle: Vector) -> tuple[Obstacle, ...]:
    """Mirror planes between the finger and its neighbors, as obstacles."""
    half = pi / setup.fingers  # from the middle of the finger to the plane, about the line along x
    sides = (1,) if setup.fingers == 2 or model.mesh.symmetry_faces else (1, -1)
    planes = []
    for number, side in enumerate(sides, start=1):
        across = 0.0 if setup.fingers == 2 else -side * cos(half)
        plane = Plane(point=middle, normal=(0.0, across, sin(half)))
        below = float(((np.array(middle) - model.mesh.points) @ np.array(plane.normal)).max())
        if below > ROUND_OFF.same * float(np.ptp(model.mesh.points)):
            place = ", ".join(f"{part / mm:g}" for part in middle)
            raise TurgorError(
                f"the finger reaches {below / mm:.3g} mm across the mirror plane to the next of {setup.fingers} "
                f"fingers around ({place}) mm; move the object '{setup.object}' further down."
            )
        name = BETWEEN if len(sides) == 1 else f"{BETWEEN}_{number}"
        planes.append(BetweenFingers(name=name, shape=plane))
    return tuple(planes)
