"""Cylinder: a rigid round bar."""

from dataclasses import dataclass, field

import numpy as np

from turgor.core.model.obstacles.distances import from_center, outer
from turgor.core.model.obstacles.outlines import AROUND, frame, span
from turgor.core.model.obstacles.rigid_shape import (
    DIRECTION,
    SAME,
    Array,
    Distances,
    Ints,
    RigidShape,
    Vector,
    across,
    direction,
    in_mm,
    listed,
    positive,
)
from turgor.foundation.given import vector
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm


@dataclass(frozen=True, slots=True, kw_only=True)
class Cylinder(RigidShape):
    """A rigid round bar, endless or with flat ends.

    Parameters
    ----------
    center : (3,) floats [m]
        A point of its axis: the middle of a bar that has ends.
    axis : (3,) floats
        Direction of its axis; any length but zero.
    radius : float [m]
        More than 0.
    length : float [m], optional
        More than 0; endless if left out.
    """

    center: Vector
    axis: Vector = field(metadata=DIRECTION)
    radius: float
    length: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "center", vector(self.center, "cylinder: center", "length"))
        object.__setattr__(self, "axis", direction("cylinder: axis", self.axis))
        positive("cylinder: radius", self.radius)
        if self.length is not None:
            positive("cylinder: length", self.length)

    def text(self) -> str:
        """Return the shape and its place in words."""
        kind = "endless cylinder" if self.length is None else f"cylinder {self.length / mm:g} mm long"
        place = f"around {in_mm(self.center)} along ({listed(self.axis)})"
        return f"{kind} of radius {self.radius / mm:g} mm {place}"

    def turned(self, axis: int, center: Vector) -> bool:
        """Whether both axes are the same."""
        along = np.abs(across(self.axis, axis)).max() < SAME
        return bool(along and np.allclose(across(self.center, axis), across(center, axis), atol=SAME))

    def not_graspable(self, fingers: int) -> str:
        """The bar lies along x for more than two fingers, and along or across the mid-plane between two."""
        along = np.abs(self.axis)
        if fingers > 2 and along[0] < 1 - SAME:
            return f"{fingers} fingers stand around the line along x, and so must the cylinder's axis."
        inclined = SAME < along[2] < 1 - SAME
        return "the cylinder is inclined to the mid-plane, so that two fingers would differ." if inclined else ""

    def signed_distance(self, points: Array) -> Distances:
        """Compute the distance to the side, to an end, or to the edge between both."""
        axis = np.array(self.axis)
        from_middle = points - np.array(self.center)
        along = from_middle @ axis
        plane = np.eye(3) - np.outer(axis, axis)
        radial, out, bend = from_center(from_middle @ plane, plane, ROUND_OFF.zero * self.radius)
        side = radial - self.radius
        if self.length is None:
            return side, out, bend
        beyond = np.abs(along) - self.length / 2
        end = np.where(along < 0, -1.0, 1.0)[:, None] * axis
        on_end = beyond > side
        distance = np.where(on_end, beyond, side)
        gradient = np.where(on_end[:, None], end, out)
        hessian = np.where(on_end[:, None, None], 0.0, bend)
        rim = np.flatnonzero((side > 0) & (beyond > 0))  # nearest is the edge between the side and an end
        a, b = side[rim], beyond[rim]
        distance[rim] = np.hypot(a, b)
        a, b = (a / distance[rim])[:, None], (b / distance[rim])[:, None]
        gradient[rim] = a * out[rim] + b * end[rim]
        turned = b * out[rim] - a * end[rim]
        around = a[:, :, None] * bend[rim]
        hessian[rim] = outer(turned, turned) / distance[rim, None, None] + around
        return distance, gradient, hessian

    def outline(self, place: Array, extent: Array) -> tuple[Array, Ints]:
        """Return triangles of the bar with flat ends; an endless one ends a little beyond the actuator."""
        axis, center = np.array(self.axis), np.array(self.center)
        if self.length is None:
            ends = np.array(span(center + place, axis[None], extent)).ravel()
        else:
            ends = np.array([-0.5, 0.5]) * self.length
        first, second = frame(axis)
        angle = 2 * np.pi * np.arange(AROUND) / AROUND
        ring = center + self.radius * (np.outer(np.cos(angle), first) + np.outer(np.sin(angle), second))
        middle = center + np.outer(ends, axis)
        points = np.concatenate([ring + ends[0] * axis, ring + ends[1] * axis, middle])
        here = np.arange(AROUND)
        there = (here + 1) % AROUND
        below, above = np.full(AROUND, 2 * AROUND), np.full(AROUND, 2 * AROUND + 1)
        faces = ((here, there, there + AROUND), (here, there + AROUND, here + AROUND),
                 (below, there, here), (above, here + AROUND, there + AROUND))  # fmt: skip
        return points + place, np.concatenate([np.stack(face, axis=1) for face in faces])
