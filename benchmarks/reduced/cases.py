"""Further cases of reduced models next to full solves: a plate, motion, impacts, a wound bender that relaxes.

Each function trains a small model and returns rows of quantity, measured value and target.
"""

from dataclasses import replace
from pathlib import Path
from time import process_time

import numpy as np

import turgor as tg
from turgor.core.model.obstacles import Obstacle, Plane
from turgor.core.solvers.energies import imbalance
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.reduced.reduce import Budget
from turgor.reduced.states.reduced import Reduced
from turgor.units import deg, kPa, mm

JOB = Path(__file__).parents[2] / "examples" / "fast_pneunet.toml"
OPTIONS = tg.EngineOptions(threads=1)
KEY = "loads.pressure"

Rows = list[tuple[str, str, str]]


def short_finger(chambers: int) -> tg.Model:
    """A fast PneuNet of few chambers in large cells."""
    changes = {"mesh.size": "8 mm", "actuator.chambers": chambers, "actuator.length": f"{2 + 10 * chambers} mm"}
    return prepare(read_job(JOB, changes), lambda text: None)[0]


def floor_at(model: tg.Model, height: float) -> tg.Model:
    """The model above a plate across z."""
    floor = Obstacle(name="floor", shape=Plane(point=(0.0, 0.0, height), normal=(0.0, 0.0, 1.0)))
    supports = [each for each in model.supports if not each.mirror]
    return tg.Model(
        model.mesh, supports=supports, materials=dict(model.materials), loads=model.loads,
        contact=tg.Contact(tg.obstacles.SelfContact(), obstacles=[floor]),
    )  # fmt: skip


def plate() -> Rows:
    """A finger of four chambers that presses a plate, pressure and height as inputs."""
    model = floor_at(short_finger(4), -12 * mm)
    box = {KEY: (0.0, 12 * kPa), "obstacles.floor.point.3": (-17 * mm, -6 * mm)}
    reduced = tg.reduce(model, box, budget=Budget(held_out=4, paths=12, modes=24), options=OPTIONS, say=print)
    errors = reduced.held_out
    pressing = errors.force > 0
    name = f"finger of four chambers above a plate, {len(errors.inputs)} held-out states at 4 untrained heights"
    return [
        (f"{name}, {pressing.sum()} of them pressing: force", f"{errors.force.max():.2%} of the largest", "5 %"),
        ("the same: displacement", f"{errors.worst:.2%} of the largest", ""),
    ]


def motion() -> Rows:
    """A step of pressure in 20 ms, against `Dynamic` with the same steps of 4 ms."""
    model = short_finger(2)
    budget = Budget(motion=True, held_out=0)
    reduced = tg.reduce(model, {KEY: (0.0, 12 * kPa)}, budget=budget, options=OPTIONS)
    error, _, spent = moved(model, reduced, 6 * kPa, 0.004)
    name = "finger of two chambers, pressure in 20 ms, steps of 4 ms"
    return [
        (f"{name}: tip against `Dynamic`", f"{error:.2%} of the largest", "2 %"),
        ("the same: processor time of a step", f"{1e3 * spent:.1f} ms", "4 ms"),
    ]


def impact() -> Rows:
    """The same finger hits a plate after 2 mm, in long and in short steps."""
    model = floor_at(short_finger(2), -2 * mm)
    budget = Budget(motion=True, held_out=0, steps=16)
    reduced = tg.reduce(model, {KEY: (0.0, 12 * kPa)}, budget=budget, options=OPTIONS)
    rows = []
    for step in (0.002, 0.0005):
        error, missed, _ = moved(model, reduced, 10 * kPa, step, end=0.06)
        name = f"finger of two chambers that hits a plate, pressure in 20 ms, steps of {1e3 * step:g} ms"
        rows.append((f"{name}: tip against `Dynamic`", f"{error:.2%} of the largest", ""))
        rows.append(("the same: energy that `Dynamic` misses", f"{missed:.2%}", ""))
    return rows


def moved(
    model: tg.Model, reduced: Reduced, pressure: float, step: float, *, end: float = 0.2
) -> tuple[float, float, float]:
    """A pressure that rises in 20 ms, with damping 5 ms, in the full and the reduced model.

    Returns
    -------
    (float, float, float)
        Largest error of the tip over its largest displacement, energy that the full run misses over its work, and
        processor time [s] of a step.
    """
    rise, damping = 0.02, 0.005
    loads = [replace(load, pressure=pressure, history=((0, 0), (rise / end, 1), (1, 1))) for load in model.loads]
    procedure = tg.Dynamic(duration=end, stiffness_damping=damping, first_step=step, max_step=step, adaptive=False)
    full = tg.solve(replace(model, loads=loads), procedure, options=OPTIONS).states
    times = np.array([state.time for state in full])
    moving = tg.real_time.Moving(step=step, stiffness_damping=damping)
    given = {"pressure": np.interp(times, [0.0, rise, end], [0.0, pressure, pressure])}
    reduced.follow(times[:3], {"pressure": given["pressure"][:3]}, moving)  # compiled loops are loaded
    began = process_time()
    followed = reduced.follow(times, given, moving)
    spent = (process_time() - began) / (len(times) - 1)
    tips = np.array([np.mean(state.displacement[np.unique(model.mesh.face("tip"))], axis=0) for state in full])
    ours = np.array([np.mean(a.displacement[np.unique(model.mesh.face("tip"))], axis=0) for a in followed.answers])
    error = np.linalg.norm(ours - tips, axis=1).max() / np.linalg.norm(tips, axis=1).max()
    return float(error), imbalance(full), spent


def wound() -> Rows:
    """A wound bender whose rubber relaxes by 30 %, over 10 s of a history of pressure."""
    points, pressure = [(0.0, 0.0), (2.0, 1.0), (4.0, 1.0), (7.0, 0.3), (10.0, 0.6)], 30 * kPa
    model = wound_bender()
    reduced = tg.reduce(model, {KEY.replace("pressure", "cavity.pressure"): (0.0, 1.2 * pressure)},
                        budget=Budget(held_out=0), options=OPTIONS, say=print)  # fmt: skip
    loads = [replace(load, pressure=pressure, history=tg.over_time(points, 10.0)) for load in model.loads]
    began = process_time()
    procedure = tg.Static(duration=10.0, first_step=0.02, max_step=0.02)
    full = tg.solve(replace(model, loads=loads), procedure, options=OPTIONS).states
    whole = process_time() - began
    times = np.array([state.time for state in full])
    given = np.interp(times, *zip(*((time, share * pressure) for time, share in points), strict=True))
    reduced.follow(times[:3], {"pressure": given[:3]})
    began = process_time()
    followed = reduced.follow(times, {"pressure": given})
    spent, largest = process_time() - began, max(np.abs(state.displacement).max() for state in full)
    errors = [
        np.abs(answer.displacement - state.displacement).max() / largest
        for answer, state in zip(followed.answers, full, strict=True)
    ]
    name = f"wound bender of {model.mesh.unknown_count:,} unknowns that relaxes, 10 s in {len(times) - 1} steps"
    return [
        (f"{name}: displacement at all times", f"{max(errors):.2%} of the largest", "2 %"),
        ("the same: processor time, full and reduced", f"{whole:.0f} s, {spent:.2f} s", "10 s"),
    ]


def wound_bender() -> tg.Model:
    """The bender of examples/fiber_reinforced_bender.py of rubber that relaxes."""
    mesh = tg.mesh(tg.actuators.FiberReinforcedBender(length=40 * mm, skin=0.0).build(), size=6 * mm, cells="hexahedra")
    series = tg.laws.Prony(g=(0.2, 0.1), tau=(0.5, 4.0), moduli="long_term")
    rubber = replace(
        tg.from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020"), viscoelasticity=series
    )  # fmt: skip
    hoops = tg.Fibers(
        face=("outside", "strain_limiting_layer"),
        material=tg.from_library("kevlar-fiber"),
        diameter=0.1778 * mm,
        winding=tg.Winding(angle_from_circumference=0 * deg, spacing=3 * mm),
    )
    paper = tg.Shell(tg.from_library("paper", record="hooke-polygerinos-2020"), thickness=0.1 * mm)
    return tg.Model(
        mesh,
        materials={"body": rubber, "strain_limiting_layer": paper},
        supports=[tg.Fixed("fixed")],
        loads=[tg.Pressure("cavity", 10 * kPa)],
        reinforcements=[hoops],
    )
