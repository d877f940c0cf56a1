"""Settings of remeshing: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class RemeshingSettings:
    """Settings of remeshing.

    Parameters
    ----------
    least_ratio : float
        A cell is degraded where the volume ratio at one of its nodes is below this share of its mean: rubber has the
        same ratio everywhere, and 0 is inside out.
    degraded_volume : float
        Share of the volume of the body at rest in degraded cells at which cells are cut. At a sharp inner edge the
        cells next to it fold however small they are; this share falls with their size.
    growth : float
        Number of cells afterwards over that before. Twice as many are soon degraded again, eight times as many cost
        more than the whole path before.
    most : int
        Times that cells are cut on one path.
    most_unknowns : int
        Unknowns that the mesh may have afterwards.
    earlier : tuple of int
        States before the last stable one to which it goes back, one after the other, where no equilibrium is found on
        the new cells; the last resort is the state at rest.
    last_steps : int
        Last attempts among which one that turned a cell inside out says why a path ended.
    most_moved : float
        Norm of the displacement by which the new equilibrium may differ from the old state, over that of the state: a
        larger one is another equilibrium.
    tolerance, iterations : float, int
        Relative residual of the equilibrium on the new cells, and most iterations to it.
    new_cells : float
        Cells that come with each tetrahedron whose edges are all cut, its neighbors included, as measured.
    """

    least_ratio: float = 0.2
    degraded_volume: float = 0.01
    growth: float = 3.0
    most: int = 2
    most_unknowns: int = 200_000
    earlier: tuple[int, ...] = (0, 1, 3, 7, 15)
    last_steps: int = 5
    most_moved: float = 0.3
    tolerance: float = 1e-6
    iterations: int = 12
    new_cells: float = 13.0


REMESHING = RemeshingSettings()
