"""Chains in MuJoCo: it finds the equilibria that turgor finds, within the error that the file states."""

from time import process_time

import numpy as np
import pytest
from robot_chains import fitted, spatial

import turgor as tg
from refused import refused
from turgor.systems.robots.chains import mjcf

mujoco = pytest.importorskip("mujoco")


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    return tg.robots.write_mjcf(fitted(), tmp_path_factory.mktemp("mjcf") / "finger.xml")


def settled(model, pressures, seconds=1.0):
    data = mujoco.MjData(model)
    data.ctrl[:] = pressures
    for _ in range(round(seconds / model.opt.timestep)):
        mujoco.mj_step(model, data)
    assert np.abs(data.qvel).max() < 1e-4
    return data


def test_it_settles_at_twenty_pressures_within_the_stated_error(file):
    made, model = fitted(), mujoco.MjModel.from_xml_path(str(file))
    stated = model.numeric("tip_error_over_length").data[0]
    assert stated == pytest.approx(made.error)
    assert stated <= 0.03
    away = []
    for pressures, tip, wanted in zip(made.tested, made.tips, made.wanted, strict=True):
        place = settled(model, pressures).site("tip").xpos
        assert place == pytest.approx(tip, abs=1e-6), "the equilibrium that turgor finds without MuJoCo"
        away.append(np.linalg.norm(place - wanted) / made.length)
    assert len(away) == 20
    assert max(away) <= 1.001 * stated


def test_it_runs_fifty_times_faster_than_time(file):
    model = mujoco.MjModel.from_xml_path(str(file))
    start = process_time()
    settled(model, [8e3], seconds=4.0)
    assert 4.0 / (process_time() - start) > 50


def test_the_file_states_its_error_and_has_the_surface_as_skin(file):
    text = file.read_text(encoding="utf-8")
    assert fitted().text[1:] in text.partition("-->")[0]
    model = mujoco.MjModel.from_xml_path(str(file))
    assert (model.nskin, model.nu) == (1, 1)
    assert model.skin_vertnum[0] > 500
    sums = np.zeros(model.skin_vertnum[0])
    np.add.at(sums, model.skin_bonevertid, model.skin_bonevertweight)
    assert sums == pytest.approx(1.0, abs=1e-5)


def test_a_chain_in_space_with_weight_is_that_of_turgor():
    chain, pressures = spatial(), np.array([2e4, 1e4])
    root = mjcf.chain_element(chain, "arm", tg.robots.MjcfOptions())
    model = mujoco.MjModel.from_xml_string(mjcf.text_of(root))
    data = settled(model, pressures, seconds=4.0)
    x = chain.equilibrium(pressures)
    assert data.qpos == pytest.approx(x, rel=1e-4, abs=1e-7)
    assert data.site("tip").xpos == pytest.approx(chain.tip(chain.placed(x)), abs=1e-6)
    mujoco.mj_forward(model, data)
    assert data.ten_length == pytest.approx(chain.gains @ x, rel=1e-3)


def test_a_capsule_stops_at_what_is_around():
    root = mjcf.chain_element(spatial(gravity=(0, 0, -9.81)), "arm", tg.robots.MjcfOptions())
    world = root.find("worldbody")
    mjcf.Xml.SubElement(world, "geom", type="plane", size="1 1 0.1", pos="0 0 -0.005")
    model = mujoco.MjModel.from_xml_string(mjcf.text_of(root))
    data = mujoco.MjData(model)
    for _ in range(500):
        mujoco.mj_step(model, data)
    assert data.ncon > 0


def test_a_time_step_that_damping_cannot_stabilize_is_refused():
    with refused("damping_time", "0.0005", "0.001"):
        tg.robots.MjcfOptions(damping_time=0.0005)
    with refused("step", "0.1"):
        tg.robots.MjcfOptions(step=0.2)
