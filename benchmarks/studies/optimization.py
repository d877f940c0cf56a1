"""Count the runs of an optimization of three dimensions of a fast PneuNet at its default mesh.

Run ``python benchmarks/studies/optimization.py [FOLDER]``. A finger with a wall of 1.3 mm, a base of 1.2 mm and 17 mm
high is solved at 7 kPa, before its walls meet. The search begins at the default dimensions, and is to find a finger
with the same bending angle, cavity volume and von Mises stress within 1 % in at most 25 runs. Called again with the
same folder, it reads them.
"""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import turgor as tg
from turgor.studies.runs.jobs.job_function import job_function
from turgor.studies.runs.jobs.job_runs import solved_job
from turgor.units import kPa, mm

JOB = """
[actuator]
type = "fast_pneunet"
[mesh]
size = "3 mm"
[materials]
body = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }
base = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }
strain_limiting_layer = { library = "paper", record = "hooke-polygerinos-2020", thickness = "0.1 mm" }
[loads]
pressure = "7 kPa"
[output]
measures = ["bending_angle", "cavity_volume", "von_mises_p99"]
"""

TRUE = {"actuator.wall": 1.3 * mm, "actuator.base": 1.2 * mm, "actuator.height": 17 * mm}
RANGES = {"actuator.wall": (0.8, 1.6), "actuator.base": (0.8, 2.2), "actuator.height": (12, 18)}
START = {"actuator.wall": 1 * mm, "actuator.base": 1.5 * mm, "actuator.height": 15 * mm}
MEASURES = ("bending_angle", "cavity_volume", "von_mises_p99")

#: Runs within which all targets are to be met.
MOST = 25


def main(folder: Path) -> None:
    """Optimize, and print what it took."""
    (folder / "finger.toml").write_text(JOB, encoding="utf-8")
    job = job_function(tg.jobs.read_job(folder / "finger.toml"), folder / "optimization")
    computation = tg.studies.Computation(function=solved_job, values=job.values, gather="numbers")
    runs = tg.studies.saved_in(folder / "optimization" / "runs", processes=2, progress=told)
    (true,) = runs.of([computation.run(TRUE)])
    assert true.result is not None, true.problem
    at = ("pressure", 7 * kPa)
    goals = [tg.studies.Target(name, float(true.result.response[name][-1]), at=at) for name in MEASURES]
    factors = [
        tg.studies.Factor(name=name, low=low * mm, high=high * mm, unit="mm") for name, (low, high) in RANGES.items()
    ]
    search = tg.studies.Search(most_solves=MOST)
    result = tg.optimize(computation, factors, goals, start=START, search=search, evaluations=runs)
    seconds = sum(row.seconds for row in result.study.rows)
    print(result.summary())
    print(f"{result.solves} runs, at most {MOST} are allowed; {seconds:.0f} CPU s")
    assert result.converged, "all targets within 1 % in at most 25 runs"


def told(ended: tg.studies.Ended) -> None:
    print(ended.run.name, ended.problem or "done", flush=True)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        Path(sys.argv[1]).mkdir(parents=True, exist_ok=True)
        main(Path(sys.argv[1]))
    else:
        with TemporaryDirectory() as temporary:
            main(Path(temporary))
