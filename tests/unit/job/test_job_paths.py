"""Procedures of job files that go past limit points: what is read, refused, checked, locked and told."""

import pytest

from refused import refused
from turgor.core.model.loads import Gravity, Pressure
from turgor.core.solvers.procedures.arc_length import ArcLength
from turgor.core.solvers.procedures.auto import Auto
from turgor.core.solvers.procedures.gas_mass import GasMass
from turgor.core.solvers.procedures.volume_control import VolumeControl
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.job.run import run_job
from turgor.job.text.problems import JobError
from turgor.units import kPa, mL, mm
from turgor.views.report.describe_procedure import fields_of

TUBE = """
[actuator]
type = "extending_cylinder"
length = "40 mm"

[mesh]
size = "8 mm"

[materials]
body = { library = "elastosil-m4601", record = "neo-hooke-polygerinos-2020", density = "1130 kg/m³" }
"""
TWO = """
[actuator]
type = "bidirectional_bender"

[mesh]
size = "6 mm"

[materials]
body = { library = "elastosil-m4601", record = "neo-hooke-polygerinos-2020" }
strain_limiting_layer = { library = "paper", record = "hooke-polygerinos-2020", thickness = "0.1 mm" }
"""


def write(tmp_path, text):
    path = tmp_path / "job.toml"
    path.write_text(text, encoding="utf-8")
    return path


def job(tmp_path, *parts):
    return read_job(write(tmp_path, "\n".join(parts)))


CASES = [  # tables, procedure, loads
    ('[procedure]\ntype = "volume_control"\nvolume = "5 mL"\nat = [0.5]', VolumeControl(volume=5 * mL, at=(0.5,)), ()),
    (
        '[loads]\ngravity = "+x"\n[procedure]\ntype = "gas_mass"\nmass_ratio = 2\npressure = "5 kPa"\nseal = 0.3',
        GasMass(mass_ratio=2.0, pressure=5 * kPa, seal=0.3),
        (Gravity((1.0, 0.0, 0.0)),),
    ),
    (
        '[loads]\npressure = "60 kPa"\n[procedure]\ntype = "arc_length"\nmax_displacement = "12 mm"\nat = ["30 kPa"]',
        ArcLength(max_displacement=12 * mm, at=(0.5,)),
        (Pressure("cavity", 60 * kPa),),
    ),
    (
        '[loads]\npressure = "60 kPa"\n[procedure]\ntype = "auto"\npast = 4.0',
        Auto(past=4.0),
        (Pressure("cavity", 60 * kPa),),
    ),
]


@pytest.mark.parametrize(("tables", "procedure", "loads"), CASES)
def test_a_procedure_is_read_and_its_lock_file_reads_back_the_same(tmp_path, tables, procedure, loads):
    read = job(tmp_path, TUBE, tables)
    assert read.procedure == procedure
    assert read.loads == loads
    again = read_job(write(tmp_path, lock_text(read, {})))
    assert again.procedure == procedure
    assert again.loads == loads


def test_each_cavity_has_its_own_amount(tmp_path):
    tables = '[procedure]\ntype = "volume_control"\nvolume = { cavity_1 = "1 mL", cavity_2 = "-0.5 mL" }'
    read = job(tmp_path, TWO, tables)
    assert read.procedure == VolumeControl(volume={"cavity_1": 1 * mL, "cavity_2": -0.5 * mL})
    assert read_job(write(tmp_path, lock_text(read, {}))).procedure == read.procedure
    assert dict(fields_of(read.procedure))["volume"] == "cavity_1 1 mL, cavity_2 -0.5 mL"


@pytest.mark.parametrize(
    ("lines", "facts"),
    [
        ('type = "volume_control"', ["procedure.volume", "'volume'", "missing"]),
        ('type = "volume_control"\nvolume = 5', ["procedure.volume", 5, "'12 mL'"]),
        ('type = "volume_control"\nvolume = "5 kPa"', ["procedure.volume", "'5 kPa'", "a volume"]),
        ('type = "volume_control"\nvolume = { cavity = "5" }', ["procedure.volume", "'5'", "'12 mL'"]),
        ('type = "volume_control"\nvolume = "0 mL"', ["procedure.volume", "0 m³", "zero"]),
        ('type = "gas_mass"\nmass_ratio = "2"', ["procedure.mass_ratio", "'2'"]),
        ('type = "gas_mass"\nexponent = 3.0', ["procedure.exponent", 3, "1 to 1.7"]),
        ('type = "arc_length"', ["[loads]", "missing"]),
        ('type = "volume"\nvolume = "5 mL"', ["procedure.type", "'volume'", "'volume_control'"]),
    ],
)
def test_what_is_wrong_is_said_in_one_sentence(tmp_path, lines, facts):
    with refused(*facts, error=JobError):
        job(tmp_path, TUBE, f"[procedure]\n{lines}")


def test_a_cavity_that_cannot_be_driven_is_refused_before_anything_is_solved(tmp_path):
    tables = '[procedure]\ntype = "volume_control"\nvolume = "1 mL"'
    with refused("procedure.volume", "cavity_1, cavity_2"):
        prepare(job(tmp_path, TWO, tables))
    with refused("cavity", "pressure load", "procedure.volume"):
        prepare(job(tmp_path, TUBE, '[loads]\npressure = "1 kPa"', tables))


def test_a_run_writes_the_pressure_that_it_found(tmp_path):
    tables = '[procedure]\ntype = "volume_control"\nvolume = "1 mL"\nmax_step = 1.0\n[output]\npictures = false'
    outcome = run_job(job(tmp_path, TUBE, tables), tmp_path / "out", threads=1)
    head, *rows = (tmp_path / "out" / "response.csv").read_text(encoding="utf-8").splitlines()
    assert head.startswith("load_factor,pressure_kPa,pressure_mesh_error_kPa,injected_volume_mL,")
    _, pressure, _, volume, *_ = map(float, rows[-1].split(","))
    assert volume == pytest.approx(1.0)
    assert pressure == pytest.approx(outcome.solution.states[-1].pressures["cavity"] / kPa)
    report = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "an injected volume of 1 mL" in report
    assert "injected volume" in report
