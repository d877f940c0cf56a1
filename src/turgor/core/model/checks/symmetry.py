"""Symmetry: refuse shells, fibers and obstacles that differ between the images of a half, a quarter or a wedge."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.wedge import HIGH, LOW, Wedge
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.contact import Contact
from turgor.core.model.fibers import DISCRETE, Fibers
from turgor.core.model.loads.images import WHOLE
from turgor.core.model.obstacles import Obstacle
from turgor.core.model.obstacles.rigid_shape import SAME, across
from turgor.foundation.errors import TurgorError
from turgor.units import mm

#: Load factors at which it is seen whether a mirror plane cuts an obstacle; and those of the points of its ways.
PLACES = 9


def check_uncut_shell(mesh: Mesh, face: str) -> None:
    """Refuse a shell that the cuts of a wedge cut: nothing would keep its slope there.

    Parameters
    ----------
    mesh : Mesh
    face : str
        Face of the shell.

    Raises
    ------
    TurgorError
    """
    if mesh.wedge is not None and np.isin(mesh.face_nodes(face), mesh.face_nodes(LOW)).any():
        raise TurgorError(
            f"the shell on '{face}' is cut by the wedge, at whose cuts it could fold; make it a membrane, or model the "
            'whole part (symmetry = "none").'
        )


def check_wedge(mesh: Mesh, reinforcements: Sequence[Fibers], contact: Contact) -> None:
    """Refuse what is not the same in all sectors of a wedge.

    Parameters
    ----------
    mesh : Mesh
        Nothing is checked if it has no wedge.
    reinforcements : sequence of Fibers
    contact : Contact

    Raises
    ------
    TurgorError
    """
    wedge = mesh.wedge
    if wedge is None:
        return
    for fibers in reinforcements:
        if fibers.form == DISCRETE:
            raise TurgorError(
                f"fibers on '{fibers.place}': single threads do not end at the cuts of a wedge as they begin; spread "
                f"them over the face (smeared), or {WHOLE}"
            )
    for obstacle in contact.obstacles:
        if not same_when_turned(obstacle, wedge):
            raise TurgorError(
                f"obstacle '{obstacle.name}': it is not the same after a turn by {360 / wedge.fold:.4g}° about the "
                f"axis {wedge.axis} of the wedge, as planes across it are, and balls and round bars on it that "
                f"move along it; {WHOLE}"
            )


def check_turning(mesh: Mesh, contact: Contact) -> None:
    """Refuse an obstacle that a mirror plane cuts and that turns about another axis than its normal.

    Its image would turn the other way, and it would be no rigid body.

    Parameters
    ----------
    mesh : Mesh
    contact : Contact

    Raises
    ------
    TurgorError
    """
    extent = np.stack([mesh.points.min(axis=0), mesh.points.max(axis=0)])
    for obstacle in contact.obstacles:
        turns = np.abs([vector for _, vector in obstacle.rotation]).reshape(-1, 3).max(axis=0, initial=0.0) > SAME
        for axis, level in mesh.mirror_planes if turns.any() else ():
            if np.delete(turns, axis).any() and _cut(obstacle, axis, level, extent):
                raise TurgorError(
                    f"obstacle '{obstacle.name}': rotation is about {' and '.join(np.array(list('xyz'))[turns])}, and "
                    f"the mirror plane {'xyz'[axis]} = {level / mm:.4g} mm cuts it: its image would turn the other "
                    f"way. Turn it about {'xyz'[axis]}, or {WHOLE}"
                )


def _cut(obstacle: Obstacle, axis: int, level: float, extent: NDArray[np.float64]) -> bool:
    """Whether an obstacle lies on both sides of a mirror plane anywhere on its way."""
    margin = SAME * float(np.ptp(extent, axis=0).max())
    for load_factor in np.unique([*np.linspace(0.0, 1.0, PLACES), *obstacle.stops]):
        offset = obstacle.outline(obstacle.pose(float(load_factor)), extent)[0][:, axis] - level
        if offset.min() < -margin and offset.max() > margin:
            return True
    return False


def check_not_cut(mesh: Mesh, what: str, face: str) -> None:
    """Refuse a support or a load on a cut face of a wedge, which lies inside the whole."""
    if mesh.wedge is not None and face in (LOW, HIGH):
        raise TurgorError(
            f"{what} on '{face}': this face is a cut through the whole part, and moves as the other cut does; nothing "
            "can hold or load it."
        )


def same_when_turned(obstacle: Obstacle, wedge: Wedge) -> bool:
    """Whether an obstacle and its motion are the same after any turn about the axis of a wedge."""
    axis = "xyz".index(wedge.axis)
    if any(abs(vector[i]) > SAME for _, vector in obstacle.path for i in wedge.across):
        return False
    about = across(obstacle.about or obstacle.shape.middle, axis) - across(wedge.center, axis)
    turns = any(abs(vector[i]) > SAME for _, vector in obstacle.rotation for i in wedge.across)
    if turns or (obstacle.rotation and np.abs(about).max() > SAME):
        return False
    return obstacle.shape.turned(axis, wedge.center)
