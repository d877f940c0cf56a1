"""Settings of mesh errors and of meshes that are refined: every number that was chosen, with its reason.

The truth set (`docs/truth.md`) and `tests/unit/accuracy/adaptivity` need them.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class MeshErrorSettings:
    """Settings of the estimate.

    Parameters
    ----------
    places : tuple of float
        Places of the states that are solved again, as shares of the length of the path; the last one first.
    state_work, state_work_touching : float
        Factorizations of the first mesh that pay for a state on a second one of the same size, without and with
        contact: it needs 2.5 and 15, and the estimate may take half the work of the solve.
    cost_exponent : float
        A factorization of n unknowns takes n to this power.
    growth : float
        Growth of the number of cells beyond which more states are solved again rather than more cells are cut. On a
        mesh that was refined already, where the error is spread over many cells, it is the least.
    least_growth, least_growth_hexahedra : float
        Least growth on other meshes of tetrahedra and of hexahedra.
    most_remaining : float
        Share of the squared error in energy that remains on the second mesh at most: the difference between the meshes
        is scaled up to four times by it. On 14 random shapes (seed 7 of `benchmarks/accuracy/estimates.py`) the share
        is 0.16 to 0.79.
    remaining_of_films : float
        The same of films without a solid, whose second mesh has sides of half the size: errors that fall with the
        square of it, as wrinkled films have them.
    folds : float
        Share of the difference between the displacements that counts as an error at least, of films: it is the
        difference between their folds, ten times that of rise and volume of an airbag.
    negligible : float
        A measure that differs between two meshes by less than this share of its change was prescribed, and one that is
        smaller than this share of its largest value has no relative error.
    doubted : float
        A measure whose relative mesh error is above the requested one gets a note, above this many times it a warning.
    """

    places: tuple[float, ...] = (1.0, 0.5, 0.2)
    state_work: float = 5.0
    state_work_touching: float = 30.0
    cost_exponent: float = 1.5
    growth: float = 3.0
    least_growth: float = 2.0
    least_growth_hexahedra: float = 2.5
    most_remaining: float = 0.75
    remaining_of_films: float = 0.25
    folds: float = 0.1
    negligible: float = 1e-5
    doubted: float = 2.5


MESH_ERROR = MeshErrorSettings()


@dataclass(frozen=True, slots=True)
class RefinementSettings:
    """Settings of meshes that are refined until an error is met.

    Parameters
    ----------
    unknowns, rounds : int
        Unknowns at which it stops unless another limit is given, and most rounds.
    least_growth, most_growth : float
        Growth of the mesh from one round to the next.
    """

    unknowns: int = 200_000
    rounds: int = 6
    least_growth: float = 1.6
    most_growth: float = 4.0


REFINEMENT = RefinementSettings()
