"""Grasp: fingers close around an object, which is then pulled out of them."""

from dataclasses import dataclass, field, replace
from math import cos, pi, sin

import numpy as np

from turgor.errors import TurgorError, unknown
from turgor.model.loads import RAMP, Pressure
from turgor.model.model import Model
from turgor.model.obstacles import Cylinder, Obstacle, Plane, RigidSurface, Vector
from turgor.solvers.procedures.static import Static
from turgor.solvers.setups.directions import DIRECTIONS, check_unmirrored, with_contact
from turgor.units import mm

#: Begin of the names of the mirror planes between the fingers.
BETWEEN = "between_fingers"

#: Directions in which an object can be pulled: not the one in which fingers close.
PULLS = ("+x", "-x", "+y", "-y")

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


@dataclass(frozen=True, slots=True, kw_only=True)
class Grasp(Static):
    """Fingers close around a rigid object under pressure; then the object is pulled out while the pressure is held.

    One finger is modeled, as it is: along x from the palm to the tip, its base below. The object is an obstacle of
    the model and lies below the finger. The other fingers are images of the first one, turned about the line along x
    through the middle of the object. Rigid planes without friction stand where neighboring fingers meet: for two
    fingers the mid-plane, which keeps a finger from passing its mirror image.

    Up to the load factor ``closing`` the pressures rise to their full value, then the object moves. Measures:
    ``grip_force`` with which one finger presses the object towards the middle, ``holding_force`` with which all of them
    resist the pull, and ``pull_distance``. Friction is that of the obstacle, which is frictionless unless it says
    otherwise; 0.5 suits silicone on many dry things.

    Parameters
    ----------
    object : str
        Name of the obstacle that is grasped. For two fingers it looks the same in the mid-plane's mirror, for three or
        more it looks the same from each of them: a sphere, or a cylinder along x.
    pull_distance : float [m]
        How far it is pulled, more than 0.
    pull : str
        Where it is pulled: ``"+x"``, out of the palm; ``"-x"``, ``"+y"`` or ``"-y"``.
    fingers : int
        How many equal fingers hold it, 2 to 12.
    closing : float [-]
        Load factor at which the pressure is full and the pull begins, within (0, 1).
    max_step : float [-]
        As of `Static`, but small: where things slide with friction the result depends on the path.

    Raises
    ------
    TurgorError
        If a value is out of its range. `amended` refuses a model without the obstacle, loads that do not fit, a finger
        that reaches across a mirror plane and an object that breaks the symmetry.

    Examples
    --------
    >>> Grasp(pull_distance=8e-3).fingers
    2
    >>> Grasp(pull_distance=8e-3, fingers=1)
    Traceback (most recent call last):
    turgor.errors.TurgorError: procedure.fingers is 1; allowed is 2 to 12.
    """

    object: str = "object"
    pull_distance: float = field(metadata={"dimension": "length"})
    pull: str = "+x"
    fingers: int = 2
    closing: float = 0.5
    max_step: float = 0.1

    def __post_init__(self) -> None:
        Static.__post_init__(self)  # super() does not know a class with slots
        if not 0 < self.pull_distance < float("inf"):
            raise TurgorError(f"procedure.pull_distance is {self.pull_distance / mm:g} mm; allowed is more than 0.")
        if self.pull in DIRECTIONS and self.pull not in PULLS:
            raise TurgorError(
                f"procedure.pull is '{self.pull}', towards a finger; an object is pulled along {', '.join(PULLS)}."
            )
        if self.pull not in PULLS:
            raise unknown("pull", self.pull, PULLS)
        if not 2 <= self.fingers <= 12:
            raise TurgorError(f"procedure.fingers is {self.fingers}; allowed is 2 to 12.")
        if self.fingers > 2 and self.pull[1] != "x":
            raise TurgorError(
                f"procedure.pull is '{self.pull}', but {self.fingers} fingers stand around the line along x and would "
                "not be pulled alike; pull along '+x' or '-x'."
            )
        if not 0 < self.closing < 1:
            raise TurgorError(f"procedure.closing is {self.closing:g}; it lies between 0 and 1, without these.")

    def amended(self, model: Model) -> Model:
        """Return the model with its pressures held after closing, the pull of the object and the planes between.

        Parameters
        ----------
        model : Model
            One finger, or the half of one, with the object among the obstacles of its contact.

        Returns
        -------
        Model
            Its object is a `Grasped`.

        Raises
        ------
        TurgorError
            If the model and the grasp do not fit together.
        """
        check_unmirrored(model.mesh, "procedure.pull", self.pull)
        obstacle = self._object_of(model)
        x, y, z = DIRECTIONS[self.pull]
        rest, end = (0.0, 0.0, 0.0), (self.pull_distance * x, self.pull_distance * y, self.pull_distance * z)
        grasped = Grasped(
            name=obstacle.name, shape=obstacle.shape, friction=obstacle.friction, face=obstacle.face,
            stiffness=obstacle.stiffness, path=((0.0, rest), (self.closing, rest), (1.0, end)),
            fingers=self.fingers, pull=(x, y, z),
        )  # fmt: skip
        others = tuple(each for each in model.contact.obstacles if each is not obstacle)
        planes = self._planes(model, _middle(obstacle))
        return Model(
            model.mesh,
            materials=model.materials,
            supports=model.supports,
            loads=self._loads(model),
            formulation=model.formulation,
            reinforcements=model.reinforcements,
            contact=with_contact(model.contact, (grasped, *others, *planes)),
        )

    def _object_of(self, model: Model) -> Obstacle:
        """The obstacle that is grasped, if it can be."""
        obstacles = {obstacle.name: obstacle for obstacle in model.contact.obstacles}
        if self.object not in obstacles:
            if not obstacles:
                raise TurgorError(f"a grasp needs an obstacle '{self.object}' to grasp; the model has no obstacles.")
            raise unknown("obstacle", self.object, obstacles)
        found = obstacles[self.object]
        said = f"a grasp of the obstacle '{self.object}'"
        for key in ("path", "spring"):
            if getattr(found, key):
                raise TurgorError(f"{said}: it is held rigidly and pulled by the grasp; leave its {key} out.")
        if isinstance(found.shape, Plane):
            raise TurgorError(
                f"{said}: it is a plane, which has no far side; take a cylinder, sphere, box or STL file."
            )
        if isinstance(found.shape, Cylinder):
            _check_axis(said, found.shape, self.fingers)
        return found

    def _loads(self, model: Model) -> tuple[Pressure, ...]:
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
                    f"the load factor {self.closing:g} and held; leave the history out."
                )
            held.append(replace(load, history=((0.0, 0.0), (self.closing, 1.0), (1.0, 1.0))))
        return tuple(held)

    def _planes(self, model: Model, middle: Vector) -> tuple[Obstacle, ...]:
        """Mirror planes between the finger and its neighbors, as obstacles."""
        half = pi / self.fingers  # from the middle of the finger to the plane, about the line along x
        sides = (1,) if self.fingers == 2 or model.mesh.symmetry_faces else (1, -1)
        planes = []
        for number, side in enumerate(sides, start=1):
            across = 0.0 if self.fingers == 2 else -side * cos(half)
            plane = Plane(point=middle, normal=(0.0, across, sin(half)))
            below = float(((np.array(middle) - model.mesh.points) @ np.array(plane.normal)).max())
            if below > TOUCHING * float(np.ptp(model.mesh.points)):
                place = ", ".join(f"{part / mm:g}" for part in middle)
                raise TurgorError(
                    f"the finger reaches {below / mm:.3g} mm across the mirror plane to the next of {self.fingers} "
                    f"fingers around ({place}) mm; move the object '{self.object}' further down."
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
