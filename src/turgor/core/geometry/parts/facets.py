"""Facets: triangles of film, and tubes of them between polygons, as in origami."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import acos, cos, hypot, pi, sin

from turgor.core.geometry.shapes.film_shape import Patch, Point


def facet(corners: tuple[Point, Point, Point], faces: tuple[str, ...], edge: str = "") -> list[Patch]:
    """Make a triangle of three patches that meet inside it, where they are least skew: away from its blunt corner.

    Parameters
    ----------
    corners : (3,) points [m]
        Seen from the cavity they run counterclockwise.
    faces : tuple of str
        Faces that the triangle belongs to.
    edge : str
        Face that its edge from the first to the second corner makes; empty for none.

    Examples
    --------
    >>> pieces = facet(((0, 0, 0), (3, 0, 0), (0, 3, 0)), ("film",), "fixed")
    >>> [piece.edges for piece in pieces]
    [('fixed', '', '', ''), ('', '', '', 'fixed'), ('', '', '', '')]
    """
    center = _center(corners)
    middles = [_middle((corners[k], corners[(k + 1) % 3])) for k in range(3)]
    names = ((edge, "", "", ""), ("", "", "", edge), ("", "", "", ""))
    return [
        Patch(corners=(corners[k], middles[k], center, middles[k - 1]), faces=faces, edges=names[k]) for k in range(3)
    ]


@dataclass(frozen=True, slots=True, kw_only=True)
class Ring:
    """A regular polygon of a folded tube, across x.

    Parameters
    ----------
    x : float [m]
        Where it is.
    turn : float [rad]
        How far it is turned about x.
    radius : float [m]
        Circumradius.
    """

    x: float
    turn: float
    radius: float

    def corners(self, sides: int) -> list[Point]:
        """Corners [m], counterclockwise seen from the tip.

        Examples
        --------
        >>> [round(value, 12) for value in Ring(x=1.0, turn=0.0, radius=2.0).corners(4)[1]]
        [1.0, 0.0, 2.0]
        """
        angles = (self.turn + 2 * pi * k / sides for k in range(sides))
        return [(self.x, self.radius * cos(angle), self.radius * sin(angle)) for angle in angles]


def folded_tube(rings: Sequence[Ring], sides: int) -> list[Patch]:
    """Triangles between regular polygons, and a plate on the last one.

    Parameters
    ----------
    rings : sequence of Ring
        From the fixed rim to the plate. A turn from one to the next makes the diagonals lean that way.
    sides : int
        Corners of the polygons.

    Returns
    -------
    list of Patch
        The tube with faces ``film`` and ``cavity``, its first polygon as the edge ``fixed``, and the plate with faces
        ``tip`` and ``cavity``.

    Examples
    --------
    >>> len(folded_tube([Ring(x=0.0, turn=0.0, radius=0.02), Ring(x=0.02, turn=0.5, radius=0.02)], 6))
    54
    """
    patches = []
    for row, (first, second) in enumerate(pairwise(rings)):
        low, high = first.corners(sides), second.corners(sides)
        leans = second.turn >= first.turn  # diagonals go back, from the next corner below
        edge = "fixed" if row == 0 else ""
        for k in range(sides):
            a, b, c, d = low[k], low[(k + 1) % sides], high[(k + 1) % sides], high[k]
            patches += facet((b, a, d if leans else c), ("film", "cavity"), edge)
            patches += facet((c, b if leans else a, d), ("film", "cavity"))
    last, center = rings[-1].corners(sides), (rings[-1].x, 0.0, 0.0)
    for a, b in pairwise([*last, last[0]]):
        patches += facet((b, a, center), ("tip", "cavity"))
    return patches


def folded_volume(rings: Sequence[Ring], sides: int) -> float:
    """Volume within a folded tube [m³]: each row is a prismatoid, between two polygons and one halfway between.

    Examples
    --------
    >>> round(folded_volume([Ring(x=0.0, turn=0.0, radius=2**0.5), Ring(x=1.0, turn=0.0, radius=2**0.5)], 4), 12)
    4.0
    """
    volume = 0.0
    for low, high in pairwise(rings):
        a = Ring(x=0.0, turn=0.0, radius=low.radius).corners(sides)
        b = Ring(x=0.0, turn=abs(high.turn - low.turn), radius=high.radius).corners(sides)
        between = [_middle(pair) for k in range(sides) for pair in ((a[k], b[k]), (a[(k + 1) % sides], b[k]))]
        volume += (high.x - low.x) * (_area(a) + 4 * _area(between) + _area(b)) / 6
    return volume


def _area(corners: Sequence[Point]) -> float:
    """Area of a polygon across x."""
    return sum(p[1] * q[2] - q[1] * p[2] for p, q in pairwise([*corners, corners[0]])) / 2


def _center(corners: Sequence[Point]) -> Point:
    """Where the patches of a triangle meet: each corner counts with the cosine of half its angle.

    The bending of the three patches of blunt triangles then needs a penalty that is a fifth smaller than at the
    centroid, within 3 % of the best place.
    """
    turned = (tuple(corners[(k + i) % 3] for i in range(3)) for k in range(3))
    weights = [cos(_angle(*each) / 2) for each in turned]
    x, y, z = (
        sum(w * p for w, p in zip(weights, axis, strict=True)) / sum(weights) for axis in zip(*corners, strict=True)
    )
    return (x, y, z)


def _angle(at: Point, first: Point, second: Point) -> float:
    """Angle at a corner between the edges to two others."""
    u, v = ([b - a for a, b in zip(at, end, strict=True)] for end in (first, second))
    return acos(sum(a * b for a, b in zip(u, v, strict=True)) / (hypot(*u) * hypot(*v)))


def _middle(points: Sequence[Point]) -> Point:
    x, y, z = (sum(values) / len(points) for values in zip(*points, strict=True))
    return (x, y, z)
