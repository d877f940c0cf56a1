"""Any file name is that of a job, a part may lack a cavity, and a reader may stop reading."""

import os
import subprocess
import sys
from pathlib import Path

import cad_cases as cases
import pytest
from netgen.occ import Box, Pnt

from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, BROKEN_PIPE, DONE
from turgor.job.job import standard_measures
from turgor.job.read import read_job

BLOCK = """\
[actuator]
type = "cad_file"
file = "block.step"

[actuator.faces]
fixed = { normal = "-x" }

[mesh]
size = "6 mm"

[materials]
body = { law = "neo_hooke", C10 = "0.12 MPa", density = "1.07 g/cm³" }

[loads]
gravity = "-z"
"""

FINGER = """\
[actuator]
type = "fast_pneunet"
chambers = 2
length = "20 mm"

[materials]
body = { law = "neo_hooke", C10 = "0.12 MPa" }
base = { law = "neo_hooke", C10 = "0.12 MPa" }

[loads]
pressure = "2 kPa"
"""


@pytest.mark.parametrize(
    ("file", "name"),
    [
        ("my job.toml", "my-job"),
        ("finger (copy 2), 60 kPa.toml", "finger-copy-2-60-kPa"),
        ("Prüfling №3.toml", "Prüfling-3"),
        ("%.toml", "job"),
        ("a--b_c.1.toml", "a--b_c.1"),
    ],
)
def test_any_file_name_is_that_of_a_job(tmp_path: Path, file: str, name: str) -> None:
    (tmp_path / file).write_text(FINGER, encoding="utf-8")
    assert read_job(tmp_path / file).name == name


def test_default_measures_fit_a_part_without_cavity_and_tip(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    cases.written(tmp_path, Box(Pnt(0, 0, 0), Pnt(40, 10, 6)), "block.step")
    Path("my job.toml").write_text(BLOCK, encoding="utf-8")
    assert main(["check", "my job.toml"]) == DONE
    assert "my job.toml is a valid job" in capsys.readouterr().out
    left = {"bending_angle", "tip_displacement", "cavity_volume"}
    assert read_job("my job.toml").output.measures == tuple(each for each in standard_measures() if each not in left)
    Path("asked.toml").write_text(f'{BLOCK}\n[output]\nmeasures = ["cavity_volume"]\n', encoding="utf-8")
    assert main(["check", "asked.toml"]) == BAD_INPUT
    assert "measure 'cavity_volume': unknown face 'cavity'" in capsys.readouterr().err


@pytest.mark.skipif(sys.platform == "win32", reason="pipes break otherwise there")
def test_a_reader_that_goes_away_gets_no_message() -> None:
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}
    program = [sys.executable, "-m", "turgor", "actuators"]
    reader, writer = os.pipe()
    os.close(reader)
    try:
        done = subprocess.run(program, stdout=writer, stderr=subprocess.PIPE, env=environment, check=False)
    finally:
        os.close(writer)
    assert (done.returncode, done.stderr) == (BROKEN_PIPE, b"")
