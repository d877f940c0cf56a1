"""Settings of what acts on faces: every number that was chosen, with its reason.

All are without unit unless it is stated. Scaled units are lengths in mean edge lengths, stresses in shear moduli.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class SideSearchSettings:
    """Settings of the search for the side of a face at a point: a marker, a point force, a point of a thread.

    Parameters
    ----------
    samples : int
        A side is sampled at so many places along each of its edges.
    nearest : int
        So many of the samples that are nearest to the point are starts for its place on their sides.
    point_force_within : float
        A point force acts this near the surface, as a share of the size of the part.
    """

    samples: int = 5
    nearest: int = 20
    point_force_within: float = 0.01


SIDE_SEARCH = SideSearchSettings()


@dataclass(frozen=True, slots=True)
class PlateSettings:
    """Settings of sheets that resist bending, tested in `tests/unit/core/engine/test_plate_terms.py`.

    Parameters
    ----------
    penalty_triangles, penalty_quadrilaterals : float
        Penalty η of the angles at edges. On flat sides that are not very skew the energy is positive above 3, and the
        deflection of a flat plate hardly depends on it. Too little of it makes a curved shell too soft, too much makes
        it too stiff: the pinched cylinder of 16 × 16 cells is 9, 2 and −3.5 % too soft on triangles with 4, 10 and 50,
        and 5, −1.4 and −6 % on quadrilaterals with 2.5, 4 and 10.
    margin, least_penalty : float
        Of a film without a solid, each edge has the least penalty that keeps the bending energy of its sides positive
        (`least_penalties`) with this margin, and at least the second number. Sides of folded tubes are skew: with 5
        everywhere, a Miura tube (sides of 4.3 mm) shortens by 5 % less, a Kresling tube (10 mm) by 4 %.
    across : float
        A side of the body that is fixed keeps the slope of a sheet that ends at it, if it goes on across the sheet:
        the smallest sine of the angle between both.
    """

    penalty_triangles: float = 10.0
    penalty_quadrilaterals: float = 5.0
    margin: float = 1.05
    least_penalty: float = 3.0
    across: float = 0.5


PLATE = PlateSettings()


@dataclass(frozen=True, slots=True)
class FilmSettings:
    """Settings of films without a solid, tested in `tests/verification/membranes_shells/test_films_alone.py`.

    Parameters
    ----------
    full_share : float
        Share of the area of nine-node sides that is integrated with 3 × 3 points. Without it, a coarse Mylar balloon is
        a zigzag of 20 % of its height; with 0.02 and 0.05 its path ends at folds.
    full_degree : int
        Degree of these points.
    """

    full_share: float = 0.01
    full_degree: int = 5


FILM = FilmSettings()


@dataclass(frozen=True, slots=True)
class WarpSettings:
    """Settings of woven sheets.

    Parameters
    ----------
    least_share : float
        Least length on the surface of a unit vector that gives the warp: below it, the direction on the surface would
        be chance.
    """

    least_share: float = 0.05


WARP = WarpSettings()


@dataclass(frozen=True, slots=True)
class TensionFieldSettings:
    """Settings of sheets that wrinkle, tested in `tests/unit/core/engine/test_relaxed_energy.py`.

    Parameters
    ----------
    toe_per_stiffness, longest_toe : float
        The toe over the stiffness of the sheet in scaled units: a tension of the rubber's modulus times an edge of the
        mesh is reached at a stretch of √(2 × 1e-6) = 0.14 %, however stiff the sheet is. A sheet as soft as the rubber
        has a toe of 1e-6. The longest toe, beyond which a sheet is half a percent longer than it would be.
    slack_stiffness, largest_share : float
        Stiffness that a sheet keeps in compression, in scaled units: that of rubber of a thirtieth of an edge. Its
        tension stays far below 2 μ / k, at which rubber wrinkles in waves of two edges. The largest share of the
        sheet's stiffness.
    strain_weight : float
        Weight of strains over stresses where Newton's method chooses what to linearize a sheet about, in scaled units.
        Up to 15 kPa, five chambers above a stiff film took 72 iterations with 100 and 90 with 300. In shorter steps, a
        chamber up to 50 kPa took 271, 204, 174 and 250 with 10, 100, 300 and 1000, and 292 with strains alone.
    film_toe, film_share : float
        Toe and share of a film without a solid, which no rubber gives a scale. The film is up to 0.05 % longer. A pouch
        of polyethylene reaches 20 kPa in 503 iterations, and ends at 2.5 kPa with a share of 1e-4. The center of a
        square airbag rises by 0.2 % less with a share of 1e-4 than with 1e-5.
    """

    toe_per_stiffness: float = 1e-6
    longest_toe: float = 1e-2
    slack_stiffness: float = 0.1
    largest_share: float = 1e-3
    strain_weight: float = 100.0
    film_toe: float = 1e-3
    film_share: float = 1e-3


TENSION_FIELD = TensionFieldSettings()
