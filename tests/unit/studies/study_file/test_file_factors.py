"""Files as factors: parts that a CAD program wrote are the designs of a sweep."""

import pytest

from refused import refused
from turgor.core.geometry import occ
from turgor.core.geometry.silenced_output import captured_output
from turgor.studies.runs.evaluations import saved_in
from turgor.studies.study_file.job_sweep import sweep_job
from turgor.studies.study_file.study_file import read_study_file

JOB = """
[actuator]
type = "cad_file"
file = "thin.step"
[actuator.faces]
fixed = { normal = "-x" }
tip = { normal = "+x" }
[mesh]
size = "8 mm"
[materials]
body = { law = "neo_hooke", C10 = "20 kPa" }
[loads]
pressure = "1 kPa"
[output]
measures = ["cavity_volume"]
mesh_error = false
"""


def draw(file, wall):
    block = occ.Box(occ.Pnt(0, -8, 0), occ.Pnt(20, 8, 16))
    with captured_output():
        (block - occ.Box(occ.Pnt(3, wall - 8, wall), occ.Pnt(17, 8 - wall, 16 - wall))).WriteStep(str(file))


@pytest.fixture
def study(tmp_path):
    for name, wall in (("thin", 3.0), ("thick", 4.0)):
        draw(tmp_path / f"{name}.step", wall)
    (tmp_path / "job.toml").write_text(JOB)
    (tmp_path / "study.toml").write_text(
        'job = "job.toml"\n[factors]\nactuator.file = ["thin.step", "thick.step"]\n[sweep]\n'
    )
    return read_study_file(tmp_path / "study.toml")


def swept(study, folder):
    return sweep_job(study, folder, saved_in(folder / "runs"))


def test_each_design_is_a_part_of_its_own(tmp_path, study):
    done = swept(study, tmp_path / "out")
    volumes = done.column("cavity_volume") * 1e9
    assert volumes[0] == pytest.approx(14 * 10 * 10, rel=0.15)
    assert volumes[1] == pytest.approx(14 * 8 * 8, rel=0.15)
    assert (tmp_path / "out" / "thick.step").read_bytes() == (tmp_path / "thick.step").read_bytes()
    draw(tmp_path / "thick.step", 5.0)
    with refused("factors.actuator.file", "thick.step", "out"):
        swept(study, tmp_path / "out")


def test_a_file_that_is_missing_or_elsewhere_is_refused(tmp_path, study):
    (tmp_path / "thick.step").unlink()
    with refused("factors.actuator.file", "thick.step"):
        swept(study, tmp_path / "out")
    text = (tmp_path / "study.toml").read_text().replace("thick.step", "../thick.step")
    (tmp_path / "study.toml").write_text(text)
    with refused("factors.actuator.file", "../thick.step"):
        swept(read_study_file(tmp_path / "study.toml"), tmp_path / "out")
