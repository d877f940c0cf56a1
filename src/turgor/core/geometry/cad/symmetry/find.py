"""Find the mirror planes and rotations that map a CAD part onto itself, with the names of its faces.

A face has a partner where a face of the same area and bodies has its center of mass at the image of its own center,
and lies about that center as its image does. Centers are those of facets: the CAD kernel integrates exactly over planes
and cylinders, but misses the center of a closed spline by 0.7 % of its size. `turgor.core.geometry.cad.symmetry.cut`
checks the volumes of both sides besides.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from turgor.core.geometry.cad.part import Part
from turgor.core.geometry.cad.symmetry.settings import SYMMETRY
from turgor.core.geometry.cad.symmetry.waves import returns, surface_waves

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class MirrorPlane:
    """A plane across an axis that maps a part onto itself.

    Parameters
    ----------
    normal : str
        ``"x"``, ``"y"`` or ``"z"``.
    position : float [CAD units]
        Coordinate of the plane along its normal.
    joined : tuple of (str, str)
        Names of faces that the plane maps onto each other, such as two cavities; empty if every name stays.
    """

    normal: str
    position: float
    joined: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class PartSymmetry:
    """Mirror planes and turns that map a part onto itself.

    Parameters
    ----------
    mirrors : tuple of MirrorPlane
        At most one for each coordinate axis.
    axis : str
        Axis of the rotations, empty if there are none.
    fold : int
        By how many equal turns about the axis the part returns to itself; 1 if by none, 0 for a body of revolution.
    center : (3,) tuple [CAD units]
        A point on that axis.
    """

    mirrors: tuple[MirrorPlane, ...]
    axis: str
    fold: int
    center: tuple[float, float, float]

    def __str__(self) -> str:
        planes = " and ".join(f"{plane.normal} = {_shown(plane.position)} mm" for plane in self.mirrors)
        parts = [f"mirror plane{'s' if len(self.mirrors) > 1 else ''} {planes}"] if planes else []
        if self.fold == 0:
            parts.append(f"a body of revolution about {self.axis} (wedges of any number of sectors)")
        elif self.fold > 1:
            parts.append(f"the same after each of {self.fold} turns about {self.axis} (wedge {self.fold})")
        return "; ".join(parts) or "none"


def find_symmetry(part: Part, names: Sequence[str]) -> PartSymmetry:
    """Find the mirror planes across x, y and z and the rotations about x, y and z of a part.

    The planes go through the middle of the box around the part, the axes through the mean of its surface.

    Parameters
    ----------
    part : Part
    names : sequence of str
        Name of each of its faces.
    """
    faces = _Faces.of(part, names)
    size = float(np.ptp(part.facets.points, axis=0).max())
    center = part.facets.points.min(axis=0) / 2 + part.facets.points.max(axis=0) / 2
    center[np.abs(center) < SYMMETRY.same * size] = 0.0  # a part made about the origin is symmetric about it
    mirrors = []
    for axis, letter in enumerate("xyz"):
        flip = np.eye(3)
        flip[axis, axis] = -1.0
        joined = faces.images(flip, center, SYMMETRY.same * size)
        if joined is not None:
            mirrors.append(MirrorPlane(normal=letter, position=float(center[axis]), joined=joined))
    middle = faces.middle(center, SYMMETRY.same * size)
    folds = [_fold((faces, part), axis, middle, SYMMETRY.same * size) for axis in range(3)]
    axis = folds.index(0) if 0 in folds else int(np.argmax(folds))
    x, y, z = (float(value) for value in middle)
    about = "" if folds[axis] == 1 else "xyz"[axis]
    return PartSymmetry(mirrors=tuple(mirrors), axis=about, fold=folds[axis], center=(x, y, z))


def joined_by_turn(
    part: Part, names: Sequence[str], symmetry: PartSymmetry, fold: int
) -> tuple[tuple[str, str], ...] | None:
    """Pairs of different names that a turn by 1/fold about the axis of a part joins; None if that is no symmetry."""
    faces, axis = _Faces.of(part, names), "xyz".index(symmetry.axis)
    size = float(np.ptp(part.facets.points, axis=0).max())
    center = np.array(symmetry.center)
    if not returns(surface_waves(part.facets, axis, center), fold):
        return None
    return faces.images(_turn(axis, 2 * np.pi / fold), center, SYMMETRY.same * size)


def _shown(position: float) -> str:
    return f"{position:.4g}"


def _fold(of: tuple["_Faces", Part], axis: int, center: Array, slack: float) -> int:
    """By how many equal turns about an axis a part returns to itself; 0 if by any turn."""
    faces, part = of
    turns = [SYMMETRY.any_angle, *(2 * np.pi / fold for fold in range(SYMMETRY.most_fold, 1, -1))]
    folds = [
        fold
        for fold, turn in zip((0, *range(SYMMETRY.most_fold, 1, -1)), turns, strict=True)
        if faces.images(_turn(axis, turn), center, slack) is not None
    ]
    if not folds:
        return 1
    waves = surface_waves(part.facets, axis, center)
    return next((fold for fold in folds if returns(waves, fold)), 1)


def _turn(axis: int, angle: float) -> Array:
    """Rotation about an axis."""
    turn = np.eye(3)
    b, c = (axis + 1) % 3, (axis + 2) % 3
    turn[b, b] = turn[c, c] = np.cos(angle)
    turn[c, b], turn[b, c] = np.sin(angle), -np.sin(angle)
    return turn


@dataclass(frozen=True, slots=True, eq=False)
class _Faces:
    """Areas (f,), centers (f, 3), second moments (f, 3, 3), names and bodies of the faces of a part."""

    areas: Array
    centers: Array
    moments: Array
    names: tuple[str, ...]
    bodies: tuple[frozenset[str], ...]

    @classmethod
    def of(cls, part: Part, names: Sequence[str]) -> "_Faces":
        owners: dict[object, set[str]] = {}
        for solid in part.shape.solids:
            for face in solid.faces:
                owners.setdefault(face, set()).add(str(solid.name))
        bodies = tuple(frozenset(owners[face]) for face in part.faces)
        areas = np.array([float(face.mass) for face in part.faces])
        lies = [_lies(part.facets.corners(np.array([i]))) for i in range(len(part.faces))]
        centers, moments = (np.array(each) for each in zip(*lies, strict=True))
        return cls(areas, centers, moments, tuple(names), bodies)

    def middle(self, center: Array, slack: float) -> Array:
        """Where an axis of rotation would go through: the mean of the surface, or a center that is as good."""
        mean = self.areas @ self.centers / self.areas.sum()
        mean[np.abs(mean) < slack] = 0.0
        return np.where(np.abs(mean - center) < slack, center, mean)

    def images(self, turn: Array, center: Array, slack: float) -> tuple[tuple[str, str], ...] | None:
        """Pairs of different names that a map joins, None if it does not map the part onto itself."""
        mapped = (self.centers - center) @ turn.T + center
        turned = turn @ self.moments @ turn.T
        tree = cKDTree(self.centers)
        joined: set[tuple[str, str]] = set()
        taken: set[int] = set()
        for i, near in enumerate(tree.query_ball_point(mapped, slack)):
            fits = [j for j in near if j not in taken and self._alike(i, j) and _near(turned[i], self.moments[j])]
            if not fits:
                return None
            same = [j for j in fits if self.names[j] == self.names[i]] or fits
            taken.add(same[0])
            if self.names[same[0]] != self.names[i]:
                first, second = sorted((self.names[i], self.names[same[0]]))
                joined.add((first, second))
        return tuple(sorted(joined))

    def _alike(self, i: int, j: int) -> bool:
        """Whether two faces have the same area and separate the same bodies."""
        equal = abs(self.areas[i] - self.areas[j]) <= SYMMETRY.same * max(self.areas[i], self.areas[j])
        return bool(equal) and self.bodies[i] == self.bodies[j]


def _lies(triangles: Array) -> tuple[Array, Array]:
    """Center (3,) of triangles (t, 3, 3), and their second moments of area (3, 3) about it."""
    middle = triangles.mean(axis=1)
    area = np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1) / 2
    center = area @ middle / area.sum()
    arms = np.concatenate([triangles.reshape(-1, 3), middle]) - center
    weights = np.concatenate([np.repeat(area / 12, 3), area * 9 / 12])
    return center, np.asarray(np.einsum("t,ti,tj->ij", weights, arms, arms))


def _near(first: Array, second: Array) -> bool:
    return bool(np.abs(first - second).max() <= SYMMETRY.alike * np.abs(first).max())
