"""Prescribed motion: which unknowns of reference points are prescribed, and how those of their faces follow them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.points.point_unknowns import Carrier
from turgor.core.model.model import Model
from turgor.core.model.points import Hinge, Rotation
from turgor.foundation.errors import TurgorError
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Pairs of arrows whose product each multiplier prescribes.
PAIRS = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))


@dataclass(frozen=True, slots=True, eq=False)
class Turned:
    """How the arrows of a point move in a prescribed rotation, like the value of a `Displacement`."""

    rotation: Rotation
    radius: float

    def displacement(self, points: Array, load_factor: float) -> Array:
        """Change of the arrows (3, 3) [m], one in each row; r θ (1, 3) [m] where the axis may tilt."""
        if self.rotation.tilts:
            return np.array([[self.radius * self.rotation.angle_at(load_factor), 0.0, 0.0]])
        return self.radius * (self.rotation.matrix(load_factor).T - np.eye(3))


def hold_points(model: Model, carriers: Sequence[Carrier], mask: NDArray[np.bool_]) -> list[tuple[Ints, Turned]]:
    """Mark the prescribed components of the points' nodes in ``mask``, in place; return the arrows that are turned.

    The displacements of the points are marked already. Mirror planes and wedges hold what would differ in an image. A
    multiplier is prescribed where all components that it constrains are prescribed.
    """
    rotations = {each.point: each for each in model.supports if isinstance(each, Rotation)}
    hinges = {each.point: each for each in model.supports if isinstance(each, Hinge)}
    moving = []
    for carrier in carriers:
        name = carrier.point.name
        arrows = np.zeros((3, 3), dtype=bool)
        for axis in carrier.unturned:
            arrows[axis] = arrows[:, axis] = True
        if carrier.bearing is not None:
            mask[carrier.bolts] = [isinstance(carrier.bearing, Rotation)] * 2 + [name in hinges], [True] * 3
        elif name in hinges:
            arrows |= any(hinges[name].direction[k] for k in range(3) if k not in carrier.unturned)
        if name in rotations:
            turned, driven = Turned(rotations[name], carrier.radius), rotations[name].tilts and not carrier.unturned
            _check_mirror(carrier, rotations[name])
            arrows |= not driven
            moving.append((carrier.bolts[1:] if driven else carrier.arrows, turned))
        _check_moves(model, carrier)
        mask[carrier.arrows] = arrows
        mask[carrier.node, list(carrier.blocked)] = True
        mask[carrier.stress] = _settled(arrows).reshape(2, 3)
        if not carrier.rigid:
            mask[carrier.ties[0], list(carrier.blocked)] = True
            mask[carrier.ties[1], [k for k in range(3) if k not in carrier.turning]] = True
    return moving


def _settled(arrows: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Which products of arrows (6,) have their value already, because of prescribed components (3, 3)."""
    zero = arrows & ~np.eye(3, dtype=bool)
    if arrows.all():
        return np.ones(6, dtype=bool)
    return np.array([not ((~arrows[i] & ~zero[j]) | (~arrows[j] & ~zero[i])).any() for i, j in PAIRS])


def _check_mirror(carrier: Carrier, rotation: Rotation) -> None:
    for axis in carrier.unturned:
        if rotation.angle and any(rotation.axis[k] for k in range(3) if k != axis):
            what = "mirror plane" if axis in carrier.mirrored else "wedge"
            raise TurgorError(
                f"rotation of '{carrier.point.name}': its axis is {rotation.axis}; a {what} cuts the face, so "
                f"that it can turn about {'xyz'[axis]} only; model the whole actuator (symmetric = false)."
            )


def _check_moves(model: Model, carrier: Carrier) -> None:
    for each in model.supports:
        if not each.moves or each.place != carrier.point.name:
            continue
        end = np.broadcast_to(each.displacement(carrier.at[None], 1.0), (1, 3))[0]
        for axis in carrier.blocked:
            if "xyz"[axis] in each.prescribed[1] and end[axis]:
                why = "a mirror plane" if axis in carrier.mirrored else "a wedge"
                raise TurgorError(
                    f"displacement of '{carrier.point.name}': {end[axis] / mm:.4g} mm along {'xyz'[axis]} has no "
                    f"symmetric image, for {why} cuts the face; model the whole actuator (symmetric = false)."
                )


def rigid_ties(carriers: Sequence[Carrier]) -> tuple[Ints, Ints, Array]:
    """Degrees of freedom of rigid faces, those that they follow, and the weights: u = u_P + Σ Dᵢ vᵢ / r, (k,) each.

    The multipliers stand among those with a weight of zero: they are then coupled to whatever their arrows are coupled
    to, and a solver that pivots finds both in one front.
    """
    followers, leaders, weights = [], [], []
    for each in carriers:
        if not each.rigid:
            continue
        nothing = np.zeros((len(each.nodes), each.count - 4))
        shares = np.column_stack([np.ones(len(each.nodes)), each.arms / each.radius, nothing])
        for axis in range(3):
            followers.append(np.repeat(3 * each.nodes + axis, each.count))
            leaders.append(np.tile(3 * (each.node + np.arange(each.count)) + axis, len(each.nodes)))
            weights.append(shares.ravel())
    none = np.zeros(0, dtype=np.int64)
    return (
        np.concatenate([none, *followers]),
        np.concatenate([none, *leaders]),
        np.concatenate([np.zeros(0), *weights]),
    )


def check_rigid(carriers: Sequence[Carrier], mask: NDArray[np.bool_], taken: Ints) -> None:
    """Refuse a rigid face of which nodes are fixed by other supports, other than mirror planes, or tied twice.

    Parameters
    ----------
    carriers : sequence of Carrier
    mask : (n, 3) bool array
        Components that supports other than mirror planes hold.
    taken : (k,) int array
        Nodes with other ties or directions.
    """
    point_of: dict[int, str] = {}
    for each in carriers:
        if not each.rigid:
            continue
        count = int((mask[each.nodes].any(axis=1) | np.isin(each.nodes, taken)).sum())
        if count:
            raise TurgorError(
                f"reference point '{each.point.name}': {count} of the {len(each.nodes)} nodes of its rigid face "
                f"'{each.point.face}' are fixed by another support; remove one of both."
            )
        for node in each.nodes.tolist():
            if node in point_of:
                raise TurgorError(
                    f"reference points '{point_of[node]}' and '{each.point.name}': their rigid faces share nodes; tie "
                    "both faces to one point, or make one of them averaging."
                )
        point_of |= dict.fromkeys(each.nodes.tolist(), each.point.name)
