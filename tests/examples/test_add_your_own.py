"""A law, an actuator, a measure and a procedure from outside the package, one file each, go through every door."""

import runpy
from pathlib import Path

import numpy as np
import pytest

import turgor.core.geometry.actuators
import turgor.core.materials.laws.energies
import turgor.core.results.measures
import turgor.core.solvers.procedures
from refused import refused
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.fitting.fit_laws import fit
from turgor.core.materials.laws.laws import LAWS
from turgor.core.results.measures.measures import MEASURES
from turgor.job.job import ACTUATORS
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.job.tables.procedures import PROCEDURES, drives

ROOT = Path(__file__).parents[2]

LAW = """
from dataclasses import dataclass, field

import sympy

@dataclass(frozen=True, kw_only=True)
class Demiray:
    mu: float
    b: float = field(metadata={"dimension": "number", "bounds": (0.01, 10.0)})

    def energy(self, I1, I2):
        return self.mu / (2 * self.b) * (sympy.exp(self.b * (I1 - 3)) - 1)

    @property
    def shear_modulus(self):
        return self.mu
"""

ACTUATOR = """
from dataclasses import dataclass

from turgor.core.geometry.actuators.extending_cylinder import ExtendingCylinder

@dataclass(frozen=True, kw_only=True)
class Bladder:
    length: float = 0.02

    def build(self):
        return ExtendingCylinder(length=self.length).build()
"""

MEASURE = """
from turgor.core.results.measures.measure import Measure

rise = Measure(name="rise", unit="mm", function=lambda at: at.displacement[:, 2].max(), definition="largest rise")
"""

PROCEDURE = """
from dataclasses import dataclass, field

from turgor.core.solvers.procedures.volume_control import VolumeControl

@dataclass(frozen=True, slots=True, kw_only=True)
class SlowFilling(VolumeControl):
    max_step: float = 0.05
    pause: float = field(default=1.0, metadata={"dimension": "time"})
"""

JOB = """
[actuator]
type = "bladder"
length = "25 mm"

[mesh]
size = "8 mm"

[materials]
body = { law = "demiray", mu = "0.2 MPa", b = 3.0 }

[procedure]
type = "slow_filling"
volume = "1 mL"
pause = "2 s"

[output]
measures = ["rise"]
"""


def test_own_parts_need_no_change_in_the_package():
    result = runpy.run_path(str(ROOT / "examples" / "add_your_own.py"))
    assert result["risen"]["Exponential"] == pytest.approx(3.20, rel=0.02)
    # a law whose exponent is tiny is the neo-Hookean one
    law = result["Exponential"](mu=0.2e6, b=1e-6)
    assert float(law.energy(4.0, 4.0)) == pytest.approx(0.1e6, rel=1e-5)


def test_a_file_in_the_folder_of_its_kind_gives_a_name_in_job_files(tmp_path, monkeypatch):
    kinds = (
        (turgor.core.materials.laws.energies, LAWS, "demiray", LAW),
        (turgor.core.geometry.actuators, ACTUATORS, "bladder", ACTUATOR),
        (turgor.core.results.measures, MEASURES, "rise", MEASURE),
        (turgor.core.solvers.procedures, PROCEDURES, "slow_filling", PROCEDURE),
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
    assert (job.procedure.volume, job.procedure.pause, job.procedure.max_step) == (pytest.approx(1e-6), 2.0, 0.05)
    (tmp_path / "lock.toml").write_text(lock_text(job, {}), encoding="utf-8")
    again = read_job(tmp_path / "lock.toml")
    assert again.materials["body"].law == job.materials["body"].law
    assert again.procedure == job.procedure
    _fits_by_name(job.materials["body"].law)
    model, _ = prepare(job)
    assert model.materials["body"].law == job.materials["body"].law
    monkeypatch.undo()
    assert all(name not in registry for _, registry, name, _ in kinds)


def _fits_by_name(law):
    stretch = np.linspace(1.1, 3.0, 20)
    blank = MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=stretch, name="strip")
    test = MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=blank.predicted(law), name="strip")
    assert fit("demiray", test, starts=5).values == pytest.approx({"mu": law.mu, "b": law.b}, rel=1e-3)


@pytest.mark.parametrize(
    ("name", "expected"),
    [("volume_control", True), ("gas_mass", True), ("sealed", False), ("static", False), ("dynamic", False)],
)
def test_a_procedure_that_takes_a_value_for_each_cavity_needs_no_load(name, expected):
    assert drives({"type": name}) is expected


@pytest.mark.parametrize("values", [None, {}, {"type": ["static"]}, {"type": "statics"}])
def test_a_wrong_procedure_drives_nothing(values):
    assert drives(values) is False


def test_two_files_of_one_name_are_refused(tmp_path, monkeypatch):
    (tmp_path / "other.py").write_text(MEASURE.replace('"rise"', '"reaction"'), encoding="utf-8")
    package = turgor.core.results.measures
    monkeypatch.setattr(package, "__path__", [*package.__path__, str(tmp_path)])
    with refused("turgor.core.results.measures", "'reaction'", error=ValueError):
        list(MEASURES)
