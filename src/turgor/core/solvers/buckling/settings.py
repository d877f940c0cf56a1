"""Settings of buckling: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class BucklingSettings:
    """Settings of buckling modes and branches.

    Parameters
    ----------
    most_modes : int
        More modes than this are of no use, and their shapes take memory.
    nudge : float
        Largest displacement, in edge lengths, of the differences of tangents: their error is of its square.
    tolerance : float
        Relative error of the eigenvalues.
    smallest : float
        An inverse load factor below this is no buckling: a straight line does not reach a thousandfold load.
    inverse_iterations : int
        Iterations for the mode at a bifurcation: its eigenvalue is thousands of times smaller than the next.
    close, closer : float, int
        Share of the load factor to which a bifurcation is located before its branch is followed, and the steps for it.
    largest_imperfection : float
        A deviation above this share of the largest extent is another design.
    first_move : float
        Largest displacement of the first step along a branch, in edge lengths: round-off is far below it, and the
        branch is still straight.
    real_share : float
        An eigenvalue whose imaginary part is a larger share than this is an artifact of round-off.
    """

    most_modes: int = 20
    nudge: float = 1e-4
    tolerance: float = 1e-8
    smallest: float = 1e-3
    inverse_iterations: int = 4
    close: float = 1e-7
    closer: int = 5
    largest_imperfection: float = 0.1
    first_move: float = 0.02
    real_share: float = 1e-4


BUCKLING = BucklingSettings()
