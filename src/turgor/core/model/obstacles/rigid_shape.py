"""RigidShape: the base of the shapes of obstacles, with everything that follows from one.

A shape is a frozen dataclass that inherits `RigidShape`, in a file of its own. It answers what contact, checks, setups,
pictures, reports and job files need to know; nothing else asks for its class.
"""

from collections.abc import Iterable
from dataclasses import Field, fields, replace
from typing import Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.directions import normalized
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import vector
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]
Vector = tuple[float, float, float]
Own = TypeVar("Own", bound="RigidShape")

#: Distance, gradient, Hessian.
Distances = tuple[Array, Array, Array]

#: Two directions are the same, and a point lies on an axis [m], up to this.
SAME = ROUND_OFF.same

#: Dimension of a field that does not change with the unit of length.
DIRECTION = {"dimension": "direction"}


class RigidShape:
    """The shape of an obstacle, and all that follows from it; `Plane`, `Sphere` and the like inherit it.

    It gives its distance as a formula, and triangles for pictures. A shape of triangles inherits `TriangulatedShape`
    instead. Its numbers are lengths, unless the field says otherwise: ``field(metadata={"dimension": "direction"})``.
    """

    __slots__ = ()

    #: Whether the name of its file names it in job files; a dataclass without a file of its own there has none.
    in_job_files: ClassVar[bool] = True

    def text(self) -> str:
        """Return the shape and its place in words."""
        return type(self).__name__.lower()

    def signed_distance(self, points: Array) -> Distances:
        """Compute the signed distance of points, where the shape has not moved.

        The distance is positive outside. Inside, the nearest part of the surface counts, so that the distance is smooth
        across the surface wherever the surface is. The Hessian is exact wherever the distance is twice differentiable;
        on the planes between two regions, such as those through the ends of a cylinder, it is that of one of them.

        Parameters
        ----------
        points : (k, 3) array
            In the unit of the shape's lengths.

        Returns
        -------
        distance : (k,) array
            Positive outside, negative inside; in the same unit.
        gradient : (k, 3) array [-]
            The unit normal at the nearest point of the surface, out of the body.
        hessian : (k, 3, 3) array [1/length]

        Examples
        --------
        >>> from turgor.core.model.obstacles import Sphere
        >>> distance, gradient, hessian = Sphere(center=(0, 0, 0), radius=2.0).signed_distance(np.array([[5.0, 0, 0]]))
        >>> distance, gradient
        (array([3.]), array([[1., 0., 0.]]))
        >>> hessian[0].diagonal()
        array([0. , 0.2, 0.2])
        """
        raise TurgorError(f"shape {type(self).__name__} has no method signed_distance, which gives its distance.")

    def surface(self) -> tuple[Array, Ints] | None:
        """Return points (p, 3) [m] and triangles (t, 3) by which contact computes the distance; None with a formula."""
        return None

    def outline(self, place: Array, extent: Array) -> tuple[Array, Ints]:
        """Triangulate the surface for pictures and for ParaView.

        Planes and endless cylinders end a little beyond the extent of the actuator.

        Parameters
        ----------
        place : (3,) array [m]
            Displacement of the obstacle.
        extent : (2, 3) array [m]
            Least and greatest coordinates of the actuator.

        Returns
        -------
        points : (p, 3) array [m]
        triangles : (t, 3) int array
            Counterclockwise seen from outside.

        Examples
        --------
        >>> from turgor.core.model.obstacles import Plane
        >>> ground = Plane(point=(0, 0, -1e-3), normal=(0, 0, 1))
        >>> points, triangles = ground.outline(np.zeros(3), np.array([[0, 0, 0], [0.1, 0.02, 0.02]]))
        >>> np.ptp(points, axis=0).round(6).tolist()
        [0.13, 0.05, 0.0]
        """
        raise TurgorError(f"shape {type(self).__name__} has no method outline, which gives triangles for pictures.")

    def scaled(self: Own, length: float) -> Own:
        """Return a shape with a formula, its lengths in units of a length [m].

        Examples
        --------
        >>> from turgor.core.model.obstacles import Sphere
        >>> Sphere(center=(0, 0, 0.002), radius=0.004).scaled(0.001)
        Sphere(center=(0.0, 0.0, 2.0), radius=4.0)
        """
        shape: Any = self
        lengths = {item.name: getattr(self, item.name) for item in fields(shape) if dimension_of(item) == "length"}
        scaled: Own = replace(shape, **{name: over(value, length) for name, value in lengths.items()})
        return scaled

    def turned(self, axis: int, center: Vector) -> bool:
        """Whether the shape is the same after any turn about an axis.

        Parameters
        ----------
        axis : int
            Number of its direction.
        center : (3,) floats [m]
            A point of the axis.
        """
        return False

    @property
    def facing(self) -> Vector | None:
        """Outward normal of a shape with one flat side, on which a tip may bear; None of others."""
        return None

    @property
    def middle(self) -> Vector:
        """Its middle, around which fingers stand: the field ``center``, or that of the box around its triangles [m]."""
        center: Vector | None = getattr(self, "center", None)
        if center is None:
            points, _ = self.outline(np.zeros(3), np.zeros((2, 3)))
            x, y, z = (float(value) for value in (points.min(axis=0) + points.max(axis=0)) / 2)
            center = x, y, z
        return center

    def not_graspable(self, fingers: int) -> str:
        """Return why equal fingers around the line along x through its middle cannot grasp it; empty if they can."""
        return ""

    def nearest(self, points: Array) -> int:
        """Return which of some points is nearest to it."""
        return int(self.signed_distance(points)[0].argmin())

    def clearance(self, points: Array) -> float:
        """Return its distance from the nearest of some points [m], negative inside."""
        return float(self.signed_distance(points)[0].min())

    def depths(self, points: Array, allowed: float) -> Array:
        """Return how deep points lie in it [m], those deeper than ``allowed``; inf where the depth is not known."""
        return -self.signed_distance(points)[0]


def dimension_of(item: Field[Any]) -> str:
    """Return the dimension of a field of a shape; a length unless it states another one."""
    return str(item.metadata.get("dimension", "length"))


def over(value: Any, length: float) -> Any:
    """Return a length, or a vector of lengths, over a unit of length; None stays."""
    if value is None:
        return None
    return tuple(part / length for part in value) if isinstance(value, tuple) else value / length


def across(values: Vector, axis: int) -> NDArray[np.float64]:
    """Return the two components of a vector across an axis."""
    return np.delete(np.array(values), axis)


def in_mm(values: Vector) -> str:
    """Return a place or a way in millimeters, in words."""
    return f"({listed(value / mm for value in values)}) mm"


def listed(values: Iterable[float]) -> str:
    """Return numbers in words."""
    return ", ".join(f"{value:.4g}" for value in values)


def positive(what: str, value: float, unit: str = " mm") -> None:
    """Refuse a value that is not more than 0."""
    if not (np.isfinite(value) and value > 0):
        shown = value * 1e3 if unit else value
        raise TurgorError(f"{what} is {shown:g}{unit}; allowed is more than 0.")


def direction(what: str, values: Any) -> Vector:
    """Return the unit vector of a direction that was given."""
    given = vector(values, what)
    unit = normalized(given)
    if unit is None:
        why = "a zero vector" if not any(given) else f"{values!r}, whose length cannot be computed"
        raise TurgorError(f"{what} is {why}; give a direction such as (0, 0, 1).")
    return unit
