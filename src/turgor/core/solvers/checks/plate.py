"""Checks of the plate that stops a tip: whether it was touched, and whether it is the tip that bears on it."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.drive import drive_text
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Obstacle
from turgor.core.solvers.checks.settings import PLATE
from turgor.core.solvers.solution import State, Touch
from turgor.foundation.finding import Finding, Severity
from turgor.units import mm

Array = NDArray[np.float64]


def bearing_distance(mesh: Mesh, plate: Obstacle, touch: Touch) -> float:
    """Return how far from the tip a plate is touched: the mean over the force, on the actuator at rest [m].

    Parameters
    ----------
    mesh : Mesh
    plate : Obstacle
    touch : Touch
        Of the plate in one state.

    Returns
    -------
    float
        nan where nothing presses.
    """
    nodes = np.flatnonzero(touch.force.any(axis=1))
    share = touch.force[nodes] @ _push(plate)
    if not len(nodes) or share.sum() == 0:
        return float("nan")
    tip = mesh.points[mesh.face_nodes(plate.tip)]
    away = np.linalg.norm(mesh.points[nodes, None] - tip, axis=2).min(axis=1)
    return float(away @ share / share.sum())


def plate_findings(model: Model, states: Sequence[State]) -> tuple[Finding, ...]:
    """Find a plate that was never touched (B24), or on which the tip does not bear (B25) in the last state.

    Parameters
    ----------
    model : Model
    states : sequence of State
        The whole path, of all stages.

    Returns
    -------
    tuple of Finding
        None where no plate stops a tip.
    """
    plates = [each for each in model.contact.obstacles if each.tip and each.push]
    findings = (
        _never_touched(model, each, states) or _other_than_tip(model, each, states[-1]) for each in plates if states
    )
    return tuple(each for each in findings if each is not None)


def _never_touched(model: Model, plate: Obstacle, states: Sequence[State]) -> Finding | None:
    if any(plate.name in state.touches and state.touches[plate.name].area > 0 for state in states):
        return None
    gaps = [_gap(model, plate, state, plate.face or plate.tip) for state in states]
    last = states[-1].load_factor
    load = drive_text(states[-1].model, last, 3) or f"load factor {last:.3g}"
    return Finding(
        code="B24",
        severity=Severity.WARNING,
        message=f"The actuator never touched the plate, so the blocked force is 0: at {load} it was "
        f"{gaps[-1] / mm:.3g} mm away from the plate, and {max(min(gaps), 0.0) / mm:.3g} mm where it was nearest.",
        advice="State the direction in which the tip moves, a smaller distance, or a higher load.",
    )


def _other_than_tip(model: Model, plate: Obstacle, state: State) -> Finding | None:
    """Compare the place at which a plate is touched with that of the tip, at rest."""
    mesh, touch = model.mesh, state.touches.get(plate.name)
    if plate.shape.facing is None:  # a round sensor bears where it stands
        return None
    away = float("nan") if touch is None else bearing_distance(mesh, plate, touch)
    if touch is None or not away > PLATE.behind_tip * float(np.ptp(mesh.points, axis=0).max()):
        return None
    gap = _gap(model, plate, state, plate.tip)
    share = touch.force @ _push(plate)
    place = share @ mesh.points / share.sum()
    for axis, plane in mesh.mirror_planes:
        place[axis] = plane
    x, y, z = place / mm + 0.0
    what = "What bears on the plate is not the tip" if gap > 0 else "Not the tip alone bears on the plate"
    hovers = f", while the tip is {gap / mm:.3g} mm away from the plate" if gap > 0 else ""
    return Finding(
        code="B25",
        severity=Severity.WARNING,
        message=f"{what}: at the end of the path the force acts {away / mm:.3g} mm "
        f"behind it, around ({x:.3g}, {y:.3g}, {z:.3g}) mm at rest{hovers}.",
        advice="The lever of such a force is shorter than the actuator, and the force larger than that of the tip. "
        f"State a distance at which the tip meets the plate first, or hold the tip: hold = '{_axis(plate)}'.",
    )


def _gap(model: Model, plate: Obstacle, state: State, face: str) -> float:
    """Distance of the plate from the foremost point of a face [m]; negative where it penetrates."""
    nodes, pose = model.mesh.face_nodes(face), plate.pose(state.load_factor)
    return plate.shape.clearance(pose.at_first(model.mesh.points[nodes] + state.displacement[nodes]))


def _push(plate: Obstacle) -> Array:
    """The direction in which the tip pushes, (3,)."""
    return np.array(plate.push, dtype=np.float64)


def _axis(plate: Obstacle) -> str:
    return "xyz"[int(np.abs(_push(plate)).argmax())]
