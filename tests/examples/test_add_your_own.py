"""A law, an actuator and a measure from outside the package, in one file, go through every door."""

import runpy
from pathlib import Path

import pytest

import turgor.geometry.actuators
import turgor.materials.laws.energies
import turgor.results.measures
from turgor.job.job import ACTUATORS
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job
from turgor.job.run import prepare
from turgor.materials.laws.laws import LAWS
from turgor.results.measures.measures import MEASURES

ROOT = Path(__file__).parents[2]

LAW = """
from dataclasses import dataclass, field

import sympy

@dataclass(frozen=True, kw_only=True)
class Demiray:
    mu: float
    b: float = field(metadata={"dimension": "number"})

    def energy(self, I1, I2):
        return self.mu / (2 * self.b) * (sympy.exp(self.b * (I1 - 3)) - 1)

    @property
    def shear_modulus(self):
        return self.mu
"""

ACTUATOR = """
from dataclasses import dataclass

from turgor.geometry.actuators.extending_cylinder import ExtendingCylinder

@dataclass(frozen=True, kw_only=True)
class Bladder:
    length: float = 0.02

    def build(self):
        return ExtendingCylinder(length=self.length).build()
"""

MEASURE = """
from turgor.results.measures.reading import Measure

rise = Measure(name="rise", unit="mm", function=lambda at: at.displacement[:, 2].max(), definition="largest rise")
"""

JOB = """
[actuator]
type = "bladder"
length = "25 mm"

[mesh]
size = "8 mm"

[materials]
body = { law = "demiray", mu = "0.2 MPa", b = 3.0 }

[loads]
pressure = "1 kPa"

[output]
measures = ["rise"]
"""


def test_own_parts_need_no_change_in_the_package():
    found = runpy.run_path(str(ROOT / "examples" / "add_your_own.py"))
    assert found["risen"]["Exponential"] == pytest.approx(3.20, rel=0.02)
    # a law whose exponent is tiny is the neo-Hookean one
    law = found["Exponential"](mu=0.2e6, b=1e-6)
    assert float(law.energy(4.0, 4.0)) == pytest.approx(0.1e6, rel=1e-5)


def test_a_file_in_the_folder_of_its_kind_gives_a_name_in_job_files(tmp_path, monkeypatch):
    kinds = (
        (turgor.materials.laws.energies, LAWS, "demiray", LAW),
        (turgor.geometry.actuators, ACTUATORS, "bladder", ACTUATOR),
        (turgor.results.measures, MEASURES, "rise", MEASURE),
    )
    for package, registry, name, text in kinds:
        assert name not in registry
        folder = tmp_path / name
        folder.mkdir()
        (folder / f"{name}.py").write_text(text, encoding="utf-8")
        monkeypatch.setattr(package, "__path__", [*package.__path__, str(folder)])
        assert name in registry
    (tmp_path / "job.toml").write_text(JOB, encoding="utf-8")
    job = read_job(tmp_path / "job.toml")
    assert (type(job.actuator).__name__, job.actuator.length) == ("Bladder", 0.025)
    assert (job.materials["body"].law.mu, job.materials["body"].law.b) == (0.2e6, 3.0)
    (tmp_path / "lock.toml").write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(tmp_path / "lock.toml").materials["body"].law == job.materials["body"].law
    model, _ = prepare(job)
    assert model.materials["body"].law == job.materials["body"].law
    monkeypatch.undo()
    assert all(name not in registry for _, registry, name, _ in kinds)


def test_two_files_of_one_name_are_refused(tmp_path, monkeypatch):
    (tmp_path / "other.py").write_text(MEASURE.replace('"rise"', '"reaction"'), encoding="utf-8")
    package = turgor.results.measures
    monkeypatch.setattr(package, "__path__", [*package.__path__, str(tmp_path)])
    with pytest.raises(ValueError, match=r"two files of turgor\.results\.measures define 'reaction'"):
        list(MEASURES)
