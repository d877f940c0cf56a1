"""Mesh sizes: the range that a geometry allows, its default size, and checks of given sizes."""

from collections.abc import Mapping
from math import ceil, floor, isfinite
from numbers import Integral, Real
from typing import Any

from turgor.core.geometry.cad.surface.shape import SurfaceShape
from turgor.core.geometry.extrusion import Along
from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.shapes.film_shape import FilmShape
from turgor.core.geometry.shapes.lazy_shape import LateShape
from turgor.core.geometry.thin_corners import THIN_CORNERS
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.sizing.settings import QUALITIES, SIZING
from turgor.foundation.errors import TurgorError, unknown
from turgor.units import mm


def size_range(geometry: Geometry) -> tuple[float, float]:
    """Smallest and largest mesh size that `mesh` accepts for a geometry [m].

    The smallest makes about 3 million unknowns; the largest is the part itself. Above `wall_size`, thin walls get
    smaller cells than the rest.
    """
    if isinstance(geometry.shape, FilmShape):
        return geometry.extent / SIZING.most_film_sides, geometry.extent
    return size_for(geometry, SIZING.most_unknowns), extent_of(geometry)


def wall_size(geometry: Geometry) -> float:
    """Largest mesh size that suits every wall of a geometry [m]: four times the thinnest wall, or the part itself."""
    return min(SIZING.largest_per_wall * geometry.smallest_wall, extent_of(geometry))


def check_settings(geometry: Geometry, settings: MeshSettings) -> None:
    """Refuse what no mesh can be made with.

    Parameters
    ----------
    geometry : Geometry
    settings : MeshSettings
        With a size.

    Raises
    ------
    TurgorError
        If its size, grading or number of cells through walls is not allowed: what it is, and what is allowed.
    """
    grading: object = settings.grading
    _check_wall_cells(settings.wall_cells)
    _check_size(geometry, settings.size)
    if isinstance(grading, bool) or not isinstance(grading, Real) or not 0.1 <= float(grading) <= 1:
        raise TurgorError(f"mesh grading is {grading!r}; allowed is 0.1 to 1.")


def check_quality(quality: object) -> None:
    """Refuse a quality that has no name.

    Examples
    --------
    >>> check_quality("fin")
    Traceback (most recent call last):
    turgor.TurgorError: unknown mesh quality 'fin'; did you mean 'fine'? Known: draft, fine, normal.
    """
    if not isinstance(quality, str) or quality not in QUALITIES:
        raise unknown("mesh quality", str(quality), QUALITIES)


def check_target(target: float) -> None:
    """Refuse a relative mesh error that no mesh can be refined to.

    Examples
    --------
    >>> check_target(2.0)
    Traceback (most recent call last):
    turgor.TurgorError: mesh target is 200 %; allowed is 0.01 % to 50 %.
    """
    low, high = SIZING.least_target, SIZING.most_target
    if not low <= target <= high:
        raise TurgorError(f"mesh target is {100 * target:g} %; allowed is {100 * low:g} % to {100 * high:g} %.")


def check_face_sizes(geometry: Geometry, face_sizes: Mapping[str, Any], size: float) -> None:
    """Refuse sizes of faces that the geometry does not have, that are no lengths or larger than the whole mesh's.

    Parameters
    ----------
    geometry : Geometry
    face_sizes : mapping of str to float [m]
        Sizes by the name of the face.
    size : float [m]
        Size of the whole mesh.

    Raises
    ------
    TurgorError
        If one of them is not allowed: what it is, and what is allowed.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> check_face_sizes(FastPneuNet().build(), {"cavty": 1e-3}, 2e-3)
    Traceback (most recent call last):
    turgor.TurgorError: unknown face 'cavty'; did you mean 'cavity'? Known: cavity, fixed, outside, ...
    """
    given: object = face_sizes
    if not isinstance(given, Mapping):
        raise TurgorError(f"mesh face_sizes is {face_sizes!r}; sizes by face are needed, such as {{'cavity': 1*mm}}.")
    for name, value in given.items():
        if name not in geometry.faces:
            raise unknown("face", str(name), geometry.faces)
        if isinstance(value, bool) or not isinstance(value, Real) or not isfinite(value):
            raise TurgorError(f"mesh size of face '{name}' is {value!r}; a length in meters is needed, such as 1*mm.")
        low = (SIZING.unknowns_per_area * _face_area(geometry, name) / SIZING.most_unknowns) ** 0.5
        if not low <= value <= size:
            shown = f"{ceil(low / mm * 1000) / 1000:g} mm to {size / mm:.6g} mm, the size of the whole mesh"
            raise TurgorError(f"mesh size of face '{name}' is {value / mm:.6g} mm; allowed is {shown}.")


def check_features(geometry: Geometry, limit: object, size: float, cells: str) -> None:
    """Refuse a limit of small features that is no length, larger than the cells, or has no meaning for them.

    Parameters
    ----------
    geometry : Geometry
    limit : float or None [m]
        Radius below which rounds are left coarse.
    size : float [m]
        Size of the mesh.
    cells : str
        Kind of the cells.

    Raises
    ------
    TurgorError
        What is given, and what is allowed.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> check_features(FastPneuNet().build(), 5e-3, 2e-3, "tetrahedra")
    Traceback (most recent call last):
    turgor.TurgorError: mesh ignore_features_below is 5 mm; allowed is 0 to 2 mm, the size of the mesh.
    """
    if limit is None:
        return
    if isinstance(limit, bool) or not isinstance(limit, Real) or not isfinite(limit):
        raise TurgorError(f"mesh ignore_features_below is {limit!r}; a length in meters is needed, such as 1*mm.")
    if not 0 <= float(limit) <= size:
        raise TurgorError(
            f"mesh ignore_features_below is {float(limit) / mm:.6g} mm; allowed is 0 to {size / mm:.6g} mm, the size "
            "of the mesh."
        )
    if cells == "hexahedra" or isinstance(geometry.shape, SurfaceShape):
        what = "hexahedra of a swept section" if cells == "hexahedra" else "cells in a part that is given by facets"
        raise TurgorError(f"mesh ignore_features_below is given, but {what} are not smaller at rounds; leave it out.")


def extent_of(geometry: Geometry) -> float:
    """Longest side [m], the same before and after meshing: a triangulation widens the box around curved faces."""
    if not isinstance(geometry.shape, SurfaceShape | LateShape | FilmShape):  # the box of a late shape is the wider one
        geometry.shape.MakeTriangulation()
    return geometry.extent


def size_for(geometry: Geometry, unknowns: float) -> float:
    """Size of tetrahedra [m] that make about so many unknowns."""
    return float((SIZING.unknowns_per_volume * geometry.solid_volume / unknowns) ** (1 / 3))


def _check_size(geometry: Geometry, size: object) -> None:
    if isinstance(size, bool) or not isinstance(size, Real) or not isfinite(size):
        raise TurgorError(f"mesh size is {size!r}; a finite length in meters is needed, such as 3*mm.")
    length, (low, high) = float(size), size_range(geometry)
    if low <= length <= high * (1 + 1e-9):
        return
    # rounded inwards, so that both numbers shown are themselves allowed
    shown = f"{ceil(low / mm * 1000) / 1000} mm to {floor(high / mm * 1000 + 1e-6) / 1000:g} mm (the whole part)"
    given = f"mesh size is {length / mm:.6g} mm"
    if length <= 0:
        raise TurgorError(f"{given}; allowed is {shown}.")
    if length < low and isinstance(geometry.shape, FilmShape):
        raise TurgorError(f"{given}, more than {SIZING.most_film_sides:g} sides along the film; allowed is {shown}.")
    if length < low:
        millions = SIZING.unknowns_per_volume * geometry.solid_volume / length**3 / 1e6
        raise TurgorError(f"{given}, which makes about {millions:.3g} million unknowns; allowed is {shown}.")
    hint = "; is the unit right?" if low <= length * mm <= high else "."
    raise TurgorError(f"{given}, larger than the part; allowed is {shown}{hint}")


def is_tube(geometry: Geometry) -> bool:
    """Whether the same section fills most of a straight path, so that its walls hardly bend along their length."""
    sweep = geometry._sweep
    if sweep is None or not isinstance(sweep.path, Along):
        return False
    lengths = [layer.end - layer.start for layer in sweep.layers]
    return 2 * max(lengths) > sum(lengths) and max(lengths) > THIN_CORNERS.long * geometry.smallest_wall


def is_block(geometry: Geometry) -> bool:
    """Whether layers lie on each other up z without air around them: a block with chambers in it.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.geometry.actuators.helical_pneunet import HelicalPneuNet
    >>> from turgor.core.geometry.actuators.slow_pneunet import SlowPneuNet
    >>> [is_block(kind().build()) for kind in (SlowPneuNet, FastPneuNet, HelicalPneuNet)]
    [True, False, False]
    """
    sweep = geometry._sweep
    if sweep is None or sweep.path != Along(axis=2):
        return False
    return all(name is not None for layer in sweep.layers for name, _ in layer.fill)


def is_slanted_row(geometry: Geometry) -> bool:
    """Whether layers lie on each other up z with gaps between them: chambers in a row whose walls are slanted.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.helical_pneunet import HelicalPneuNet
    >>> from turgor.core.geometry.actuators.slow_pneunet import SlowPneuNet
    >>> [is_slanted_row(kind().build()) for kind in (HelicalPneuNet, SlowPneuNet)]
    [True, False]
    """
    sweep = geometry._sweep
    return sweep is not None and sweep.path == Along(axis=2) and not is_block(geometry)


def is_row(geometry: Geometry) -> bool:
    """Whether a hollow section comes again along a straight path, as where chambers stand in a row.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.geometry.actuators.rectangular_bender import RectangularBender
    >>> [is_row(kind().build()) for kind in (FastPneuNet, RectangularBender)]
    [True, False]
    """
    sweep = geometry._sweep
    if sweep is None or not isinstance(sweep.path, Along):
        return False
    hollow = [layer.fill for layer in sweep.layers if any(str(name).startswith("cavity") for name, _ in layer.fill)]
    return len(set(hollow)) < len(hollow)


def has_both_sides(geometry: Geometry) -> bool:
    """Whether a section of a sweep passes several cavities, as where chambers stand on both sides of a layer.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.bidirectional_pneunet import BidirectionalPneuNet
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> [has_both_sides(kind().build()) for kind in (BidirectionalPneuNet, FastPneuNet)]
    [True, False]
    """
    layers = () if geometry._sweep is None else geometry._sweep.layers
    return any(len({n for n, _ in layer.fill if str(n).startswith("cavity")}) > 1 for layer in layers)


def _check_wall_cells(wall_cells: object) -> None:
    whole = isinstance(wall_cells, Integral) and not isinstance(wall_cells, bool)
    if not whole or not 1 <= int(wall_cells) <= SIZING.wall_cells:  # type: ignore[call-overload]
        raise TurgorError(
            f"mesh wall_cells is {wall_cells!r}; allowed is 1, which leaves the walls as they come, to "
            f"{SIZING.wall_cells}, which puts so many cells through every wall at least; a smaller size puts more."
        )


def _face_area(geometry: Geometry, name: str) -> float:
    """Area of a named face [m²]."""
    faces = set(geometry._cad.faces)  # a face between two solids is listed for both
    return float(sum(face.mass for face in faces if face.name == name)) * geometry.length_scale**2
