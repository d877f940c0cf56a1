"""Gradients of jobs: numbers by the keys of the file, in Python and on the command line."""

import json

import pytest

import turgor as tg
from refused import refused
from turgor.cli import main
from turgor.units import mm

JOB = """
[actuator]
type = "fast_pneunet"
chambers = 1
length = "20 mm"
wall = "2 mm"

[mesh]
size = "8 mm"
cells = "hexahedra"

[materials.body]
law = "neo_hooke"
C10 = "0.11 MPa"

[materials.base]
law = "neo_hooke"
C10 = "0.15 MPa"

[loads]
pressure = "5 kPa"

[output]
measures = ["bending_angle", "cavity_volume"]
"""

KEYS = ["actuator.length", "materials.body.C10", "materials.base.C10", "loads.pressure"]


@pytest.fixture(scope="module")
def job_file(tmp_path_factory):
    file = tmp_path_factory.mktemp("gradient") / "finger.toml"
    file.write_text(JOB, encoding="utf-8")
    return file


@pytest.fixture(scope="module")
def gradient(job_file):
    return tg.studies.gradient_of_job(tg.jobs.read_job(job_file), KEYS)


def test_bending_depends_on_pressure_over_stiffness_alone(gradient):
    """Dimensional analysis: no change of the angle if pressure and both stiffnesses grow alike."""
    change = gradient.relative("bending_angle")
    assert sum(change[key] for key in KEYS[1:]) == pytest.approx(0, abs=1e-7 * abs(change["loads.pressure"]))
    assert gradient["cavity_volume", "loads.pressure"] > 0
    assert gradient.way == "adjoint"


def test_numbers_have_the_units_of_the_job(gradient):
    assert [each.unit for each in gradient.numbers] == ["mm", "MPa", "MPa", "kPa"]
    assert gradient.numbers[0].values[0] == 20 * mm


def test_only_numbers_of_the_actuator(job_file):
    job = tg.jobs.read_job(job_file)
    for key, facts in (
        ("mesh.size", ["'mesh.size'", "setting"]),
        ("actuator.chambers", ["'actuator.chambers'", "whole number", 1]),
        ("materials.body.C20", ["'materials.body.C20'", "'materials.body.C10'"]),
        ("materials.body.C10,materials.base.C10", ["110000 and 150000"]),
    ):
        with refused(*facts):
            tg.studies.gradient_of_job(job, [key])


def test_command_writes_a_table_and_a_document(job_file, gradient, tmp_path, capsys):
    wanted = [part for key in KEYS for part in ("--wrt", key)]
    table = tmp_path / "slopes.csv"
    assert main(["gradient", str(job_file), *wanted, "--output", str(table), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["result"]
    assert told["derivatives"][0] == pytest.approx(gradient["bending_angle"].tolist(), rel=1e-6)
    assert [each["key"] for each in told["numbers"]] == KEYS
    assert len(table.read_text(encoding="utf-8").splitlines()) == 1 + len(KEYS)
