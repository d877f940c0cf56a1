"""A load of one's own: one file serves Python, job files, half models, stages, reports, measures and .inp files."""

import numpy as np
import pytest

import turgor as tg
import turgor.core.model.loads
from class_queries import files_that_query
from refused import refused
from turgor.core.inp.write_inp import write_inp
from turgor.core.model.continued_model import continued
from turgor.core.model.loads import BodyForce
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.job.text.listed_loads import LOADS
from turgor.views.report import describe

SPIN = '''
from dataclasses import dataclass, field

import numpy as np

from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.loads.load import DeckRows, Load
from turgor.foundation.given import number, vector


@dataclass(frozen=True, slots=True)
class Spin(Load):
    """Centrifugal force on the shape at rest, which turns about an axis through the origin.

    Parameters
    ----------
    speed : float [1/s]
        Angular speed.
    axis : (3,) floats
        Direction of the axis; any length but zero.
    """

    speed: float = field(metadata={"dimension": "rate"})
    axis: tuple[float, float, float] = (0.0, 0.0, 1.0)
    history: History = RAMP

    job_key = "spins"
    needs_density = True

    def __post_init__(self):
        object.__setattr__(self, "speed", number(self.speed, "spin: speed", "rate"))
        object.__setattr__(self, "axis", vector(self.axis, "spin: axis"))
        object.__setattr__(self, "history", checked(self.history, "spin"))

    @property
    def words(self):
        return f"Centrifugal force at {self.speed:g} rad/s about {self.axis}"

    def mirrored(self, axis):
        return not self.axis[axis] or self.turned(axis)

    def turned(self, axis):
        return not any(self.axis[across] for across in range(3) if across != axis)

    def dead_forces(self, nodal):
        along = np.array(self.axis) / np.linalg.norm(self.axis)
        return nodal.per_mass(lambda points: self.speed**2 * (points - np.outer(points @ along, along)))

    def deck_rows(self, deck):
        axis = ", ".join(f"{part:g}" for part in self.axis)
        return (DeckRows("*DLOAD", self.history, (f"Eall, CENTRIF, {self.speed**2:.12g}, 0, 0, 0, {axis}",)),)
'''

JOB = """\
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "5 mm"
cells = "hexahedra"

[materials]
body = { law = "neo_hooke", C10 = "0.1 MPa", density = "1000 kg/m³" }
base = { law = "neo_hooke", C10 = "0.1 MPa", density = "1000 kg/m³" }

[[loads.spins]]
speed = "60 1/s"
history = [[0, 0], [0.5, 1], [1, 1]]
"""


@pytest.fixture
def spin(tmp_path, monkeypatch):
    folder = tmp_path / "own"
    folder.mkdir()
    (folder / "spin.py").write_text(SPIN, encoding="utf-8")
    package = turgor.core.model.loads
    assert "spin" not in LOADS
    monkeypatch.setattr(package, "__path__", [*package.__path__, str(folder)])
    return LOADS["spin"]


def read(folder, text=JOB):
    (folder / "spun.toml").write_text(text, encoding="utf-8")
    return read_job(folder / "spun.toml")


def test_a_job_file_states_it_and_the_lock_file_gives_it_back(spin, tmp_path):
    job = read(tmp_path)
    assert job.loads == (spin(60.0, history=[(0, 0), (0.5, 1), (1, 1)]),)
    (tmp_path / "lock.toml").write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(tmp_path / "lock.toml") == job
    for wrong, facts in (
        (JOB.replace("60 1/s", "60 mm"), ("loads.spins.speed", "'60 mm'", "length", "rate")),
        (JOB.replace("speed", "sped"), ("loads.spins.sped", "'sped'", "'speed'")),
        (JOB.replace(', density = "1000 kg/m³"', ""), ("materials.body", "materials.base", "density", "spin")),
        (JOB + "axis = [0, 1, 1]", ("loads.spins", "mirror image", "actuator.symmetric = false")),
    ):
        with refused(*facts):
            read(tmp_path, wrong)


def test_its_half_model_is_solved_as_the_whole(spin, tmp_path):
    half, _ = prepare(read(tmp_path))
    whole, _ = prepare(read(tmp_path, JOB.replace("chambers = 1", "chambers = 1\nsymmetric = false")))
    parts = [tg.solve(each, tg.Static(at=(1.0,))) for each in (half, whole)]
    fields = [tg.measure(each, "tip_displacement", "outside_work") for each in parts]
    for name in ("tip_displacement", "outside_work"):
        assert fields[0].column(name)[-1] == pytest.approx(fields[1].column(name)[-1], rel=5e-4)  # two meshes
    assert fields[0].column("tip_displacement")[-1] > 4e-6
    assert fields[0].column("outside_work")[-1] < 0  # it works on the actuator
    stated = BodyForce(lambda points: 1000.0 * 60.0**2 * points * (1, 1, 0), half.loads[0].history)
    by_function = tg.solve(tg.Model(half.mesh, half.materials, half.supports, [stated]), tg.Static(at=(1.0,)))
    moved = parts[0].states[-1].displacement
    assert by_function.states[-1].displacement == pytest.approx(moved, abs=1e-9 * np.abs(moved).max())
    with refused("spin", "'symmetry_y'", "normal to y", "symmetric"):
        tg.Model(half.mesh, half.materials, half.supports, [spin(60.0, (0, 1, 1))])


def test_stages_reports_and_other_programs_have_it(spin, tmp_path):
    model, _ = prepare(read(tmp_path))
    assert describe.loads(model) == [
        "Centrifugal force at 60 rad/s about (0.0, 0.0, 1.0), its share over the load factor: 0 at 0, 1 at 0.5, 1 at 1."
    ]
    assert "Spin" in repr(model)
    old, new = continued(model, (1.0, {}), [spin(10.0)]).loads
    assert [(load.speed, load.share(0.0), load.share(1.0)) for load in (old, new)] == [(60, 1, 0), (10, 0, 1)]
    (still,) = continued(model, (0.25, {}), []).loads
    assert (still.share(0.0), still.share(1.0)) == (0.5, 0.5)
    write_inp(model, tmp_path / "spun.inp", program="abaqus")
    assert "*DLOAD, AMPLITUDE=history_1\nEall, CENTRIF, 3600, 0, 0, 0, 0, 0, 1\n" in (tmp_path / "spun.inp").read_text()


def test_few_files_ask_for_classes_of_loads():
    classes = {kind.__name__ for kind in LOADS.values()}
    querying = files_that_query(classes)
    assert len(classes) == 21
    assert len(querying) <= 8, querying
