"""Foundations: read, written back, what they leave free, and what is refused."""

from pathlib import Path

import pytest
from lattice_cases import KINDS, lattice

import turgor as tg
from refused import refused
from turgor.core.inp.write_inp import write_inp
from turgor.core.solvers.checks.supports import free_motions
from turgor.foundation.errors import CheckError
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.05e6))
JOB = """
[actuator]
type = "extending_cylinder"
length = "20 mm"

[mesh]
size = "5 mm"

[materials]
body = {{ law = "neo_hooke", C10 = "0.12 MPa" }}

[loads]
pressure = "5 kPa"

[supports]
{support}
"""


@pytest.mark.parametrize(("bed", "free"), [((1e3, 0.0), 3), ((0.0, 1e3), 3), ((1e3, 1e3), 0)])
def test_springs_prevent_the_motions_that_they_resist(bed: tuple[float, float], free: int) -> None:
    mesh = lattice((2, 1, 1), KINDS["hex"])
    model = tg.Model(mesh, RUBBER, [tg.supports.Foundation("x0", *bed)], [tg.Pressure("x1", 1.0)])
    assert free_motions(model) == free
    if free:
        with refused(f"{free} of 6", "B01", error=CheckError):
            tg.solve(model)


def test_a_job_beds_a_face_and_a_lock_file_says_so(tmp_path: Path) -> None:
    file = tmp_path / "bed.toml"
    bed = 'fixed = { normal_stiffness = "20 kPa/mm", tangential_stiffness = "1e-3 N/mm³" }'
    file.write_text(JOB.format(support=bed), encoding="utf-8")
    job = read_job(file)
    assert job.supports == (tg.supports.Foundation("fixed", 20e6, 1e6),)
    assert job.supports[0].text() == "fixed is bedded on springs of 20 kPa/mm along its normal and 1 kPa/mm across it."
    again = tmp_path / "again.toml"
    again.write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(again).supports == job.supports


@pytest.mark.parametrize(
    ("support", "facts"),
    [
        ('fixed = { normal_stifness = "1 kPa/mm" }', ("supports.fixed", "'normal_stiffness'")),
        ('fixd = { normal_stiffness = "1 kPa/mm" }', ("supports.fixd", "'fixed'")),
        ('fixed = { normal_stiffness = "1 kPa" }', ("supports.fixed.normal_stiffness", "kPa")),
        ('fixed = { normal_stiffness = "-1 kPa/mm" }', ("supports.fixed", "-1e+06", "0 or more")),
        ('fixed = { normal_stiffness = "1 kPa/mm", directions = "x" }', ("supports.fixed", "directions")),
    ],
)
def test_foundations_that_cannot_be(tmp_path: Path, support: str, facts: tuple[str, ...]) -> None:
    file = tmp_path / "bed.toml"
    file.write_text(JOB.format(support=support), encoding="utf-8")
    with refused(*facts):
        read_job(file)


def test_files_of_other_programs_and_reduced_models_have_none(tmp_path: Path) -> None:
    mesh = lattice((2, 1, 1), KINDS["hex"])
    model = tg.Model(mesh, RUBBER, ["x1", tg.supports.Foundation("x0", 1e3)], [])
    with refused("Foundation(x0)", ".inp"):
        write_inp(model, tmp_path / "bed.inp", program="abaqus")
    with refused("'x0'", "normal", "0 Pa/m"):
        tg.supports.Foundation("x0")
