"""Measures of contact and of the setups that need it: forces on obstacles, areas, pressures, penetration."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.contact import SELF
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Obstacle
from turgor.core.results.fields.contact import contact_force, contact_moment
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.measure import Measure
from turgor.core.setups.grasped_object import Grasped
from turgor.core.setups.setup_values import PLATE
from turgor.core.solvers.checks.plate import bearing_distance as distance_from_tip
from turgor.core.solvers.solution import Solution
from turgor.foundation.errors import TurgorError, near_match, unknown

Array = NDArray[np.float64]


def force_on(obstacle: str) -> Measure:
    """Make the measure of the force on one obstacle, by its name.

    Examples
    --------
    >>> force_on("plate").name
    'plate_force'
    """
    return Measure(
        name=f"{obstacle}_force", unit="N", function=lambda at: float(np.linalg.norm(_force_on(at, obstacle))),
        definition=f"magnitude of the force of the actuator on the obstacle {obstacle}, whole actuator",
    )  # fmt: skip


def moment_on(obstacle: str) -> Measure:
    """Make the measure of the moment on one obstacle, by its name.

    Examples
    --------
    >>> moment_on("knob").name
    'knob_moment'
    """
    return Measure(
        name=f"{obstacle}_moment", unit="Nm", function=lambda at: float(np.linalg.norm(_moment_on(at, obstacle))),
        definition=f"magnitude of the moment of the actuator on the obstacle {obstacle} about the point about which it "
        "turns, by default its middle, whole actuator",
    )  # fmt: skip


def area_on(obstacle: str) -> Measure:
    """Make the measure of the contact area with one obstacle, by its name, or ``"self"``.

    Examples
    --------
    >>> area_on("plate").name
    'plate_contact_area'
    """
    where = "between walls of the actuator, both counted" if obstacle == SELF else f"with the obstacle {obstacle}"
    return Measure(
        name=f"{obstacle}_contact_area", unit="mm2", function=lambda at: _area_on(at, obstacle),
        definition=f"contact area {where}, on the deformed surface, whole actuator",
    )  # fmt: skip


def contact_measures_of(solution: Solution) -> tuple[Measure, ...]:
    """Return the measures that a response has by itself: those of its setup, of each obstacle, of all contact.

    Parameters
    ----------
    solution : Solution

    Returns
    -------
    tuple of Measure
        None where nothing can touch and nothing is blocked.
    """
    model = solution.model
    obstacles = model.contact.obstacles
    names = dict.fromkeys(name for support in model.supports for name in support.measures)
    names |= dict.fromkeys(name for each in obstacles for name in each.measures or ())
    chosen = [_NAMED[name] for name in names]
    chosen += [force_on(each.name) for each in obstacles if each.measures is None]
    chosen += [moment_on(each.name) for each in obstacles if each.rotation]
    if model.contact.obstacles or any(state.touches for state in solution.states):
        chosen += [contact_area, maximum_contact_pressure, deepest_penetration]
    return tuple(chosen)


def _obstacle(model: Model, name: str) -> Obstacle:
    """The obstacle of a name; without it, the error helps with names of measures too."""
    for obstacle in model.contact.obstacles:
        if obstacle.name == name:
            return obstacle
    if not model.contact.obstacles:
        raise TurgorError(
            f"the model has no obstacle '{name}'{near_match(f'{name}_force', _NAMED) or ': it has no obstacles.'}"
        )
    raise unknown("obstacle", name, [obstacle.name for obstacle in model.contact.obstacles])


def _force_on(at: StateFields, name: str) -> Array:
    """Force of the whole actuator on an obstacle, (3,) [N]."""
    _obstacle(at.model, name)
    return contact_force(at, name)


def _moment_on(at: StateFields, name: str) -> Array:
    """Moment of the whole actuator on an obstacle, (3,) [N m]."""
    _obstacle(at.model, name)
    return contact_moment(at, name)


def _area_on(at: StateFields, name: str) -> float:
    if name != SELF:
        _obstacle(at.model, name)
    touch = at.state.touches.get(name)
    return 0.0 if touch is None else at.mesh.symmetry_factor * touch.area


def _push(at: StateFields) -> tuple[Array, Array]:
    """Force of the tip on what stops it, of the whole actuator [N], and the direction in which it pushes, (3,) each."""
    for support in at.model.supports:
        if support.push is not None:
            face, directions = support.prescribed
            force, axes = np.zeros(3), ["xyz".index(letter) for letter in directions]
            force[axes] = _force_on_gauge(at, face)[axes]
            return at.facts.of_whole(force), np.array(support.push)
    pushes = [each.push for each in at.model.contact.obstacles if each.name == PLATE and each.push is not None]
    if not pushes:
        raise TurgorError(
            "nothing stops the tip: the model has neither a plane obstacle 'plate' nor a fixed tip; make it "
            "with setups.blocked_force."
        )
    return _force_on(at, PLATE), np.array(pushes[0])


def _force_on_gauge(at: StateFields, face: str) -> Array:
    """Force of a fixed face, or of the tab that is glued to it, of the whole actuator, (3,) [N]."""
    tab = at.state.points.get(face)
    if tab is not None:
        return -tab.force
    return -at.mesh.symmetry_factor * at.state.nodal_force[at.mesh.face_nodes(face)].sum(axis=0)


def _blocked_force(at: StateFields) -> float:
    force, direction = _push(at)
    return float(force @ direction)


def _bearing_distance(at: StateFields) -> float:
    plate = next((each for each in at.model.contact.obstacles if each.tip), None)
    if plate is None:
        raise TurgorError("no plate stops the tip; make the model with setups.blocked_force.")
    touch = at.state.touches.get(plate.name)
    return float("nan") if touch is None else distance_from_tip(at.mesh, plate, touch)


def _component(axis: str) -> Measure:
    """Make the measure of the force of the tip along an axis."""
    return Measure(
        name=f"blocked_force_{axis}", unit="N", function=lambda at: float(_push(at)[0]["xyz".index(axis)]),
        definition=f"force of the tip on the plate or on what holds it, positive along +{axis}, whole actuator",
    )  # fmt: skip


def _grasped(at: StateFields) -> Grasped:
    for obstacle in at.model.contact.obstacles:
        if isinstance(obstacle, Grasped):
            return obstacle
    raise TurgorError("nothing is grasped; make the model with setups.grasp.")


def _holding_force(at: StateFields) -> float:
    grasped = _grasped(at)
    return float(-grasped.fingers * _force_on(at, grasped.name) @ np.array(grasped.pull))


def _pull_distance(at: StateFields) -> float:
    grasped = _grasped(at)
    return float(grasped.displacement(at.state.load_factor) @ np.array(grasped.pull))


def _largest(values: Sequence[float]) -> float:
    return float(max(values, default=0.0))


blocked_force = Measure(
    name="blocked_force", unit="N", function=_blocked_force,
    definition="force of the tip on the plate or on what holds it, along the direction in which it is blocked: "
    "positive where it pushes that way, negative where it pulls back, whole actuator",
)  # fmt: skip
blocked_force_x, blocked_force_y, blocked_force_z = map(_component, "xyz")
bearing_distance = Measure(
    name="bearing_distance", unit="mm", function=_bearing_distance,
    definition="how far from the tip the plate is touched, a mean over the force on the actuator at rest: 0 where the "
    "tip alone bears; no number where nothing touches",
)  # fmt: skip
contact_area = Measure(
    name="contact_area", unit="mm2",
    function=lambda at: at.mesh.symmetry_factor * sum(touch.area for touch in at.state.touches.values()),
    definition="contact area with obstacles and between walls, on the deformed surface, whole actuator; where walls "
    "meet both count",
)  # fmt: skip
maximum_contact_pressure = Measure(
    name="maximum_contact_pressure", unit="kPa",
    function=lambda at: _largest([touch.pressure.max() for touch in at.state.touches.values()]),
    definition="largest contact pressure at any node; at edges it depends on the mesh",
)  # fmt: skip
deepest_penetration = Measure(
    name="deepest_penetration", unit="um",
    function=lambda at: _largest([touch.penetration for touch in at.state.touches.values()]),
    definition="deepest penetration of any contact",
)  # fmt: skip
grip_force = Measure(
    name="grip_force", unit="N", function=lambda at: float(-_force_on(at, _grasped(at).name)[2]),
    definition="force of one finger on the object along -z, towards the middle between two fingers",
)  # fmt: skip
holding_force = Measure(
    name="holding_force", unit="N", function=_holding_force,
    definition="force with which all fingers together resist the pull; negative while they push the object out",
)  # fmt: skip
pull_distance = Measure(
    name="pull_distance", unit="mm", function=_pull_distance, definition="how far the object has been pulled",
)  # fmt: skip

#: The measures above by their names.
_NAMED = {each.name: each for each in list(globals().values()) if isinstance(each, Measure)}
