"""Two meshes instead of one: iterations, factorizations and CPU seconds of fast PneuNets, alone and led.

python benchmarks/two_meshes.py [CHAMBERS STATES SIZE_MM COARSE_MM]

The pressure is that of the demo, 22.5 kPa; walls meet at about 8 kPa. States are spread evenly over it. Times are CPU
seconds of one thread, coarse path and meshing of neither included in the columns of the fine mesh; `both` is the sum.
"""

import sys
from collections.abc import Callable
from pathlib import Path
from time import process_time

import turgor as tg

JOB = Path(__file__).parents[1] / "examples" / "fast_pneunet.toml"

#: Chambers, states, fine and coarse size [mm].
CASES = ((3, 3, 2.2, 6.0), (4, 12, 2.2, 6.0), (11, 3, 2.2, 6.0), (11, 12, 2.2, 6.0))

OPTIONS = tg.EngineOptions(threads=1)


def model_of(chambers: int, size: float) -> tg.Model:
    """The demo with so many chambers, at a mesh size [mm]."""
    changes = {"actuator.chambers": chambers, "actuator.length": f"{10 * chambers} mm", "mesh.size": f"{size} mm"}
    return tg.jobs.prepare(tg.jobs.read_job(JOB, changes))[0]


def timed(solve: Callable[[], tg.Solution]) -> tuple[tg.Solution, float]:
    """A solution and its CPU seconds."""
    began = process_time()
    solution = solve()
    return solution, process_time() - began


def compare(chambers: int, states: int, size: float, coarse_size: float) -> str:
    """One line: the path alone, and led by a coarse mesh."""
    at = tuple((i + 1) / states for i in range(states - 1))
    model, coarse = model_of(chambers, size), model_of(chambers, coarse_size).mesh
    tg.solve(model_of(2, 20.0), tg.Static(at=at), options=OPTIONS)  # compiled before the clock runs
    alone, seconds = timed(lambda: tg.solve(model, tg.Static(at=at), options=OPTIONS))
    steps = tg.Static(at=at, max_step=1.0)
    led, in_all = timed(lambda: tg.solve(model, steps, coarse=coarse, options=OPTIONS))
    assert led.coarse is not None
    on_coarse = led.coarse.timing.factorizations
    angles = [tg.measure(each, tg.bending_angle, mesh_error=False).column("bending_angle")[-1] for each in (alone, led)]
    off = abs(angles[1] - angles[0]) / abs(angles[0])
    return (
        f"{chambers} chambers, {states} states, {model.mesh.unknown_count:,} unknowns: "
        f"alone {alone.iterations} iterations, {alone.timing.factorizations} factorizations, {seconds:.0f} s; "
        f"led {led.iterations}, {led.timing.factorizations - on_coarse} "
        f"(and {led.coarse.iterations}, {on_coarse} at {coarse.unknown_count:,}), both {in_all:.0f} s; "
        f"bending angle off by {off:.1e}"
    )


if __name__ == "__main__":
    asked = [float(text) for text in sys.argv[1:]]
    for case in [(int(asked[0]), int(asked[1]), asked[2], asked[3])] if asked else CASES:
        print(compare(*case), flush=True)
