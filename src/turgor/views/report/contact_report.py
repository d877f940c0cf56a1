"""Contact in a report: a row for each contact, and plots against the drive."""

import numpy as np

from turgor.core.model.contact import SELF
from turgor.core.model.model import Model
from turgor.core.results.fields.contact import ContactResult, contact_results, drawn_obstacles
from turgor.core.results.measures.contact_measures import area_on, force_on
from turgor.core.results.measures.measures import measure
from turgor.core.solvers.solution import Solution
from turgor.units import kPa, mm, um
from turgor.views.plots.figures import svg_of
from turgor.views.plots.response_plots import contact_figure

#: Heads of the columns of the table.
CONTACT_HEADS = (
    "contact", "force x [N]", "force y [N]", "force z [N]", "force [N]", "area [mm²]", "largest pressure [kPa]",
    "deepest penetration [µm]", "of the tolerance [%]",
)  # fmt: skip


def contact_section(solution: Solution) -> dict[str, object]:
    """Collect the part of a report about contact: a row for each contact, the surfaces without contact, and plots.

    Parameters
    ----------
    solution : Solution

    Returns
    -------
    dict
        Empty rows where there is no contact.
    """
    contacts = contact_results(solution.states[-1]) if solution.states else ()
    plot = contact_plot(solution)
    apart = [_name(result) for result in contacts if result.area == 0]
    return {
        "contact_heads": CONTACT_HEADS,
        "contact_rows": [_row(result) for result in contacts if result.area > 0],
        "contact_apart": apart,
        "contact_plot": plot,
        "contact_panels": plot.count('id="axes_'),
    }


def contact_columns(model: Model) -> set[str]:
    """Name the columns of a response that measures of single contacts fill."""
    names = [each.name for each in model.contact.obstacles]
    return {force_on(name).name for name in names} | {area_on(name).name for name in (SELF, *names)}


def contact_plot(solution: Solution) -> str:
    """Draw the force on each obstacle and the areas that touch along the path.

    Parameters
    ----------
    solution : Solution

    Returns
    -------
    str
        SVG; empty where nothing ever touches.
    """
    names = (SELF, *(each.name for each in drawn_obstacles(solution.model)))
    touched = [name for name in names if _ever_touched(solution, name)]
    if not touched:
        return ""
    forces = [force_on(name) for name in touched if name != SELF]
    figure = contact_figure(measure(solution, *forces, *map(area_on, touched)))
    return svg_of(figure) if figure else ""


def _ever_touched(solution: Solution, name: str) -> bool:
    return any(name in state.touches and state.touches[name].area > 0 for state in solution.states)


def _row(result: ContactResult) -> list[str]:
    if result.name == SELF:
        force = ["–", "–", "–", _number(result.pressing)]
    else:
        force = [_number(part) for part in (*result.force, float(np.linalg.norm(result.force)))]
    return [
        _name(result), *force, _number(result.area / mm**2), _number(result.pressure / kPa),
        _number(result.penetration / um), f"{100 * result.share:.0f}",
    ]  # fmt: skip


def _name(result: ContactResult) -> str:
    return "the actuator with itself" if result.name == SELF else result.name.replace("_", " ")


def _number(value: float) -> str:
    """Three digits without an exponent; zero for what is a millionth of the unit or less."""
    if abs(value) < 1e-6:
        return "0"
    decimals = int(np.clip(2 - np.floor(np.log10(abs(value))), 0, 6))
    return f"{value:.{decimals}f}".replace("-", "−")
