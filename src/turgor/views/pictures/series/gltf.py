"""GLB files (glTF 2.0): the surface of an actuator with its shapes along a path as morph targets.

The format is a JSON document and one block of numbers; the specification is https://registry.khronos.org/glTF/.
"""

import json
import struct
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.results.fields.state_fields import StateFields
from turgor.views.pictures.colors import CONTACT_PRESSURE, FIBER_TENSION
from turgor.views.pictures.rendering import View
from turgor.views.pictures.settings import RENDERING
from turgor.views.pictures.shading import GAMMA
from turgor.views.pictures.skin import Skin, visible_skin

Array = NDArray[np.float64]

#: Numbers of the format: float, unsigned integer; array of vertices, array of indices; triangles.
FLOAT, UNSIGNED, VERTICES, INDICES, TRIANGLES = 5126, 5125, 34962, 34963, 4

#: Turn by a quarter about x, as a quaternion: height is along y in glTF.
UPRIGHT = [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]


def write_glb(path: Path, shapes: Sequence[StateFields], view: View, *, seconds: float, back: bool) -> None:
    """Write shapes of an actuator as a body that moves from the first to the last.

    Parameters
    ----------
    path : Path
        File to write.
    shapes : sequence of StateFields
        Two or more, of one mesh.
    view : View
        The field and the range of the colors.
    seconds : float [s]
        From the first shape to the last.
    back : bool
        Whether it moves back.
    """
    surfaces = _surfaces(shapes, view)
    buffer = _Buffer()
    first = surfaces[0]
    attributes = {
        "POSITION": buffer.add(first.points, VERTICES, limits=True),
        "NORMAL": buffer.add(first.normals, VERTICES),
        "COLOR_0": buffer.add(_colors(first, view), VERTICES),
    }
    targets = [
        {
            "POSITION": buffer.add(each.points - first.points, VERTICES, limits=True),
            "NORMAL": buffer.add(each.normals - first.normals, VERTICES),
            "COLOR_0": buffer.add(_colors(each, view) - _colors(first, view), VERTICES),
        }
        for each in surfaces[1:]
    ]
    indices = buffer.add(first.triangles, INDICES)
    count = len(targets)
    times, weights = _keys(count, seconds, back)
    sampler = {"input": buffer.add(times, None, limits=True), "output": buffer.add(weights.ravel(), None)}
    primitive = {"attributes": attributes, "indices": indices, "targets": targets, "mode": TRIANGLES, "material": 0}
    document = _document(shapes[0].mesh.name, primitive, sampler) | buffer.described()
    _write(path, document, buffer.content())


def _document(name: str, primitive: dict[str, Any], sampler: dict[str, int]) -> dict[str, Any]:
    """Scene with one body that moves from shape to shape."""
    return {
        "asset": {"version": "2.0", "generator": "turgor"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "rotation": UPRIGHT, "name": name}],
        "meshes": [{"primitives": [primitive], "weights": [0.0] * len(primitive["targets"])}],
        "materials": [
            {
                "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.8},
                "doubleSided": True,
                "name": "rubber",
            }
        ],
        "animations": [
            {
                "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}],
                "samplers": [sampler],
                "name": "path",
            }
        ],
    }


class _Buffer:
    """Block of numbers, with the accessors that say where each array is."""

    def __init__(self) -> None:
        self._parts: list[bytes] = []
        self._views: list[dict[str, Any]] = []
        self._accessors: list[dict[str, Any]] = []

    def add(self, values: NDArray, target: int | None, limits: bool = False) -> int:
        """Add an array, (n,) or (n, 3); return the number of its accessor."""
        whole = target == INDICES
        flat = np.ascontiguousarray(values, dtype="<u4" if whole else "<f4")
        start = sum(map(len, self._parts))
        self._parts.append(flat.tobytes())
        self._views.append({"buffer": 0, "byteOffset": start, "byteLength": flat.nbytes})
        if target is not None:
            self._views[-1]["target"] = target
        accessor = {
            "bufferView": len(self._views) - 1,
            "componentType": UNSIGNED if whole else FLOAT,
            "count": flat.size if whole or flat.ndim == 1 else len(flat),
            "type": "SCALAR" if whole or flat.ndim == 1 else "VEC3",
        }
        if limits:
            table = flat.reshape(len(flat), -1)
            accessor |= {"min": table.min(axis=0).tolist(), "max": table.max(axis=0).tolist()}
        self._accessors.append(accessor)
        return len(self._accessors) - 1

    def content(self) -> bytes:
        return b"".join(self._parts)

    def described(self) -> dict[str, Any]:
        size = sum(map(len, self._parts))
        return {"accessors": self._accessors, "bufferViews": self._views, "buffers": [{"byteLength": size}]}


def _surfaces(shapes: Sequence[StateFields], view: View) -> list[Skin]:
    """Surfaces of all shapes with the same points, those that sides of cells share once."""
    field = view.field
    many = 4 * len(shapes[0].facts.surface) * len(shapes[0].facts.images) > RENDERING.triangles
    fine = 1 if many else 2
    plain = field.name in (CONTACT_PRESSURE, FIBER_TENSION)
    skins = [visible_skin(at, np.zeros(len(at.points)) if plain else field.read(at), parts=fine) for at in shapes]
    first = skins[0]
    patch = np.empty(len(first.points), dtype=np.int64)
    patch[first.triangles] = first.patch[:, None]
    size = float(np.ptp(first.points, axis=0).max())
    # points of one place at rest and of one smooth patch are one point, with one normal
    key = np.column_stack([np.round(first.points / size * 1e6).astype(np.int64), patch])
    _, chosen, place = np.unique(key, axis=0, return_index=True, return_inverse=True)
    triangles = place.ravel()[first.triangles]
    return [
        Skin(points=each.points[chosen], normals=each.normals[chosen], values=each.values[chosen], triangles=triangles,
             patch=first.patch)
        for each in skins
    ]  # fmt: skip


def _colors(skin: Skin, view: View) -> Array:
    """Colors of the points in linear light, (p, 3)."""
    share = (skin.values - view.floor) / (view.limit - view.floor)
    return np.asarray(view.field.color_map()(np.clip(share, 0, 1))[:, :3] ** GAMMA)


def _keys(count: int, seconds: float, back: bool) -> tuple[Array, Array]:
    """Times (k,) and weights (k, count) of the shapes: at each time one of them, and none at first."""
    weights = np.vstack([np.zeros(count), np.eye(count)])
    times = np.linspace(0.0, seconds, count + 1)
    if back:
        weights = np.vstack([weights, weights[-2::-1]])
        times = np.concatenate([times, seconds + times[1:]])
    return times, weights


def _write(path: Path, document: dict[str, Any], content: bytes) -> None:
    """Write the header, the document and the numbers, each filled up to a multiple of four bytes."""
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    content += b"\0" * (-len(content) % 4)
    size = 12 + 8 + len(text) + 8 + len(content)
    with path.open("wb") as stream:
        stream.write(struct.pack("<III", 0x46546C67, 2, size))
        stream.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
        stream.write(struct.pack("<II", len(content), 0x004E4942) + content)
