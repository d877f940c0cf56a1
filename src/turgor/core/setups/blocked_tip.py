"""blocked_force: a model whose tip is stopped, by a plate before it or a gauge that holds it."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.directions import DIRECTIONS
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import outer_triangles
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Plate, Vector
from turgor.core.model.obstacles.obstacle import push_text
from turgor.core.model.points import ReferencePoint
from turgor.core.model.supports import Fixed, Support
from turgor.core.setups.directions import check_unmirrored
from turgor.core.setups.free_tip import first_direction, outward
from turgor.core.setups.rig import pushed_along, rig_position, rig_shape
from turgor.core.setups.settings import BLOCKED_TIP
from turgor.core.setups.setup_values import FREE, PLATE, BlockedForce
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import one

#: Face of the amended mesh that may touch the plate.
NEAR_TIP = "near_tip"

#: Reference point of a stiff tab that is glued to the tip.
TAB = "tab"

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class FixedTip(Fixed):
    """The tip, or the tab that is glued to it, fixed to a gauge that measures its force.

    Parameters
    ----------
    push : (3,) floats
        Unit vector along which the tip pushes.
    """

    push: Vector = (0.0, 0.0, -1.0)

    @property
    def measures(self) -> tuple[str, ...]:
        """The blocked force, and its components where the tip is fixed in several directions."""
        parts = [f"blocked_force_{axis}" for axis in self.directions]
        return "blocked_force", *(parts if len(parts) > 1 else ())

    def text(self) -> str:
        """Return the sentence of a report."""
        return f"{self.face} does not move in {', '.join(self.directions)}; {push_text(self.push)}."


def blocked_force(
    model: Model,
    *,
    hold: str = PLATE,
    distance: float | None = None,
    position: float | None = None,
    direction: str = FREE,
    face: str = "tip",
    friction: float = 0.0,
    rotational_spring: float | None = None,
    tilt: float = 0.0,
    spring: float | None = None,
    sensor_radius: float | None = None,
    behind_tip: float | None = None,
) -> Model:
    """Return a model whose tip is stopped: by a rigid plate, as on a load cell, or fixed to a gauge.

    The plate is plane and rigid, and square to the direction. It is endless, but only the quarter of the actuator
    nearest the tip can touch it, as where a load cell stands under the tip: an actuator that lies flat on a table
    would push on it all along. Its force is the measure ``blocked_force``, of the whole actuator where a half is
    modeled. A tip that is fixed pushes and pulls; the force is that of the fixed face, sideways forces included in
    ``blocked_force_x``, ``_y`` and ``_z``.

    Parameters
    ----------
    model : Model
        The actuator, free at its tip.
    hold : str
        What stops the tip: ``"plate"``, or the directions in which its face is fixed, ``"x"``, ``"z"``, ``"xz"`` …
        ``"xyz"``. A tip that is free along x is as good as a root on a slider with rollers.
    distance : float [m], optional
        How far the tip can move before it meets the plate; 0 where no position is given either. A negative one is a
        preload: the plate is pushed that far into the tip, over the first 2 % of the load.
    position : float [m], optional
        Where the plate stands instead: its coordinate along the axis of the direction, which must be stated. Lock files
        give it.
    direction : str
        Where the tip pushes, and on which side of it the plate stands: ``"-z"``, ``"+x"`` and the like. ``"free"`` is
        the direction along an axis in which the free tip sets out under the first 5 % of the load: -z of benders, +x
        of what extends.
    face : str
        The face that is the tip.
    friction : float [-]
        Coulomb's coefficient on the plate, 0 to 2.
    rotational_spring : float [N m/rad], optional
        A fixed tip is glued to a stiff tab that may turn about the middle of the face against a spring: its moment per
        angle, 0 for a hinge. Left out, every point of the face is fixed.
    tilt : float [rad]
        Angle of the plate, about y, or about x where the tip pushes along y; a positive one brings its side at larger x
        (or z) nearer. The blocked force is that square to the plate, as a load cell under it measures.
    spring : float [N/m], optional
        Stiffness of the load cell, which gives way; rigid by default.
    sensor_radius : float [m], optional
        A round button presses instead of a plate; this is the radius of its ball.
    behind_tip : float [m], optional
        How far behind the tip the button stands, along the actuator at rest; 0 by default.

    Returns
    -------
    Model
        With an obstacle ``plate`` and a face ``near_tip`` that may touch it, or with a `FixedTip` among its supports.
        Any procedure solves it, `Static` as a rule.

    Raises
    ------
    TurgorError
        If a value is out of its range, the values do not go together, the mesh lacks the face, the direction points
        back into the actuator or across a mirror plane, or the model has a ``plate`` already.
    """
    one(model, Model, "model", "a Model is needed")
    setup = BlockedForce(
        hold=hold, distance=distance, position=position, direction=direction, face=face, friction=friction,
        rotational_spring=rotational_spring, tilt=tilt, spring=spring, sensor_radius=sensor_radius,
        behind_tip=behind_tip,
    )  # fmt: skip
    return blocked(model, setup)


def blocked(model: Model, setup: BlockedForce, notify: Callable[[str], None] | None = None) -> Model:
    """Return a model whose tip is stopped as a setup says; see `blocked_force`.

    Parameters
    ----------
    model : Model
    setup : BlockedForce
    notify : callable, optional
        Where notices of the engine go while a direction is found.

    Returns
    -------
    Model
    """
    mesh = model.mesh
    normal = outward(mesh, setup.face)
    direction = setup.direction
    if direction == FREE:
        direction = first_direction(model, setup.face, "xyz" if setup.hold == PLATE else setup.hold, notify)
    check_unmirrored(mesh, "blocked_force: direction", direction)
    if setup.hold != PLATE:
        return replace(model, supports=(*model.supports, *_supports(setup, direction)))
    push = np.array(DIRECTIONS[direction])
    if normal @ push < -0.5:
        raise TurgorError(
            f"blocked_force: direction is '{direction}', so the plate would stand behind the tip, in the actuator; "
            f"hold the tip instead (hold = '{direction[1]}'), or choose a direction away from it."
        )
    if any(obstacle.name == PLATE for obstacle in model.contact.obstacles):
        raise TurgorError(f"blocked_force adds an obstacle '{PLATE}', but the model has one; rename that one.")
    sides = _near(mesh, setup.face, normal)
    if setup.tilt:
        check_unmirrored(mesh, "blocked_force: the tilt of the plate", "+x" if direction[1] == "z" else "+z")
    shape, pushed_in = rig_shape(mesh, setup, direction, sides)
    along = pushed_along(setup, direction)
    moved = tuple(-pushed_in * along)
    rest = (0.0, 0.0, 0.0)
    plate = Plate(
        name=PLATE, shape=shape, friction=setup.friction, face=NEAR_TIP, tip=setup.face, spring=setup.spring,
        along=None if shape.facing else _vector(along),
        path=((0.0, rest), (BLOCKED_TIP.pushed, moved), (1.0, moved)) if pushed_in else (),
    )  # fmt: skip
    contact = model.contact.with_obstacles((*model.contact.obstacles, plate))
    return replace(model, mesh=replace(mesh, faces={**mesh.faces, NEAR_TIP: sides}), contact=contact)


def directed(setup: BlockedForce, model: Model) -> BlockedForce:
    """Return a setup that states the direction in which the tip of its model is blocked.

    Parameters
    ----------
    setup : BlockedForce
    model : Model
        Of `blocked`.

    Returns
    -------
    BlockedForce
    """
    return replace(setup, direction=_chosen(model)) if setup.direction == FREE else setup


def settled(setup: BlockedForce, model: Model) -> BlockedForce:
    """Return a setup that states what was chosen in its model: the direction, and the place of the plate.

    Parameters
    ----------
    setup : BlockedForce
    model : Model
        Of `blocked`.

    Returns
    -------
    BlockedForce
        It makes the same model from the same actuator.
    """
    stated = directed(setup, model)
    if stated.direction == FREE or stated.hold != PLATE:
        return stated
    sides = _near(model.mesh, stated.face, outward(model.mesh, stated.face))
    return replace(stated, distance=None, position=rig_position(model.mesh, stated, stated.direction, sides))


def _supports(setup: BlockedForce, direction: str) -> tuple[Support, ...]:
    """The place that fixes a tip: its face, or the point of a stiff tab that is glued to it."""
    push = DIRECTIONS[direction]
    if setup.rotational_spring is None:
        return (FixedTip(setup.face, setup.hold, push),)
    tab = ReferencePoint(TAB, setup.face, rotational_spring=setup.rotational_spring)
    return tab, FixedTip(TAB, setup.hold, push)


def _chosen(model: Model) -> str:
    """The direction in which the tip of a model is blocked; free where nothing blocks it."""
    pushes = [each.push for each in model.supports if each.push is not None]
    pushes += [plate.push for plate in model.contact.obstacles if plate.tip and plate.push is not None]
    return next((name for name, vector in DIRECTIONS.items() if pushes and np.dot(pushes[0], vector) > 0.5), FREE)


def _near(mesh: Mesh, face: str, outward: Array) -> NDArray[np.int64]:
    """Sides of the surface outside cavities and mirror planes that lie near the tip, (f, k)."""
    inner = [name for name in mesh.faces if name in (*mesh.cavities, *mesh.cut_faces)]
    corners = mesh.cell_type.side.corners
    taken = {tuple(sorted(side)) for name in inner for side in mesh.faces[name][:, :corners].tolist()}
    sides = outer_triangles(mesh)
    outside = np.array([tuple(sorted(side)) not in taken for side in sides[:, :corners].tolist()])
    along = mesh.points @ outward
    tip = float(along[mesh.face_nodes(face)].mean())
    near = along[sides[:, :corners]].mean(axis=1) >= tip - BLOCKED_TIP.reach * float(np.ptp(along))
    return sides[outside & near]


def _vector(values: Array) -> Vector:
    x, y, z = (float(value) + 0.0 for value in values)
    return x, y, z
