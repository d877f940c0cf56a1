"""Page: what a reduced model answers, and its errors against the inputs, in one HTML file."""

from base64 import b64encode
from importlib.resources import files

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import NotSolved
from turgor.foundation.response import COLUMN_UNITS
from turgor.reduced.measures import readings
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.inputs import Inputs
from turgor.reduced.states.reduced import Reduced
from turgor.views.pictures.state_picture import bare_picture, shared_view
from turgor.views.plots.figures import svg_of
from turgor.views.plots.studies.known_errors import KnownError, error_figure, summary
from turgor.views.report.templating import rendered

Array = NDArray[np.float64]

#: Errors of held-out states by their names on the page: what they are shares of.
NAMES = {
    "displacement": "displacement of any node, over the largest",
    "tip": "displacement of the tip, over its travel",
    "volume": "volume of a cavity",
    "force": "force on an obstacle, over the largest",
}


def reduced_page(reduced: Reduced) -> str:
    """Write the page of a reduced model: inputs, held-out errors with their picture, and the actuator.

    Parameters
    ----------
    reduced : Reduced
        Its measures (`with_measures`) are read off at the largest inputs.

    Returns
    -------
    str
        HTML that loads nothing.
    """
    box, names = reduced.inputs, _names(reduced)
    units = np.array([COLUMN_UNITS[unit] for unit in box.units])
    held_out = reduced.held_out
    known = [
        KnownError(label=f"{name}, held out", inputs=held_out.inputs / units, errors=getattr(held_out, name))
        for name in names
    ]
    if len(reduced.known.errors):
        trained = reduced.known.places[:, 1:] / reduced.weights[1:]
        known.insert(0, KnownError(label="displacement, training", inputs=trained / units,
                                   errors=reduced.known.errors, trained=True))  # fmt: skip
    answer = _largest(reduced)
    picture = "" if answer is None else _picture(answer)
    r, m = reduced.equations.sizes
    values = {
        "title": f"Reduced model: {reduced.model.mesh.name}",
        "verdict": _verdict(reduced),
        "inputs": [(key, box.shown(k, box.low[k]), box.shown(k, box.high[k])) for k, key in enumerate(box.keys)],
        "errors": summary({NAMES[name]: getattr(held_out, name) for name in names}),
        "plot": svg_of(error_figure(_labels(box), known, reduced.wanted)),
        "picture": picture,
        "at": "" if answer is None else box.text(answer.inputs),
        "estimate": "" if answer is None else f"{100 * answer.estimate:.2g} %",
        "measures": [] if answer is None else [(each.words, each.text) for each in readings(answer)],
        "parts": [
            ("unknowns of the full model", f"{reduced.model.mesh.unknown_count:,}"),
            ("modes of displacement and mean stress", f"{r} + {m}"),
            *((name, f"{count:,}") for name, count in reduced.counts.items()),
        ],
    }
    return rendered(files("turgor.views.report").joinpath("templates/reduced.html").read_text("utf-8"), values)


def _names(reduced: Reduced) -> list[str]:
    """Errors that a model has: none of forces without obstacles."""
    if not len(reduced.held_out.inputs):
        return []
    return [name for name in NAMES if name == "displacement" or getattr(reduced.held_out, name).any()]


def _labels(box: Inputs) -> list[str]:
    return [f"{key} [{unit}]" if unit else key for key, unit in zip(box.keys, box.units, strict=True)]


def _verdict(reduced: Reduced) -> str:
    """One sentence: the largest held-out error, and whether it is the wanted one."""
    worst, wanted = reduced.held_out.worst, f"{100 * reduced.wanted:g} %"
    if np.isnan(worst):
        return f"No full solve was kept from training, so the wanted error of {wanted} is unchecked."
    count, lost = len(reduced.held_out.inputs), int(np.isinf(reduced.held_out.displacement).sum())
    if lost:
        return (
            f"At {lost} of {count} states that training never saw, the reduced model finds nothing; train more densely."
        )
    meets = f"within the wanted {wanted}" if worst <= reduced.wanted else f"above the wanted {wanted}"
    return (
        f"At {count} states that training never saw, the largest error of a displacement is {100 * worst:.2g} % of the "
        f"largest displacement: {meets}."
    )


def _largest(reduced: Reduced) -> ReducedState | None:
    """The answer at the largest values of the inputs, or at a held-out state where there is none."""
    for place in [reduced.inputs.high, *reduced.held_out.inputs[::-1]]:
        try:
            return reduced.at(place)
        except NotSolved:
            continue
    return None


def _picture(answer: ReducedState) -> str:
    """The actuator, a PNG as text."""
    state = answer.state()
    return b64encode(bare_picture(state, shared_view([state], width=900))).decode()
