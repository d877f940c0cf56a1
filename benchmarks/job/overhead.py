"""CPU seconds of `turgor run` around the solve, and of further runs in one process.

python benchmarks/job/overhead.py          two tables
python benchmarks/run.py overhead      both as a section of results.md
python benchmarks/job/overhead.py --one    what one warm process spends, by part

The job is the demo with a small pressure and without the estimate of the mesh error. A first process fills the caches,
and keeps shape and mesh for the next ones. What counts as overhead is all but the mesh, the solve, the pictures and
plots, fields and the report, which have targets of their own: starting Python, imports, reading, building or finding
the shape, finding the mesh, checks, loading compiled kernels, tables and files of the path, and the end of the process.
The code of matplotlib and of what draws is loaded with the first picture, and counts as files. The process ends as that
of a command does. Output goes to a pipe; on a terminal, the code of the bar takes 0.03 CPU seconds more. Exit code 1
beyond 1 CPU second.
"""

import os
import resource
import subprocess
import sys
from collections import defaultdict
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
from benchmarks.shared.tables import table

MOST = 1.0
DEMO = Path(__file__).parents[2] / "examples" / "fast_pneunet.toml"
LOAD = ("--set", 'loads.pressure="0.2 kPa"', "--set", "output.mesh_error=false")


def one() -> None:
    """Run the job in this process with a clock around each part; print part and CPU seconds, one a line."""
    spent: dict[str, float] = defaultdict(float)

    def clock(owner: object, name: str, part: str) -> None:
        function: Callable = getattr(owner, name)

        def timed(*given, **named):
            began = process_time()
            try:
                return function(*given, **named)
            finally:
                spent[part] += process_time() - began

        setattr(owner, name, timed)

    from turgor.cli.app import command
    from turgor.foundation.startup.garbage import search_rarely

    search_rarely()
    from turgor.cli.console import PlainDisplay  # noqa: F401  what the command loads
    from turgor.core.solvers import solve
    from turgor.job import meshes, prepare, read, run
    from turgor.job.output import tables

    spent["Python and imports"] = process_time()
    clock(read, "_build", "shape")
    clock(meshes, "mesh_on_disk", "mesh looked up on disk")
    clock(meshes, "_new_mesh", "mesh")
    clock(prepare, "check_mesh", "checks of the mesh")
    clock(solve, "compile_kernels", "loading compiled kernels")
    clock(run, "prepare", "all before the solve")
    clock(run.RunRecord, "create", "record")
    clock(run, "follow_question", "solve")
    clock(run, "_written", "files")
    clock(tables, "write_tables", "tables")
    with TemporaryDirectory() as folder:
        sys.argv[1:] = ["run", str(DEMO), "--output", folder, "--force", "--threads", "1", *LOAD]
        command()
    spent["all"] = process_time()
    for part, seconds in spent.items():
        print(f"= {part}: {seconds:.3f}")


def parts() -> dict[str, float]:
    """The parts of one process: of several, the one with the smallest overhead; the first one fills the caches."""
    best: dict[str, float] = {}
    keeping = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    for _ in range(4):
        before = _of_children()
        command = [sys.executable, __file__, "--one"]
        told = subprocess.run(command, capture_output=True, text=True, check=True, env=keeping).stdout
        lines = (line[2:].rpartition(": ") for line in told.splitlines() if line.startswith("= "))
        result = defaultdict(float, {part: float(seconds) for part, _, seconds in lines})
        result["end"] = _of_children() - before - result["all"]
        counted = result["loading compiled kernels"] + result["tables"] + result["end"]
        result["overhead"] = result["all"] - result["mesh"] - result["solve"] - result["files"] + counted
        if not best or result["overhead"] < best["overhead"]:
            best = result
    return best


def _of_children() -> float:
    """CPU seconds of all processes that this one has started and that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def again() -> list[tuple[str, float, float, float]]:
    """Solve with three pressures in one process: what each costs before its path begins, read, prepared, equations."""
    import turgor as tg
    from turgor.core.engine.algebra.tangent import Tangent
    from turgor.core.engine.system import System
    from turgor.job.text.overrides import parse_changes

    runs = []
    for pressure in ("0.2 kPa", "0.3 kPa", "0.4 kPa"):
        times = [process_time()]
        job = tg.jobs.read_job(DEMO, parse_changes([f"loads.pressure={pressure}"]))
        times.append(process_time())
        model, _ = tg.jobs.prepare(job)
        times.append(process_time())
        Tangent(System(model), "rslab", 1)
        times.append(process_time())
        read, prepared, equations = (after - before for before, after in pairwise(times))
        runs.append((pressure, read, prepared, equations))
    return runs


def section() -> str:
    """The section of the page."""
    result = parts()
    rows = [(part, f"{seconds:.2f}") for part, seconds in result.items()]
    text = (
        "`turgor run` of the demo with a small pressure, caches filled. Overhead is all but mesh, solve and files: "
        f"{result['overhead']:.2f} CPU s, of which at most {MOST:g} are asked. The parts contain each other."
    )
    more = "Three pressures in one process, CPU seconds before the path begins; the first run does what all need."
    head = ("pressure", "reading", "mesh and checks", "equations")
    several = [(pressure, *(f"{seconds:.2f}" for seconds in spent)) for pressure, *spent in again()]
    return f"## Overhead\n\n{text}\n\n{table(('part', 'CPU s'), rows)}\n\n{more}\n\n{table(head, several)}\n"


def main() -> int:
    if sys.argv[1:] == ["--one"]:
        one()
    result = parts()
    for part, seconds in result.items():
        print(f"{seconds:6.2f} CPU s  {part}")
    print("shape and mesh were", "built" if result["mesh"] else "found on disk, where the run before kept them")
    print(f"{MOST:g} CPU s of overhead asked")
    for pressure, read, prepared, equations in again():
        print(f"{pressure}: reading {read:.2f}, mesh and checks {prepared:.2f}, equations {equations:.2f} CPU s")
    return int(result["overhead"] > MOST)


if __name__ == "__main__":
    sys.exit(main())
