"""Control of a three-chamber actuator: paths verified by the full model, a loop, times.

    python benchmarks/systems/control.py FOLDER     the page control.md and its pictures; half an hour

FOLDER stores the reduced models, so that a second run begins with them.
"""

import json
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
import turgor as tg
from benchmarks.shared.machine import machine
from benchmarks.shared.tables import table
from benchmarks.systems.control_arm import LENGTH, OPTIONS, PRESSURE, trained
from turgor.reduced.states.reduced import Reduced
from turgor.units import kPa, mm, ms
from turgor.views.plots.figures import PlotFigure, write_figure
from turgor.views.plots.styling import INK, QUIET, style_axes

Array = NDArray[np.float64]

PAGE = Path(__file__).with_suffix(".md")
PICTURES = Path(__file__).parents[2] / "docs" / "images" / "control"
ROWS, EVERY, RATE, SHARE = 200, 5, 20 * kPa, 0.6
SIDES = tg.control.Tip("yz")
PERIOD, SECONDS, DELAY, NOISE, STIFFER, LOOP_SHARE = 5 * ms, 6.0, 10 * ms, 0.2 * mm, 1.1, 0.5
TUNING = tg.control.Tuning(gain=0.05, smoothness=3e-4)
HEAD = """# Control of a three-chamber actuator

Written by `python benchmarks/systems/control.py FOLDER`, one thread. The actuator is 60 mm long, of Ecoflex 00-30, with three
chambers up to 12.3 kPa. The tip follows paths across the axis. Every fifth row is solved again with the full model: the
error is the distance of the tip of the full model from the wanted place, over the length of the actuator. Times are
processor time.

"""


@dataclass(frozen=True)
class Followed:
    """A path that was followed, and the errors of the rows that the full model solved again."""

    name: str
    track: tg.control.Track
    errors: list[float]
    model_errors: list[float]


def shapes(reach: float, count: int) -> dict[str, Array]:
    """Paths of the tip along y and z, within a share of the reach."""
    t = 2 * np.pi * np.arange(count) / (count - 1)
    spiral = np.linspace(0.0, 1.0, count)
    return {
        "circle": reach * np.column_stack([np.cos(t), np.sin(t)]),
        "figure-eight": reach * np.column_stack([np.sin(t), np.sin(t) * np.cos(t)]),
        "spiral": reach * spiral[:, None] * np.column_stack([np.cos(3 * t), np.sin(3 * t)]),
    }


def reach_of(reduced: Reduced) -> tuple[float, float]:
    """Smallest distance of the tip from the axis with one chamber at its limit; bending angle with two [rad]."""
    one = [reduced.at(PRESSURE * np.eye(3)[place]).tip[1:] for place in range(3)]
    two = tg.bending_angle(reduced.at(PRESSURE * np.array([0.0, 1.0, 1.0])).state())
    return float(np.linalg.norm(one, axis=1).min()), abs(two)


def followed(reduced: Reduced, name: str, path: Array, file: Path) -> Followed:
    """Follow a path, and solve every fifth row again with the full model; errors are saved as they come."""
    times, limits = np.linspace(0.0, 10.0, len(path)), tg.control.Limits(rate=RATE)
    track = tg.control.track(reduced, path, times=times, output=SIDES, limits=limits)
    print(name, track, track.seconds.max())
    known = json.loads(file.read_text()) if file.exists() else {}
    for place in range(0, len(path), EVERY):
        if str(place) in known:
            continue
        full = tg.real_time.verified(track.states[place], OPTIONS).state
        tip = np.array([tg.measures.tip_displacement_y(full), tg.measures.tip_displacement_z(full)])
        x = tg.measures.tip_displacement_x(full)
        model = np.linalg.norm(np.array([x, *tip]) - track.states[place].tip)
        known[str(place)] = [float(np.linalg.norm(tip - path[place])) / LENGTH, float(model) / LENGTH]
        file.write_text(json.dumps(known))
        print(name, place, known[str(place)], flush=True)
    own, model = zip(*known.values(), strict=True)
    return Followed(name, track, list(own), list(model))


def loop(reduced: Reduced, plant: Reduced, reach: float, delay: float) -> tg.control.LoopRun:
    """Follow a circle in a loop whose plant is stiffer, late and noisy; the controller counts on 10 ms."""
    path = loop_path(reach)
    controller = tg.control.Controller(
        reduced, period=PERIOD, output=SIDES, air=tg.control.Air(delay=DELAY), tuning=TUNING
    )
    actuator = tg.control.Plant(reduced=plant, air=tg.control.Air(delay=delay), stiffness=STIFFER, noise=NOISE)
    return tg.control.run_loop(controller, actuator, path)


def loop_path(reach: float) -> Array:
    """From rest to a circle, which is then followed once in four seconds."""
    t = np.arange(0.0, SECONDS, PERIOD)
    grown = 0.5 - 0.5 * np.cos(np.pi * np.minimum(t / 2.0, 1.0))
    turn = 2 * np.pi * np.maximum(t - 2.0, 0.0) / 4.0
    return np.asarray(reach * grown[:, None] * np.column_stack([np.cos(turn), np.sin(turn)]))


def unstable_from(reduced: Reduced, plant: Reduced, reach: float) -> tuple[float, dict[float, float]]:
    """Smallest delay with which the distance grows beyond a fifth of the circle, and the distances at each delay."""
    distances = {}
    for periods in (2, 4, 8, 12, 16, 20, 24, 28, 32, 40):
        try:
            distances[periods * PERIOD] = loop(reduced, plant, reach, periods * PERIOD).rms(after=2.0) / reach
        except tg.TurgorError:
            distances[periods * PERIOD] = np.inf
        print("delay", periods * PERIOD, distances[periods * PERIOD], flush=True)
        if distances[periods * PERIOD] > 0.2:
            return periods * PERIOD, distances
    return np.inf, distances


def draw(results: list[Followed], run: tg.control.LoopRun) -> None:
    """Draw the paths with the rows of the full model, and the loop."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    figure = PlotFigure(figsize=(10.5, 3.8))
    for axes, each in zip(figure.subplots(1, 3), results, strict=True):
        axes.plot(*each.track.target.T / mm, color=QUIET, lw=4, alpha=0.6, label="wanted")
        axes.plot(*each.track.reached.T / mm, color="#1f5fa8", lw=1.2, label="reduced model")
        axes.set_title(f"{each.name}: {max(each.errors):.2%} at most", color=INK, fontsize=10)
        axes.set_aspect("equal", adjustable="datalim")
        axes.set_xlabel("tip y [mm]", color=INK)
        axes.set_ylabel("tip z [mm]", color=INK)
        style_axes(axes)
    figure.axes[0].legend(frameon=False, fontsize=8)
    write_figure(PICTURES / "paths.png", figure, dpi=130)
    figure = PlotFigure(figsize=(9.0, 4.0))
    left, right = figure.subplots(1, 2)
    left.plot(*run.target.T / mm, color=QUIET, lw=4, alpha=0.6, label="wanted")
    left.plot(*run.reached.T / mm, color="#1f5fa8", lw=1.2, label="stiffer actuator in the loop")
    left.set_aspect("equal", adjustable="datalim")
    left.set_xlabel("tip y [mm]", color=INK)
    left.set_ylabel("tip z [mm]", color=INK)
    left.legend(frameon=False, fontsize=8)
    right.plot(run.times, run.inputs / kPa, lw=1.2)
    right.set_xlabel("time [s]", color=INK)
    right.set_ylabel("commands [kPa]", color=INK)
    for axes in (left, right):
        style_axes(axes)
    write_figure(PICTURES / "loop.png", figure, dpi=130)


def page(reduced: Reduced, results: list[Followed], run: tg.control.LoopRun, limit: float, sizes: Array) -> str:
    """Write the page."""
    reach, angle, loop_reach = sizes
    rows = [
        ("largest bending angle, two chambers", f"{np.rad2deg(angle):.0f}°", "60°"),
        ("reach of the tip across the axis", f"{reach / mm:.1f} mm", ""),
        ("held-out error of the displacement", f"{reduced.held_out.worst:.2%}", ""),
    ]
    for each in results:
        ticks, inputs = 1e3 * each.track.seconds, each.track.inputs
        steps = np.abs(np.diff(inputs, axis=0)).max() / (RATE * 10.0 / (ROWS - 1))
        rows += [
            (f"{each.name}: error against the full model, mean", f"{np.mean(each.errors):.3%}", "0.5 %"),
            (f"{each.name}: largest", f"{max(each.errors):.3%}", "1 %"),
            (f"{each.name}: that of the reduced model alone, largest", f"{max(each.model_errors):.3%}", ""),
            (f"{each.name}: tick, median", f"{np.median(ticks):.1f} ms", "5 ms"),
            (f"{each.name}: tick, 99th percentile", f"{np.percentile(ticks, 99):.1f} ms", "20 ms"),
            (f"{each.name}: pressures", f"{inputs.min() / kPa:.4f} to {inputs.max() / kPa:.4f} kPa", "0 to 12.3 kPa"),
            (f"{each.name}: largest rate over its limit", f"{steps:.12f}", "1 + 1e-9"),
        ]
    loop_ms = 1e3 * run.seconds
    rows += [
        ("loop: root mean square of the distance, over the radius", f"{run.rms(2.0) / loop_reach:.2%}", "2 %"),
        ("loop: tick of the controller, median", f"{np.median(loop_ms):.1f} ms", "5 ms"),
        ("loop: tick, 99th percentile", f"{np.percentile(loop_ms, 99):.1f} ms", "20 ms"),
        (
            "loop: delay from which it is unstable",
            "none up to 200 ms" if np.isinf(limit) else f"{1e3 * limit:.0f} ms",
            "",
        ),
    ]
    facts = "\n".join(f"- {name}: {value}" for name, value in machine().items())
    return HEAD + table(("quantity", "measured", "target"), rows) + "\n\n" + facts + "\n"


def main(folder: Path) -> None:
    """Train, follow, verify, run the loop, and write the page."""
    folder.mkdir(parents=True, exist_ok=True)
    reduced, plant = trained(folder, 18), trained(folder, 24)
    reach, angle = reach_of(reduced)
    loop_reach = LOOP_SHARE * reach
    run = loop(reduced, plant, loop_reach, DELAY)
    print(run, run.rms(2.0) / loop_reach)
    limit, _ = unstable_from(reduced, plant, loop_reach)
    results = [
        followed(reduced, name, path, folder / f"{name}.json") for name, path in shapes(SHARE * reach, ROWS).items()
    ]
    draw(results, run)
    PAGE.write_text(page(reduced, results, run, limit, np.array([reach, angle, loop_reach])), encoding="utf-8")
    print(PAGE.read_text(encoding="utf-8"))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
