"""Rigs of blocked force as they are built: angle of the plate, round sensor, load cell that gives way, preload."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.setups.setup_values import BlockedForce
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.units import N, deg, mm

JOB = """
[actuator]
type = "extending_cylinder"
length = "20 mm"

[mesh]
size = "6 mm"
cells = "hexahedra"

[materials]
body = { law = "neo_hooke", C10 = "0.1 MPa" }

[loads]
pressure = "10 kPa"

[procedure]
type = "blocked_force"
direction = "+x"
"""


@pytest.fixture(scope="module")
def actuator(tmp_path_factory):
    file = tmp_path_factory.mktemp("rig") / "tube.toml"
    file.write_text(JOB.split("[procedure]")[0], encoding="utf-8")
    return prepare(read_job(file))[0]


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    file = tmp_path_factory.mktemp("whole") / "tube.toml"
    text = JOB.split("[procedure]")[0].replace("[mesh]", "symmetric = false\n\n[mesh]")
    file.write_text(text, encoding="utf-8")
    return prepare(read_job(file))[0]


def blocked(actuator, **rig):
    return tg.setups.blocked_force(actuator, direction="+x", **rig)


def force(actuator, **rig):
    return tg.measure(tg.solve(blocked(actuator, **rig)), tg.measures.blocked_force).column("blocked_force")[-1]


def plate_of(model):
    return next(each for each in model.contact.obstacles if each.name == "plate")


@pytest.mark.parametrize(
    "rig", [{}, {"tilt": 5 * deg}, {"tilt": -20 * deg}, {"sensor_radius": 3 * mm}, {"sensor_radius": 40 * mm}], ids=str
)
def test_the_gap_is_that_of_the_nearest_point(whole, rig):
    for gap in (0.0, 1 * mm):
        plate = plate_of(blocked(whole, distance=gap, **rig))
        points = whole.mesh.points[np.unique(whole.mesh.faces["tip"])]
        # the center of a button may lie over the inside of a side, where no node is
        assert plate.shape.clearance(points) == pytest.approx(gap, abs=0.02 * mm)
        assert not plate.path


def test_a_tilted_plate_measures_along_its_normal(whole, actuator):
    with refused("tilt", "mirror plane"):
        blocked(actuator, tilt=30 * deg)
    plate = plate_of(blocked(whole, tilt=30 * deg))
    x, y, z = plate.push
    assert (x, abs(z)) == pytest.approx((np.cos(30 * deg), 0.5)) and y == 0


def test_a_load_cell_that_gives_way_is_a_rigid_one_farther_away(actuator):
    soft = force(actuator, spring=500 * N / 1.0)
    assert soft == pytest.approx(force(actuator, distance=soft / 500), rel=0.01)
    assert soft < 0.9 * force(actuator)


def test_a_preload_pushes_from_the_beginning(actuator):
    model = blocked(actuator, distance=-0.2 * mm)
    plate = plate_of(model)
    assert plate.displacement(0.0) == pytest.approx(np.zeros(3))
    assert plate.displacement(1.0) == pytest.approx([-0.2 * mm, 0, 0])
    pushed, touching, away = (force(actuator, distance=gap) for gap in (-0.2 * mm, 0.0, 0.2 * mm))
    assert pushed > 1.2 * touching > 1.2 * away
    response = tg.measure(tg.solve(model), tg.measures.blocked_force)
    begun = response.column("load_factor") > 0.02
    assert response.column("blocked_force")[0] == 0
    assert response.column("blocked_force")[begun][0] > 0.5 * (pushed - touching)


def test_the_lock_repeats_the_rig(whole):
    """What was chosen is stated: position in place of the distance, with all units."""
    from turgor.core.setups.with_setup import with_choices, with_setup
    from turgor.job.tables.setups import read_setup, written_setup
    from turgor.job.text.problems import Problems

    for rig in ({"tilt": 5 * deg, "distance": 1 * mm}, {"sensor_radius": 3 * mm, "spring": 2e3, "distance": -0.1 * mm}):
        setup = BlockedForce(direction="+x", **rig)
        model = with_setup(whole, setup)
        settled = with_choices(setup, model)
        assert settled.distance is None
        table = written_setup(settled, tg.Static(), model.loads)
        problems = Problems("job.toml", {})
        again, _ = read_setup("blocked_force", table, model.loads, problems)
        assert again == settled and not problems.entries
        assert plate_of(with_setup(whole, again)) == plate_of(model)


@pytest.mark.parametrize(
    ("rig", "facts"),
    [
        ({"tilt": 80 * deg}, ("tilt", "80 deg", "-60 to 60 deg")),
        ({"spring": 0.0}, ("spring", 0, "more than 0")),
        ({"sensor_radius": -1 * mm}, ("sensor_radius", "more than 0")),
        ({"behind_tip": 1 * mm}, ("behind_tip", "sensor_radius")),
        ({"sensor_radius": 1 * mm, "tilt": 5 * deg}, ("tilt", "sensor_radius")),
        ({"hold": "yz", "spring": 1e3}, ("spring", "yz")),
        ({"distance": float("inf")}, ("distance", "finite")),
    ],
)
def test_values_that_do_not_fit_are_refused(rig, facts):
    with refused("blocked_force", *facts):
        BlockedForce(**rig)


def test_a_button_beside_the_actuator_is_refused(whole):
    with refused("0.1 mm", "behind_tip", "-z"):
        tg.setups.blocked_force(whole, direction="-z", sensor_radius=0.1 * mm, behind_tip=-5 * mm)


def test_a_button_between_nodes_stands_at_its_gap(whole):
    """The lowest line of a round tube is straight; a small button touches it between nodes, 1.5 mm apart."""
    gaps = {}
    for place in (2.25 * mm, 1.5 * mm):  # between nodes, and at one
        rig = {"sensor_radius": 1.5 * mm, "behind_tip": place, "distance": 1 * mm}
        plate = plate_of(tg.setups.blocked_force(whole, direction="-z", **rig))
        assert plate.shape.center[0] == pytest.approx(20 * mm - place)
        gaps[place] = whole.mesh.points[:, 2].min() - plate.shape.center[2] - 1.5 * mm
    assert gaps == {place: pytest.approx(1 * mm, abs=0.02 * mm) for place in gaps}


def test_a_button_beyond_the_edge_of_the_tip_stands_at_its_gap(whole):
    """The nearest point is the edge, to the side of the middle of the ball."""
    rig = {"sensor_radius": 3 * mm, "behind_tip": -1.5 * mm, "distance": 0.5 * mm}
    plate = plate_of(tg.setups.blocked_force(whole, direction="-z", **rig))
    assert plate.shape.clearance(whole.mesh.points) == pytest.approx(0.5 * mm, abs=0.02 * mm)
