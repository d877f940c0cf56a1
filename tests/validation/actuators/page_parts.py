"""What the parts of docs/measured-actuators.md share: the kept runs, tables, figures and recorded distances."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from PIL import Image
from turgor.pictures import COLORS as COLORS

import turgor as tg
from turgor.studies.runs.executors.run_outcome import Ended
from turgor.studies.runs.run import Run

DOCS = Path(__file__).parents[3] / "docs"
IMAGES = DOCS / "images" / "measured"
RECORDED = Path(__file__).parent / "recorded_distances.csv"


@dataclass(frozen=True, slots=True, kw_only=True)
class Page:
    """The runs that the page reads, and the distances that it states.

    Parameters
    ----------
    ended : dict of str to Ended
        By the key of the run.
    factor : float [-]
        Of all stresses of the calibrated bending actuators.
    distances : list of (str, str, float)
        What was compared, with what, and the distance [-].
    """

    ended: dict[str, Ended]
    factor: float = 1.0
    distances: list[tuple[str, str, float]] = field(default_factory=list)

    def of(self, run: Run) -> tg.Response:
        """What a run found; its problem as an error where it failed."""
        each = self.ended[run.key]
        if each.result is None:
            raise RuntimeError(f"{run.name}: {each.problem}")
        return each.result.response

    def picture(self, run: Run, name: str) -> str:
        """Write the picture of a run and return its place on the page."""
        result = self.ended[run.key].result
        IMAGES.mkdir(parents=True, exist_ok=True)
        with Image.open(BytesIO(result.picture if result else b"")) as drawn:
            drawn.convert("RGB").quantize(128).save(IMAGES / name, optimize=True)
        return f"images/measured/{name}"

    def record(self, what: str, model: str, distance: float) -> str:
        """Keep a distance for the summary and the tests; return it in percent."""
        self.distances.append((what, model, round(distance, 4)))
        return percent(round(distance, 4))


def text(name: str) -> str:
    """A part of the page, with the names of its numbers in braces."""
    return (Path(__file__).parent / "text" / f"{name}.md").read_text(encoding="utf-8")


def percent(value: float, digits: int = 1) -> str:
    """A share in percent."""
    return f"{100 * value:.{digits}f} %"


def signed(value: float) -> str:
    """A relative difference in percent with its sign; a dash where there is none."""
    return f"{100 * value:+.0f} %" if np.isfinite(value) else "–"


def number(value: float, digits: int = 1) -> str:
    """A number; a dash where there is none."""
    return f"{value:.{digits}f}" if np.isfinite(value) else "–"


def lines_of(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table in Markdown."""
    table = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(row)} |" for row in table) + "\n"


def save(figure: Figure, name: str) -> str:
    """Write a figure and return its place on the page."""
    IMAGES.mkdir(parents=True, exist_ok=True)
    with matplotlib.rc_context({"svg.hashsalt": "turgor"}):
        figure.savefig(IMAGES / name, metadata={"Date": None})
    return f"images/measured/{name}"


def new_figure(columns: int, height: float = 3.6) -> tuple[Figure, list]:
    """A figure with axes side by side."""
    figure = Figure(figsize=(4.0 * columns + 0.4, height), layout="constrained", facecolor="white")
    return figure, list(np.atleast_1d(figure.subplots(1, columns)))
