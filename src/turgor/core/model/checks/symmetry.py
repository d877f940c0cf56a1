"""What a half, a quarter or a wedge cannot carry: loads and obstacles that are not the same on all its images."""

from collections.abc import Sequence

import numpy as np

from turgor.core.geometry.wedge import HIGH, LOW, Wedge
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.contact import Contact
from turgor.core.model.fibers import DISCRETE, Fibers
from turgor.core.model.loads import Hanging, LineForce, Load, Moment, PointForce, Traction
from turgor.core.model.obstacles import Cylinder, Obstacle, Plane, Sphere
from turgor.foundation.errors import TurgorError

#: Two directions are the same, and a point lies on an axis [m], up to this.
SAME = 1e-9


def check_symmetric(mesh: Mesh, what: str, vector: Sequence[float]) -> None:
    """Refuse a force that has no mirror image, or has another direction in the next sector of a wedge.

    Parameters
    ----------
    mesh : Mesh
    what : str
        The load, with a place for the component that is wrong: ``"force on 'tip': {:g} N"``.
    vector : (3,) floats

    Raises
    ------
    TurgorError
    """
    for plane, (axis, _) in zip(mesh.symmetry_faces, mesh.mirror_planes, strict=True):
        if vector[axis] != 0:
            raise TurgorError(
                f"{what.format(vector[axis])} along {'xyz'[axis]} points across the mirror "
                f"plane '{plane}', and its mirror image against it; model the whole actuator (symmetric = false)."
            )
    wedge = mesh.wedge
    for axis in () if wedge is None else wedge.across:
        if wedge is not None and vector[axis] != 0:
            raise TurgorError(
                f"{what.format(vector[axis])} along {'xyz'[axis]} points across the axis {wedge.axis} of the wedge; "
                f"turned by {360 / wedge.fold:.4g}° it points elsewhere in the next sector; model the whole part "
                '(symmetry = "none").'
            )


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


def check_wedge(mesh: Mesh, loads: Sequence[Load], reinforcements: Sequence[Fibers], contact: Contact) -> None:
    """Refuse what is not the same in all sectors of a wedge.

    Parameters
    ----------
    mesh : Mesh
        Nothing is checked if it has no wedge.
    loads : sequence of Load
    reinforcements : sequence of Fibers
    contact : Contact

    Raises
    ------
    TurgorError
    """
    wedge = mesh.wedge
    if wedge is None:
        return
    whole = 'model the whole part (symmetry = "none").'
    for load in loads:
        match load:
            case Traction(face, vector):
                check_symmetric(mesh, f"traction on '{face}': {{:g}} Pa", vector)
            case PointForce() | LineForce():
                where = "a point force" if isinstance(load, PointForce) else "a line force"
                raise TurgorError(
                    f"{where} acts once on the whole, but would act in every sector of the wedge; {whole}"
                )
            case Moment(point, vector):
                check_symmetric(mesh, f"moment on '{point}': {{:g}} N m", vector)
            case Hanging():
                check_symmetric(mesh, f"weight on '{load.point}': {{:g}} N", load.force)
    for fibers in reinforcements:
        if fibers.form == DISCRETE:
            raise TurgorError(
                f"fibers on '{fibers.name}': single threads do not end at the cuts of a wedge as they begin; spread "
                f"them over the face (smeared), or {whole}"
            )
    for obstacle in contact.obstacles:
        if not same_when_turned(obstacle, wedge):
            raise TurgorError(
                f"obstacle '{obstacle.name}': it is not the same after a turn by {360 / wedge.fold:.4g}° about the "
                f"axis {wedge.axis} of the wedge, as planes across it are, and balls and round bars on it that "
                f"move along it; {whole}"
            )


def check_not_cut(mesh: Mesh, what: str, face: str) -> None:
    """Refuse a support or a load on a cut face of a wedge, which lies inside the whole."""
    if mesh.wedge is not None and face in (LOW, HIGH):
        raise TurgorError(
            f"{what} on '{face}': this face is a cut through the whole part, and moves as the other cut does; nothing "
            "can hold or load it."
        )


def same_when_turned(obstacle: Obstacle, wedge: Wedge) -> bool:
    """Whether an obstacle and its motion are the same after any turn about the axis of a wedge."""
    across = list(wedge.across)
    if any(abs(vector[i]) > SAME for _, vector in obstacle.path for i in across):
        return False
    shape = obstacle.shape
    if isinstance(shape, Plane):
        return bool(np.abs(np.array(shape.normal)[across]).max() < SAME)
    on_axis = isinstance(shape, Sphere | Cylinder) and np.allclose(
        np.array(shape.center)[across], np.array(wedge.center)[across], atol=SAME
    )
    along = not isinstance(shape, Cylinder) or np.abs(np.array(shape.axis)[across]).max() < SAME
    return bool(on_axis and along)
