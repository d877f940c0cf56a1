"""Pictures of a path: its first and its last state, the contact pressure, and the damage of bonds."""

from collections.abc import Iterator

from matplotlib.figure import Figure

from turgor.core.engine.cells.internal_variables import bonds_of
from turgor.core.results.fields.path_fields import PathFields
from turgor.core.solvers.solution import Solution
from turgor.foundation.response import Response
from turgor.views.pictures.colors import BOND_DAMAGE, CONTACT_PRESSURE
from turgor.views.pictures.marks.glyphs import draw_marks
from turgor.views.pictures.marks.listing import marks_of
from turgor.views.pictures.state_picture import picture_title, shared_view, state_figure

#: Caption of each picture of a path.
CAPTIONS = {
    "undeformed": "Undeformed",
    "deformed": "At the last state",
    "bonds": "Damage of bonds at the last state: 1 is open",
    "contact": "Contact at the last state, seen through the actuator; colors are not dimmed by light or shadow",
}


def pictured(of: Solution) -> tuple[str, ...]:
    """Return which pictures `path_figures` draws of a path, by the keys of `CAPTIONS`."""
    touches = any(touch.area > 0 for touch in of.states[-1].touches.values())
    known = bonds_of(of.states[-1].memory)
    damaged = any(known[bond.name][0].any() for bond in of.model.bonds if bond.name in known)
    kinds = {"undeformed": True, "deformed": len(of.states) > 1, "contact": touches, "bonds": damaged}
    return tuple(kind for kind, drawn in kinds.items() if drawn)


def path_figures(of: PathFields, response: Response, name: str) -> Iterator[tuple[str, Figure]]:
    """Draw the first and the last state with the same view, scale and colors.

    The first picture has marks of supports and loads. The outline of the first state is drawn behind the last. If there
    is contact in the last state, a third picture shows the contact pressure; another one the damage of bonds.

    Parameters
    ----------
    of : PathFields
        Fields of the path.
    response : Response
        Measures of the path, for the titles.
    name : str
        Name of the actuator in the titles.

    Yields
    ------
    tuple of str and matplotlib.figure.Figure
        ``"undeformed"``, ``"deformed"``, ``"contact"`` or ``"bonds"``, and the picture.
    """
    first, last, kinds = of.at(0), of.at(-1), pictured(of.solution)
    view, end = shared_view([first, last]), picture_title(response, -1, name)
    undeformed = state_figure(first, view, title=picture_title(response, 0, name))
    draw_marks(undeformed, first, view, marks_of(first))
    yield "undeformed", undeformed
    if "deformed" in kinds:
        yield "deformed", state_figure(last, view, title=end, ghost=first)
    if "contact" in kinds:
        yield "contact", state_figure(last, shared_view([first, last], color_by=CONTACT_PRESSURE), title=end)
    if "bonds" in kinds:
        yield "bonds", state_figure(last, shared_view([first, last], color_by=BOND_DAMAGE), title=end)
