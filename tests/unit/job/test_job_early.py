"""Findings of a job: before the solve, by weight, and none twice; `turgor check` and `turgor run` say the same."""

import pytest

from refused import states
from turgor.cli import main
from turgor.cli.exits import DONE, FOUND_ERROR
from turgor.foundation.finding import Severity
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.job.run import run_job

JOB = """\
[actuator]
type = "fast_pneunet"
chambers = 2
length = "20 mm"
gap = "2 mm"

[mesh]
size = "4 mm"

[materials]
body = { law = "yeoh", C10 = "110 kPa", C20 = "-20 kPa", C30 = "0 Pa" }
base = { law = "yeoh", C10 = "110 kPa", C20 = "-20 kPa", C30 = "0 Pa", density = "1.07 kg/m³" }

[loads]
pressure = "2 kPa"

[procedure]
type = "static"
first_step = 0.5
max_step = 0.5

[output]
mesh_error = false
fields = false
pictures = false
report = false
measures = ["bending_angle"]
"""


@pytest.fixture
def file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "finger.toml").write_text(JOB, encoding="utf-8")
    return tmp_path / "finger.toml"


def test_findings_come_before_the_solve_and_once(file):
    said = []
    outcome = run_job(read_job(file), notify=said.append, report=said.append)
    findings = [each for each in said if not isinstance(each, str)]
    assert said.index("solving") > max(said.index(each) for each in findings)
    assert [each.code for each in findings] == [
        "G01",
        "M06",
        "M06",
        "P01",
    ]  # laws that differ in density are told apart
    assert [each.code for each in outcome.findings] == ["G01", "M06", "M06", "P01"]
    assert len(set(outcome.findings)) == len(outcome.findings)
    log = (file.parent / "finger-results" / "run.log").read_text()
    assert log.count("P01 warning") == 1


def test_g01_waits_for_the_mesh_error(file):
    file.write_text(JOB.replace("mesh_error = false\n", ""), encoding="utf-8")
    said = []

    def stop(text):
        if text == "solving":
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_job(read_job(file), notify=stop, report=said.append)
    assert [each.code for each in said] == ["M06", "M06", "P01"]


def test_the_command_line_prints_each_finding_once_and_early(file, capsys):
    assert main(["run", "finger.toml", "--quiet"]) == DONE
    lines = capsys.readouterr().err.splitlines()
    assert [line[:3] for line in lines] == ["G01", "M06", "M06", "P01"]
    assert main(["check", "finger.toml"]) == DONE
    assert [line[:3] for line in capsys.readouterr().err.splitlines()] == ["M06", "M06", "P01"]


def test_what_is_impossible_fails_the_check(file, capsys):
    file.write_text(JOB.replace('"2 kPa"', '"-500 kPa"'), encoding="utf-8")
    assert main(["check", "finger.toml"]) == FOUND_ERROR
    assert states(capsys.readouterr().err, "L08 error:", "'cavity'", "-500 kPa")
    _, findings = prepare(read_job(file))
    assert findings[0].severity is Severity.ERROR
