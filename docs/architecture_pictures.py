"""Draw docs/images/rooms.svg and docs/images/step.svg, the two pictures of docs/architecture.md.

Run it after a wing or a part of a step has changed: ``python docs/architecture_pictures.py``, some seconds. `ROOMS` and
`PARTS` name what the pictures show, and a test looks that all of it exists.
"""

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch
from matplotlib.path import Path as MarkerPath

IMAGES = Path(__file__).parent / "images"

#: The folders (and `measure`) of all wings in the order of imports, as the page has it.
ROOMS = (
    "core.materials", "core.geometry", "core.meshing", "core.model", "core.engine", "core.solvers", "core.setups",
    "core.inp", "core.results", "fast_models.formulas", "fast_models.rod", "fast_models.section", "views",
    "accuracy.gradients", "accuracy.adaptivity", "accuracy.measure", "accuracy.laboratory", "job", "studies.runs",
    "studies.calibration", "studies.uncertainty", "studies.sensitivity", "studies.surrogates", "studies.optimization",
    "studies.study_file", "reduced", "systems", "studio", "cli",
)  # fmt: skip

#: The wings above the core in the first picture: two rows, from below.
WINGS = {
    "fast_models": "formulas, rods, sections",
    "views": "pictures, plots, report",
    "accuracy": "mesh error, gradients",
    "job": "one run as a TOML file",
    "studies": "many runs, and their use",
    "reduced": "answers in milliseconds",
    "systems": "actuators with drives",
    "studio": "a page in the browser",
    "cli": "one command, one file",
}

#: What every wing stands on.
FOUNDATION = ("errors", "source", "finding", "response", "registry", "store", "startup")

#: What does the work in each box of the second picture.
PARTS = (
    "turgor.core.solvers.continuation.path_follower.follow",
    "turgor.core.solvers.continuation.step_control.StepControl",
    "turgor.core.solvers.continuation.path_run.Strategy",
    "turgor.core.solvers.continuation.predictor.predicted",
    "turgor.core.solvers.newton.newton.newton",
    "turgor.core.solvers.newton.contact_newton.newton_with_contact",
    "turgor.core.solvers.newton.line_search.line_search",
    "turgor.core.solvers.newton.border.Border",
    "turgor.core.solvers.newton.inertia_correction.inertia_corrected",
    "turgor.core.solvers.newton.pseudo_transient.pseudo_transient",
    "turgor.core.solvers.continuation.step_acceptance.why_rejected",
    "turgor.core.solvers.continuation.continuity.judged",
    "turgor.core.solvers.continuation.limit_points.insert_limit_points",
    "turgor.core.solvers.step_reasons.Reason",
    "turgor.core.engine.system.System",
    "turgor.core.engine.algebra.tangent.Tangent",
)

#: Distance between the lines of a box.
LEADING = 2.5
INK, QUIET = "#1f2933", "#5f6c7b"
BLUE, GREEN, AMBER, ROSE, GRAY = "#dbe9f6", "#dcefe0", "#fbeccb", "#f8dfdc", "#eef0f3"
EDGE = {BLUE: "#4a7fb5", GREEN: "#4c9464", AMBER: "#c28b1c", ROSE: "#c0605a", GRAY: "#9aa5b1", "white": "#4a7fb5"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """A rounded box with a heading, a room in the type of code, and lines; ``x`` and ``y`` are its middle."""

    x: float
    y: float
    width: float
    height: float
    heading: str = ""
    room: str = ""
    lines: str = ""
    color: str = BLUE
    dashed: bool = False

    def draw(self, axes: Axes) -> None:
        """Draw it."""
        corner = (self.x - self.width / 2, self.y - self.height / 2)
        axes.add_patch(
            FancyBboxPatch(
                corner, self.width, self.height, boxstyle="round,pad=0,rounding_size=1.1", facecolor=self.color,
                edgecolor=EDGE[self.color], linewidth=1.2, linestyle=(0, (4, 3)) if self.dashed else "solid", zorder=2,
            )
        )  # fmt: skip
        rows = [(self.heading, 11, "bold", "sans-serif")] if self.heading else []
        rows += [(self.room + "/", 9.5, "normal", "monospace")] if self.room else []
        rows += [(line, 9.5, "normal", "sans-serif") for line in self.lines.splitlines()]
        for place, (text, size, weight, family) in enumerate(rows):
            height = self.y + LEADING * ((len(rows) - 1) / 2 - place)
            axes.text(self.x, height, text, ha="center", va="center", fontsize=size, fontweight=weight, family=family,
                      color=INK, zorder=3)  # fmt: skip

    def at(self, side: str, along: float = 0.0) -> tuple[float, float]:
        """Point on a side: ``"left"``, ``"right"``, ``"top"`` or ``"bottom"``, moved along it from the middle."""
        across = {"left": -self.width / 2, "right": self.width / 2}
        if side in across:
            return self.x + across[side], self.y + along
        return self.x + along, self.y + (self.height / 2 if side == "top" else -self.height / 2)


def arrow(axes: Axes, start: tuple[float, float], end: tuple[float, float], **style: object) -> None:
    """Draw an arrow; ``bend`` curves it, ``both`` gives it two heads, ``dashed`` breaks its line."""
    heads = "<|-|>" if style.get("both") else "-|>"
    axes.add_patch(
        FancyArrowPatch(
            start, end, arrowstyle=heads, mutation_scale=12, linewidth=1.4, color=style.get("color", QUIET),
            shrinkA=1.5, shrinkB=2.5, zorder=1, linestyle=(0, (4, 3)) if style.get("dashed") else "solid",
            connectionstyle=str(style.get("bend", "arc3,rad=0")),
        )
    )  # fmt: skip


def label(axes: Axes, x: float, y: float, text: str, **style: object) -> None:
    """Write small text next to an arrow or a box."""
    axes.text(
        x, y, text, ha=style.get("ha", "center"), va=style.get("va", "center"), fontsize=style.get("size", 9),
        color=style.get("color", QUIET), style=style.get("style", "normal"), linespacing=1.25, zorder=3,
        family=style.get("family", "sans-serif"), fontweight=style.get("weight", "normal"),
    )  # fmt: skip


def route(axes: Axes, corners: tuple[tuple[float, float], ...]) -> None:
    """Draw an arrow along straight lines through some corners."""
    path = MarkerPath(corners, [MarkerPath.MOVETO] + [MarkerPath.LINETO] * (len(corners) - 1))
    axes.add_patch(
        FancyArrowPatch(path=path, arrowstyle="-|>", mutation_scale=12, linewidth=1.4, color=QUIET, zorder=1,
                        joinstyle="round")
    )  # fmt: skip


def blank(width: float, height: float) -> tuple[Figure, Axes]:
    """Make an empty picture of 100 units across, without axes."""
    figure = Figure(figsize=(width, height), facecolor="white")
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, 100), ylim=(0, 100 * height / width))
    axes.axis("off")
    return figure, axes


def panel(axes: Axes, corner: tuple[float, float], width: float, height: float, color: str = "white") -> None:
    """Draw a large box behind others."""
    axes.add_patch(
        FancyBboxPatch(corner, width, height, boxstyle="round,pad=0,rounding_size=1.1", facecolor=color,
                       edgecolor=EDGE[AMBER if color != "white" else color], linewidth=1.2, zorder=0.5)
    )  # fmt: skip


def wings(axes: Axes) -> None:
    """Draw the wings on the core, and the foundation below it."""
    for place, (wing, lines) in enumerate(WINGS.items()):
        row, column = divmod(place, 5)
        Box(x=11.5 + 19.25 * column, y=50 + 8 * row, width=18, height=6.4, lines=lines, room=wing,
            color=ROSE if row else AMBER).draw(axes)  # fmt: skip
    Box(x=50, y=2.6, width=94, height=4, lines="foundation:   " + ",  ".join(FOUNDATION), color=GRAY).draw(axes)
    label(
        axes,
        50,
        63.7,
        "A wing imports from those below it, and from those to its left in the same row.",
        style="italic",
    )


def rooms() -> Figure:
    """Draw the wings; in the core the values, what makes them, and the files that they are read from and written to."""
    figure, axes = blank(10, 6.6)
    wings(axes)
    panel(axes, (3, 6.6), 94, 38.6)
    label(axes, 92, 42.2, "core/", family="monospace", size=10.5, color=INK)
    high, low, middle = 36, 18.4, 27.2
    test = Box(x=13, y=high, width=16, height=8, heading="MaterialTest", room="materials", color=GREEN)
    material = Box(x=34, y=high, width=14, height=8, heading="Material", room="materials", color=GREEN)
    geometry = Box(x=13, y=low, width=16, height=8, heading="Geometry", room="geometry", color=GREEN)
    mesh = Box(x=34, y=low, width=14, height=8, heading="Mesh", room="meshing", color=GREEN)
    model = Box(x=50.5, y=middle, width=12.4, height=8, heading="Model", room="model")
    solution = Box(x=69, y=middle, width=13, height=8, heading="Solution", room="solvers")
    response = Box(x=88.5, y=middle, width=13, height=8, heading="Response", room="results")
    setups = Box(x=53, y=40, width=19, height=6, lines="blocked force, grasp", room="setups", color=AMBER)
    engine = Box(x=69, y=13, width=27, height=7, lines="residual, tangent, factors", room="engine", color=AMBER)
    for box in (test, material, geometry, mesh, model, solution, response, setups, engine):
        box.draw(axes)
    arrow(axes, test.at("right"), material.at("left"))
    arrow(axes, geometry.at("right"), mesh.at("left"))
    arrow(axes, material.at("bottom", 3), model.at("left", 2), bend="arc3,rad=0.22")
    arrow(axes, mesh.at("top", 3), model.at("left", -2), bend="arc3,rad=-0.22")
    arrow(axes, model.at("right"), solution.at("left"))
    arrow(axes, solution.at("right"), response.at("left"))
    arrow(axes, engine.at("top"), solution.at("bottom"), both=True)
    arrow(axes, setups.at("bottom", -2.5), model.at("top"))
    for x, y, text in ((24, high, "fit"), (24, low, "mesh"), (59.6, middle, "solve"), (78.8, middle, "measure")):
        label(axes, x, y + 1.6, text, family="monospace", size=9, color=INK)
    label(axes, test.x, high + 5.6, "from CSV")
    label(axes, material.x, high + 5.6, "from TOML, to TOML")
    label(axes, geometry.x, low - 6.4, "from STEP, BREP, STL\nto STEP, STL")
    label(axes, mesh.x, low - 6.4, "from gmsh, Abaqus, VTK\nto VTU, STL")
    label(axes, model.x + 1, middle - 6.5, "to Abaqus,\nCalculiX")
    label(axes, solution.x, middle + 5.6, "to VTU")
    label(axes, response.x, middle - 5.6, "to CSV")
    return figure


def step() -> Figure:
    """Draw one step along a path."""
    figure, axes = blank(10, 6.0)
    middle, below = 33.0, 13.5
    state = Box(x=8, y=middle, width=13, height=10, heading="State", lines="the last one\nof the path", color=GREEN)
    control = Box(x=28, y=middle, width=14, height=10, heading="Step control", lines="the parameter\nto try next")
    guess = Box(x=46.3, y=middle, width=14, height=10, heading="Predictor", lines="extrapolates the\nlast states")
    judge = Box(
        x=90.6, y=middle, width=17, height=10, heading="Acceptance", lines="converged? stable?\non the same branch?"
    )
    shorter = Box(x=28, y=below, width=13.4, height=8, heading="Shorter step", lines="a third of it", color=ROSE)
    rescue = Box(
        x=8, y=below, width=13.6, height=10, heading="Rescue", lines="pseudo-transient\ncontinuation", color=ROSE
    )
    panel(axes, (56.2, 10), 23.2, 39, "#fdf7e8")
    label(axes, 67.8, 46.6, "Newton's method", size=11, color=INK, weight="bold")
    inner = [
        Box(x=66.6, y=41.2, width=17.6, height=5.2, lines="residual", color=AMBER),
        Box(x=66.6, y=34.0, width=17.6, height=5.2, lines="tangent and its factors", color=AMBER),
        Box(x=66.6, y=26.8, width=17.6, height=5.2, lines="update, with border", color=AMBER),
        Box(x=66.6, y=19.6, width=17.6, height=5.2, lines="line search", color=AMBER),
    ]
    for box in (state, control, guess, judge, shorter, rescue, *inner):
        box.draw(axes)
    for upper, lower in pairwise(inner):
        arrow(axes, upper.at("bottom"), lower.at("top"))
    route(axes, (inner[3].at("right"), (77.6, 19.6), (77.6, 41.2), inner[0].at("right")))
    label(axes, 67.8, 13.2, "contact: partners, friction and\npenalty renewed until they settle", size=8.5)
    arrow(axes, state.at("right"), control.at("left"))
    arrow(axes, control.at("right"), guess.at("left"))
    arrow(axes, guess.at("right"), (56.2, middle))
    arrow(axes, (79.4, middle), judge.at("left"))
    route(axes, (judge.at("top"), (90.6, 54.5), (8, 54.5), state.at("top")))
    label(
        axes, 49.5, 56.3, "accepted: limit points on the way are found, the path has a new state", size=9.5, color=INK
    )
    route(axes, (judge.at("bottom"), (90.6, 4.5), (28, 4.5), shorter.at("bottom")))
    label(axes, 59, 2.6, "rejected, with a reason", size=9.5, color=INK)
    arrow(axes, shorter.at("top"), control.at("bottom"))
    arrow(axes, shorter.at("left"), rescue.at("right"))
    label(axes, 18, below + 1.5, "too short", size=8.5)
    arrow(axes, rescue.at("top"), state.at("bottom"))
    label(axes, 8, 5.8, "or the run ends: status,\nadvice, the path so far", size=8.5)
    return figure


def main() -> None:
    """Write both pictures; text becomes paths, so that they look the same everywhere."""
    with matplotlib.rc_context({"svg.hashsalt": "turgor", "svg.fonttype": "path", "font.family": "DejaVu Sans"}):
        rooms().savefig(IMAGES / "rooms.svg", metadata={"Date": None})
        step().savefig(IMAGES / "step.svg", metadata={"Date": None})


if __name__ == "__main__":
    main()
