"""Folds: profile of a corrugated tube of constant wall thickness, for all bellows."""

from dataclasses import dataclass
from math import pi, sqrt

from turgor.core.geometry.rules import MOST_FOLDS, SMALLEST_LENGTH, check_choice, check_count, check_length, in_mm
from turgor.core.geometry.shapes.sections import Outline, Point
from turgor.units import m, mm

SHAPES = ("rounded", "straight")

#: Edges of an outline in order: the start of each, and its angle of turn.
Path = list[tuple[Point, float]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Folds:
    """Corrugated wall from neck to neck: it starts and ends at its smallest radius.

    Parameters
    ----------
    count : int
        Number of folds, 1 to 50.
    inner_radius : float [m]
        Smallest radius of the cavity.
    outer_radius : float [m]
        Largest radius of the outside.
    wall : float [m]
        Thickness of the wall, measured across it; the same everywhere.
    pitch : float [m]
        Length of one fold.
    shape : str
        ``"rounded"``: flat rings joined by arcs that are tangent to them; ``"straight"``: cones with sharp edges.

    Examples
    --------
    >>> folds = Folds(count=2, inner_radius=8e-3, outer_radius=16e-3, wall=1e-3, pitch=10e-3, shape="straight")
    >>> round(folds.neck_radius * 1e3, 3)  # the cone's wall of 1 mm, cut along the radius, in mm
    9.621
    >>> Folds(count=2, inner_radius=8e-3, outer_radius=16e-3, wall=6e-3, pitch=10e-3, shape="rounded")
    Traceback (most recent call last):
    turgor.TurgorError: wall is 6 mm; allowed is 0.01 mm to 2.99 mm, so that folds with a pitch of 10 mm \
fit between the radii 8 mm and 16 mm.
    """

    count: int
    inner_radius: float
    outer_radius: float
    wall: float
    pitch: float
    shape: str

    def __post_init__(self) -> None:
        check_count("folds", self.count, low=1, high=MOST_FOLDS)
        check_choice("fold_shape", self.shape, SHAPES)
        least, rounded = SMALLEST_LENGTH, self.shape == "rounded"
        check_length("inner_radius", self.inner_radius, low=0.5 * mm, high=1 * m)
        check_length("outer_radius", self.outer_radius, low=self.inner_radius + 3 * least, high=1 * m)
        height = self.outer_radius - self.inner_radius
        between = f"fit between the radii {in_mm(self.inner_radius)} and {in_mm(self.outer_radius)}"
        high, why = 1 * m, ""
        if rounded:
            high, why = 2 * (height - 2 * least), f"so that rounded folds {between}"
        check_length("pitch", self.pitch, low=10 * least, high=high, why=why)
        high, why = height - least, f"so that folds with a pitch of {in_mm(self.pitch)} {between}"
        if rounded:
            high = min(height - self.pitch / 2 - least, self.pitch / 2 - 2 * least)
        check_length("wall", self.wall, high=high, why=why)

    @property
    def length(self) -> float:
        """Length of all folds [m]."""
        return self.count * self.pitch

    @property
    def neck_radius(self) -> float:
        """Outer radius at both ends [m]."""
        return self.inner_radius + self._radial_wall

    @property
    def _radial_wall(self) -> float:
        """Thickness of the wall along the radius, at its smallest and largest radius [m]."""
        if self.shape == "rounded":
            return self.wall
        height, rise = self.outer_radius - self.inner_radius, 2 * self.wall / self.pitch
        climb = (height**2 - self.wall**2) / (height + sqrt(height**2 - (1 - rise**2) * (height**2 - self.wall**2)))
        return height - climb

    def outside(self, start: float) -> Path:
        """Outer side of the wall from its end back to its start at x = ``start`` [m], as (x, radius)."""
        return self._path(start, self.neck_radius, self.outer_radius, -self.wall / 2)

    def inside(self, start: float) -> Path:
        """Inner side of the wall from its end back to its start at x = ``start`` [m], as (x, radius)."""
        return self._path(start, self.inner_radius, self.outer_radius - self._radial_wall, self.wall / 2)

    def hinges(self, start: float) -> tuple[Point, ...]:
        """Re-entrant corners of straight folds from x = ``start`` [m]: within each crest and outside between two."""
        if self.shape != "straight":
            return ()
        crests = [(start + (i + 0.5) * self.pitch, self.outer_radius - self._radial_wall) for i in range(self.count)]
        necks = [(start + i * self.pitch, self.neck_radius) for i in range(1, self.count)]
        return (*crests, *necks)

    def _path(self, start: float, low: float, high: float, shift: float) -> Path:
        """One side of the wall; ``shift`` is what it adds to the radius of the arcs at the necks."""
        path: Path = []
        for i in reversed(range(self.count)):
            x = start + i * self.pitch
            path += self._straight(x, low, high) if self.shape == "straight" else self._rounded(x, low, high, shift)
        return path

    def _straight(self, x: float, low: float, high: float) -> Path:
        return [((x + self.pitch, low), 0.0), ((x + self.pitch / 2, high), 0.0)]

    def _rounded(self, x: float, low: float, high: float, shift: float) -> Path:
        neck, crest = self.pitch / 4 + shift, self.pitch / 4 - shift
        return [
            ((x + self.pitch, low), -pi / 2),
            ((x + self.pitch - neck, low + neck), 0.0),
            ((x + self.pitch - neck, high - crest), pi),
            ((x + neck, high - crest), 0.0),
            ((x + neck, low + neck), -pi / 2),
        ]


@dataclass(frozen=True, slots=True, kw_only=True)
class Necks:
    """Straight necks between equal groups of folds.

    Parameters
    ----------
    count : int
        Number of necks.
    length : float [m]
        Length of each.
    """

    count: int = 0
    length: float = 0.0


def bellows_profiles(
    folds: Folds, *, start: float = 0.0, cap: float, clamp: float = 0.0, inlet: float = 0.0, necks: Necks = Necks()
) -> tuple[Outline, Outline]:
    """Profiles (x, radius) of a closed bellows, filled, and of its cavity.

    Parameters
    ----------
    folds : Folds
        The folds of one group.
    start : float [m]
        Position of the fixed end on the x axis.
    cap : float [m]
        Thickness of the caps.
    clamp : float [m]
        Length of a solid block before the first cap.
    inlet : float [m]
        Diameter of the duct through the fixed end; 0 for none.
    necks : Necks
        Necks between the groups of folds.

    Returns
    -------
    outside, cavity : Outline

    Examples
    --------
    >>> folds = Folds(count=2, inner_radius=8e-3, outer_radius=16e-3, wall=1e-3, pitch=10e-3, shape="straight")
    >>> outside, cavity = bellows_profiles(folds, cap=4e-3)
    >>> round(cavity.area * 1e6, 3), round(outside.area * 1e6, 3)  # mm²
    (223.79, 333.178)
    """
    first = start + clamp + cap
    groups = [first + i * (folds.length + necks.length) for i in reversed(range(necks.count + 1))]
    last = groups[0] + folds.length
    end, neck, radius = last + cap, folds.neck_radius, folds.inner_radius
    outside: Path = [((start, 0.0), 0.0), ((end, 0.0), 0.0), ((end, neck), 0.0)]
    duct = inlet / 2
    cavity: Path = [((start if duct else first, 0.0), 0.0), ((last, 0.0), 0.0)]
    for group in groups:
        outside += [*folds.outside(group), ((group, neck), 0.0)]
        cavity += [*folds.inside(group), ((group, radius), 0.0)]
    if clamp:
        outside.append(((start + clamp, neck), 0.0))
    outside.append(((start, neck), 0.0))
    if duct:
        cavity += [((first, duct), 0.0), ((start, duct), 0.0)]
    return _closed(outside), _closed(cavity)


def _closed(path: Path) -> Outline:
    corners, arcs = zip(*path, strict=True)
    return Outline(corners=corners, arcs=arcs)
