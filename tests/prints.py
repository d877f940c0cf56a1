"""Surfaces as slicers and scanners write them: twelve parts of our own make, three of them rough."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from manifold3d import CrossSection, Manifold, Mesh64

from turgor.core.meshing.exchange.formats.stl import stl_bytes

RNG = 7


@dataclass(frozen=True)
class Print:
    """Triangles (t, 3, 3) [mm], volumes of the rubber and of its cavities [mm³], and how far the surface may be off."""

    corners: np.ndarray
    solid: float
    cavities: tuple[float, ...]
    tolerance: float = 1e-6

    def write(self, path: Path) -> Path:
        """Write the surface as binary STL."""
        triangles = np.arange(3 * len(self.corners)).reshape(-1, 3)
        path.write_bytes(stl_bytes(self.corners.reshape(-1, 3), triangles))
        return path


def corners_of(body: Manifold) -> np.ndarray:
    mesh = body.to_mesh64()
    return np.asarray(mesh.vert_properties)[:, :3][np.asarray(mesh.tri_verts).astype(np.int64)]


def rounded_box(low: tuple[float, ...], high: tuple[float, ...], radius: float) -> Manifold:
    """A box with rounded edges."""
    ball = Manifold.sphere(radius, 16)
    spots = [[a + radius, b - radius] for a, b in zip(low, high, strict=True)]
    balls = [ball.translate((x, y, z)) for x in spots[0] for y in spots[1] for z in spots[2]]
    return Manifold.batch_hull(balls)


def box(low: tuple[float, ...], high: tuple[float, ...]) -> Manifold:
    return Manifold.cube(tuple(b - a for a, b in zip(low, high, strict=True))).translate(low)


def along_x(radius: float, start: float, end: float, segments: int = 32) -> Manifold:
    return Manifold.cylinder(end - start, radius, radius, segments).rotate((0, 90, 0)).translate((start, 0, 0))


def parted(outside: Manifold, *cavities: Manifold) -> Print:
    """One body with closed cavities."""
    body = outside
    for cavity in cavities:
        body = body - cavity
    return Print(corners_of(body), body.volume(), tuple(cavity.volume() for cavity in cavities))


def chambers(count: int = 3) -> tuple[list[Manifold], list[Manifold]]:
    """Rounded chambers on a base, and the hollows within them with their channel."""
    outer = [box((0, -7, 0), (12 * count, 7, 4))]
    inner = [box((3, -1, 1.6), (12 * count - 3, 1, 2.6))]
    for i in range(count):
        outer.append(rounded_box((12 * i + 1, -7, 0.5), (12 * i + 11, 7, 15), 1.2))
        inner.append(rounded_box((12 * i + 2.6, -5.4, 1.6), (12 * i + 9.4, 5.4, 13.4), 1.0))
    return outer, inner


def union(bodies: list[Manifold]) -> Manifold:
    out = bodies[0]
    for body in bodies[1:]:
        out = out + body
    return out


def finger() -> Print:
    """A PneuNet with fillets."""
    outer, inner = chambers()
    return parted(union(outer), union(inner))


def overlapping() -> Print:
    """The same finger whose chambers and base were never united, as some slicers accept."""
    outer, inner = chambers()
    whole = parted(union(outer), union(inner))
    cavity = corners_of(union(inner))[:, ::-1]
    return Print(np.concatenate([*map(corners_of, outer), cavity]), whole.solid, whole.cavities)


def flipped() -> Print:
    """The finger with a third of its facets turned over."""
    made = finger()
    turned = np.random.default_rng(RNG).random(len(made.corners)) < 1 / 3
    return Print(np.where(turned[:, None, None], made.corners[:, ::-1], made.corners), made.solid, made.cavities)


def doubled() -> Print:
    """The finger with some facets twice, and with flat ones."""
    made = finger()
    some = np.random.default_rng(RNG).choice(len(made.corners), 40, replace=False)
    flat = made.corners[some][:, [0, 1, 1]]
    return Print(np.concatenate([made.corners, made.corners[some], flat]), made.solid, made.cavities)


def open_inlet() -> Print:
    """A tube whose inlet was cut off: the cap of the channel is missing in the outside and in the cavity."""
    body = along_x(8, 0, 50) - along_x(5, 4, 46)
    made = Print(corners_of(body), body.volume(), (along_x(5, 4, 46).volume(),))
    end = (made.corners[:, :, 0] > 49.999).all(axis=1)
    return Print(made.corners[~end], made.solid, made.cavities)


def punctured() -> Print:
    """The finger with six facets missing."""
    made = finger()
    area = np.linalg.norm(
        np.cross(made.corners[:, 1] - made.corners[:, 0], made.corners[:, 2] - made.corners[:, 0]), axis=1
    )
    missing = np.argsort(area, kind="stable")[len(area) // 2 :: len(area) // 13][:6]
    return Print(np.delete(made.corners, missing, axis=0), made.solid, made.cavities, 2e-3)


def bellows() -> Print:
    """Three round folds with a closed cavity."""
    x = np.linspace(0, 36, 37)
    outside = 8 + 2.5 * np.sin(np.pi * x / 12) ** 2
    profile = np.column_stack([np.append(outside, [0, 0]), np.append(x, [36, 0])])
    inner = (x >= 2) & (x <= 34)
    hollow = np.column_stack([np.append(outside[inner] - 1.6, [0, 0]), np.append(x[inner], [34, 2])])
    solid, void = (
        Manifold.revolve(CrossSection([np.ascontiguousarray(each)]), 48).rotate((0, 90, 0))
        for each in (profile, hollow)
    )
    return parted(solid, void)


def omnidirectional() -> Print:
    """A cylinder with three round chambers."""
    holes = [
        along_x(2.5, 3, 37).translate((0, 5 * np.cos(angle), 5 * np.sin(angle)))
        for angle in np.array([90, 210, 330]) * np.pi / 180
    ]
    return parted(along_x(9, 0, 40, 48), *holes)


def half_round() -> Print:
    """A bender with a half-round section."""
    outside = along_x(8, 0, 50, 48) ^ box((0, -8, 0), (50, 8, 8))
    hollow = along_x(6.5, 3, 47, 48) ^ box((3, -7, 4), (47, 7, 7))
    return parted(outside, hollow)


def rough(make: Callable[[], Print], length: float, noise: float) -> Print:
    """A scan of a print: many facets, whose corners are off by a random distance."""
    made = make()
    points, places = np.unique(made.corners.reshape(-1, 3), axis=0, return_inverse=True)
    body = Manifold(Mesh64(points, places.reshape(-1, 3).astype(np.uint64))).refine_to_length(length)
    mesh = body.to_mesh64()
    points = np.asarray(mesh.vert_properties)[:, :3].copy()
    points += np.random.default_rng(RNG).uniform(-noise, noise, points.shape)
    return Print(points[np.asarray(mesh.tri_verts).astype(np.int64)], made.solid, made.cavities, 0.02)


def rough_tube() -> Print:
    """A scanned tube with a closed cavity."""
    return rough(lambda: parted(along_x(8, 0, 50), along_x(5, 4, 46)), 2.5, 0.04)


def rough_bender() -> Print:
    """A scanned bender."""
    return rough(half_round, 2.5, 0.04)


def rough_omnidirectional() -> Print:
    """A scanned cylinder with three chambers."""
    return rough(omnidirectional, 2.5, 0.04)


PRINTS: dict[str, Callable[[], Print]] = {
    make.__name__: make
    for make in (
        finger,
        overlapping,
        flipped,
        doubled,
        open_inlet,
        punctured,
        bellows,
        omnidirectional,
        half_round,
        rough_tube,
        rough_bender,
        rough_omnidirectional,
    )
}
