"""Sketches of the page on measures: `python docs/measures_sketches.py` writes docs/images/measures, in seconds."""

from collections.abc import Callable
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from scipy.spatial import ConvexHull

FOLDER = Path(__file__).parent / "images" / "measures"

#: Colors: lines of the actuator, what is measured, what stays in the background, the rubber.
INK, BLUE, QUIET, RUBBER = "#262b34", "#1f5fa8", "#9aa2ad", "#efe9e1"

#: Width and height of a sketch [inch].
SIZE = (2.9, 2.1)


def arc(angle: float, length: float = 1.0, count: int = 80) -> np.ndarray:
    """Points (n, 2) of an arc that starts along x and bends downwards."""
    s = np.linspace(0, length, count)
    turn = angle * s / length
    radius = length / angle
    return np.stack([radius * np.sin(turn), radius * (np.cos(turn) - 1)], axis=1)


def body(axes: Axes, line: np.ndarray, width: np.ndarray | float) -> None:
    """Draw an actuator of a width around its center line."""
    tangent = np.gradient(line, axis=0)
    normal = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1) / np.linalg.norm(tangent, axis=1)[:, None]
    half = np.broadcast_to(np.asarray(width) / 2, len(line))[:, None]
    outline = np.concatenate([line + half * normal, (line - half * normal)[::-1]])
    axes.add_patch(Polygon(outline, facecolor=RUBBER, edgecolor=INK, lw=0.9))


def clamp(axes: Axes, height: float = 0.34) -> None:
    """Draw what holds the left end."""
    axes.plot([0, 0], [-height / 2, height / 2], color=INK, lw=2)
    for y in np.linspace(-height / 2, height / 2, 6):
        axes.plot([-0.05, 0], [y - 0.04, y], color=INK, lw=0.7)


def arrow(
    axes: Axes, start: tuple[float, float], end: tuple[float, float], color: str = BLUE, both: bool = False
) -> None:
    """Draw an arrow."""
    how = {"arrowstyle": "<|-|>" if both else "-|>", "color": color, "lw": 1.1, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", end, start, arrowprops=how, annotation_clip=False)


def angle(axes: Axes, at: tuple[float, float], between: tuple[float, float], radius: float, text: str) -> None:
    """Draw an angle between two directions [degrees] with its letter."""
    turn = np.radians(np.linspace(*between, 40))
    axes.plot(at[0] + radius * np.cos(turn), at[1] + radius * np.sin(turn), color=BLUE, lw=1.1)
    middle = np.radians(sum(between) / 2)
    axes.text(at[0] + 1.3 * radius * np.cos(middle), at[1] + 1.3 * radius * np.sin(middle), text, color=BLUE,
              ha="center", va="center")  # fmt: skip


def angles(axes: Axes) -> None:
    """Bending angle and chord angle."""
    turn = 1.3
    line = arc(turn)
    body(axes, line, 0.16)
    clamp(axes)
    tip = line[-1]
    axes.plot([0, 1.25], [0, 0], color=QUIET, lw=0.8, ls="--")
    axes.plot([0, tip[0]], [0, tip[1]], color=BLUE, lw=0.9, ls=":")
    ahead = 0.34 * np.array([np.cos(turn), -np.sin(turn)])
    arrow(axes, tuple(tip), tuple(tip + ahead))
    axes.plot([tip[0], tip[0] + 0.36], [tip[1], tip[1]], color=QUIET, lw=0.8, ls="--")
    angle(axes, tuple(tip), (0, -np.degrees(turn)), 0.22, "θ")
    angle(axes, (0, 0), (0, -np.degrees(turn) / 2), 0.42, "θ/2")


def curvature(axes: Axes) -> None:
    """Curvature and radius."""
    turn = 1.9
    line = arc(turn)
    body(axes, line, 0.16)
    clamp(axes)
    axes.plot(*line.T, color=BLUE, lw=1.1)
    center = (0.0, -1 / turn)
    axes.plot(*center, "o", color=BLUE, ms=3)
    arrow(axes, center, tuple(line[50]))
    axes.text(0.06, -0.34, "R = 1/κ", color=BLUE)
    axes.text(line[62][0] + 0.13, line[62][1], "s", color=BLUE)


def plane(axes: Axes) -> None:
    """Bending plane, seen from the tip towards the base."""
    turn = np.linspace(0, 2 * np.pi, 80)
    axes.fill(0.35 * np.cos(turn), 0.35 * np.sin(turn), facecolor=RUBBER, edgecolor=INK, lw=0.9)
    arrow(axes, (0, 0), (0, -0.72), QUIET)
    arrow(axes, (0, 0), (0.75, 0), QUIET)
    axes.text(0.05, -0.8, "−z: towards the base", color=INK, va="center")
    axes.text(0.8, 0, "+y", color=INK, va="center")
    direction = np.radians(-90 + 50)
    arrow(axes, (0, 0), (0.85 * np.cos(direction), 0.85 * np.sin(direction)))
    angle(axes, (0, 0), (-90, -40), 0.5, "φ")


def helix(axes: Axes) -> None:
    """Radius and pitch of a helix."""
    turn = np.linspace(0, 4.6 * np.pi, 400)
    x, y = 0.085 * turn, 0.3 * np.sin(turn)
    front = np.cos(turn) > 0
    axes.plot(x, np.where(front, y, np.nan), color=INK, lw=2)
    axes.plot(x, np.where(front, np.nan, y), color=QUIET, lw=2)
    axes.plot([-0.05, 1.32], [0, 0], color=QUIET, lw=0.8, ls="--")
    first, second = 0.085 * np.pi / 2, 0.085 * 2.5 * np.pi
    arrow(axes, (first, 0.42), (second, 0.42), both=True)
    axes.text((first + second) / 2, 0.48, "pitch P", color=BLUE, ha="center")
    for place in (first, second):
        axes.plot([place, place], [0.3, 0.44], color=BLUE, lw=0.6)
    arrow(axes, (0.085 * 3.5 * np.pi, 0), (0.085 * 3.5 * np.pi, -0.3))
    axes.text(0.085 * 3.5 * np.pi + 0.04, -0.16, "r", color=BLUE)


def deviation(axes: Axes) -> None:
    """Distance of the center line from the nearest arc."""
    line = arc(1.5)
    ripple = line + 0.06 * np.sin(np.linspace(0, 4 * np.pi, 80))[:, None] * np.stack(
        [np.sin(np.linspace(0, 1.5, 80)), np.cos(np.linspace(0, 1.5, 80))], axis=1
    )
    clamp(axes)
    axes.plot(*ripple.T, color=INK, lw=2)
    axes.plot(*line.T, color=BLUE, lw=1.1, ls="--")
    for k in (10, 30, 50, 70):
        axes.plot(*np.stack([line[k], ripple[k]]).T, color=BLUE, lw=1.1)
    axes.text(0.5, 0.12, "distance d", color=BLUE)
    axes.text(0.02, -0.62, "nearest arc", color=BLUE)


def ballooning(axes: Axes) -> None:
    """Width now and at rest."""
    line = np.stack([np.linspace(0, 1.1, 80), np.zeros(80)], axis=1)
    width = 0.24 + 0.3 * np.sin(np.pi * np.linspace(0, 1, 80)) ** 2
    body(axes, line, width)
    clamp(axes)
    for sign in (-1, 1):
        axes.plot([0, 1.1], [sign * 0.12] * 2, color=QUIET, lw=0.9, ls="--")
    arrow(axes, (0.55, -0.27), (0.55, 0.27), both=True)
    arrow(axes, (0.22, -0.12), (0.22, 0.12), QUIET, both=True)
    axes.text(0.58, 0.02, "b", color=BLUE)
    axes.text(0.25, 0.0, "b₀", color=INK)


def work(axes: Axes) -> None:
    """Area under pressure over volume."""
    volume = np.linspace(0, 1, 60)
    pressure = 0.75 * (1.6 * volume - 1.1 * volume**2 + 0.45 * volume**3)
    axes.fill_between(volume, 0, pressure, color=BLUE, alpha=0.18, lw=0)
    axes.plot(volume, pressure, color=BLUE, lw=1.6)
    arrow(axes, (0, 0), (1.2, 0), INK)
    arrow(axes, (0, 0), (0, 0.85), INK)
    axes.text(1.22, 0, "volume V", va="center", color=INK)
    axes.text(0.04, 0.85, "pressure p", va="center", color=INK)
    axes.text(0.6, 0.2, "W = ∫ p dV", color=BLUE, ha="center")


def efficiency(axes: Axes) -> None:
    """What goes in, what is stored, what goes out."""
    for low, high, text in ((0.0, 0.5, "stored in rubber"), (0.5, 0.8, "out: F · u")):
        color = QUIET if low == 0 else BLUE
        axes.fill_between([0.8, 1.25], low, high, color=color, alpha=0.35, lw=0)
        axes.text(1.3, (low + high) / 2, text, va="center", color=INK if low == 0 else BLUE)
    axes.fill_between([0.0, 0.45], 0.0, 0.8, color=BLUE, alpha=0.18, lw=0)
    axes.text(0.22, 0.4, "fluid\n∫ p dV", va="center", ha="center", color=BLUE)
    arrow(axes, (0.5, 0.4), (0.75, 0.4), INK)


def stiffness(axes: Axes) -> None:
    """A small force at the tip, and how far the tip moves."""
    line, moved = arc(1.0), arc(1.28)
    body(axes, line, 0.14)
    clamp(axes)
    axes.plot(*moved.T, color=BLUE, lw=1.2, ls="--")
    tip, new = line[-1], moved[-1]
    arrow(axes, (tip[0] + 0.24, tip[1] + 0.30), (tip[0] + 0.06, tip[1] + 0.08))
    axes.text(tip[0] + 0.27, tip[1] + 0.28, "δF", color=BLUE)
    arrow(axes, tuple(tip), tuple(new))
    axes.text(new[0] - 0.04, new[1] - 0.12, "δu", color=BLUE)


def workspace(axes: Axes) -> None:
    """Places of the tip and their hull."""
    turn = np.linspace(-1.2, 1.2, 7)
    places = np.array([(np.sin(a) / a if a else 1, (1 - np.cos(a)) / a if a else 0) for a in turn])
    places = np.concatenate([places, 0.9 * places, 0.8 * places[2:5]])
    hull = places[ConvexHull(places).vertices]
    axes.add_patch(Polygon(hull, facecolor=BLUE, alpha=0.16, lw=0))
    axes.add_patch(Polygon(hull, facecolor="none", edgecolor=BLUE, lw=1.1))
    axes.plot(*places.T, "o", color=BLUE, ms=3)
    for number in (0, 3, 6):
        bend = turn[number]
        axes.plot(*(arc(-bend).T if bend else np.array([[0, 1], [0, 0]])), color=QUIET, lw=1.4)
    clamp(axes)


#: Sketches by the names of their files.
SKETCHES: dict[str, Callable[[Axes], None]] = {
    "angles": angles,
    "curvature": curvature,
    "bending-plane": plane,
    "helix": helix,
    "arc-deviation": deviation,
    "ballooning": ballooning,
    "work": work,
    "efficiency": efficiency,
    "tip-stiffness": stiffness,
    "workspace": workspace,
}


def sketch(draw: Callable[[Axes], None]) -> Figure:
    """Make a figure of one sketch."""
    figure = Figure(figsize=SIZE, facecolor="white")
    axes = figure.add_axes((0.02, 0.02, 0.96, 0.96))
    draw(axes)
    axes.set_aspect("equal")
    axes.margins(0.08)
    axes.axis("off")
    return figure


def main() -> None:
    """Write all sketches."""
    FOLDER.mkdir(exist_ok=True)
    style = {"font.size": 9, "svg.fonttype": "none", "svg.hashsalt": "turgor", "font.family": "DejaVu Sans"}
    with matplotlib.rc_context(style):
        for name, draw in SKETCHES.items():
            metadata = {"Creator": "turgor", "Date": None}
            sketch(draw).savefig(FOLDER / f"{name}.svg", metadata=metadata, bbox_inches="tight", pad_inches=0.05)


if __name__ == "__main__":
    main()
