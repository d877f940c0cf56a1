"""Chains as URDF: the frames are those of the chain, read by MuJoCo's own loader and as plain XML."""

from xml.etree import ElementTree

import numpy as np
import pytest
from robot_chains import X, fitted, spatial

import turgor as tg
from turgor.systems.robots.chains.urdf import Xml, robot_element

mujoco = pytest.importorskip("mujoco")


def test_joints_turn_the_tip_as_those_of_the_chain():
    chain = spatial()
    model = mujoco.MjModel.from_xml_string(Xml.tostring(robot_element(chain, "arm", 0.05), encoding="unicode"))
    assert model.jnt_range == pytest.approx(chain.limits)
    assert model.dof_damping == pytest.approx(0.05 * chain.springs[:, 0])
    data = mujoco.MjData(model)
    data.qpos[:] = X
    mujoco.mj_kinematics(model, data)
    at = chain.placed(X)
    last = data.body("link_3")
    assert last.xmat.reshape(3, 3) == pytest.approx(at.turns[-1], abs=1e-9)
    assert last.xpos + at.turns[-1] @ chain.end == pytest.approx(chain.tip(at), abs=1e-9)
    assert model.body_subtreemass[0] == pytest.approx(chain.masses.sum(), rel=0.01)


def test_a_file_has_every_element_that_urdf_requires_and_its_error(tmp_path):
    made = fitted()
    file = tg.robots.write_urdf(made, tmp_path / "finger.urdf")
    assert made.text[1:] in file.read_text(encoding="utf-8")
    root = ElementTree.parse(file).getroot()
    links = [link.get("name") for link in root.findall("link")]
    assert len(links) == len(set(links)) == len(made.chain.springs) + 2
    joints = root.findall("joint")
    parents = {joint.find("child").get("link"): joint.find("parent").get("link") for joint in joints}
    assert set(parents) == set(links) - {"base"}, "a tree whose root is the base"
    for joint in joints:
        if joint.get("type") in ("revolute", "prismatic"):
            limit = joint.find("limit")
            assert float(limit.get("lower")) < 0 < float(limit.get("upper"))
            assert float(limit.get("effort")) > 0
            assert np.linalg.norm([float(x) for x in joint.find("axis").get("xyz").split()]) == 1
    for mass in root.iter("mass"):
        assert float(mass.get("value")) > 0
    mujoco.MjModel.from_xml_path(str(file))
