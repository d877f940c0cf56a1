"""Numbering: which unknowns of a section stand in the sparse core, and which in its border.

The core holds positions and mean stresses with a few components pinned, so that it is regular at given strains. The
border holds these pins, the strains of the rod, and the multipliers of the conditions that fix the section in its
frame: that the mean displacement of its solids and their mean rotation about x are zero.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.boundary import prescribed_components
from turgor.core.model.model import Model
from turgor.fast_models.section.kinematics import STRAINS
from turgor.fast_models.section.plane import Plane, area_weights, near_nodes, tables
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Numbering:
    """Unknowns of a section: components of its nodes, strains, mean stresses, multipliers, one after the other.

    Parameters
    ----------
    axes : (n, 3, 3) array
        Directions of the components of each node, in rows.
    conditions : (g, n, 3) array
        Weights of the displacements (global components) whose sum is zero.
    core, border : (size,) int arrays
        Place of each unknown in the core and in the border; −1 for none. A prescribed one has neither.
    first_mean, first_multiplier : int
        Numbers of the first mean stress and of the first multiplier.
    fixed : tuple of int
        Strains that mirror planes keep at rest.
    """

    axes: Array
    conditions: Array
    core: Ints
    border: Ints
    first_mean: int
    first_multiplier: int
    fixed: tuple[int, ...]

    @property
    def first_strain(self) -> int:
        """Number of the stretch of the rod."""
        return 3 * len(self.axes)

    @property
    def strains(self) -> Ints:
        """Places of the strains in the border."""
        return np.asarray(self.border[self.first_strain : self.first_strain + STRAINS])

    @property
    def constraints(self) -> int:
        """Mean stresses and multipliers: negative pivots of a stable section."""
        return len(self.core) - self.first_mean

    def of_nodes(self, nodes: Ints) -> Ints:
        """Unknowns (f, 3 n + 4) of nodes (f, n) and of the strains."""
        own = (3 * nodes[:, :, None] + np.arange(3)).reshape(len(nodes), -1)
        strains = np.broadcast_to(self.first_strain + np.arange(STRAINS), (len(nodes), STRAINS))
        return np.hstack([own, strains])

    def turned(self, nodes: Ints) -> tuple[Ints, Array]:
        """Pieces (f, n) with a node whose directions are not x, y, z, and the matrices (k, 3n, 3n) that turn them."""
        odd = np.asarray((np.abs(self.axes - np.eye(3)) > 0).any(axis=(1, 2)))
        chosen = np.flatnonzero(odd[nodes].any(axis=1))
        n = nodes.shape[1]
        out = np.zeros((len(chosen), n, 3, n, 3))
        for a in range(n):
            out[:, a, :, a, :] = self.axes[nodes[chosen, a]]
        return chosen, out.reshape(len(chosen), 3 * n, 3 * n)


def numbering_of(model: Model, plane: Plane, mean_count: int) -> Numbering:
    """Number the unknowns of a section.

    Raises
    ------
    TurgorError
        If a support is not one of a section.
    """
    _check_supports(model)
    is_fixed, axes = _prescribed_components(model, plane)
    mirrors = {axis for axis, _ in model.mesh.mirror_planes}
    centered = any(not support.mirror for support in model.supports)
    kinds = ["x", *("yz"[axis - 1] for axis in (1, 2) if axis not in mirrors and not centered)]
    kinds += [] if mirrors else ["turn"]
    conditions = _conditions(plane, kinds)
    pins = _pins(plane, kinds, is_fixed, axes)
    count = 3 * len(plane.points)
    size = count + STRAINS + mean_count + len(kinds)
    in_border = np.zeros(size, dtype=bool)
    in_border[pins] = True
    in_border[count : count + STRAINS] = True
    in_border[size - len(kinds) :] = True
    prescribed = np.zeros(size, dtype=bool)
    prescribed[:count] = is_fixed.ravel()
    core, border = np.full(size, -1), np.full(size, -1)
    free = ~prescribed & ~in_border
    core[free] = np.arange(free.sum())
    border[in_border] = np.arange(in_border.sum())
    still = {frozenset(): (), frozenset({1}): (1, 3), frozenset({2}): (1, 2), frozenset({1, 2}): (1, 2, 3)}
    return Numbering(
        axes=axes,
        conditions=conditions,
        core=core,
        border=border,
        first_mean=count + STRAINS,
        first_multiplier=size - len(kinds),
        fixed=still[frozenset(mirrors)],
    )


def _check_supports(model: Model) -> None:
    for support in model.supports:
        if not support.in_sections:
            raise TurgorError(
                f"{type(support).__name__} of '{support.place}' is no support of a section, which is "
                "free along a long actuator; Radial and mirror planes are."
            )


def _prescribed_components(model: Model, plane: Plane) -> tuple[Flags, Array]:
    """Prescribed components (n, 3) of the nodes of the section, and the directions of these components."""
    supports = prescribed_components(model)
    place = near_nodes(plane)
    axes = np.tile(np.eye(3), (len(model.mesh.points), 1, 1))
    axes[supports.frames.nodes] = supports.frames.axes
    return supports.mask[place], axes[place]


def _conditions(plane: Plane, kinds: list[str]) -> Array:
    """Weights (g, n, 3): the mean displacement, and the mean rotation about x."""
    areas = area_weights(plane.points, plane.quads)
    summed = np.bincount(plane.quads.ravel(), (areas @ tables().N).ravel(), minlength=len(plane.points))
    shares: Array = summed / summed.sum()
    out = np.zeros((len(kinds), len(plane.points), 3))
    for row, kind in zip(out, kinds, strict=True):
        if kind == "turn":
            y, z = plane.points[:, 1], plane.points[:, 2]
            spread = shares @ (y**2 + z**2)
            row[:, 1], row[:, 2] = -shares * z / spread, shares * y / spread
        else:
            row[:, "xyz".index(kind)] = shares
    return out


def _pins(plane: Plane, kinds: list[str], is_fixed: Flags, axes: Array) -> Ints:
    """Unknowns that stand in the border, so that the core cannot move as a whole."""
    free = np.flatnonzero(~is_fixed.any(axis=1) & (np.abs(axes - np.eye(3)) == 0).all(axis=(1, 2)))
    far = free[np.linalg.norm(plane.points[free], axis=1).argmax()]
    pins = [3 * far + "xyz".index(kind) for kind in kinds if kind != "turn"]
    if "turn" in kinds:
        arm = plane.points[free] - (plane.points[far] if "y" in kinds else 0.0)
        other = free[np.linalg.norm(arm, axis=1).argmax()]
        along = np.abs(plane.points[other] - (plane.points[far] if "y" in kinds else 0.0))
        pins.append(3 * other + (1 if along[2] > along[1] else 2))
    return np.array(pins)
