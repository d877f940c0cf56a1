"""Count the runs and CPU seconds of a calibration of two numbers of a small bender against one curve.

Run ``python benchmarks/studies/calibration.py [FOLDER]``. The curve is made up: the same bender with a softer rubber
and a thicker floor, with noise of 0.05°. The floor has a prior of 3 %. Called again with the same folder, it reads
them.
"""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2] / "tests"))

import turgor as tg
from calibration_cases import free_parameters
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies.calibration.job_calibration import job_trial
from turgor.studies.runs.jobs.job_function import job_function
from turgor.studies.runs.jobs.job_runs import solved_job
from turgor.units import deg, kPa, mm

JOB = """
[actuator]
type = "rectangular_bender"
length = "60 mm"
base = "0 mm"
[mesh]
size = "6 mm"
wall_cells = 1
cells = "hexahedra"
[materials]
body = { law = "neo_hooke", C10 = "0.12 MPa" }
strain_limiting_layer = { library = "paper", record = "hooke-polygerinos-2020", thickness = "0.1 mm" }
[loads]
pressure = "20 kPa"
[output]
measures = ["bending_angle"]
"""

FREE = ["materials.body.C10", "actuator.floor=1.5 mm:1 mm:2 mm"]
PRIOR = ["actuator.floor=1.65 mm +- 3 %"]
TRUE = {"materials.body.C10": 0.1e6, "actuator.floor": 1.65 * mm}


def main(folder: Path) -> None:
    """Calibrate, and print what it took."""
    (folder / "bender.toml").write_text(JOB, encoding="utf-8")
    job = job_function(tg.jobs.read_job(folder / "bender.toml"), folder / "calibration")
    true = solved_job(**job.values, numbers=TRUE).response
    at = np.linspace(1 * kPa, 19 * kPa, 15)
    angle = np.interp(at, true["pressure"], true["bending_angle"])
    angle += 0.05 * deg * np.random.default_rng(0).standard_normal(15)
    columns = Column("pressure", "kPa", at), Column("bending_angle", "deg", angle)
    measured = Response(columns=columns, source=Source(text="made up"))
    runs = tg.studies.saved_in(folder / "calibration" / "runs")
    result = tg.studies.calibrate(
        job_trial(job, measured, spread=0.05 * deg), free_parameters(FREE, PRIOR, job), evaluations=runs
    )
    seconds = sum(each.result.seconds for each in runs.ended.values() if each.result is not None)
    print(result.summary())
    print(f"{result.solves} solves, {result.computed} of them computed now; {seconds:.1f} CPU s")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        Path(sys.argv[1]).mkdir(parents=True, exist_ok=True)
        main(Path(sys.argv[1]))
    else:
        with TemporaryDirectory() as temporary:
            main(Path(temporary))
