"""Shapes and meshes of actuator families on disk: the next run with equal dimensions neither builds nor meshes.

An entry holds a mesh, or all of a geometry but its CAD shape. Files of users may change, and families of users follow
from sources that are not known here: neither is cached.
"""

import os
import platform
import sys
from collections.abc import Mapping
from dataclasses import replace
from importlib.metadata import version
from typing import Protocol

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.shapes.film_shape import FilmShape
from turgor.core.geometry.shapes.lazy_shape import LateShape
from turgor.core.meshing.generator_override import INSTEAD
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.quality_cache import check_results
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.sizing.sizes import extent_of
from turgor.foundation.errors import TurgorError
from turgor.foundation.store.cached_values import Cache, sources

#: Environment variable with the most megabytes that all entries may take; 0 saves nothing and finds nothing.
MOST = "TURGOR_CACHE_MB"

#: Most megabytes where the variable is not set: some hundred meshes.
MOST_MB = 256.0

#: Families whose sources are known, the packages that make their shapes and meshes, and libraries that do.
_FAMILIES = "turgor.core.geometry.actuators."
_PACKAGES = ("turgor.core.geometry", "turgor.core.meshing")
_LIBRARIES = ("turgor", "netgen-mesher", "numpy", "scipy")

#: Key of the results of checks of a mesh, which are an entry of their own.
CHECKS = "checks"


class Family(Protocol):
    """An actuator that its dimensions describe."""

    def build(self) -> Geometry:
        """Build the shape with named regions and faces."""


def is_cached(actuator: object) -> bool:
    """Return whether shapes and meshes of an actuator are cached: of those that a family of this package describes.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> is_cached(FastPneuNet())
    True
    """
    return type(actuator).__module__.startswith(_FAMILIES)


def geometry_on_disk(actuator: Family) -> Geometry | None:
    """Return the cached geometry of an actuator, whose CAD shape is built when it is needed; None where there is none.

    Parameters
    ----------
    actuator : dataclass
        Of any kind; only families of this package are found.

    Returns
    -------
    Geometry or None
    """
    geometry = _entries(actuator).get(*_key(actuator))
    if not isinstance(geometry, Geometry):
        return None
    if isinstance(geometry.shape, FilmShape):
        return geometry
    return replace(geometry, shape=LateShape(build=actuator.build, bounding_box=geometry.shape))


def mesh_on_disk(actuator: Family, settings: MeshSettings) -> Mesh | None:
    """Return the cached mesh of an actuator and settings, with the results of its checks; None where there is none.

    Parameters
    ----------
    actuator : dataclass
    settings : MeshSettings

    Returns
    -------
    Mesh or None
    """
    if INSTEAD.get() is not None:
        return None
    entries = _entries(actuator)
    mesh = entries.get(*_key(actuator, settings))
    if not isinstance(mesh, Mesh):
        return None
    saved = entries.get(*_key(actuator, settings), CHECKS)
    if isinstance(saved, dict):
        results = check_results(mesh)
        results.by_check.update(saved)
        results.saved = len(saved)
    return mesh


def save_family(actuator: Family, geometry: Geometry, settings: MeshSettings, mesh: Mesh) -> None:
    """Save the geometry and the mesh of an actuator, and the results of checks of the mesh, where they are not yet.

    Parameters
    ----------
    actuator : dataclass
    geometry : Geometry
        Its geometry.
    settings : MeshSettings
        As `mesh_with` got them.
    mesh : Mesh
        Its mesh with these settings.
    """
    if INSTEAD.get() is not None:
        return
    entries, results = _entries(actuator), check_results(mesh)
    if not isinstance(geometry.shape, LateShape) and not entries.has(*_key(actuator)):
        film = isinstance(geometry.shape, FilmShape)
        extent_of(geometry)  # which triangulates the shape: its box is saved as meshing sees it
        low, high = geometry.shape.bounding_box
        entries.put(geometry if film else replace(geometry, shape=(tuple(low), tuple(high))), *_key(actuator))
    key = _key(actuator, settings)
    if not entries.has(*key):
        entries.put(mesh, *key)
    if len(results.by_check) > results.saved:
        entries.put(results.by_check, *key, CHECKS)
        results.saved = len(results.by_check)


def most_bytes() -> float:
    """Return the most bytes that all entries may take.

    Raises
    ------
    TurgorError
        If the environment variable is no number.
    """
    stated = os.environ.get(MOST, "")
    try:
        return 1e6 * max(0.0, float(stated) if stated else MOST_MB)
    except ValueError:
        raise TurgorError(f"the environment variable {MOST} is '{stated}'; a number of megabytes is needed.") from None


def _entries(actuator: Family) -> Cache:
    """The cache, which is empty for other actuators than families of this package."""
    return Cache("families", most_bytes() if is_cached(actuator) else 0.0)


def _key(actuator: Family, settings: MeshSettings | None = None) -> tuple[object, ...]:
    """All that a shape or mesh follows from: the dimensions and settings, versions, and sources."""
    if settings is not None and isinstance(settings.face_sizes, Mapping):
        settings = replace(settings, face_sizes=dict(settings.face_sizes))  # an equal frozen one is written like it
    programs = [sys.version, platform.machine(), *map(version, _LIBRARIES), *map(sources, _PACKAGES)]
    return programs, actuator, settings
