"""The thermal expansion of a material: stated, in jobs and lock files, and taken by temperatures."""

from dataclasses import replace

import pytest
import results_cases as cases

import turgor as tg
from refused import refused
from turgor.core.model.loads import Temperature
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job

RUBBER = replace(cases.RUBBER, expansion=3e-4)
MESH = cases.body()

JOB = """\
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "4 mm"

[materials]
base = { law = "neo_hooke", C10 = "50 kPa" }
body = { law = "neo_hooke", C10 = "50 kPa", expansion = "310 ppm/K" }

[loads]
pressure = "1 kPa"
temperature = [{ body = "body", temperature = "60 °C" }]
"""


def warmed(load, **materials):
    return tg.Model(MESH, {"body": RUBBER, "base": cases.RUBBER} | materials, "fixed", [load])


def test_a_temperature_takes_the_expansion_of_its_material():
    (load,) = warmed(Temperature("body", "60 °C")).loads
    assert load.growth == pytest.approx(3e-4 * 40)
    assert "0.0003 per kelvin" in load.text()
    (own,) = warmed(Temperature("body", "60 °C", expansion="100 ppm/K")).loads
    assert own.growth == pytest.approx(1e-4 * 40)


def test_without_any_expansion_a_temperature_must_change_something():
    with refused("'base'", "expansion", "3e-4 1/K", "modulus"):
        warmed(Temperature("base", "60 °C"))
    (softer,) = warmed(Temperature("base", "60 °C", modulus="rubber")).loads
    assert softer.expansion is None
    (none,) = warmed(Temperature("base", "60 °C", expansion=0.0)).loads
    assert none.growth == 0.0


def test_jobs_state_it_and_lock_files_bring_it_back(tmp_path):
    file = tmp_path / "tube.toml"
    file.write_text(JOB, encoding="utf-8")
    job = read_job(file)
    assert job.materials["body"].expansion == pytest.approx(3.1e-4)
    again = tmp_path / "again.toml"
    again.write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(again).materials == job.materials
    assert read_job(again).loads == job.loads
    assert Temperature("body", "60 °C", expansion=3.1e-4) in job.loads


def test_a_job_without_it_is_refused_at_its_line(tmp_path):
    file = tmp_path / "tube.toml"
    file.write_text(JOB.replace(', expansion = "310 ppm/K"', ""), encoding="utf-8")
    with refused("tube.toml", "loads.temperature", "'body'", "expansion"):
        read_job(file)


def test_an_expansion_needs_a_number():
    with refused("expansion", "'warm'"):
        tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=5e4), expansion="warm")
