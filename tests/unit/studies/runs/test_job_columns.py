"""Columns of a job that are known before it is computed: they are those that its response has."""

from calibration_cases import JOB
from refused import refused
from turgor.job.read import read_job
from turgor.studies.runs.jobs.columns import unit_of_column
from turgor.studies.runs.jobs.job_function import job_function
from turgor.studies.runs.jobs.job_runs import solved_job

TWO = """
[actuator]
type = "bidirectional_bender"
[materials]
body = { law = "neo_hooke", C10 = "0.12 MPa" }
[loads]
cavity_1 = { pressure = "20 kPa" }
"""


def test_each_column_of_a_response_is_known_with_its_unit(tmp_path):
    volume = '[procedure]\ntype = "volume_control"\nvolume = "0.1 mL"\n'
    (tmp_path / "tube.toml").write_text(JOB.replace('[loads]\npressure = "20 kPa"\n', volume), encoding="utf-8")
    job = read_job(tmp_path / "tube.toml")
    response = solved_job(**job_function(job, tmp_path / "found").values, numbers={}).response
    assert {"load_factor", "pressure", "injected_volume", "cavity_volume"} <= set(response.names)
    assert {each.name: each.unit for each in response.columns} == {
        each: unit_of_column(job, each) for each in response.names
    }


def test_pressures_of_several_cavities_and_their_volumes(tmp_path):
    (tmp_path / "two.toml").write_text(TWO, encoding="utf-8")
    job = read_job(tmp_path / "two.toml")
    assert unit_of_column(job, "cavity_2_pressure") == "kPa"
    assert unit_of_column(job, "cavity_2_volume", ["cavity_volume"]) == "mL"
    with refused("'cavity_2_volume'", "'cavity_2_pressure'"):
        unit_of_column(job, "cavity_2_volume", ["tip_displacement_x"])
    with refused("'cavty_2_pressure'", "'cavity_2_pressure'"):
        unit_of_column(job, "cavty_2_pressure")


def test_energies_are_columns_of_procedures_that_count_them(tmp_path):
    for kind in ("stabilized", "static"):
        (tmp_path / f"{kind}.toml").write_text(f'{TWO}\n[procedure]\ntype = "{kind}"\n', encoding="utf-8")
    assert unit_of_column(read_job(tmp_path / "stabilized.toml"), "missing_energy") == "mJ"
    with refused("missing_energy"):
        unit_of_column(read_job(tmp_path / "static.toml"), "missing_energy")
