"""Blocked forces of the bending actuators: on a plate below the tip, and on the rig of the authors' sketch.

There a tab at the tip is fastened to the load cell, and the root stands on a slider with rollers. So the tip cannot
move across the actuator, is free along it, as good as a root that slides, and turns as far as tab and cell give way.
"""

from typing import Any

import numpy as np
from bender import READ, SOURCE, STATED, model_of, solved
from bender_data import measured_blocked
from turgor.measures import Measure

import turgor as tg
from turgor.foundation.response import Column
from turgor.studies.runs.run import Computed
from turgor.units import N, kPa, mm

#: Spring that keeps the tip from turning, in effect [N m/rad].
STIFF = 100.0
#: Pressure at which a spring is fitted [kPa].
FITTED_AT = 30.0
#: Springs to begin with [N m/rad], and how near the force has to come [-].
TRIED, NEAR = (0.3, 0.7), 2e-3


def rests(chambers: int, top_kPa: float, how: dict[str, Any]) -> Computed:
    """The tip before a plate level with the film or below it: force, where it is touched, how far the tip is away."""
    given = {**STATED, "clamp_mm": 5.0, **how}
    blocked = tg.setups.blocked_force(model_of(chambers, given), direction="-z", distance=given["plate_mm"] * mm)
    return _computed(blocked, top_kPa, ("bearing_distance", tip_gap))


def holds(chambers: int, top_kPa: float, spring: float, how: dict[str, Any]) -> Computed:
    """The tip on a tab that turns against a spring [N m/rad] and slides along x: its force, and how far it turns."""
    given = {**STATED, "clamp_mm": 5.0, **how}
    held = {"hold": "yz", "direction": "-z", "rotational_spring": spring}
    blocked = tg.setups.blocked_force(model_of(chambers, given), **held)
    return _computed(blocked, top_kPa, ("tab_rotation_y",))


def fitted_spring(chambers: int, wall_mm: float, how: dict[str, Any]) -> Computed:
    """The spring [N m/rad] with which an actuator makes the measured force at `FITTED_AT`.

    Secant method in the inverse of the force, which is linear in the spring for a beam.
    """
    aim = blocked_at(chambers, wall_mm, FITTED_AT)

    def found(spring: float) -> float:
        response = holds(chambers, FITTED_AT, spring, {"wall_mm": wall_mm, **how}).response
        return float(response.column("blocked_force")[-1] / N)

    springs, forces = list(TRIED), [found(each) for each in TRIED]
    while abs(forces[-1] / aim - 1) > NEAR:
        a, b = (1 / each for each in forces[-2:])
        springs.append(springs[-1] + (1 / aim - b) * (springs[-1] - springs[-2]) / (b - a))
        forces.append(found(springs[-1]))
    return Computed(response=tg.Response(columns=(Column("spring", "", np.array([springs[-1]])),), source=SOURCE))


def blocked_at(chambers: int, wall_mm: float, pressure: float) -> float:
    """Measured force less that of the rest before it [N] at a pressure [kPa]."""
    data = measured_blocked(chambers, wall_mm)
    return float(np.interp(pressure, data["pressure"], data["force"]))


def _computed(model: tg.Model, top_kPa: float, others: tuple[str | Measure, ...]) -> Computed:
    at = tuple(each / top_kPa for each in READ if each < top_kPa)
    solution = solved(model, tg.Pressure("cavity", top_kPa * kPa), tg.Static(at=at), "none")
    result = tg.measure(solution, "blocked_force", *others, mesh_error=False)
    names = ("pressure", "blocked_force", *(each if isinstance(each, str) else each.name for each in others))
    columns = tuple(map(result.find, names))
    return Computed(response=tg.Response(columns=columns, source=SOURCE, message=solution.message))


def _tip_gap(at: Any) -> float:
    """How far the lowest point of the tip is above the plate."""
    (plate,) = at.model.contact.obstacles
    tip = at.mesh.face_nodes("tip")
    return float((at.mesh.points[tip] + at.displacement[tip])[:, 2].min() - plate.shape.point[2])


tip_gap = Measure(name="tip_gap", unit="mm", function=_tip_gap, definition="distance of the tip from the plate")
