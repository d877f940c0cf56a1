"""A part may lie anyhow in its file: what is read is the same as where it lies along x."""

import cad_cases as cases
import numpy as np
import pytest
from netgen.occ import Axis, Dir, Pnt
from turgor.jobs import read_job

from refused import refused
from turgor.core.geometry.cad.read import read_here
from turgor.core.geometry.cad.selectors import WithNormal
from turgor.job.output.lock import lock_text
from turgor.units import mm

#: Turns of the part in its file: axis and angle.
TURNS = {
    "x": ((0, 0, 1), 0),
    "y": ((0, 0, 1), 90),
    "z": ((0, 1, 0), -90),
    "y with z along x": ((1, 1, 1), 120),
    "backwards": ((0, 0, 1), 180),
    "tilted": ((1, 2, 3), 50),
}


def turned(vector, turn):
    """A vector after a turn, by the formula of Rodrigues."""
    axis, angle = np.array(turn[0]) / np.linalg.norm(turn[0]), np.radians(turn[1])
    v = np.array(vector, dtype=float)
    return np.cos(angle) * v + np.sin(angle) * np.cross(axis, v) + (1 - np.cos(angle)) * (axis @ v) * axis


def drawn(folder, shape, turn, name="part.step"):
    axis, angle = turn
    shape = shape.Rotate(Axis(Pnt(0, 0, 0), Dir(*axis)), angle) if angle else shape
    return cases.written(folder, shape, name)


def ends(turn):
    return {"fixed": WithNormal(tuple(turned((-1, 0, 0), turn))), "tip": WithNormal(tuple(turned((1, 0, 0), turn)))}


def centers(geometry):
    """Names and centers of all faces [mm], in their order."""
    return [(face.name, *np.round([*face.center], 6)) for face in geometry.shape.faces]


@pytest.fixture(scope="module")
def straight(tmp_path_factory):
    return read_here(drawn(tmp_path_factory.mktemp("x"), cases.finger(), TURNS["x"]), faces=ends(TURNS["x"]))


@pytest.mark.parametrize("name", TURNS)
def test_same_finger_however_it_is_drawn(tmp_path, straight, name):
    part = read_here(drawn(tmp_path, cases.finger(), TURNS[name]), faces=ends(TURNS[name]))
    assert np.array(part.bounds) == pytest.approx(np.array(straight.bounds), abs=1e-6)
    result, wanted = (sorted(centers(each)) for each in (part, straight))
    assert [row[0] for row in result] == [row[0] for row in wanted]
    assert np.array([row[1:] for row in result], dtype=float) == pytest.approx(
        np.array([row[1:] for row in wanted], dtype=float), abs=1e-4
    )
    assert part.cavity_volumes == pytest.approx(straight.cavity_volumes)
    assert [each.code for each in part.findings if each.code == "D08"] == ([] if name == "x" else ["D08"])


def test_cavities_are_numbered_along_the_new_axis(tmp_path):
    """Three chambers side by side, the first at +z: those of a part that was turned are numbered as they lie then."""
    straight = read_here(drawn(tmp_path, cases.three_chambers(), TURNS["x"]), faces=ends(TURNS["x"]))
    part = read_here(drawn(tmp_path, cases.three_chambers(), TURNS["y"], "y.step"), faces=ends(TURNS["y"]))
    assert sorted(part.cavity_volumes) == sorted(straight.cavity_volumes)
    for one, other in zip(sorted(centers(part)), sorted(centers(straight)), strict=True):
        assert one[0] == other[0]
        assert one[1:] == pytest.approx(other[1:], abs=1e-4)


def test_stated_axes_hold_for_selectors_too(tmp_path, straight):
    file = drawn(tmp_path, cases.finger(), TURNS["z"])
    part = read_here(file, faces=ends(TURNS["x"]), axes=("z", "y", "-x"))
    assert np.array(part.bounds) == pytest.approx(np.array(straight.bounds), abs=1e-6)
    assert not [each for each in part.findings if each.code == "D08"]
    askew = tuple(tuple(turned(axis, TURNS["tilted"])) for axis in np.eye(3))
    part = read_here(drawn(tmp_path, cases.finger(), TURNS["tilted"]), faces=ends(TURNS["x"]), axes=askew)
    assert np.array(part.bounds) == pytest.approx(np.array(straight.bounds), abs=1e-6)
    whole = read_here(drawn(tmp_path, cases.finger(), TURNS["z"]), faces=ends(TURNS["z"]), axes=("x", "y", "z"))
    assert whole.bounds[1][2] == pytest.approx(38 * mm, abs=1e-6)


def test_axis_that_does_not_show_is_said(tmp_path):
    """It is fixed by its bottom, and drawn along z: nobody can say where the axis is."""
    file = drawn(tmp_path, cases.finger(), TURNS["z"])
    faces = {"fixed": WithNormal("+x"), "tip": WithNormal("+z")}
    (result,) = [each for each in read_here(file, faces=faces).findings if each.code == "D08"]
    assert "do not show its axis" in result.message


@pytest.mark.parametrize(
    ("axes", "facts"),
    [
        (("x", "y", "-z"), ("x, y, -z", "left-handed")),
        (("x", "x", "z"), ("('x', 'x', 'z')", "x, y and z")),
        (("x", "y", "w"), ("('x', 'y', 'w')", "x, y and z")),
        (((1, 0, 0), (1, 1, 0), (0, 0, 1)), ("((1, 0, 0), (1, 1, 0), (0, 0, 1))", "right angles")),
    ],
)
def test_axes_that_are_none(tmp_path, axes, facts):
    with refused(*facts):
        read_here(drawn(tmp_path, cases.finger(), TURNS["x"]), axes=axes)


def test_job_states_axes(tmp_path, straight):
    drawn(tmp_path, cases.finger(), TURNS["z"])
    job = tmp_path / "job.toml"
    job.write_text(
        '[actuator]\ntype = "cad_file"\nfile = "part.step"\nunit = 0.001\naxes = ["z", "y", "-x"]\n'
        'faces = { fixed = { normal = "-x" }, tip = { normal = "+x" } }\n'
        '[materials]\nbody = { law = "neo_hooke", C10 = "50 kPa" }\n[loads]\npressure = "1 kPa"\n'
    )
    result = read_job(job)
    assert np.array(result.geometry().bounds) == pytest.approx(np.array(straight.bounds), abs=1e-6)
    (tmp_path / "lock.toml").write_text(lock_text(result, {}))
    assert read_job(tmp_path / "lock.toml") == result
