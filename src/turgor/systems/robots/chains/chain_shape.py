"""Chain shape: where the joints of a chain lie, its coordinates from the frames of slices, masses and capsules."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import lsq_linear

from turgor.core.engine.faces.surfaces import side_areas
from turgor.core.engine.mass import cell_volumes, densities
from turgor.core.model.model import Model
from turgor.core.results.fields.state_fields import MeshFacts
from turgor.systems.robots.backbone import Array, Backbone
from turgor.systems.robots.chains.chain import SLIDE, TURN_Y, TURN_Z

#: A joint lies in the middle between its slices unless the samples say otherwise: weight of this, over a radian's.
MIDDLE = 0.02

#: A joint is at least this share of the step away from both of its slices.
ENDS = 0.1

#: Turns below this share of the others are none.
FLAT = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """Where joints lie: a is a joint in the frame of the slice before, b the slice behind it from there, at rest.

    Parameters
    ----------
    before, behind : (n, 3) arrays [m]
    kinds : tuple of int
        As in `Chain`.
    """

    before: Array
    behind: Array
    kinds: tuple[int, ...]

    def pivots(self, base: Array) -> Array:
        """Origins (n, 3) of the links, each in the frame of the one before."""
        return np.concatenate([[base + self.before[0]], self.behind[:-1] + self.before[1:]])

    def coordinates(self, frames: tuple[Array, Array]) -> Array:
        """Coordinates (d,) of frames of slices (m + 1)."""
        relative, steps = steps_of(frames)
        angles = angles_of(relative)
        away = np.einsum("mba,mb->ma", relative, steps - self.before) - self.behind
        every = {TURN_Y: angles[:, 0], TURN_Z: angles[:, 1], SLIDE: away[:, 0]}
        return np.column_stack([every[kind] for kind in self.kinds]).ravel()


def steps_of(frames: tuple[Array, Array]) -> tuple[Array, Array]:
    """Rotation and place of each slice in the frame of the one before."""
    turns, places = frames
    back = np.swapaxes(turns[:-1], 1, 2)
    return back @ turns[1:], np.einsum("mab,mb->ma", back, np.diff(places, axis=0))


def angles_of(relative: Array) -> Array:
    """Angles (m, 2) about y, then z, that turn x as rotations (m, 3, 3) do; twist is left out."""
    x, y, z = np.moveaxis(relative[:, :, 0], 1, 0)
    return np.column_stack([np.arctan2(-z, x), np.arcsin(np.clip(y, -1, 1))])


def shape_of(backbone: Backbone, samples: list[tuple[Array, Array]], slide: bool) -> Shape:
    """Place the joints so that rigid links between them follow frames of slices as closely as possible.

    Parameters
    ----------
    backbone : Backbone
    samples : list of (turns, places)
    slide : bool
        Whether joints slide, too.
    """
    rest = np.concatenate([backbone.base[None], [each.center for each in backbone.slices]])
    steps = np.diff(rest, axis=0)
    angles = np.array([angles_of(steps_of(frames)[0]) for frames in samples])
    most = np.abs(angles).max(axis=(0, 1))
    kinds = [kind for kind, size in zip((TURN_Y, TURN_Z), most, strict=True) if size > FLAT * most.max()]
    rows, right = [MIDDLE * len(steps) * np.eye(steps.size)], [MIDDLE * len(steps) * 0.5 * steps.ravel()]
    for turns, places in samples:
        matrix = turns[:-1] - turns[1:]  # the place of a slice is a sum of these on all joints before it
        rest_of = np.cumsum(np.einsum("mab,mb->ma", turns[1:], steps), axis=0)
        away = places[1:] - backbone.base - rest_of
        for last in range(len(steps)):
            block = np.zeros((3, *steps.shape))
            block[:, : last + 1] = np.moveaxis(matrix[: last + 1], 0, 1)
            flat, value = block.reshape(3, -1), away[last]
            if slide:  # what is along the turned axis, the slide takes
                across = np.eye(3) - np.outer(turns[last + 1][:, 0], turns[last + 1][:, 0])
                flat, value = across @ flat, across @ value
            rows.append(flat)
            right.append(value)
    low, high = np.full(steps.shape, -np.inf), np.full(steps.shape, np.inf)
    low[:, 0], high[:, 0] = ENDS * steps[:, 0], (1 - ENDS) * steps[:, 0]
    solved = lsq_linear(np.concatenate(rows), np.concatenate(right), bounds=(low.ravel(), high.ravel()))
    before = solved.x.reshape(steps.shape)
    return Shape(before, steps - before, (*kinds, *([SLIDE] if slide else [])))


@dataclass(frozen=True, slots=True, eq=False)
class Bodies:
    """What the links weigh, and their capsules, as in `Chain`."""

    masses: Array
    centers: Array
    inertias: Array
    capsules: Array


def bodies_of(model: Model, links: int, origins: Array | None = None, at_base: bool = False) -> Bodies:
    """Share rubber and sheets among links by where it is at rest.

    Parameters
    ----------
    model : Model
    links : int
    origins : (n, 3) array [m], optional
        Of the links at rest; those of space by default.
    at_base : bool
        Whether the first link begins at the base; otherwise half a link there does not move.
    """
    mesh, images = model.mesh, MeshFacts(model.mesh).images
    weights, middles = _pieces(model)
    x = mesh.points[:, 0]
    ends = x.min() + np.ptp(x) * np.append((np.arange(links) + (0.0 if at_base else 0.5)) / links, 1.0)
    origins = np.zeros((links, 3)) if origins is None else origins
    masses, centers, inertias, capsules = [], [], [], []
    for origin, low, high in zip(origins, ends[:-1], ends[1:], strict=True):
        inside = (middles[:, 0] >= low) & (middles[:, 0] < high)
        places = np.concatenate([image.of(middles[inside]) for image in images]) - origin
        weight = np.tile(weights[inside], len(images))
        mass = float(weight.sum())
        center = weight @ places / mass
        square = weight @ (places - center) ** 2
        masses.append(mass)
        centers.append(center)
        # a cell counts as a point, so a link has at least the inertia of a ball of 2 mm
        inertias.append(square.sum() - square + mass * 1e-6)
        near = (x >= low - 1e-9) & (x <= high + 1e-9)
        capsules.append(_capsule(np.concatenate([image.of(mesh.points[near]) for image in images]) - origin))
    return Bodies(np.array(masses), np.array(centers), np.array(inertias), np.array(capsules))


def _pieces(model: Model) -> tuple[Array, Array]:
    """Masses (k,) of all cells and of the sides of sheets, and their middles (k, 3)."""
    mesh = model.mesh
    weights = [densities(model) * cell_volumes(mesh)]
    middles = [mesh.points[mesh.cells[:, : mesh.cell_type.corners]].mean(axis=1)]
    for name, mass in model.sheet_masses.items():
        sides = mesh.face(name)
        weights.append(mass * side_areas(mesh.points, sides))
        middles.append(mesh.points[sides[:, : mesh.cell_type.side.corners]].mean(axis=1))
    return np.concatenate(weights), np.concatenate(middles)


def _capsule(places: Array) -> Array:
    """Ends and radius of a capsule along x that fills the smaller of height and width of a piece (k, 3)."""
    low, high = places.min(axis=0), places.max(axis=0)
    radius, middle, length = float((high - low)[1:].min()) / 2, (low + high)[1:] / 2, float(high[0] - low[0])
    inset = min(radius, 0.45 * length)
    return np.array([low[0] + inset, *middle, high[0] - inset, *middle, radius])
