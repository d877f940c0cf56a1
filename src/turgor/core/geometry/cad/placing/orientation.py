"""How a part lies in its file: its axis from the face fixed to the face tip, and which way is up."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.part import Part
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.foundation.finding import Finding, Severity

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class OrientationSettings:
    """When faces show how a part lies; `test_cad_axes` needs the numbers.

    Parameters
    ----------
    plane : float
        The face fixed is plane if the mean of its normals is longer than this. A plane wall whose normal is so near to
        the upward direction (cosine of 25°) shows it better than the middle of cavities.
    ahead : float
        The face fixed shows the axis if the face tip lies in front of it: cosine of 60°. Where it does not show it, the
        tip may lie this far off x without a finding.
    off : float
        What is off the middle by a smaller share of the size of the part does not show which way is up.
    """

    plane: float = 0.9
    ahead: float = 0.5
    off: float = 0.005


ORIENTATION = OrientationSettings()


def rotation_along_x(part: Part, names: Sequence[str]) -> tuple[Array | None, bool]:
    """Find the rotation after which a part lies along x.

    Parameters
    ----------
    part : Part
    names : sequence of str
        Name of each of its faces.

    Returns
    -------
    rotation : (3, 3) array or None
        Our x, y and z in the axes of the file; None where the part lies along x, or its axis does not show.
    clear : bool
        Whether its axis shows, or there is none because a face has no name.
    """
    fixed, tip = (_triangles(part, [i for i, name in enumerate(names) if name == end]) for end in ("fixed", "tip"))
    if fixed is None or tip is None:
        return None, True
    areas = np.cross(fixed[:, 1] - fixed[:, 0], fixed[:, 2] - fixed[:, 0])
    inward = -areas.sum(axis=0) / max(float(np.linalg.norm(areas, axis=1).sum()), 1e-300)
    toward = _unit(_middle(tip) - _middle(fixed))
    if np.linalg.norm(inward) < ORIENTATION.plane or _unit(inward) @ toward < ORIENTATION.ahead:
        return None, bool(toward[0] > ORIENTATION.ahead)
    x = _unit(inward)
    if x[0] > TOLERANCE.direction:
        return None, True
    z = _up(part, names, x)
    return np.stack([x, np.cross(z, x), z]), True


def _up(part: Part, names: Sequence[str], x: Array) -> Array:
    """Direction across the axis away from the strain-limiting layer, from the base, or toward the cavities.

    Without any of them z stays as near to that of the file as the turn of the axis allows.
    """
    size = float(np.ptp(part.facets.points, axis=0).max())
    everything = _middle(part.facets.corners())
    layer = _triangles(part, [i for i, name in enumerate(names) if name == "strain_limiting_layer"])
    base = _triangles(part, [i for i, owners in enumerate(part.owners) if owners == ("base",)])
    cavity = _triangles(part, [i for i, name in enumerate(names) if name.startswith("cavity")])
    offsets = [everything - _middle(below) for below in (layer, base) if below is not None]
    offsets += [_centroid(cavity) - _centroid(part.facets.corners()[part.facets.outer])] if cavity is not None else []
    for offset in offsets:
        across = offset - (offset @ x) * x
        if np.linalg.norm(across) > ORIENTATION.off * size:
            return _upright(part, x, _unit(across))
    return _turned_least(x)


def _upright(part: Part, x: Array, up: Array) -> Array:
    """The normal of a plane wall along the axis that is nearest to a direction, if one is near."""
    normals = [np.array(item.normal) for item in part.items if item.normal is not None]
    across = [_unit(n - (n @ x) * x) * np.sign(n @ up) for n in normals if abs(n @ x) < 1e-3]
    best = max(across, key=lambda normal: float(normal @ up), default=up)
    return best if best @ up > ORIENTATION.plane else up


def _turned_least(x: Array) -> Array:
    """Z after the smallest turn that takes the x of the file to an axis."""
    first = np.array([1.0, 0.0, 0.0])
    about = np.cross(first, x)
    if np.linalg.norm(about) < 1e-9:
        return np.array([0.0, 0.0, 1.0])
    z = np.array([0.0, 0.0, 1.0])
    return np.asarray(z + np.cross(about, z) + np.cross(about, np.cross(about, z)) / (1 + first @ x))


def turned_axes(rotation: Array) -> str:
    """Write the axes of a rotation as the key ``axes`` takes them."""
    if np.abs(np.abs(rotation).max(axis=1) - 1).max() < 1e-6:
        places = np.abs(rotation).argmax(axis=1)
        named = [f"{'-' if row[place] < 0 else ''}{'xyz'[place]}" for row, place in zip(rotation, places, strict=True)]
        return "[" + ", ".join(f'"{axis}"' for axis in named) + "]"
    return "[" + ", ".join("[" + ", ".join(f"{value + 0.0:.6g}" for value in row) + "]" for row in rotation) + "]"


def placing_finding(part: Part, rotation: Array | None) -> Finding:
    """Say that a part was turned, or that it does not lie along x and its axis does not show (D08)."""
    if rotation is None:
        return Finding(
            code="D08",
            severity=Severity.WARNING,
            message=f"'{part.path.name}' does not lie along x, from the face fixed to the face tip, and these faces do "
            "not show its axis.",
            advice="Bending angle, curvature, ballooning and other measures count along x: state the directions in the "
            'file of our x, y and z, such as axes = ["z", "x", "y"]; axes = ["x", "y", "z"] leaves it as it is.',
        )
    return Finding(
        code="D08",
        severity=Severity.WARNING,
        message=f"'{part.path.name}' does not lie along x of its file: it was turned so that x leads from the face "
        f"fixed to the face tip and z up, axes = {turned_axes(rotation)}.",
        advice="Selectors of faces, regions and the split are in the axes of the file; loads, obstacles, markers and "
        "measures are in the new ones, which pictures show. If you state these axes, selectors are in them too.",
    )


def _triangles(part: Part, faces: Sequence[int]) -> Array | None:
    return part.facets.corners(np.array(faces)) if len(faces) else None


def _middle(triangles: Array) -> Array:
    """Centroid of a surface."""
    areas = np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)
    return np.asarray(areas @ triangles.mean(axis=1) / max(float(areas.sum()), 1e-300))


def _centroid(triangles: Array) -> Array:
    """Centroid of the volume within a surface, up to small openings; whichever way it faces."""
    start = _middle(triangles)
    a, b, c = (triangles[:, i] - start for i in range(3))
    parts = np.einsum("ti,ti->t", a, np.cross(b, c))
    return np.asarray(start + parts @ (a + b + c) / 4 / (parts.sum() or 1.0))


def _unit(vector: Array) -> Array:
    return np.asarray(vector / max(float(np.linalg.norm(vector)), 1e-300))
