"""Shapes of cross-sections: areas, moments and chambers in closed form, about the center of the rubber's area.

The axis of the rod is x; y is the width and z the height. Torsion constants and shear factors are those of small
strains and Poisson's ratio 1/2 (Cowper 1966, doi 10.1115/1.3625046).
"""

from dataclasses import dataclass
from math import inf, pi, tanh

from turgor.fast_models.rod.sections.chamber import RodChamber
from turgor.foundation.errors import TurgorError

#: Shear factor of a rectangle and, for want of a better one, of a half round at Poisson's ratio 1/2.
FLAT_SHEAR = 6 / 7


@dataclass(frozen=True, slots=True, kw_only=True)
class Round:
    """A solid disk.

    Parameters
    ----------
    radius : float [m]

    Examples
    --------
    >>> round(Round(radius=1.0).torsion_constant, 4)
    1.5708
    """

    radius: float

    def __post_init__(self) -> None:
        _check("round", radius=self.radius)

    @property
    def area(self) -> float:
        """Area of the rubber [m²]."""
        return pi * self.radius**2

    @property
    def second_moments(self) -> tuple[float, float]:
        """Second moments of area about y and z [m⁴]."""
        return pi * self.radius**4 / 4, pi * self.radius**4 / 4

    @property
    def torsion_constant(self) -> float:
        """Saint-Venant's torsion constant [m⁴]."""
        return pi * self.radius**4 / 2

    @property
    def shear_factors(self) -> tuple[float, float]:
        """Share of the area that resists shear in y and z."""
        return 0.9, 0.9

    @property
    def chambers(self) -> tuple[RodChamber, ...]:
        """Chambers in which pressure may act."""
        return ()

    @property
    def contact_radius(self) -> float:
        """Distance from the axis to the outside [m]."""
        return self.radius


@dataclass(frozen=True, slots=True, kw_only=True)
class Rectangle:
    """A solid rectangle.

    Parameters
    ----------
    width : float [m]
        Extent in y.
    height : float [m]
        Extent in z.

    Examples
    --------
    >>> round(Rectangle(width=1.0, height=1.0).torsion_constant, 4)
    0.1406
    """

    width: float
    height: float

    def __post_init__(self) -> None:
        _check("rectangle", width=self.width, height=self.height)

    @property
    def area(self) -> float:
        """Area of the rubber [m²]."""
        return self.width * self.height

    @property
    def second_moments(self) -> tuple[float, float]:
        """Second moments of area about y and z [m⁴]."""
        return self.width * self.height**3 / 12, self.height * self.width**3 / 12

    @property
    def torsion_constant(self) -> float:
        """Saint-Venant's torsion constant, by the first terms of its series [m⁴]."""
        thin, wide = sorted((self.width, self.height))
        rest = sum(tanh(n * pi * wide / (2 * thin)) / n**5 for n in range(1, 40, 2))
        return wide * thin**3 / 3 * (1 - 192 / pi**5 * thin / wide * rest)

    @property
    def shear_factors(self) -> tuple[float, float]:
        """Share of the area that resists shear in y and z."""
        return FLAT_SHEAR, FLAT_SHEAR

    @property
    def chambers(self) -> tuple[RodChamber, ...]:
        """Chambers in which pressure may act."""
        return ()

    @property
    def contact_radius(self) -> float:
        """Distance from the axis to the outside in z [m]."""
        return self.height / 2


@dataclass(frozen=True, slots=True, kw_only=True)
class Tube:
    """A round tube whose bore is a chamber.

    Parameters
    ----------
    outer_radius : float [m]
    inner_radius : float [m]

    Examples
    --------
    >>> tube = Tube(outer_radius=5e-3, inner_radius=3e-3)
    >>> round(tube.area * 1e6, 2), tube.chambers[0].name
    (50.27, 'cavity')
    """

    outer_radius: float
    inner_radius: float

    def __post_init__(self) -> None:
        _check("tube", outer_radius=self.outer_radius)
        _check("tube", self.outer_radius, inner_radius=self.inner_radius)

    @property
    def area(self) -> float:
        """Area of the rubber [m²]."""
        return pi * (self.outer_radius**2 - self.inner_radius**2)

    @property
    def second_moments(self) -> tuple[float, float]:
        """Second moments of area about y and z [m⁴]."""
        moment = pi * (self.outer_radius**4 - self.inner_radius**4) / 4
        return moment, moment

    @property
    def torsion_constant(self) -> float:
        """Saint-Venant's torsion constant [m⁴]."""
        return 2 * self.second_moments[0]

    @property
    def shear_factors(self) -> tuple[float, float]:
        """Share of the area that resists shear in y and z."""
        ratio = (self.inner_radius / self.outer_radius) ** 2
        factor = 9 * (1 + ratio) ** 2 / (10 * (1 + ratio) ** 2 + 26 * ratio)
        return factor, factor

    @property
    def chambers(self) -> tuple[RodChamber, ...]:
        """The bore."""
        return (RodChamber(area=pi * self.inner_radius**2),)

    @property
    def contact_radius(self) -> float:
        """Distance from the axis to the outside [m]."""
        return self.outer_radius


@dataclass(frozen=True, slots=True, kw_only=True)
class HalfRound:
    """A half round with a half round chamber, its flat side down, as semicircular benders have it.

    The wall is equally thick all around. The torsion constant is Bredt's for the ring of walls plus that of an open
    strip: within 3 % of finite differences of Prandtl's stress function for walls of 0.1 to 0.5 of the radius.

    Parameters
    ----------
    radius : float [m]
        Outer radius of the round side, whose center lies on the upper face of the flat wall.
    wall : float [m]
        Thickness of the round and of the flat wall; 0 < wall < radius.

    Examples
    --------
    >>> half = HalfRound(radius=8e-3, wall=2e-3)
    >>> round(half.chambers[0].offset[1] * 1e3, 3)  # mm above the center of the rubber
    0.371
    """

    radius: float
    wall: float

    def __post_init__(self) -> None:
        _check("half round", radius=self.radius)
        _check("half round", self.radius, wall=self.wall)

    @property
    def _parts(self) -> tuple[tuple[float, float, float, float], ...]:
        """Area, height of its center, and second moments about y and z of outer half, flat wall and chamber."""
        r, a, t = self.radius, self.radius - self.wall, self.wall
        return (
            (pi * r**2 / 2, 4 * r / (3 * pi), (pi / 8 - 8 / (9 * pi)) * r**4, pi * r**4 / 8),
            (2 * r * t, -t / 2, r * t**3 / 6, t * (2 * r) ** 3 / 12),
            (-pi * a**2 / 2, 4 * a / (3 * pi), -(pi / 8 - 8 / (9 * pi)) * a**4, -pi * a**4 / 8),
        )

    @property
    def area(self) -> float:
        """Area of the rubber [m²]."""
        return sum(part[0] for part in self._parts)

    @property
    def center(self) -> float:
        """Height of the center of the rubber above the upper face of the flat wall [m]."""
        return sum(part[0] * part[1] for part in self._parts) / self.area

    @property
    def second_moments(self) -> tuple[float, float]:
        """Second moments of area about y and z [m⁴]."""
        about_y = sum(own + area * (z - self.center) ** 2 for area, z, own, _ in self._parts)
        return about_y, sum(part[3] for part in self._parts)

    @property
    def torsion_constant(self) -> float:
        """Torsion constant [m⁴]."""
        middle = self.radius - self.wall / 2
        enclosed = pi * middle**2 / 2 + middle * self.wall
        around = (pi + 2) * middle + self.wall
        return 4 * enclosed**2 * self.wall / around + around * self.wall**3 / 3

    @property
    def shear_factors(self) -> tuple[float, float]:
        """Share of the area that resists shear in y and z."""
        return FLAT_SHEAR, FLAT_SHEAR

    @property
    def chambers(self) -> tuple[RodChamber, ...]:
        """The half round chamber."""
        inner = self.radius - self.wall
        return (RodChamber(area=pi * inner**2 / 2, offset=(0.0, 4 * inner / (3 * pi) - self.center)),)

    @property
    def contact_radius(self) -> float:
        """Distance from the axis to the flat outside below it [m]."""
        return self.center + self.wall


def _check(kind: str, most: float = inf, /, **lengths: float) -> None:
    for name, value in lengths.items():
        if not 0 < value < most:
            upper = "" if most == inf else f" and less than {most:g} m"
            raise TurgorError(f"{kind}: {name} is {value:g} m; it must be more than 0{upper}.")
