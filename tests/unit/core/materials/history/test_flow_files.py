"""Bergström and Boyce's network and permanent set in files: records, jobs, lock files, words and Abaqus."""

from dataclasses import replace

import pytest

import turgor as tg
from refused import refused
from turgor.core.inp.materials import material_lines
from turgor.core.materials.fitting.save import save_material
from turgor.core.materials.history.softening import Mullins
from turgor.core.materials.library.record_text import describe_material
from turgor.core.materials.library.records import from_library
from turgor.job.output.lock import lock_text

FLOWING = tg.laws.BergstromBoyce(stiffness=1.6, rate=0.125, stress=150e3, exponent=4.0, strain_exponent=-0.7)
SETTING = tg.laws.PermanentSet(stress=9876.5e3, exponent=1.7, onset=12e3)
RUBBER = tg.Material(
    name="ours", law=tg.laws.NeoHooke(C10=1e5), bulk_modulus=2e6, viscoelasticity=FLOWING, permanent_set=SETTING
)
JOB = """\
name = "finger"

[actuator]
type = "fast_pneunet"
chambers = 2

[materials.body]
law = "neo_hooke"
C10 = "0.1 MPa"
viscoelasticity = { stiffness = 1.6, rate = "0.125 1/s", stress = "150 kPa", exponent = 4, strain_exponent = -0.7 }
permanent_set = { stress = "9.8765 MPa", exponent = 1.7, onset = "12 kPa" }

[materials.base]
library = "elastosil-m4601"
record = "yeoh-mosadegh-2014"
permanent_set = { stress = "5 MPa", exponent = 2 }

[materials.strain_limiting_layer]
library = "paper"
record = "hooke-yang-2020"
thickness = "0.1 mm"

[mesh]
size = "4 mm"

[loads]
pressure = "3 kPa"
"""


@pytest.fixture
def write(tmp_path):
    def write(text, name="job.toml"):
        (tmp_path / name).write_text(text, encoding="utf-8")
        return tmp_path / name

    return write


def test_a_material_is_saved_read_and_described(tmp_path):
    file = tmp_path / "ours.toml"
    save_material(file, RUBBER, "may")
    again = from_library(str(file), record="may")
    assert (again.viscoelasticity, again.permanent_set) == (FLOWING, SETTING)
    text = describe_material(str(file))
    assert "viscoelasticity: Bergström and Boyce: stiffness = 1.6, rate = 0.125 1/s, stress = 150 kPa" in text
    assert "permanent set: stress = 9876 kPa, exponent = 1.7, onset = 12 kPa" in text


def test_a_job_states_both_and_its_lock_file_repeats_them(write):
    job = tg.jobs.read_job(write(JOB))
    body, base = job.materials["body"], job.materials["base"]
    assert (body.viscoelasticity, body.permanent_set) == (FLOWING, SETTING)
    assert base.permanent_set == tg.laws.PermanentSet(stress=5e6, exponent=2.0)
    again = tg.jobs.read_job(write(lock_text(job, {"turgor": "0.0"}), "lock.toml"))
    assert again.materials == job.materials


@pytest.mark.parametrize(
    ("old", "new", "facts"),
    [
        ("exponent = 4", "exponnent = 4", ("job.toml:10", "viscoelasticity", "exponnent", "exponent")),
        ("viscoelasticity = { stiffness = 1.6,", "viscoelasticity = { stifness = 1.6 } #", ("stifness", "stiffness")),
        (", exponent = 4", "", ("viscoelasticity", "'exponent'", "missing")),
        ("exponent = 4", "exponent = 4, g = [0.1]", ("viscoelasticity", "unknown key 'g'", "strain_exponent")),
        ('"0.125 1/s"', '"0.125 s"', ("viscoelasticity.rate", "0.125 s", "rate")),
        ('"0.125 1/s"', "0.125", ("viscoelasticity.rate", 0.125)),
        ("stiffness = 1.6", "stiffness = -1.6", ("viscoelasticity", "stiffness is -1.6", "more than 0")),
        ("onset =", "onsett =", ("job.toml:11", "permanent_set", "onsett", "onset")),
        ("exponent = 1.7", "exponent = 0.7", ("permanent_set", "exponent is 0.7", "1 or more")),
        ("permanent_set", "permanent_sett", ("permanent_sett", "permanent_set")),
    ],
)
def test_mistakes_are_named_with_their_line(write, old, new, facts):
    assert old in JOB
    with refused(*facts):
        tg.jobs.read_job(write(JOB.replace(old, new, 1)))


def test_abaqus_gets_either_and_calculix_refuses_both():
    flowing = replace(RUBBER, permanent_set=None)
    A = 0.125 / 0.15**4
    assert material_lines("body", flowing, "abaqus")[1:] == [
        "*HYPERELASTIC, NEO HOOKE, MODULI=LONG TERM",
        "0.1, 1",
        "*HYSTERESIS",
        f"1.6, {A:.15g}, 4, -0.7, 0.01",
    ]
    softening = Mullins(r=1.4, m=20e3)
    setting = replace(RUBBER, viscoelasticity=None, stress_softening=softening)
    lines = material_lines("body", setting, "abaqus")
    assert lines[1:5] == ["*HYPERELASTIC, NEO HOOKE", "0.1, 1", "*PLASTIC, HARDENING=ISOTROPIC", "0.012, 0"]
    assert lines[-2:] == ["*MULLINS EFFECT", "1.4, 0.02, 0"]
    table = [[float(number) for number in line.split(",")] for line in lines[5:-2]]
    assert [strain for _, strain in table] == sorted(strain for _, strain in table) and table[-1][1] == 1.0
    for stress, strain in table:
        assert ((stress * 1e6 - SETTING.onset) / SETTING.stress) ** SETTING.exponent == pytest.approx(strain, rel=1e-3)
    with refused("materials.body", "'ours'", "Bergström", "permanent_set"):
        material_lines("body", RUBBER, "abaqus")
    with refused("materials.body", "Bergström", "stress_softening"):
        material_lines("body", replace(flowing, stress_softening=softening), "abaqus")
    for material in (flowing, replace(RUBBER, viscoelasticity=None)):
        with refused("materials.body", "CalculiX", "permanent set"):
            material_lines("body", material, "calculix")
