"""Quality: the mesh error that is requested chooses the size and the kind of cells where no size is stated."""

import pytest

import turgor as tg
from refused import refused
from turgor.core.meshing.default_settings import chosen_settings
from turgor.core.meshing.generate import mesh_with
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.sizing.default_size import default_size
from turgor.core.meshing.sizing.settings import QUALITIES
from turgor.job.output.lock import lock_text
from turgor.units import mm

JOB = """
[actuator]
type = "extending_cylinder"

[mesh]
# the error that is requested
quality = "{quality}"

[materials]
body = {{ library = "ecoflex-00-30", record = "yeoh-steck-2019" }}

[loads]
pressure = "1 kPa"
"""


@pytest.fixture(scope="module")
def finger():
    return tg.FastPneuNet(chambers=1, length=10 * mm).build()


@pytest.fixture(scope="module")
def joint():
    return tg.actuators.RevoluteJoint().build()  # 48,443 unknowns of hexahedra whose middles follow


def test_each_quality_has_its_error():
    assert {name: each.error for name, each in QUALITIES.items()} == {"draft": 0.1, "normal": 0.02, "fine": 0.005}


def test_normal_is_the_default_mesh(finger):
    assert MeshSettings().quality == "normal"
    assert chosen_settings(finger, MeshSettings(quality="normal")) == chosen_settings(finger, MeshSettings())


def test_a_draft_has_fewer_unknowns_and_a_fine_mesh_more(finger):
    draft, normal, fine = (tg.mesh(finger, quality=name).unknown_count for name in QUALITIES)
    assert draft <= normal
    assert 1.3 * normal < fine < 8 * normal


def test_a_draft_has_tetrahedra_where_hexahedra_are_many(finger, joint):
    cells = {name: chosen_settings(joint, MeshSettings(quality=name)).cells for name in QUALITIES}
    assert cells == {"draft": "tetrahedra", "normal": "hexahedra", "fine": "hexahedra"}
    assert chosen_settings(finger, MeshSettings(quality="draft")).cells == "hexahedra"
    assert tg.mesh(joint, quality="draft").unknown_count < 20_000


def test_a_draft_of_chambers_in_a_row_has_hexahedra_of_twice_the_size():
    finger = tg.FastPneuNet(chambers=5, length=50 * mm, wall=1 * mm, gap=1 * mm).build()
    draft, normal = (chosen_settings(finger, MeshSettings(quality=name)) for name in ("draft", "normal"))
    assert (draft.cells, draft.size) == ("hexahedra", pytest.approx(2 * normal.size))
    made = mesh_with(finger, draft)  # as a lock file states it
    assert made.unknown_count == tg.mesh(finger, quality="draft").unknown_count
    assert made.unknown_count < 0.6 * mesh_with(finger, normal).unknown_count
    assert not made.findings


@pytest.mark.parametrize("cells", ["tetrahedra", "hexahedra"])
def test_the_size_follows_the_quality_for_stated_cells(finger, cells):
    normal = default_size(finger, cells)
    assert default_size(finger, cells, "fine") == pytest.approx(normal / 2, rel=0.06)  # two digits
    assert default_size(finger, cells, "draft") > normal / 1.0001


def test_a_stated_size_comes_first(finger):
    for name in QUALITIES:
        chosen = chosen_settings(finger, MeshSettings(size=2 * mm, quality=name))
        assert (chosen.size, chosen.cells, chosen.quality) == (2 * mm, "tetrahedra", name)


def test_the_lock_file_repeats_the_quality(tmp_path):
    text = JOB.format(quality="fine")
    (tmp_path / "job.toml").write_text(text, encoding="utf-8")
    job = tg.jobs.read_job(tmp_path / "job.toml")
    (tmp_path / "lock.toml").write_text(lock_text(job, {}), encoding="utf-8")
    again = tg.jobs.read_job(tmp_path / "lock.toml")
    assert again.mesh == job.mesh
    assert again.mesh.quality == "fine"


def test_a_job_with_an_unknown_quality_is_refused_at_its_line(tmp_path):
    (tmp_path / "job.toml").write_text(JOB.format(quality="drft"), encoding="utf-8")
    with refused("job.toml:7", "mesh.quality", "'drft'", "'draft'"):
        tg.jobs.read_job(tmp_path / "job.toml")


def test_an_unknown_quality_is_answered_with_the_nearest_one(finger):
    with refused("'drft'", "'draft'", "fine", "normal"):
        tg.mesh(finger, quality="drft")
    with refused("3", "draft", "fine", "normal"):
        tg.mesh(finger, quality=3)
