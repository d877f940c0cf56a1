"""Sheets: several states or designs in one picture, at one scale and with one color bar."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from turgor.core.results.fields.state_fields import MeshFacts, StateFields
from turgor.core.solvers.pressures import pressure_text
from turgor.core.solvers.solution import Solution, State
from turgor.foundation.errors import TurgorError
from turgor.views.pictures.colors import VON_MISES, Field
from turgor.views.pictures.framing import bands, bar_of, framed, scale_of, write_text
from turgor.views.pictures.rendering import View
from turgor.views.pictures.settings import FRAMING
from turgor.views.pictures.state_picture import Style, pixels_of, shared_view, shows_values
from turgor.views.plots.figures import check_ending, write_figure
from turgor.views.plots.settings import PLOT


def small_multiples(
    solution: Solution,
    path: str | Path,
    *,
    count: int = 6,
    color_by: str | Field = VON_MISES,
    width: int = 1600,
    style: Style | None = None,
) -> None:
    """Draw states of a path side by side, from rest to the last one, as PNG.

    Parameters
    ----------
    solution : Solution
    path : str or Path
        PNG file to write.
    count : int
        How many states, 2 or more; they are spread evenly over the load factors or times.
    color_by : str or Field
        See `shared_view`.
    width : int
        Width in pixels, 400 or more.
    style : Style, optional
    """
    if count < 2:
        raise TurgorError(f"count is {count}; small multiples show 2 states or more.")
    numbers = spread(solution, count)
    facts = MeshFacts(solution.model.mesh)
    states = [StateFields(solution.states[number], facts) for number in numbers]
    captions = [_caption(solution.states[number]) for number in numbers]
    title = solution.model.mesh.name
    write_sheet(path, states, captions, title=title, view=_view(states, color_by, width), style=style)


def side_by_side(
    designs: Mapping[str, Solution | State],
    path: str | Path,
    *,
    color_by: str | Field = VON_MISES,
    width: int = 1600,
    style: Style | None = None,
) -> None:
    """Draw designs side by side at the same scale and with the same colors, as PNG.

    Parameters
    ----------
    designs : mapping of str to Solution or State
        By their captions; of a solution its last state.
    path : str or Path
        PNG file to write.
    color_by, width, style
        See `small_multiples`.
    """
    if not designs:
        raise TurgorError("side_by_side needs at least one design.")
    states = [StateFields(each.states[-1] if isinstance(each, Solution) else each) for each in designs.values()]
    write_sheet(path, states, list(designs), view=_view(states, color_by, width), style=style)


def write_sheet(
    path: str | Path,
    states: Sequence[State | StateFields],
    captions: Sequence[str],
    *,
    title: str = "",
    view: View | None = None,
    style: Style | None = None,
) -> None:
    """Draw states in rows and columns with a caption each, as PNG.

    Parameters
    ----------
    path : str or Path
        PNG file to write.
    states : sequence of State or StateFields
    captions : sequence of str
        One for each state.
    title : str
        Line above all of them.
    view : View, optional
        Of one picture, from `shared_view`; by default one of all states on a sheet of 1600 pixels.
    style : Style, optional

    Raises
    ------
    TurgorError
        If there are not as many captions as states.
    """
    check_ending(path, "picture")
    write_figure(path, sheet_figure(states, captions, (title, view, style or Style())), kind="picture")


def sheet_figure(
    states: Sequence[State | StateFields], captions: Sequence[str], how: tuple[str, View | None, Style]
) -> Figure:
    """Draw a sheet as `write_sheet` does; ``how`` is title, view and style."""
    title, view, style = how
    if len(captions) != len(states):
        raise TurgorError(f"{len(captions)} captions were given for {len(states)} states; each needs one.")
    view = view or _view(states, VON_MISES, FRAMING.full_width)
    pictures = [_within(pixels_of(state, view, style=style), view) for state in states]
    columns = columns_for(len(pictures))
    rows = -(-len(pictures) // columns)
    scale = scale_of(view.columns * columns)
    high, wide = max(each.shape[0] for each in pictures), max(each.shape[1] for each in pictures)
    line = round(FRAMING.margin * scale)
    cell = (high + line, wide + round(FRAMING.margin / 2 * scale))
    image = np.full((rows * cell[0], columns * cell[1], 3), 255, dtype=np.uint8)
    for number, each in enumerate(pictures):
        row, column = divmod(number, columns)
        top, left = row * cell[0] + line, column * cell[1]
        image[top : top + each.shape[0], left : left + each.shape[1]] = each
    colors = bar_of(view) if any(shows_values(state, view) for state in states) else None
    figure = framed(image, view, (title, view.field.note), colors)
    head, foot = bands(image.shape[1])
    height = image.shape[0] + head + foot
    for number, text in enumerate(captions):
        row, column = divmod(number, columns)
        place = (
            (column * cell[1] + FRAMING.margin * scale) / image.shape[1],
            1 - (head + row * cell[0] + line / 2) / height,
        )
        write_text(figure, place, text, 19 * scale)
    return figure


def columns_for(count: int) -> int:
    """Columns of a sheet of some pictures: all in one row up to four, else as square as rows of three or four get.

    Examples
    --------
    >>> [columns_for(count) for count in (1, 2, 4, 5, 6, 8)]
    [1, 2, 4, 3, 3, 4]
    """
    if count <= PLOT.pictures:
        return count
    return 3 if count in (5, 6, 9) else PLOT.pictures


def spread(solution: Solution, count: int) -> list[int]:
    """Numbers of states that are spread evenly over the times or load factors of a path, rest and end among them."""
    states = solution.states
    timed = all(state.time is not None for state in states)
    along = np.array([state.time if timed else state.load_factor for state in states], dtype=np.float64)
    if not (np.diff(along) > 0).all():
        along = np.arange(len(states), dtype=np.float64)
    places = np.linspace(along[0], along[-1], min(count, len(states)))
    return sorted({int(np.abs(along - place).argmin()) for place in places})


def _view(states: Sequence[State | StateFields], color_by: str | Field, width: int) -> View:
    """View of one picture of a sheet of a given width; more pixels than it shows, so that it fits after rounding."""
    if width < 400:
        raise TurgorError(f"picture width is {width} pixels; allowed is 400 or more.")
    return shared_view(states, max(400, round(width / columns_for(len(states)))), color_by)


def _within(picture: NDArray[np.uint8], view: View) -> NDArray[np.uint8]:
    """The picture without the white on both sides of the widest state, but for a small margin."""
    content = round((view.right - view.left) / view.pixel)
    spare = max(0, (view.columns - content) // 2 - FRAMING.margin // 3)
    return picture[:, spare : picture.shape[1] - spare]


def _caption(state: State) -> str:
    acting = pressure_text(state)
    time = "" if state.time is None else f"{state.time:.3g} s"
    return " · ".join(part for part in (time, acting) if part) or f"load factor {state.load_factor:.3g}"
