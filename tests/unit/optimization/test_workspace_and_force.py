"""Goals that take several runs or contact: the workspace of a design, and the force of a blocked tip."""

import pytest

import optimization_cases as cases
import turgor as tg
from calibration_cases import JOB
from turgor.cli import main
from turgor.cli.exits import DONE
from turgor.study.job_runs import solved_job
from turgor.study.jobs.job_file import job_file
from turgor.units import kPa, mL, mm

studies = tg.studies


def test_the_largest_workspace_under_limits_of_stress_and_rubber():
    """The stress gives the wall, 160 kPa mm / 80 kPa = 2 mm, the rubber the length, 8 mL / 50 mm / 2 mm = 80 mm."""
    ranges = [
        studies.Factor(name="length", low=40 * mm, high=120 * mm, unit="mm"),
        studies.Factor(name="wall", low=1 * mm, high=4 * mm, unit="mm"),
    ]
    goals = [
        studies.Maximize("workspace_area"), studies.Limit("stress", most=80 * kPa), studies.Limit("rubber", most=8 * mL)
    ]  # fmt: skip
    found = tg.optimize(cases.reach_of_two_cavities, ranges, goals, search=studies.Search(most_solves=40))
    assert found.converged, found.summary()
    assert found.values == pytest.approx({"length": 80 * mm, "wall": 2 * mm}, rel=0.01)
    corner = 20e3 * 1e-8 * found.values["length"] ** 2 / (60 * mm) / found.values["wall"]
    assert found.reads()[0].value == pytest.approx(2 * corner**2)  # a square with diagonals of twice the corner
    assert "workspace area: " in found.summary()
    assert "mm² (as large as possible)" in found.summary()


PUSHES = """
job = "blocked.toml"

[factors]
"actuator.inner_radius" = { low = "4 mm", high = "10 mm", start = "6 mm" }

[[targets]]
measure = "blocked_force"
value = "0.8 N"
at = { pressure = "8 kPa" }
"""


def test_a_tip_before_a_plate_is_to_push_with_a_force(tmp_path, monkeypatch, capsys):
    job = JOB.replace("20 kPa", "10 kPa") + '\n[procedure]\ntype = "blocked_force"\n'
    (tmp_path / "blocked.toml").write_text(job, encoding="utf-8")
    (tmp_path / "push.toml").write_text(PUSHES, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert main(["optimize", "push.toml", "--no-mesh-error"]) == DONE
    said, progress = capsys.readouterr()
    assert progress.lstrip().startswith("actuator.inner_radius 6 mm: done")
    assert "N (wanted 0.8 N), at the start 0.2" in said
    best = job_file(tg.jobs.read_job(tmp_path / "push-optimization" / "best.toml"), tmp_path / "again")
    found = solved_job(**best.values, numbers={}, measures=["blocked_force"])
    assert list(found["pressure"])[-2:] == pytest.approx([8 * kPa, 10 * kPa])  # a state where the goal reads
    assert found["blocked_force"][-2] == pytest.approx(0.8, rel=0.011)
