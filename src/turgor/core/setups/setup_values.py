"""Values of setups: they are checked as soon as they are stated, without a mesh."""

from dataclasses import dataclass, field
from itertools import combinations
from math import inf
from typing import ClassVar

from turgor.core.geometry.directions import DIRECTIONS
from turgor.core.model.obstacles import check_friction
from turgor.foundation.errors import TurgorError, unknown
from turgor.units import deg, mm

#: The tip is stopped by a plate, not fixed.
PLATE = "plate"

#: The direction is the one in which the free tip would set out.
FREE = "free"

#: Largest angle of a plate [rad]: beyond it stands along the actuator.
MOST_TILT = 60 * deg

#: What may stop the tip: the plate, or a gauge that holds it in some directions.
HOLDS = (PLATE, *("".join(some) for count in (1, 2, 3) for some in combinations("xyz", count)))

#: Directions in which an object can be pulled: not the one in which fingers close.
PULLS = ("+x", "-x", "+y", "-y")


@dataclass(frozen=True, slots=True, kw_only=True)
class BlockedForce:
    """The plate that blocks the tip; the fields are the arguments of `turgor.core.setups.blocked_tip.blocked_force`.

    Raises
    ------
    TurgorError
        If a value is out of its range, or the values do not go together.

    Examples
    --------
    >>> BlockedForce(hold="plate", distance=2e-3, direction="-z").distance
    0.002
    >>> BlockedForce(hold="plates")
    Traceback (most recent call last):
    turgor.TurgorError: unknown hold 'plates'; did you mean 'plate'? Known: plate, x, xy, xyz, xz, y, yz, z.
    """

    hold: str = PLATE
    distance: float | None = field(default=None, metadata={"dimension": "length"})
    position: float | None = field(default=None, metadata={"dimension": "length"})
    direction: str = FREE
    face: str = "tip"
    friction: float = 0.0
    rotational_spring: float | None = field(default=None, metadata={"dimension": "rotational stiffness"})
    tilt: float = field(default=0.0, metadata={"dimension": "angle"})
    spring: float | None = field(default=None, metadata={"dimension": "spring stiffness"})
    sensor_radius: float | None = field(default=None, metadata={"dimension": "length"})
    behind_tip: float | None = field(default=None, metadata={"dimension": "length"})
    #: What it is for; a run writes it whatever else is measured.
    measures: ClassVar[tuple[str, ...]] = ("blocked_force",)

    def __post_init__(self) -> None:
        object.__setattr__(self, "hold", _in_order(self.hold))
        if self.hold not in HOLDS:
            raise unknown("hold", self.hold, HOLDS)
        if self.direction not in (FREE, *DIRECTIONS):
            raise unknown("direction", self.direction, (FREE, *DIRECTIONS))
        if self.distance is not None and not abs(self.distance) < inf:
            raise TurgorError(f"blocked_force: distance is {self.distance / mm:g} mm; a finite number is needed.")
        check_friction("blocked_force", self.friction)
        if self.hold == PLATE:
            if self.distance is None and self.position is None:
                object.__setattr__(self, "distance", 0.0)
            self._check_plate()
        else:
            self._check_fixed()

    def _check_plate(self) -> None:
        if self.rotational_spring is not None:
            raise TurgorError(
                "blocked_force: rotational_spring belongs to a tip that is fixed, such as hold = 'yz'; hold is 'plate'."
            )
        self._check_rig()
        if self.position is None:
            return
        place = f"blocked_force: position is {self.position / mm:g} mm"
        if not abs(self.position) < inf:
            raise TurgorError(f"{place}; the plate stands at a finite place.")
        if self.distance is not None:
            raise TurgorError(f"{place}, and distance is {self.distance / mm:g} mm; one of them says where it stands.")
        if self.direction == FREE:
            raise TurgorError(f"{place}, but direction is 'free'; a position needs a stated one, such as '-z'.")

    def _check_rig(self) -> None:
        if not abs(self.tilt) <= MOST_TILT:
            raise TurgorError(
                f"blocked_force: tilt is {self.tilt / deg:g} deg; allowed is {-MOST_TILT / deg:g} to "
                f"{MOST_TILT / deg:g} deg."
            )
        for name, unit in (("spring", "N/m"), ("sensor_radius", "m")):
            value = getattr(self, name)
            if value is not None and not 0 < value < inf:
                raise TurgorError(f"blocked_force: {name} is {value:g} {unit}; allowed is more than 0.")
        if self.sensor_radius is not None and self.tilt:
            raise TurgorError("blocked_force: a round sensor has no angle; leave tilt or sensor_radius out.")
        if self.behind_tip is not None and self.sensor_radius is None:
            raise TurgorError("blocked_force: behind_tip is the place of a round sensor; state its sensor_radius too.")

    def _check_fixed(self) -> None:
        if self.rotational_spring is not None and not 0 <= self.rotational_spring < inf:
            raise TurgorError(
                f"blocked_force: rotational_spring is {self.rotational_spring:g} N m/rad; allowed is 0 or more."
            )
        for name in ("distance", "position", "friction", "tilt", "spring", "sensor_radius", "behind_tip"):
            if getattr(self, name):
                raise TurgorError(
                    f"blocked_force: {name} belongs to the plate; hold is '{self.hold}', leave {name} out."
                )
        if self.direction != FREE and self.direction[1] not in self.hold:
            raise TurgorError(
                f"blocked_force: direction is '{self.direction}', but the tip is fixed along "
                f"{', '.join(self.hold)} only; "
                "it does not push in a direction in which it is free."
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class Grasp:
    """The object of a grasp and its pull; the fields are the arguments of `turgor.core.setups.grasped_object.grasp`.

    Raises
    ------
    TurgorError
        If a value is out of its range.

    Examples
    --------
    >>> Grasp(pull_distance=8e-3).fingers
    2
    >>> Grasp(pull_distance=8e-3, fingers=1)
    Traceback (most recent call last):
    turgor.TurgorError: grasp: fingers is 1; allowed is 2 to 12.
    """

    object: str = "object"
    pull_distance: float = field(metadata={"dimension": "length"})
    pull: str = "+x"
    fingers: int = 2
    closing: float = 0.5
    #: What it is for; a run writes them whatever else is measured.
    measures: ClassVar[tuple[str, ...]] = ("pull_distance", "grip_force", "holding_force")

    def __post_init__(self) -> None:
        if not 0 < self.pull_distance < float("inf"):
            raise TurgorError(f"grasp: pull_distance is {self.pull_distance / mm:g} mm; allowed is more than 0.")
        if self.pull in DIRECTIONS and self.pull not in PULLS:
            raise TurgorError(
                f"grasp: pull is '{self.pull}', towards a finger; an object is pulled along {', '.join(PULLS)}."
            )
        if self.pull not in PULLS:
            raise unknown("pull", self.pull, PULLS)
        if not 2 <= self.fingers <= 12:
            raise TurgorError(f"grasp: fingers is {self.fingers}; allowed is 2 to 12.")
        if self.fingers > 2 and self.pull[1] != "x":
            raise TurgorError(
                f"grasp: pull is '{self.pull}', but {self.fingers} fingers stand around the line along x and would not "
                "be pulled alike; pull along '+x' or '-x'."
            )
        if not 0 < self.closing < 1:
            raise TurgorError(f"grasp: closing is {self.closing:g}; it lies between 0 and 1, without these.")


Setup = BlockedForce | Grasp


def _in_order(hold: str) -> str:
    """The directions in which a tip is fixed in the order of the axes."""
    return "".join(sorted(hold)) if set(hold) <= set("xyz") else hold
