"""BlockedForce: how hard the tip pushes while something stops it."""

from dataclasses import dataclass, field
from itertools import combinations

from turgor.errors import TurgorError, unknown
from turgor.model.obstacles import check_friction
from turgor.solvers.procedures.directions import DIRECTIONS
from turgor.solvers.procedures.static import Static

#: The tip is stopped by a plate, not held.
PLATE = "plate"

#: The direction is the one in which the free tip would set out.
FREE = "free"

#: What may stop the tip: the plate, or a gauge that holds it in some directions.
HOLDS = (PLATE, *("".join(some) for count in (1, 2, 3) for some in combinations("xyz", count)))


@dataclass(frozen=True, slots=True, kw_only=True)
class BlockedForce(Static):
    """Load control while the tip is stopped: by a rigid plate, as on a load cell, or held by a gauge.

    The plate is plane and rigid, and square to the direction. It is endless, but only the quarter of the actuator
    nearest the tip can touch it, as where a load cell stands under the tip: an actuator that lies flat on a table
    would push on it all along. Its force is the measure ``blocked_force``, of the whole actuator where a half is
    modeled. A tip that is held pushes and pulls; the force is that of the held face, sideways forces included in
    ``blocked_force_x``, ``_y`` and ``_z``.

    Parameters
    ----------
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

    Raises
    ------
    TurgorError
        If a value is out of its range, or the values do not go together. `solve` refuses a model without the face,
        and a direction that points back into the actuator or across a mirror plane.

    Examples
    --------
    >>> BlockedForce(hold="plate", distance=2e-3, direction="-z").distance
    0.002
    >>> BlockedForce(hold="plates")
    Traceback (most recent call last):
    turgor.errors.TurgorError: unknown hold 'plates'; did you mean 'plate'? Known: plate, x, xy, xyz, xz, y, yz, z.
    """

    hold: str = PLATE
    distance: float = field(default=0.0, metadata={"dimension": "length"})
    direction: str = FREE
    face: str = "tip"
    friction: float = 0.0

    def __post_init__(self) -> None:
        Static.__post_init__(self)  # super() does not know a class with slots
        object.__setattr__(self, "hold", _in_order(self.hold))
        if self.hold not in HOLDS:
            raise unknown("hold", self.hold, HOLDS)
        if self.direction not in (FREE, *DIRECTIONS):
            raise unknown("direction", self.direction, (FREE, *DIRECTIONS))
        if not 0 <= self.distance < float("inf"):
            raise TurgorError(
                f"procedure.distance is {self.distance * 1e3:g} mm; the plate stands 0 mm or more before the tip."
            )
        check_friction("procedure", self.friction)
        if self.hold != PLATE:
            self._check_held()

    def _check_held(self) -> None:
        for name in ("distance", "friction"):
            if getattr(self, name):
                raise TurgorError(f"procedure.{name} belongs to the plate; hold is '{self.hold}', leave {name} out.")
        if self.direction != FREE and self.direction[1] not in self.hold:
            raise TurgorError(
                f"procedure.direction is '{self.direction}', but the tip is held along {', '.join(self.hold)} only; "
                "it does not push in a direction in which it is free."
            )


def _in_order(hold: str) -> str:
    """The directions in which a tip is held in the order of the axes."""
    return "".join(sorted(hold)) if set(hold) <= set("xyz") else hold
