"""Meshes of families on disk: the next run of an actuator with equal dimensions neither builds its shape nor meshes it.

An entry holds a mesh, or all of a geometry but its CAD shape. Its name is a hash of all that it follows from, so an
entry is never outdated; one that cannot be read is passed over. Files of others may change, and families of others
follow from sources that are not known here: neither is kept.
"""

import json
import os
import platform
import sys
import warnings
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from functools import cache
from hashlib import sha256
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import Protocol

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.shapes.lazy_shape import LateShape
from turgor.core.meshing.generator_override import INSTEAD
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.quality_cache import answers_of
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.sizing.sizes import extent_of
from turgor.foundation.errors import TurgorError
from turgor.foundation.store.archive import Content, read_archive, write_archive
from turgor.foundation.store.caches import cache_folder
from turgor.foundation.store.codec import Decoder, Encoder
from turgor.foundation.store.saved_objects import ENDING

#: Environment variable with the most megabytes that all entries may take; 0 keeps nothing and finds nothing.
MOST = "TURGOR_CACHE_MB"

#: Most megabytes where the variable is not set: some hundred meshes.
MOST_MB = 256.0

#: An entry may take this share of all, so that one large mesh does not push out all others.
LARGEST_SHARE = 0.25

#: Families whose sources are known; what their shapes and meshes are made by lies in these rooms.
_FAMILIES = "turgor.core.geometry.actuators."
_ROOMS = ("turgor.core.geometry", "turgor.core.meshing")
_MAKERS = ("turgor", "netgen-mesher", "numpy", "scipy")

#: Name of the answers to questions about a mesh, which are an entry beside it.
ANSWERS = "answers"

#: What an unreadable entry leads to.
_DAMAGE = (
    TurgorError, OSError, LookupError, TypeError, ValueError, AttributeError, ArithmeticError, MemoryError,
    RuntimeError,
)  # fmt: skip


class Family(Protocol):
    """An actuator that its dimensions describe."""

    def build(self) -> Geometry:
        """Build the shape with named regions and faces."""


def is_known(actuator: object) -> bool:
    """Whether an actuator is of a family of this package, which its dimensions describe: no file, no family of others.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> is_known(FastPneuNet())
    True
    """
    return type(actuator).__module__.startswith(_FAMILIES)


def geometry_on_disk(actuator: Family) -> Geometry | None:
    """Return the geometry that was kept for an actuator, whose CAD shape is made once it is asked for; None without.

    Parameters
    ----------
    actuator : dataclass
        Of any kind; only families of this package are found.

    Returns
    -------
    Geometry or None
    """
    found = _found(actuator)
    if not isinstance(found, Geometry):
        return None
    return replace(found, _shape=LateShape(build=actuator.build, bounding_box=found._shape))


def mesh_on_disk(actuator: Family, settings: MeshSettings) -> Mesh | None:
    """Return the mesh that was kept for an actuator and settings; None where there is none.

    Parameters
    ----------
    actuator : dataclass
    settings : MeshSettings

    Returns
    -------
    Mesh or None
    """
    found = None if INSTEAD.get() is not None else _found(actuator, settings)
    if not isinstance(found, Mesh):
        return None
    told = _found(actuator, settings, ANSWERS)
    if isinstance(told, dict):
        answers = answers_of(found)
        answers.known.update(told)
        answers.on_disk = len(told)
    return found


def keep(actuator: Family, geometry: Geometry, settings: MeshSettings, mesh: Mesh) -> None:
    """Keep the geometry and the mesh of an actuator on disk, where they are not yet.

    What cannot be written is not kept: that costs time, and no result depends on it.

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
    if not isinstance(geometry._shape, LateShape):
        extent_of(geometry)  # which triangulates the shape: its box is kept as meshing sees it
        low, high = geometry._shape.bounding_box
        _keep(replace(geometry, _shape=(tuple(low), tuple(high))), actuator)
    _keep(mesh, actuator, settings)
    _keep_answers(mesh, actuator, settings)


def most_bytes() -> float:
    """Most bytes that all entries may take.

    Raises
    ------
    TurgorError
        If the environment variable is no number.
    """
    told = os.environ.get(MOST, "")
    try:
        return 1e6 * max(0.0, float(told) if told else MOST_MB)
    except ValueError:
        raise TurgorError(f"the environment variable {MOST} is '{told}'; a number of megabytes is needed.") from None


def _found(*asked: object) -> object:
    file = _file(asked)
    if file is None or not file.exists():
        return None
    try:
        content = read_archive(file)
        found: object = Decoder(content.arrays, _nothing_elsewhere).decode(content.tree)
    except _DAMAGE as error:
        warnings.warn(f"a damaged mesh in the cache is made again ({type(error).__name__}).", stacklevel=2)
        with suppress(OSError):
            file.unlink()
        return None
    with suppress(OSError):
        os.utime(file)  # the oldest used go first
    return found


def _keep(value: object, *asked: object) -> None:
    file, most = _file(asked), most_bytes()
    if file is None or file.exists():
        return
    encoder = Encoder()
    try:
        content = Content("family", encoder.encode(value), encoder.arrays)
        if sum(array.nbytes for array in encoder.arrays.values()) > LARGEST_SHARE * most:
            return
        file.parent.mkdir(parents=True, exist_ok=True)
        write_archive(file, content)
        _drop_oldest(file.parent, most)
    except (OSError, TurgorError):
        return


def _keep_answers(mesh: Mesh, actuator: Family, settings: MeshSettings) -> None:
    """Keep what is known of a mesh beside it, unless the entry holds as much."""
    answers, file = answers_of(mesh), _file((actuator, settings, ANSWERS))
    if file is None or len(answers.known) <= answers.on_disk:
        return
    with suppress(OSError):
        file.unlink(missing_ok=True)  # of a job that asked for less
        _keep(answers.known, actuator, settings, ANSWERS)
        answers.on_disk = len(answers.known)


def _drop_oldest(where: Path, most: float) -> None:
    """Remove what was not used for longest, until the rest takes at most so many bytes."""
    known = []
    for each in where.iterdir():
        with suppress(OSError):  # another process has removed it
            about = each.stat()
            known.append((about.st_mtime_ns, about.st_size, each))
    total = sum(size for _, size, _ in known)
    for _, size, each in sorted(known):
        if total <= most:
            return
        each.unlink(missing_ok=True)
        total -= size


def _file(asked: tuple[object, ...]) -> Path | None:
    """File of what follows from an actuator, and perhaps settings; None where it is not kept."""
    folder = cache_folder("families") if is_known(asked[0]) and most_bytes() else None
    if folder is None:
        return None
    told = [_made_by(), [Encoder().encode(_plain(each)) for each in asked]]
    return folder / f"{sha256(json.dumps(told).encode()).hexdigest()[:32]}{ENDING}"


def _plain(value: object) -> object:
    """Settings with sizes of faces as a plain mapping, which an equal frozen one is written like."""
    if isinstance(value, MeshSettings) and isinstance(value.face_sizes, Mapping):
        return replace(value, face_sizes=dict(value.face_sizes))
    return value


@cache
def _made_by() -> list[str]:
    """Versions and sources that shapes and meshes follow from: a change of any makes other names of all entries."""
    return [sys.version, platform.machine(), *map(version, _MAKERS), *map(_sources, _ROOMS)]


def _sources(room: str) -> str:
    """Hash of the names, sizes and times of the files of a room; of none in a frozen program."""
    found = find_spec(room)
    places = [Path(each) for each in (found.submodule_search_locations or ())] if found else []
    files = sorted(file for place in places for file in place.rglob("*.py"))
    told = [(str(file), about.st_size, about.st_mtime_ns) for file in files for about in (file.stat(),)]
    return sha256(str(told).encode()).hexdigest()


def _nothing_elsewhere(name: str) -> object:
    raise TurgorError(f"an entry refers to '{name}' elsewhere.")
