"""What the first run on a machine costs: seconds of compiling by loop, and the time to the first solved step.

python benchmarks/core/compiling.py [JOB]
python benchmarks/run.py compiling      a section of results.md

The job is the demo by default, with a small pressure. A first process counts what is compiled, each loop with its
signatures; a second one runs `turgor run` with an empty cache and waits for its first step. Exit code 1 beyond 25 CPU
seconds of compiling or 12 seconds to the first step.
"""

import os
import resource
import subprocess
import sys
from collections import defaultdict
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, process_time
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
from benchmarks.shared.tables import table

MOST_COMPILING, MOST_WAITING, SHOWN = 25.0, 12.0, 15
DEMO = Path(__file__).parents[2] / "examples" / "fast_pneunet.toml"
LOAD = ("--set", 'loads.pressure="0.2 kPa"', "--set", "output.mesh_error=false")


def counted(job: str) -> None:
    """Run a job in this process and print the CPU seconds that each loop takes to compile, without what it calls."""
    from numba.core import event

    from turgor.cli.app import main as command
    from turgor.foundation.startup.background_compiler import background_process

    class Listener(event.Listener):
        def __init__(self) -> None:
            self.stack: list[list[float]] = []
            self.found: dict[str, list[float]] = defaultdict(lambda: [0.0, 0])
            self.total = 0.0

        def on_start(self, _: Any) -> None:
            self.stack.append([process_time(), 0.0])

        def on_end(self, told: Any) -> None:
            began, inner = self.stack.pop()
            spent = process_time() - began
            if self.stack:
                self.stack[-1][1] += spent
            else:
                self.total += spent
            entry = self.found[told.data["dispatcher"].py_func.__name__]
            entry[0] += spent - inner
            entry[1] += 1

    listener = Listener()
    with event.install_listener("numba:compile", listener), TemporaryDirectory() as folder:
        code = command(["run", job, "--output", folder, "--force", *LOAD])
    process = background_process()
    if process is not None:
        process.wait()  # what it took is counted once it has ended
    beside = resource.getrusage(resource.RUSAGE_CHILDREN)
    for name, (seconds, times) in sorted(listener.found.items(), key=lambda item: -item[1][0])[:SHOWN]:
        print(f"{seconds:6.2f} s  {times:.0f} times  {name}")
    print(
        f"{listener.total + beside.ru_utime:.1f} CPU s, of them {beside.ru_utime:.1f} in another process; exit {code}"
    )


def waited(job: str) -> float:
    """Seconds from `turgor run` with an empty cache to its first solved step."""
    with TemporaryDirectory() as cache, TemporaryDirectory() as folder:
        began = perf_counter()
        command = [sys.executable, "-m", "turgor", "run", job, "--output", folder, "--force", *LOAD]
        process = subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            env=os.environ | {"NUMBA_CACHE_DIR": cache, "TURGOR_CACHE_MB": "0"},
        )
        assert process.stdout is not None
        for line in process.stdout:
            if " step 1:" in line:
                break
        spent = perf_counter() - began
        process.kill()
        process.communicate()
    return spent


def compiled(job: str) -> list[str]:
    """Lines that `counted` prints in a process with an empty cache: the slowest loops, and the sum."""
    with TemporaryDirectory() as cache:
        environment = os.environ | {"NUMBA_CACHE_DIR": cache, "TURGOR_CACHE_MB": "0"}
        done = subprocess.run(
            [sys.executable, __file__, "--count", job], env=environment, stdout=subprocess.PIPE, text=True, check=True
        )
    return [line for line in done.stdout.splitlines() if " times " in line or " CPU s, " in line]


def section() -> str:
    """The section of the page."""
    compiling, first = float(compiled(str(DEMO))[-1].split()[0]), waited(str(DEMO))
    rows = [
        ("`turgor run` of the demo to its first solved step, wall s", f"{first:.1f}", f"{MOST_WAITING:g}"),
        ("compiling for the demo, all processes, CPU s", f"{compiling:.1f}", f"{MOST_COMPILING:g}"),
    ]
    text = "No cache of compiled kernels, shapes or meshes. `python benchmarks/core/compiling.py` tells each loop."
    return f"## First run on a machine\n\n{text}\n\n{table(('what', 'measured', 'at most'), rows)}\n"


def main() -> int:
    if sys.argv[1:2] == ["--count"]:
        counted(sys.argv[2])
        return 0
    job = sys.argv[1] if len(sys.argv) > 1 else str(DEMO)
    lines = compiled(job)
    print("\n".join(lines))
    first = waited(job)
    print(f"first solved step after {first:.1f} s; {MOST_WAITING:g} s and {MOST_COMPILING:g} CPU s asked")
    return int(first > MOST_WAITING or float(lines[-1].split()[0]) > MOST_COMPILING)


if __name__ == "__main__":
    sys.exit(main())
