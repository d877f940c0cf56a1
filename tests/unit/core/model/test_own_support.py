"""A support of one's own: one file serves Python, job files, solving, stages, reports, measures and .inp files."""

import numpy as np
import pytest

import turgor as tg
import turgor.core.model.supports
from class_queries import files_that_query
from refused import refused
from turgor.core.inp.write_inp import write_inp
from turgor.core.model.continued_model import continued
from turgor.core.model.supports.displacement import ContinuedMove
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.job.tables.supports import SUPPORTS
from turgor.units import mm
from turgor.views.report import describe

SLOPE = '''
from dataclasses import dataclass

import numpy as np

from turgor.core.model.supports.support import Support


@dataclass(frozen=True, slots=True)
class Slope(Support):
    """Let a face slide on a slope: no displacement along its normal."""

    face: str
    normal: tuple[float, float, float] = (0.6, 0.0, 0.8)

    job_texts = {"sloping": {}, "steep": {"normal": (0.8, 0.0, 0.6)}}

    def text(self):
        return f"{self.face} slides on a slope with the normal {self.normal}."

    def normals(self, mesh):
        nodes = mesh.face_nodes(self.face)
        return nodes, np.tile(self.normal, (len(nodes), 1))

    def boundary_rows(self, deck):
        return (f"** {deck.name(self.face)} slides",)
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
body = { law = "neo_hooke", C10 = "0.1 MPa", bulk_modulus = "5 MPa" }
base = { law = "neo_hooke", C10 = "0.1 MPa", bulk_modulus = "5 MPa" }

[supports]
fixed = "xyz"
tip = "steep"

[loads]
pressure = "2 kPa"
"""


@pytest.fixture
def slope(tmp_path, monkeypatch):
    folder = tmp_path / "own"
    folder.mkdir()
    (folder / "slope.py").write_text(SLOPE, encoding="utf-8")
    package = turgor.core.model.supports
    assert "slope" not in SUPPORTS
    monkeypatch.setattr(package, "__path__", [*package.__path__, str(folder)])
    return SUPPORTS["slope"]


def read(folder, text=JOB):
    (folder / "own.toml").write_text(text, encoding="utf-8")
    return read_job(folder / "own.toml")


def test_a_job_file_states_it_and_the_lock_file_gives_it_back(slope, tmp_path):
    job = read(tmp_path)
    assert job.supports == (tg.Fixed("fixed"), slope("tip", (0.8, 0.0, 0.6)))
    (tmp_path / "lock.toml").write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(tmp_path / "lock.toml") == job
    with refused("supports.tip", "'hilly'", "'sloping'"):
        read(tmp_path, JOB.replace("steep", "hilly"))
    with refused("tip", "(0.0, 0.0, 1.0)"):
        slope("tip", (0.0, 0.0, 1.0)).job_text()


def test_it_is_solved_reported_measured_and_written(slope, tmp_path):
    model, _ = prepare(read(tmp_path))
    assert describe.supports(model)[:2] == [
        "fixed does not move in x, y, z.",
        "tip slides on a slope with the normal (0.8, 0.0, 0.6).",
    ]
    assert "Slope(tip)" in repr(model)
    solution = tg.solve(model, tg.Static(at=(1.0,)))
    tip = model.mesh.face_nodes("tip")
    moved = solution.states[-1].displacement[tip]
    assert np.abs(moved @ (0.8, 0, 0.6)).max() < 1e-12
    assert np.abs(moved).max() > 1e-5
    alone = tg.solve(tg.Model(model.mesh, model.materials, [tg.Fixed("fixed")], model.loads), tg.Static(at=(1.0,)))
    reactions = [tg.measure(each, "reaction").column("reaction")[-1] for each in (solution, alone)]
    assert reactions[0] == pytest.approx(0.0, abs=1e-9)  # all supports together balance the pressure, which is closed
    assert continued(model, (1.0, {}), []).supports == model.supports
    write_inp(model, tmp_path / "own.inp", program="abaqus")
    assert "fixed, 3\n** tip slides\n" in (tmp_path / "own.inp").read_text()
    with refused("Slope"):
        tg.Section(tg.actuators.ExtendingCylinder(), {"body": model.materials["body"]}, supports=[slope("outside")])


def test_one_that_moves_a_face_needs_no_more(tmp_path):
    from dataclasses import dataclass

    @dataclass(frozen=True, slots=True)
    class Swing(tg.supports.Support):
        face: str
        angle: float

        moves = True

        @property
        def prescribed(self):
            return self.face, "xz"

        def displacement(self, points, load_factor):
            turn = self.angle * load_factor
            x, z = points[:, 0], points[:, 2]
            c, s = np.cos(turn) - 1, np.sin(turn)
            return np.stack([c * x + s * z, 0 * x, c * z - s * x], axis=1)

        def continued(self, factor, new):
            return tg.Displacement(self.face, ContinuedMove(self, factor, new), "xz")

    model, _ = prepare(read(tmp_path, JOB.replace('tip = "steep"\n', "")))
    swing = Swing("tip", 0.02)
    model = tg.Model(model.mesh, model.materials, [tg.Fixed("fixed"), swing], model.loads)
    solution = tg.solve(model, tg.Static(at=(1.0,)))
    tip = model.mesh.face_nodes("tip")
    moved = solution.states[-1].displacement[tip][:, [0, 2]]
    assert moved == pytest.approx(swing.displacement(model.mesh.points[tip], 1.0)[:, [0, 2]], abs=1e-15)
    assert np.abs(moved).max() > 0.1 * mm
    stays = continued(model, (0.5, {}), []).supports[1]
    points = model.mesh.points[tip]
    assert stays.displacement(points, 0.7) == pytest.approx(swing.displacement(points, 0.5), abs=1e-15)
    with refused("Swing(tip)"):
        write_inp(model, tmp_path / "own.inp", program="abaqus")


def test_few_files_ask_for_classes_of_supports():
    classes = {kind.__name__ for kind in SUPPORTS.values()} | {"Shift", "FixedTip"}
    assert len(classes) == 12
    querying = files_that_query(classes, without=("core/model/supports",))
    assert len(querying) <= 2, querying
