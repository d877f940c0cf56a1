"""An arm that bends to all sides, under three pressures, a force on its tip and gravity: its reduced models.

    python benchmarks/reduced/omnidirectional.py FOLDER             the page omnidirectional.md again
    python benchmarks/reduced/omnidirectional.py FOLDER pressures   the page with the model of the pressures alone

The paths of training and the full solves are saved in the folder, and a second run goes on with these. Two processes
compute them.

A cylinder of Ecoflex 00-30 with three round chambers, each wound with thread, 27.5 mm long and 9.5 mm thick, as the
flexible microactuators of Suzumori. Without threads such chambers balloon before the arm bends by 60°. The threads are
soft, and embedded: they work in compression, too. The mesh is that of a shorter arm, stretched along the axis.
"""

import re
import sys
from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from itertools import permutations
from multiprocessing import get_context
from pathlib import Path
from time import process_time

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
import turgor as tg
from benchmarks.shared.machine import machine
from benchmarks.shared.tables import table
from turgor.accuracy.gradients.model_keys import model_variation
from turgor.core.model.model import Model
from turgor.foundation.errors import NotSolved
from turgor.reduced.reduce import Budget
from turgor.reduced.states.reduced import Reduced
from turgor.reduced.training.compare import errors_of
from turgor.reduced.training.path_runs import PathRuns
from turgor.reduced.training.trainer import Trainer
from turgor.units import MPa, deg, kPa, mm

Array = NDArray[np.float64]

PAGE, OPTIONS = Path(__file__).with_suffix(".md"), tg.EngineOptions(threads=1)
STRETCH, PRESSURE, FORCE, WEIGHT = 2.75, 42 * kPa, 0.0083, 9.81
CAVITIES = ("cavity_1", "cavity_2", "cavity_3")
PRESSURES = {f"loads.{name}.pressure": (0.0, PRESSURE) for name in CAVITIES}
#: Between the corners: chambers full, others half full; with forces and gravity at ends of their ranges.
PRESSED = (
    *permutations((1.0, 0.5, 0.0)), *sorted(set(permutations((1.0, 0.5, 0.5)))),
    *sorted(set(permutations((1.0, 1.0, 0.5)))),
)  # fmt: skip
#: With forces, most of them where all chambers are under pressure and the arm is soft.
WITH_FORCES = (*PRESSED[6:], *PRESSED[:6:3])
SIGNS = np.random.default_rng(0).integers(0, 2, (8, 6)).astype(float)
STATES, HELD_OUT = 1000, 64
HEAD = """# Reduced models of an arm that bends to all sides

Written by `python benchmarks/reduced/omnidirectional.py FOLDER`. A cylinder of Ecoflex 00-30 with three wound
chambers, 27.5 mm long and 9.5 mm thick, with pressures to 42 kPa; and with a force on the tip and gravity of any
direction, which are six more inputs. Held-out states are full solves at random pressures, with a force of any
direction and size, and gravity of any direction. Times are processor time of one thread, those of states with the
displacement of every node.

"""


@dataclass(frozen=True, slots=True)
class Case:
    """Inputs of a reduced model with their ranges, loads besides the pressures, budget."""

    name: str
    inputs: Mapping[str, tuple[float, float]]
    loads: tuple[tg.loads.Load, ...]
    budget: Budget


CASES = {
    "pressures": Case(
        "pressures", PRESSURES, (),
        Budget(error=0.005, paths=19, held_out=0, modes=38, steps=7, aims=PRESSED),
    ),
    "forces": Case(
        "forces",
        PRESSURES | {"loads.tip.vector": (-FORCE, FORCE), "loads.gravity.falling": (-WEIGHT, WEIGHT)},
        (tg.loads.Force("tip", (0, 0, FORCE)), tg.Gravity()),
        Budget(
            error=0.007, paths=24, held_out=0, modes=50, steps=7,
            aims=tuple((*pressures, *others) for pressures, others in zip(WITH_FORCES, SIGNS.tolist(), strict=True)),
        ),
    ),
}  # fmt: skip


def arm(*loads: tg.loads.Load) -> Model:
    """Make the full model, without pressure, with further loads."""
    actuator = tg.actuators.OmnidirectionalActuator(
        outer_radius=4.75 * mm, chamber_size=3.6 * mm, wall=0.6 * mm, length=27.5 * mm / STRETCH, cap=2 * mm / STRETCH
    )
    mesh = tg.mesh(actuator.build(), size=4 * mm, quality="draft")
    rubber = tg.from_library("ecoflex-00-30", record="yeoh-steck-2019")
    thread = tg.Material(name="thread", law=tg.laws.Hooke(E=100 * MPa, nu=0.3))
    winding = tg.Winding(angle_from_circumference=0 * deg, spacing=0.5 * mm)
    sides = np.concatenate([_around(mesh, mesh.faces[name]) for name in CAVITIES])
    return tg.Model(
        mesh=replace(mesh, points=mesh.points * np.array([STRETCH, 1.0, 1.0]), faces=mesh.faces | {"winding": sides}),
        materials={"body": rubber},
        supports=(tg.Fixed("fixed"),),
        loads=(*(tg.Pressure(name, 1 * kPa) for name in CAVITIES), *loads),
        reinforcements=(
            tg.Fibers(face="winding", material=thread, diameter=0.1 * mm, compression=1.0, winding=winding),
        ),
    )


def _around(mesh: tg.Mesh, face: NDArray[np.int64]) -> NDArray[np.int64]:
    """Sides of a cavity that are no ends: those that do not face along the axis."""
    corners = mesh.points[face[:, :3]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return face[np.abs(normals[:, 0]) < 0.5 * np.linalg.norm(normals, axis=1)]


def trained(folder: Path, case: Case) -> tuple[Reduced, float]:
    """Train a reduced model, or read the one in the folder; processor time of the training [s]."""
    file, seconds = folder / f"{case.name}.reduced", folder / f"{case.name}.txt"
    if not file.exists():
        said: list[str] = []
        began, runs = process_time(), PathRuns(folder / case.name, 2)
        reduced = tg.reduce(
            arm(*case.loads), case.inputs, budget=case.budget, options=OPTIONS, runs=runs, say=said.append
        )
        print("\n".join(said))
        paths = sum(float(number) for line in said for number in re.findall(r"states in (\d+) s", line))
        seconds.write_text(f"{process_time() - began + paths:.0f}", encoding="utf-8")
        reduced.save(file)
    return Reduced.load(file), float(seconds.read_text(encoding="utf-8"))


def random_inputs(case: str, seed: int) -> Array:
    """Pressures, and with forces one of any direction, gravity of any direction."""
    random = np.random.default_rng(seed)
    ways = random.standard_normal((2, 3))
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    size = FORCE * random.uniform() ** (1 / 3)
    values = np.concatenate([random.uniform(0, PRESSURE, 3), size * ways[0], WEIGHT * ways[1]])
    return values if case == "forces" else values[:3]


def whole_path(answer: tg.real_time.ReducedState) -> Array:
    """Displacement [m] of the full model at the inputs of an answer, by the path from rest."""
    reduced = answer.reduced
    variation = model_variation(reduced.model, list(reduced.inputs.keys), inputs=True).model
    path = Trainer(variation, reduced.inputs, 7, OPTIONS).path(answer.inputs, differentiated=False)
    share = 1.0 if path.reached else np.inf
    return np.asarray(path.displacements[-1] * reduced.scales[0] * share)


def held_out(folder: Path, case: str, seed: int) -> tuple[float, float, float]:
    """True and estimated error of one random state, and the processor time of its full solve [s], perhaps before.

    Infinite where the reduced model refuses.
    """
    file, reduced = folder / f"{case}-{seed}.npz", Reduced.load(folder / f"{case}.reduced")
    try:
        answer = reduced.at(random_inputs(case, seed))
    except NotSolved:
        return np.inf, np.inf, np.inf
    if not file.exists():
        began = process_time()
        try:
            full = tg.real_time.verified(answer, OPTIONS).state.displacement
        except NotSolved:
            full = whole_path(answer)
        np.savez(file, displacement=full, seconds=process_time() - began)
    saved = np.load(file)
    true = errors_of(answer, saved["displacement"] / answer.reduced.scales[0])[0]
    return true, answer.estimate, float(saved["seconds"])


def times(reduced: Reduced, case: str, count: int = STATES) -> Array:
    """Processor time [ms] of random states, with their displacements, and of refusals."""
    out = []
    for seed in range(count):
        inputs, start = random_inputs(case, 10**6 + seed), process_time()
        with suppress(NotSolved):
            _ = reduced.at(inputs).displacement
        out.append(1e3 * (process_time() - start))
    return np.array(out)


def blocked(folder: Path) -> float:
    """Force [N] on the tip that cannot go down, at the largest pressure of the chamber above."""
    file = folder / "blocked.txt"
    if not file.exists():
        model = arm()
        loads = tuple(replace(load, pressure=PRESSURE * (load.face == "cavity_1")) for load in model.pressures)
        solution = tg.solve(
            tg.setups.blocked_force(replace(model, loads=loads), hold="z", direction="-z"), options=OPTIONS
        )
        force = tg.measure(solution, tg.measures.blocked_force).column("blocked_force")[-1]
        file.write_text(f"{abs(force):.4g}", encoding="utf-8")
    return float(file.read_text(encoding="utf-8"))


def bending(reduced: Reduced, pressures: tuple[float, ...]) -> float:
    """Bending angle [deg] under some pressures alone."""
    at = np.zeros(len(reduced.inputs.keys))
    at[:3] = pressures
    return float(np.rad2deg(tg.bending_angle(reduced.at(at).state())))


def rows_of(folder: Path, case: Case) -> list[tuple[str, str, str]]:
    """Train and compare one model: the rows of its table."""
    reduced, seconds = trained(folder, case)
    with ProcessPoolExecutor(2, get_context("spawn")) as pool:
        true, estimate, full = np.array(list(pool.map(partial(held_out, folder, case.name), range(HELD_OUT)))).T
    refused = np.isinf(true)
    true, estimate, full = true[~refused], estimate[~refused], full[~refused]
    times(reduced, case.name, 1)  # compiled loops are loaded
    ms, ratio = times(reduced, case.name), estimate / true
    modes, means = reduced.equations.sizes
    one, two = (bending(reduced, at) for at in ((PRESSURE, 0.0, 0.0), (PRESSURE, PRESSURE, 0.0)))
    return [
        ("inputs", f"{len(reduced.inputs.keys)}", ""),
        ("bending with one chamber full, with two", f"{one:.0f}°, {two:.0f}°", "60°"),
        ("training paths", f"{reduced.counts['training paths']}", "24"),
        ("training", f"{seconds:.0f} s", "1,200 s (ten minutes on two cores)"),
        ("modes of displacement and mean stress", f"{modes} + {means}", ""),
        ("sampled points", f"{reduced.counts['points']}", ""),
        (f"any node, largest of {len(true)} held-out states", f"{true.max():.2%} of the largest displacement", "1 %"),
        ("their median", f"{np.median(true):.2%}", ""),
        ("refused besides", f"{refused.sum()}", "0"),
        ("estimate over true error within 0.3 to 3", f"{np.mean((ratio > 0.3) & (ratio < 3)):.0%}", "95 %"),
        (f"states a second, median of {STATES:,} random inputs", f"{1e3 / np.median(ms):.0f}", "100"),
        ("99th percentile of their time", f"{np.percentile(ms, 99):.1f} ms", ""),
        ("full solve from an answer of the reduced model, median", f"{np.median(full):.1f} s", ""),
        ("file", f"{(folder / f'{case.name}.reduced').stat().st_size / 1e6:.2f} MB", "5 MB"),
    ]


def main(folder: Path, *names: str) -> None:
    """Train, compare, measure, and write the page."""
    folder.mkdir(parents=True, exist_ok=True)
    force = blocked(folder)
    text = f"{HEAD}The full model has {arm().mesh.unknown_count:,} unknowns. The largest force on the tip, {FORCE:g} N,"
    text += f" is {FORCE / force:.0%} of the blocked one of one chamber, {force:.3f} N.\n\n"
    for name in names or CASES:
        rows = rows_of(folder, CASES[name])
        text += f"## {name.capitalize()}\n\n{table(('quantity', 'measured', 'target'), rows)}\n\n"
    facts = "\n".join(f"- {name}: {value}" for name, value in machine().items())
    PAGE.write_text(text + facts + "\n", encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main(Path(sys.argv[1]), *sys.argv[2:])
