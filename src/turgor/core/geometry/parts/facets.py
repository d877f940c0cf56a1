"""Facets: triangles of film, and tubes of them between polygons, as in origami."""

from collections.abc import Sequence
from itertools import pairwise
from math import cos, pi, sin

from turgor.core.geometry.shapes.film_shape import Patch, Point


def facet(corners: tuple[Point, Point, Point], faces: tuple[str, ...], edge: str = "") -> list[Patch]:
    """Make a triangle of three patches that meet at its center.

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
    center = _middle(corners)
    middles = [_middle((corners[k], corners[(k + 1) % 3])) for k in range(3)]
    names = ((edge, "", "", ""), ("", "", "", edge), ("", "", "", ""))
    return [
        Patch(corners=(corners[k], middles[k], center, middles[k - 1]), faces=faces, edges=names[k]) for k in range(3)
    ]


def ring(x: float, radius: float, sides: int, turn: float) -> list[Point]:
    """Corners of a regular polygon across x, counterclockwise seen from the tip, from an angle [rad] on.

    Examples
    --------
    >>> [round(value, 12) for value in ring(1.0, 2.0, 4, 0.0)[1]]
    [1.0, 0.0, 2.0]
    """
    angles = (turn + 2 * pi * k / sides for k in range(sides))
    return [(x, radius * cos(angle), radius * sin(angle)) for angle in angles]


def folded_tube(places: Sequence[tuple[float, float]], radius: float, sides: int) -> list[Patch]:
    """Triangles between regular polygons, and a plate on the last one.

    Parameters
    ----------
    places : sequence of (x [m], angle [rad])
        Where each polygon is, and how far it is turned about x. A turn from one to the next makes the diagonals lean
        that way.
    radius : float [m]
        Circumradius of the polygons.
    sides : int
        Corners of the polygons.

    Returns
    -------
    list of Patch
        The tube with faces ``film`` and ``cavity``, its first polygon as the edge ``fixed``, and the plate with faces
        ``tip`` and ``cavity``.

    Examples
    --------
    >>> len(folded_tube([(0.0, 0.0), (0.02, 0.5)], 0.02, 6))
    54
    """
    rings = [ring(x, radius, sides, turn) for x, turn in places]
    patches = []
    for row, (low, high) in enumerate(pairwise(rings)):
        leans = places[row + 1][1] >= places[row][1]  # diagonals go back, from the next corner below
        edge = "fixed" if row == 0 else ""
        for k in range(sides):
            a, b, c, d = low[k], low[(k + 1) % sides], high[(k + 1) % sides], high[k]
            patches += facet((b, a, d if leans else c), ("film", "cavity"), edge)
            patches += facet((c, b if leans else a, d), ("film", "cavity"))
    center = (places[-1][0], 0.0, 0.0)
    for a, b in pairwise([*rings[-1], rings[-1][0]]):
        patches += facet((b, a, center), ("tip", "cavity"))
    return patches


def folded_volume(rises: Sequence[tuple[float, float]], radius: float, sides: int) -> float:
    """Volume within a folded tube [m³].

    Parameters
    ----------
    rises : sequence of (height [m], turn [rad])
        From one polygon to the next.
    radius, sides
        As for `folded_tube`.

    Examples
    --------
    >>> round(folded_volume([(1.0, 0.0)], 2**0.5, 4), 12)
    4.0
    """
    step = 2 * pi / sides
    # prismatoid: ends, and in the middle twice as many corners, halfway between those that an edge joins
    ends = sides / 2 * radius**2 * sin(step)
    volume = 0.0
    for height, turn in rises:
        way = abs(turn)
        a, b = ring(0.0, radius, sides, 0.0), ring(0.0, radius, sides, way)
        middle = [_middle(pair) for k in range(sides) for pair in ((a[k], b[k]), (a[(k + 1) % sides], b[k]))]
        area = sum(p[1] * q[2] - q[1] * p[2] for p, q in pairwise([*middle, middle[0]])) / 2
        volume += height * (2 * ends + 4 * area) / 6
    return volume


def _middle(points: Sequence[Point]) -> Point:
    x, y, z = (sum(values) / len(points) for values in zip(*points, strict=True))
    return (x, y, z)
