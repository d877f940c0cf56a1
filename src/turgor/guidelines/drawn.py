"""Pictures for the figures of guidelines."""

import turgor as tg
from turgor.results.pictures.state_picture import state_figure
from turgor.results.plots.figures import png_of

#: Resolution of the pictures [dots per inch]: some five stand beside each other in a figure.
DPI = 60


def picture_of(solution: tg.Solution) -> bytes:
    """Picture of the last state, colored by von Mises stress, as PNG.

    Parameters
    ----------
    solution : Solution

    Returns
    -------
    bytes
        Empty where the path has no state.
    """
    return png_of(state_figure(solution.states[-1]), dpi=DPI) if len(solution.states) else b""
