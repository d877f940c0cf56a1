"""Images of a modeled part: what acts on it must be the same on its mirror images and in all sectors of a wedge."""

from collections.abc import Callable, Sequence

from turgor.core.meshing.mesh import Mesh
from turgor.foundation.errors import TurgorError

WHOLE = 'model the whole part (symmetry = "none").'


def check_images(mesh: Mesh, what: str, mirrored: Callable[[int], bool], turned: Callable[[int], bool]) -> None:
    """Refuse a load that is not the same on all images of a modeled part.

    Parameters
    ----------
    mesh : Mesh
    what : str
        The load.
    mirrored : callable
        ``mirrored(axis)`` says whether the load is the same on both sides of a plane normal to an axis.
    turned : callable
        ``turned(axis)`` says whether the load is the same after any turn about an axis.

    Raises
    ------
    TurgorError
    """
    for plane, (axis, _) in zip(mesh.symmetry_faces, mesh.mirror_planes, strict=True):
        if not mirrored(axis):
            raise TurgorError(
                f"{what}: it is not the same on both sides of the mirror plane '{plane}', normal to {'xyz'[axis]}; "
                "model the whole actuator (symmetric = false)."
            )
    wedge = mesh.wedge
    if wedge is not None and not turned("xyz".index(wedge.axis)):
        raise TurgorError(f"{what}: it is not the same in all sectors of the wedge about {wedge.axis}; {WHOLE}")


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
    check_sectors(mesh, what, vector)


def check_sectors(mesh: Mesh, what: str, vector: Sequence[float]) -> None:
    """Refuse a vector that has another direction in the next sector of a wedge; arguments as of `check_symmetric`."""
    wedge = mesh.wedge
    for axis in () if wedge is None else wedge.across:
        if wedge is not None and vector[axis] != 0:
            raise TurgorError(
                f"{what.format(vector[axis])} along {'xyz'[axis]} points across the axis {wedge.axis} of the wedge; "
                f"turned by {360 / wedge.fold:.4g}° it points elsewhere in the next sector; {WHOLE}"
            )


def refuse_in_sectors(mesh: Mesh, what: str) -> None:
    """Refuse a load that acts once on the whole, if the mesh is a wedge.

    Parameters
    ----------
    mesh : Mesh
    what : str
        The load, such as ``"a point force"``.
    """
    if mesh.wedge is not None:
        raise TurgorError(f"{what} acts once on the whole, but would act in every sector of the wedge; {WHOLE}")
