"""Grasp: fingers close around an object, which is then pulled out of them."""

from dataclasses import dataclass, field

from turgor.errors import TurgorError, unknown
from turgor.solvers.procedures.directions import DIRECTIONS
from turgor.solvers.procedures.static import Static
from turgor.units import mm

#: Directions in which an object can be pulled: not the one in which fingers close.
PULLS = ("+x", "-x", "+y", "-y")


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
        If a value is out of its range. `solve` refuses a model without the obstacle, loads that do not fit, a finger
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
