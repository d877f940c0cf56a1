"""Bonds in job files: what they become, their way through a lock file, every mistake with its key."""

import pytest

from refused import refused
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job
from turgor.job.section import section_of

TEXT = """
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[materials]
body = {{ law = "neo_hooke", C10 = "50 kPa" }}
base = {{ law = "neo_hooke", C10 = "50 kPa" }}

[bonds.glue]
between = ["body", "{other}"]
peel_strength = "{strength}"
energy_peel = "{energy}"
{more}

[loads]
pressure = "10 kPa"
"""


def job_with(tmp_path, other="base", strength="60 kPa", energy="200 J/m²", more=""):
    file = tmp_path / "glued.toml"
    file.write_text(TEXT.format(other=other, strength=strength, energy=energy, more=more), encoding="utf-8")
    return read_job(file)


def test_a_bond_is_read_and_repeated_by_the_lock_file(tmp_path):
    more = 'energy_shear = "0.4 N/mm"\nstiffness = "50 MPa/mm"\nmixed_mode = "power"\nunbonded = { x_from = "8 mm" }'
    job = job_with(tmp_path, more=more)
    bond = job.bonds["glue"]
    assert (bond.between, bond.peel_strength, bond.energy_peel) == (("body", "base"), 60e3, 200.0)
    assert (bond.shear, bond.stiffness, bond.mixed_mode) == ((60e3, 400.0), 50e9, "power")
    assert bond.unbonded[0][0] == pytest.approx(8e-3)
    lock = tmp_path / "again.toml"
    lock.write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(lock).bonds == job.bonds


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"other": "bse"}, ("glued.toml:12", "bonds.glue.between", "bse", "base")),
        ({"other": "body"}, ("bonds.glue.between", "body")),
        ({"strength": "60 mm"}, ("bonds.glue.peel_strength",)),
        ({"energy": "200"}, ("bonds.glue.energy_peel", "J/m²")),
        ({"more": 'stiffness = "1 kPa/mm"'}, ("bonds.glue.stiffness", "9e+06 Pa/m")),
        ({"more": "exponent = 0.2"}, ("bonds.glue.exponent", "0.2", "1 to 10")),
        ({"more": 'shear_strenght = "1 kPa"'}, ("shear_strength",)),
    ],
)
def test_mistakes_name_their_key(tmp_path, changed, said):
    with refused(*said):
        job_with(tmp_path, **changed)


def test_a_bond_without_a_name_is_refused(tmp_path):
    with refused("bonds.between", "[bonds.glue]"):
        read_job(_without_name(tmp_path))


def _without_name(tmp_path):
    job_with(tmp_path)
    file = tmp_path / "glued.toml"
    file.write_text(file.read_text(encoding="utf-8").replace("[bonds.glue]", "[bonds]"), encoding="utf-8")
    return file


def test_a_section_has_no_bonds(tmp_path):
    with refused("bonds.glue"):
        section_of(job_with(tmp_path))
