"""Two meshes instead of one: iterations, factorizations and CPU seconds of fast PneuNets, alone and led.

python benchmarks/core/two_meshes.py [CHAMBERS STATES SIZE_MM COARSE_MM]
python benchmarks/run.py two_meshes      a section of results.md

The pressure is that of the demo, 22.5 kPa; walls meet at about 6 kPa. States are spread evenly over it. Times are CPU
seconds of one thread, without meshing; `both` is that of the coarse and of the fine mesh.
"""

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from time import process_time

import turgor as tg

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
from benchmarks.shared.tables import table

JOB = Path(__file__).parents[2] / "examples" / "fast_pneunet.toml"

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


def compare(chambers: int, states: int, size: float, coarse_size: float) -> tuple[str, ...]:
    """One row: the path alone, and led by a coarse mesh."""
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
        f"{chambers}",
        f"{states}",
        f"{model.mesh.unknown_count:,}",
        f"{alone.iterations}, {alone.timing.factorizations}",
        f"{seconds:.0f}",
        f"{led.iterations}, {led.timing.factorizations - on_coarse}",
        f"{led.coarse.iterations}, {on_coarse}",
        f"{in_all:.0f}",
        f"{off:.1e}",
    )


def section(cases: Sequence[tuple[int, int, float, float]] = CASES) -> str:
    """The section of the page."""
    head = ("chambers", "states", "unknowns", "alone: iterations, factorizations", "CPU s")
    head += ("led: on the fine mesh", "on the coarse", "both, CPU s", "bending off by")
    text = (
        "The demo and shorter ones, to 22.5 kPa, states spread evenly, one thread: the path on one mesh, and led by a "
        "coarse one (`solve(coarse=...)`). Walls touch in all of them. The mesh error comes on top."
    )
    return f"## Two meshes\n\n{text}\n\n{table(head, [compare(*case) for case in cases])}\n"


if __name__ == "__main__":
    asked = [float(text) for text in sys.argv[1:]]
    print(section([(int(asked[0]), int(asked[1]), asked[2], asked[3])] if asked else CASES))
