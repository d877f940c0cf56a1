"""What it costs to keep every state of a run on disk, to go on with it, and to check a job.

python benchmarks/run.py running      a section of results.md
python benchmarks/job/running.py          the same, printed
"""

import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter, process_time

import turgor as tg

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
from benchmarks.shared.case import ROOT
from benchmarks.shared.tables import table
from turgor.core.solvers.checkpoints.loop import Loop
from turgor.core.solvers.checkpoints.record import StageRecord
from turgor.units import kPa, mm

JOB = ROOT / "examples" / "fast_pneunet.toml"


class Cut(BaseException):
    """Ends a run as a signal would."""


def demo() -> tg.Model:
    """The actuator of the demo at 2.2 mm, until shortly before its walls meet."""
    job = tg.jobs.read_job(JOB)
    mesh = tg.mesh(job.actuator.build(), size=2.2 * mm, grading=job.mesh.grading)
    return tg.Model(mesh, materials=job.materials, supports=job.supports, loads=[tg.Pressure("cavity", 6 * kPa)])


@dataclass(slots=True)
class Writing:
    """CPU and wall seconds spent in keeping states."""

    cpu: float = 0.0
    wall: float = 0.0

    def watch(self) -> None:
        """Time every checkpoint from now on."""
        keep = StageRecord.keep

        def timed(record, path, loop):
            cpu, wall = process_time(), perf_counter()
            keep(record, path, loop)
            self.cpu += process_time() - cpu
            self.wall += perf_counter() - wall

        StageRecord.keep = timed  # type: ignore[method-assign]


def section() -> str:
    """The section of the page."""
    model, options, writing = demo(), tg.EngineOptions(linear_solver="rslab"), Writing()
    tg.solve(model, tg.Static(), options=options, stop=lambda state: "warm", throw=False)
    writing.watch()
    with tempfile.TemporaryDirectory() as folder:
        cpu, wall = process_time(), perf_counter()
        whole = tg.solve(model, tg.Static(), options=options, folder=Path(folder) / "whole")
        cpu, wall = process_time() - cpu, perf_counter() - wall
        size = sum(file.stat().st_size for file in (Path(folder) / "whole").iterdir())
        steps = len(whole.states) - 1
        resume = _resume(model, options, Path(folder) / "cut", steps)
    check = _check()
    each = sum(step.seconds for step in whole.steps) / steps
    rows = [
        ("writing every state, share of the run's CPU time", f"{100 * writing.cpu / cpu:.1f} %", "5 %"),
        ("writing every state, share of the run's wall time", f"{100 * writing.wall / wall:.1f} %", "5 %"),
        ("going on: from the call to where the run was cut [s]", f"{resume:.2f}", f"one step, {each:.2f}"),
        ("`turgor check` of the demo, warm [s]", f"{check:.1f}", "4"),
    ]
    text = (
        f"The demo at 2.2 mm, {model.mesh.unknown_count:,} unknowns, {steps} steps to 6 kPa in {wall:.1f} s; "
        f"{size / 2**20:.0f} MiB stay on disk. Going on includes reading, the set-up of the equations and the analysis "
        "of the linear solver, in a process that has its kernels."
    )
    return f"## Running\n\n{text}\n\n{table(('what', 'measured', 'at most'), rows)}\n"


def _resume(model: tg.Model, options: tg.EngineOptions, folder: Path, steps: int) -> float:
    """Seconds from `resume` of a run that was cut in its last step until it stands where it was cut."""

    def cut(iteration, state):
        if state is None and iteration.step == steps:
            raise Cut

    def stand(loop, path, so_far):
        restore(loop, path, so_far)
        raise Cut

    try:
        tg.solve(model, tg.Static(), options=options, folder=folder, progress=cut)
    except Cut:
        restore, Loop._restore, began = Loop._restore, stand, perf_counter()
    try:
        tg.resume(folder)
    except Cut:
        return perf_counter() - began
    finally:
        Loop._restore = restore
    raise RuntimeError("the run did not go on")


def _check() -> float:
    """The shortest of three times of `turgor check` on the demo [s]."""
    command, times = [sys.executable, "-m", "turgor", "check", str(JOB)], []
    for _ in range(3):
        began = perf_counter()
        subprocess.run(command, check=True, capture_output=True)
        times.append(perf_counter() - began)
    return min(times)


if __name__ == "__main__":
    print(section())
