"""A procedure of one's own: one file serves Python, job files, stages, reports, gradients and mesh errors."""

from dataclasses import replace
from pathlib import Path

import pytest

import turgor as tg
import turgor.core.solvers.procedures
from class_queries import queried
from refused import refused
from turgor.core.results.drive import drive_of
from turgor.core.solvers.procedures.cavity_procedure import CavityProcedure
from turgor.core.solvers.procedures.listed import PROCEDURES
from turgor.core.solvers.procedures.stages import Stages
from turgor.core.solvers.procedures.step_options import StepOptions
from turgor.core.solvers.procedures.time_options import TimeOptions
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.studies.runs.jobs.columns import unit_of_column
from turgor.studies.runs.jobs.job_gradients import gradient_of_job
from turgor.units import mL
from turgor.views.report import describe_procedure

SYRINGE = '''
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from turgor.core.solvers.constraints.elimination import Conditions
from turgor.core.solvers.procedures.cavity_procedure import CavityProcedure
from turgor.core.solvers.procedures.step_options import check_steps


@dataclass(frozen=True, slots=True, kw_only=True)
class Syringe(CavityProcedure):
    """Push a liquid into cavities through a hose that widens in proportion to the pressure.

    Parameters
    ----------
    push : float [m³], or mapping of str to float
        Volume pushed into the hose in the end; by cavity where there are several.
    compliance : float [m³/Pa]
        Volume that a hose takes in for each pressure.
    """

    drive = "pushed_volume"
    drive_unit = "mL"
    requested_field = "push"

    push: float | Mapping[str, float] = field(metadata={"dimension": "volume"})
    compliance: float = 0.0
    max_step: float = 0.5

    def __post_init__(self):
        check_steps(self)

    def target(self, chambers, volumes, pressures):
        system, pushed = chambers.system, self.requested_of(chambers.faces)
        hose = self.compliance * system.stress_scale / system.length**3
        return Hose(chambers, volumes + hose * pressures, pushed / system.length**3, hose)

    def amounts(self, chambers, volumes):
        pushed = self.requested_of(chambers.faces)
        return lambda load_factor: load_factor * pushed

    def driven_text(self, now, first):
        return f"a push of {now[self.drive] * 1e6:.4g} mL"


@dataclass(frozen=True, slots=True, eq=False)
class Hose:
    """Cavity and hose hold what they held at the start and what was pushed in."""

    chambers: Any
    start: np.ndarray
    pushed: np.ndarray
    hose: float

    def conditions(self, unknowns, parameter, scalars):
        scale = self.start + np.abs(self.pushed)
        stored = self.chambers.volumes(unknowns) + self.hose * scalars
        errors = (stored - self.start - parameter * self.pushed) / scale
        return Conditions(errors, self.chambers.gradients(unknowns) / scale[:, None], np.diag(self.hose / scale))

    def onward(self, last, now):
        return self
'''

JOB = """\
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "5 mm"
cells = "hexahedra"

[materials]
body = { law = "neo_hooke", C10 = "0.1 MPa" }
base = { law = "neo_hooke", C10 = "0.1 MPa" }

[procedure]
type = "syringe"
push = "0.1 mL"
compliance = 1e-11

[output]
measures = ["tip_displacement", "cavity_volume"]
"""


@pytest.fixture
def syringe(tmp_path, monkeypatch):
    folder = tmp_path / "own"
    folder.mkdir()
    (folder / "syringe.py").write_text(SYRINGE, encoding="utf-8")
    package = turgor.core.solvers.procedures
    assert "syringe" not in PROCEDURES
    monkeypatch.setattr(package, "__path__", [*package.__path__, str(folder)])
    return PROCEDURES["syringe"]


def read(folder, text=JOB):
    (folder / "pushed.toml").write_text(text, encoding="utf-8")
    return read_job(folder / "pushed.toml")


def test_a_job_file_states_it_and_the_lock_file_gives_it_back(syringe, tmp_path):
    job = read(tmp_path)
    assert job.procedure == syringe(push=0.1 * mL, compliance=1e-11)
    (tmp_path / "lock.toml").write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(tmp_path / "lock.toml") == job
    assert unit_of_column(job, "pushed_volume") == "mL"
    for wrong, facts in (
        (JOB.replace("0.1 mL", "0.1 mm"), ("procedure.push", "'0.1 mm'", "volume")),
        (JOB.replace("push =", "pull ="), ("'pull'", "'push'")),
    ):
        with refused(*facts):
            read(tmp_path, wrong)


def test_it_is_solved_reported_and_differentiated(syringe, tmp_path):
    job = read(tmp_path)
    model, _ = prepare(job)
    solution = tg.solve(model, job.procedure)
    assert "0.1 mL" in solution.message
    rows = dict(describe_procedure.procedure(job.procedure))
    assert (rows["push"], rows["compliance"]) == ("0.1 mL", "1e-11")

    response = tg.measure(solution, "tip_displacement", "cavity_volume")
    assert drive_of(response) == "pushed_volume"
    pressure, volume = response.column("pressure"), response.column("cavity_volume")
    assert response.column("pushed_volume")[-1] == pytest.approx(0.1 * mL)
    assert volume + 1e-11 * pressure - volume[0] == pytest.approx(
        response.column("pushed_volume"), abs=1e-6 * volume[0]
    )
    assert 1e-11 * pressure[-1] > 0.01 * mL  # the hose takes in a good part
    by_volume = tg.solve(model, tg.VolumeControl(volume=float(volume[-1] - volume[0])))
    assert tg.measure(by_volume, mesh_error=False).column("pressure")[-1] == pytest.approx(pressure[-1], rel=1e-5)
    for name in ("pressure", "tip_displacement"):
        assert response.column(f"{name}_mesh_error")[-1] > 0

    slope = gradient_of_job(job, ["procedure.push"], ["pressure"], solution=solution).by("pressure")["procedure.push"]
    ends = [tg.solve(model, replace(job.procedure, push=(1 + way * 0.01) * 0.1 * mL)).states[-1] for way in (1, -1)]
    assert slope == pytest.approx((ends[0].pressures["cavity"] - ends[1].pressures["cavity"]) / 0.002e-6, rel=1e-3)


def test_a_stage_goes_on_from_it_and_its_pressure_has_no_gradient_then(syringe, tmp_path):
    first = '[[stages]]\nname = "push"\n[stages.procedure]\ntype = "syringe"'
    stages = JOB.replace('[procedure]\ntype = "syringe"', first)
    job = read(tmp_path, stages + '\n[[stages]]\nname = "seal"\nprocedure = { type = "sealed" }\n')
    solution = tg.solve(prepare(job)[0], job.procedure)
    response = tg.measure(solution, "cavity_volume", mesh_error=False)
    assert drive_of(response) == "stage"
    assert response.column("cavity_volume")[-1] == pytest.approx(response.column("cavity_volume")[-2], rel=1e-5)
    with refused("stage"):
        gradient_of_job(job, ["materials.body.C10"], ["pressure"], solution=solution)


def test_only_their_folder_asks_for_classes_of_procedures():
    kinds = (*PROCEDURES.values(), Stages, StepOptions, TimeOptions, CavityProcedure)
    classes, home = {kind.__name__ for kind in kinds}, Path(turgor.core.solvers.procedures.__file__).parent
    files = [path for path in Path(tg.__file__).parent.rglob("*.py") if path.parent != home]
    assert len(classes) >= 12
    assert {path.name for path in files if queried(path.read_text(encoding="utf-8")) & classes} == set()
    assert queried("type(a) is Spin or type(b).__name__ == 'Weight'") == {"Spin", "Weight"}
