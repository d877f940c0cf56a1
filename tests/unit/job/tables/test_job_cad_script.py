"""A job whose part a script draws: dimensions are numbers of the job, for lock files, studies and gradients."""

import tomllib
from types import SimpleNamespace

import pytest

import turgor as tg
from refused import refused
from turgor.job.output.identity import digest_of
from turgor.job.output.lock import lock_text
from turgor.job.text.problems import JobError
from turgor.studies.runs.jobs.job_gradients import gradient_of_job
from turgor.studies.runs.jobs.job_numbers import numbers_of
from turgor.studies.study_file.job_sweep import _copy_files
from turgor.units import mm

SCRIPT = """
from typing import Annotated

from netgen.occ import Cylinder, Pnt, X


def build(wall: Annotated[float, "mm", (0.5, 4)] = 2, length=20.0, ends: int = 2):
    outer = Cylinder(Pnt(0, 0, 0), X, 6, length)
    return outer - Cylinder(Pnt(wall, 0, 0), X, 6 - wall, length - ends * wall)
"""

JOB = """
[actuator]
type = "cad_file"
file = "tube.py"
symmetry = "automatic"

[actuator.dimensions]
wall = "2.5 mm"
length = "18 mm"

[actuator.faces]
fixed = { normal = "-x" }
tip = { normal = "+x" }

[mesh]
size = "6 mm"

[materials]
body = { law = "neo_hooke", C10 = "0.1 MPa" }

[loads]
pressure = "1 Pa"

[output]
measures = ["cavity_volume"]
"""


@pytest.fixture
def job_file(tmp_path):
    (tmp_path / "tube.py").write_text(SCRIPT)
    file = tmp_path / "job.toml"
    file.write_text(JOB)
    return file


def test_a_lock_file_states_all_dimensions_and_repeats_the_job(job_file, tmp_path):
    job = tg.jobs.read_job(job_file)
    table = tomllib.loads(lock_text(job, {}))["actuator"]
    assert table["dimensions"] == {"wall": "2.5 mm", "length": "18 mm", "ends": 2}
    numbers = numbers_of({"actuator": table})
    assert numbers["actuator.dimensions.wall"].value == pytest.approx(2.5 * mm)
    assert numbers["actuator.dimensions.ends"].whole
    again = tmp_path / "again.toml"
    again.write_text(lock_text(job, {}))
    assert digest_of(tg.jobs.read_job(again)) == digest_of(job)
    other = tg.jobs.read_job(job_file, {"actuator.dimensions.wall": "2 mm"})
    assert digest_of(other) != digest_of(job)


def test_the_cavity_changes_with_a_dimension_as_its_formula_does(job_file):
    """dV/dw of π (6 - w)² (L - 2 w), at a load that changes nothing; the facets of a coarse mesh cost a few percent."""
    gradient = gradient_of_job(tg.jobs.read_job(job_file), ["actuator.dimensions.wall"], ["cavity_volume"])
    wall, length = 2.5, 18.0
    exact = -2 * 3.14159265 * ((6 - wall) * (length - 2 * wall) + (6 - wall) ** 2)
    assert float(gradient.values[0][0]) / mm**2 == pytest.approx(exact, rel=0.03)


def test_a_dimension_is_refused_at_its_key(job_file):
    for text, facts in (
        ('wall = "5 mm"', ("job.toml:8", "actuator.dimensions.wall", "5 mm", "0.5 mm to 4 mm")),
        ('walls = "2 mm"', ("job.toml:8", "actuator.dimensions.walls", "'wall'")),
        ("wall = [1, 2]", ("job.toml:8", "actuator.dimensions.wall", "[1, 2]")),
    ):
        job_file.write_text(JOB.replace('wall = "2.5 mm"', text))
        with refused(*facts, error=JobError):
            tg.jobs.read_job(job_file)
    job_file.write_text(JOB.replace('file = "tube.py"', 'file = "tube.py"\nfunction = "bulid"'))
    with refused("job.toml:5", "actuator.function", "'bulid'", "'build'", error=JobError):
        tg.jobs.read_job(job_file)


def test_a_sweep_copies_scripts_with_their_modules(job_file, tmp_path):
    (tmp_path / "sizes.py").write_text("WALL = 1\n")
    (tmp_path / "other.py").write_text("import sizes\n" + SCRIPT)
    study = SimpleNamespace(folder=tmp_path)
    designs = SimpleNamespace(values=[{"actuator.file": "tube.py"}, {"actuator.file": "other.py"}])
    _copy_files(study, designs, tmp_path / "results")
    assert sorted(each.name for each in (tmp_path / "results").iterdir()) == ["other.py", "sizes.py", "tube.py"]
