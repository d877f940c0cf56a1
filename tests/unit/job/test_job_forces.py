"""Forces in a job file: read, refused with a sentence, written into the lock file, and solved."""

import numpy as np
import pytest
from turgor.loads import Force

import turgor as tg
from refused import refused
from turgor.core.model.history import RAMP
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job

TEXT = """\
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "5 mm"
cells = "hexahedra"

[materials]
body = { law = "neo_hooke", C10 = "0.1 MPa", density = "1070 kg/m³" }
base = { law = "neo_hooke", C10 = "0.1 MPa", density = "1070 kg/m³" }

[loads]
pressure = "1 kPa"
"""


def read(tmp_path, more):
    file = tmp_path / "finger.toml"
    file.write_text(TEXT + more, encoding="utf-8")
    return read_job(file)


def forces(job):
    return [load for load in job.loads if isinstance(load, Force)]


@pytest.mark.parametrize(
    ("more", "vector", "history"),
    [
        ('[loads.tip]\nforce = [0, 0, "-0.5 N"]\n', (0, 0, -0.5), RAMP),
        (
            '[loads.tip]\nforce = ["20 mN", 0, 0]\nhistory = [[0, 0], [0.5, 1], [1, 1]]\n',
            (0.02, 0, 0),
            ((0, 0), (0.5, 1), (1, 1)),
        ),
        ('[loads.tip]\nhangs = "50 g"\n', (0, 0, -0.05 * 9.80665), RAMP),
        ('gravity = "+x"\n[loads.tip]\nhangs = "50 g"\n', (0.05 * 9.80665, 0, 0), RAMP),
    ],
)
def test_forces_are_read_and_come_back(tmp_path, more, vector, history):
    job = read(tmp_path, more)
    (force,) = forces(job)
    assert (force.face, force.vector) == ("tip", pytest.approx(vector))
    assert force.history == history
    lock = tmp_path / "job.lock.toml"
    lock.write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(lock) == job


@pytest.mark.parametrize(
    ("more", "facts"),
    [
        ('[loads.tipp]\nforce = [0, 0, "-0.5 N"]\n', ["loads.tipp", "'tipp'", "'tip'"]),
        ('[loads.tip]\nforce = [0, 0, "-0.5 kPa"]\n', ["loads.tip.force", "'-0.5 kPa'", "a force", "N, mN, kN"]),
        ('[loads.tip]\nforce = [0, "-0.5 N"]\n', ["loads.tip.force", "[0, '-0.5 N']", "three"]),
        ('[loads.tip]\nforce = [0, "0.1 N", 0]\n', ["loads.tip", "half model", "normal to y", "actuator.symmetric"]),
        ('[loads.tip]\nhangs = "50 g"\nforce = [0, 0, "1 N"]\n', ["loads.tip", "force", "hangs"]),
        ('[loads.tip]\nhangs = "-50 g"\n', ["loads.tip.hangs", "'-50 g'", 0]),
        ('[loads.tip]\nhangs = "50 mm"\n', ["loads.tip.hangs", "'50 mm'", "a mass"]),
        ('[loads.cavity]\nforce = [0, 0, "1 N"]\n', ["loads.cavity.force", "'force'"]),
    ],
)
def test_wrong_forces_are_sentences(tmp_path, more, facts):
    with refused("finger.toml", *facts):
        read(tmp_path, more)


def test_what_hangs_from_the_tip_pulls_it_down(tmp_path):
    """The supports carry the weight, of which the modeled half has a half."""
    job = read(tmp_path, '[loads.tip]\nhangs = "20 g"\n')
    model, _ = prepare(job)
    state = tg.solve(model, job.procedure).states[-1]
    carried = state.nodal_force[model.mesh.face_nodes("fixed")].sum(axis=0) * model.mesh.symmetry_factor
    assert carried[2] == pytest.approx(0.02 * 9.80665, rel=1e-3)
    assert np.isfinite(state.displacement).all()
    assert state.displacement[model.mesh.face_nodes("tip"), 2].mean() < 0
