"""Control: paths of a three-chamber actuator against the full model, a force on a plate, and a loop.

    python benchmarks/systems/control.py FOLDER    the page control.md again; ten minutes

The folder is that of `benchmarks/reduced/omnidirectional.py`, whose arm with three pressures it takes, or trains.
Every fifth point of each path is solved again with the full model, the paths in three processes, each with one thread.
"""

import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
import turgor as tg
from benchmarks.reduced.omnidirectional import CASES, trained
from benchmarks.shared.machine import machine
from benchmarks.shared.tables import table
from turgor.core.results.measures.contact_measures import force_on
from turgor.core.solvers.solution import State
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.reduced.states.reduced import Reduced
from turgor.units import kPa, mm

Array = NDArray[np.float64]
PAGE = Path(__file__).with_suffix(".md")
JOB = Path(__file__).parents[2] / "examples" / "fast_pneunet.toml"
OPTIONS = tg.EngineOptions(threads=1)
SIDES = tg.control.Tip("yz")
POINTS, EVERY, DURATION, PERIOD = 200, 5, 20.0, 5e-3
NOISE, DELAY, STIFFER, BIAS, TURN = 0.2 * mm, 10e-3, 1.1, 0.15, 6.0
HEAD = """# Control of a three-chamber actuator

Written by `python benchmarks/systems/control.py FOLDER` in one run; times are processor time.

"""


@dataclass(frozen=True, slots=True)
class Reach:
    """How far an actuator goes with one of its chambers.

    Parameters
    ----------
    radius : float [m]
        Least distance sideways of the tip, of the three chambers.
    angle : float [rad]
        Least bending.
    pressure : float [Pa]
    length : float [m]
    """

    radius: float
    angle: float
    pressure: float
    length: float


def pressures_of(reduced: Reduced) -> list[int]:
    """Places of the inputs that are pressures of the three chambers."""
    return [k for k, key in enumerate(reduced.inputs.keys) if key.endswith("pressure")]


def still(reduced: Reduced) -> tg.control.Limits:
    """Other inputs, such as a tip force, stay at zero; pressures of three chambers are not below zero."""
    keys, pressed = reduced.inputs.keys, pressures_of(reduced)
    low = {key: 0.0 for k, key in enumerate(keys)}
    return tg.control.Limits(low=low, high={key: 0.0 for k, key in enumerate(keys) if k not in pressed})


def reach_of(reduced: Reduced) -> Reach:
    """Find the reach of one chamber at its largest pressure."""
    sideways, angles = [], []
    for k in pressures_of(reduced):
        inputs = np.zeros(len(reduced.inputs.keys))
        inputs[k] = reduced.inputs.high[k]
        answer = reduced.at(inputs)
        sideways.append(float(np.linalg.norm(answer.tip[1:])))
        angles.append(turned(answer.state()))
    high = reduced.inputs.high[pressures_of(reduced)].min()
    return Reach(min(sideways), min(angles), float(high), float(np.ptp(reduced.model.mesh.points[:, 0])))


def turned(state: State) -> float:
    """Angle [rad] between the end face at rest and now."""
    from turgor.core.engine.faces import surfaces

    mesh = state.model.mesh
    rest, now = (surfaces.vector_area(points, mesh.face("tip"))
                 for points in (mesh.points, mesh.points + state.displacement))  # fmt: skip
    return float(np.arccos(rest @ now / np.linalg.norm(rest) / np.linalg.norm(now)))


def shapes(radius: float, count: int) -> dict[str, Array]:
    """Circle, figure-eight and spiral of the tip in the plane across the actuator (count, 2) [m]."""
    share = np.linspace(0.0, 1.0, count)
    turn = 2 * np.pi * share
    return {
        "circle": radius * np.column_stack([np.cos(turn), np.sin(turn)]),
        "figure-eight": radius * np.column_stack([np.sin(turn), np.sin(2 * turn) / 2]),
        "spiral": (radius * share)[:, None] * np.column_stack([np.cos(3 * turn), np.sin(3 * turn)]),
    }


def tip_of(state: State) -> Array:
    """Mean displacement (2,) [m] sideways of the end face of the full model."""
    from turgor.core.engine.faces import surfaces

    mesh = state.model.mesh
    weights = surfaces.nodal_weights(mesh.points, mesh.face("tip"))
    return np.asarray(weights @ state.displacement / weights.sum())[1:]


def followed(file: Path, name: str) -> tuple[str, ...]:
    """Follow a path, solve every fifth point again with the full model, and state a row of the table."""
    reduced = Reduced.load(file)
    reach = reach_of(reduced)
    path = shapes(0.6 * reach.radius, POINTS)[name]
    times = np.linspace(0.0, DURATION, POINTS)
    track = tg.control.track(reduced, path, times=times, output=SIDES, limits=still(reduced))
    errors, lost = [], 0
    for row in range(0, POINTS, EVERY):
        try:
            full = tg.real_time.verified(track.states[row], OPTIONS).state
        except tg.TurgorError:
            lost += 1
            continue
        errors.append(float(np.linalg.norm(tip_of(full) - path[row])) / reach.length)
    median, late = np.percentile(1e3 * track.seconds, [50, 99])
    return (
        name,
        f"{100 * track.distance.max() / reach.length:.2g} %",
        f"{100 * np.mean(errors):.2f} %",
        f"{100 * np.max(errors):.2f} %",
        f"{len(errors)} of {len(errors) + lost}",
        f"{median:.1f}, {late:.1f} ms",
        f"{100 * max(state.estimate for state in track.states):.2f} %",
    )


def paths(file: Path) -> str:
    """Follow three paths, each in a process."""
    with ProcessPoolExecutor(3, mp_context=get_context("spawn")) as pool:
        rows = list(pool.map(followed, [file] * 3, ("circle", "figure-eight", "spiral")))
    head = ("path", "distance of the reduced model", "full model, mean", "full model, largest", "solved again",
            "tick: median, 99 %", "largest estimate of the error")  # fmt: skip
    return table(head, rows)


def tight(reduced: Reduced, reach: Reach) -> str:
    """The circle again with limits that it reaches."""
    path, times = shapes(0.6 * reach.radius, POINTS)["circle"], np.linspace(0.0, DURATION, POINTS)
    free = tg.control.track(reduced, path, times=times, output=SIDES, limits=still(reduced))
    pressed = pressures_of(reduced)
    fast = (np.abs(np.diff(free.inputs, axis=0)) / np.diff(times)[:, None]).max(axis=0)
    volume = {face: (0.0, 0.99 * max(state.volumes[face] for state in free.states)) for face in reduced.faces}
    highest = {reduced.inputs.keys[k]: 0.95 * free.inputs[:, k].max() for k in pressed}
    limits = tg.control.Limits(
        low=still(reduced).low,
        high=dict(still(reduced).high) | highest,  # type: ignore[arg-type]
        rate={reduced.inputs.keys[k]: 0.9 * fast[k] for k in pressed},
        volume=volume,
    )
    track = tg.control.track(reduced, path, times=times, output=SIDES, limits=limits)
    named = sorted({name.split(".")[-1] for names in track.active for name in names})
    median, late = np.percentile(1e3 * track.seconds, [50, 99])
    return (
        f"The circle with 95 % of the largest pressures that it needs, 90 % of their rates and 99 % of the volumes: "
        f"{sum(map(bool, track.active))} of {POINTS} rows are at a limit ({', '.join(named)}), and the largest share "
        f"by which one is exceeded is {excess(track, limits):.0e}. A tick takes {median:.1f} ms in the median and "
        f"{late:.1f} ms at 99 %."
    )


def excess(track: tg.control.Track, limits: tg.control.Limits) -> float:
    """Largest share by which pressures, rates or volumes exceed their limits."""
    reduced = track.states[0].reduced
    of, inputs = limits.of(reduced), track.inputs
    wide = np.where(of.widths > 0, of.widths, 1.0)
    rates = np.abs(np.diff(inputs, axis=0)) / np.diff(track.times)[:, None] / of.rate - 1
    over = [((inputs - of.high) / wide).max(), ((of.low - inputs) / wide).max(), rates.max()]
    return float(max(0.0, *over, *(of.excess(state) for state in track.states)))


def loop(reduced: Reduced, reach: Reach, delay: float, gain: float = 0.1, noise: float = NOISE) -> tg.control.LoopRun:
    """Let a controller drive a stiffer actuator along a circle of 60 % of the reach; it counts on a delay of 10 ms.

    Some pressure stays in every chamber: near rest a chamber does little, and a controller that looks only at
    derivatives would not use it.
    """
    air, period = tg.control.Air(delay=DELAY), PERIOD
    seconds = 8.0
    count = int(seconds / period)
    radius, turn = 0.6 * reach.radius, 2 * np.pi * np.arange(count) * period / TURN
    grow = np.minimum(np.arange(count) * period / 1.0, 1.0)
    path = (radius * grow)[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])
    tuning = tg.control.Tuning(gain=gain, smoothness=1e-4)
    free = still(reduced)
    low = dict(free.low) | {reduced.inputs.keys[k]: BIAS * reach.pressure for k in pressures_of(reduced)}  # type: ignore[arg-type]
    limits = tg.control.Limits(low=low, high=free.high)
    controller = tg.control.Controller(reduced, period=period, output=SIDES, limits=limits, air=air, tuning=tuning)
    plant = tg.control.Plant(reduced=reduced, air=tg.control.Air(delay=delay), stiffness=STIFFER, noise=noise)
    return tg.control.run_loop(controller, plant, path)


def loops(reduced: Reduced, reach: Reach) -> str:
    """The loop with the delay it knows, and with longer ones until it is lost."""
    rows, radius = [], 0.6 * reach.radius
    for delay in (DELAY, 20e-3, 40e-3, 60e-3, 80e-3, 120e-3, 160e-3, 240e-3, 320e-3):
        try:
            run = loop(reduced, reach, delay)
        except tg.TurgorError as error:
            rows.append((f"{1e3 * delay:g} ms", "lost", "", "", str(error)[:60]))
            break
        late = run.distance[run.times >= 4.0]
        share = run.rms(2.0) / radius
        median, tail = np.percentile(1e3 * run.seconds, [50, 99])
        rows.append(
            (f"{1e3 * delay:g} ms", f"{100 * share:.1f} %", f"{100 * late.max() / radius:.1f} %",
             f"{median:.1f}, {tail:.1f} ms", "unstable" if late.max() > 0.5 * radius else "")
        )  # fmt: skip
        if late.max() > 0.5 * radius:
            break
    head = ("delay of the air", "root mean square of the distance, over the radius", "largest from 4 s on",
            "tick: median, 99 %", "")  # fmt: skip
    return table(head, rows)


def force() -> str:
    """A finger that presses a plate: the force follows a target, and is solved again with the full model."""
    changes = {"mesh.size": "8 mm", "actuator.chambers": 2, "actuator.length": "22 mm", "loads.pressure": "12 kPa"}
    model = prepare(read_job(JOB, changes), lambda text: None)[0]
    low = float(model.mesh.points[:, 2].min())
    plate = tg.obstacles.Obstacle(name="plate", shape=tg.obstacles.Plane(point=(0, 0, low - 1 * mm), normal=(0, 0, 1)))
    model = tg.Model(model.mesh, model.materials, [tg.Fixed("fixed")], [tg.Pressure("cavity", 12 * kPa)],
                     contact=tg.Contact(obstacles=[plate]))  # fmt: skip
    budget = tg.real_time.Budget(steps=10)
    reduced = tg.reduce(model, {"loads.pressure": (0.0, 12 * kPa)}, budget=budget, options=OPTIONS)
    most = reduced.solve(11.5 * kPa).obstacle_forces["plate"][2]
    wanted = np.abs(most) * np.concatenate([[0.0], np.linspace(0.1, 1.0, 20), np.linspace(0.9, 0.2, 20)])
    track = tg.control.track(reduced, wanted, output=tg.control.ContactForce("plate"))
    errors = []
    for row in range(1, len(wanted), EVERY):
        full = tg.real_time.verified(track.states[row], OPTIONS).state
        errors.append(abs(force_on("plate")(full) / wanted[row] - 1))
    return (
        f"A finger of two chambers ({model.mesh.unknown_count:,} unknowns) above a plate; the force goes from none to "
        f"{1e3 * np.abs(most):.0f} mN and back. Against the full model at {len(errors)} of {len(wanted)} rows it is "
        f"{100 * np.mean(errors):.2f} % off in the mean and {100 * max(errors):.2f} % at most (target 5 %)."
    )


def page(file: Path) -> str:
    """Measure with a reduced model, and return the page."""
    reduced = Reduced.load(file)
    reach = reach_of(reduced)
    text = HEAD + (
        f"{reduced!r}, {reduced.model.mesh.unknown_count:,} unknowns. It is {reach.length / mm:.0f} mm long; one "
        f"chamber alone bends it by {np.rad2deg(reach.angle):.0f}° and moves its end {reach.radius / mm:.0f} mm "
        f"sideways, at {reach.pressure / kPa:.3g} kPa.\n\n## Paths\n\n"
        f"Circle, figure-eight and spiral of 60 % of that reach, {POINTS} points each in {DURATION:g} s. Distances are "
        "over the length. Targets: full model within 0.5 % in the mean and 1 % at most; a tick of 5 ms in the median "
        "and 20 ms at 99 %; limits kept to 1e-9.\n\n"
    )
    text += paths(file) + "\n\n" + tight(reduced, reach)
    print(text, flush=True)
    text += (
        f"\n\n## Loop\n\nThe same model with {STIFFER - 1:.0%} more modulus as plant, {1e3 * DELAY:g} ms of delay, "
        f"{NOISE / mm:g} mm of noise, a period of {1e3 * PERIOD:g} ms; the circle with a turn in {TURN:g} s and at "
        f"least {BIAS:.0%} of the pressure in each chamber (target 2 %). The "
        "controller counts on 10 ms; longer delays show when it is lost.\n\n"
    ) + loops(reduced, reach)
    print(text, flush=True)
    return text + "\n\n## Force\n\n" + force()


def main(folder: Path) -> None:
    """Measure, and write the page."""
    folder.mkdir(parents=True, exist_ok=True)
    trained(folder, CASES["pressures"])
    text = page(folder / "pressures.reduced")
    facts = "\n".join(f"- {name}: {value}" for name, value in machine().items())
    PAGE.write_text(text + "\n\n" + facts + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
