"""Plane decks: plane strain and bodies of revolution as jobs with plane meshes, and what they cannot have."""

import numpy as np
import pytest

import turgor as tg
from deck_cases import RUBBER, step
from refused import refused
from turgor.job.meshes import mesh_of
from turgor.job.prepare import model_of

MESH = """\
*NODE, NSET=ALL
1, 10., 0.
2, 20., 0.
3, 20., 5.
4, 10., 5.
5, 20., 10.
6, 10., 10.
*ELEMENT, TYPE=CPE4, ELSET=BODY
1, 1,2,3,4
2, 4,3,5,6
*NSET, NSET=BOTTOM
1,2
*NSET, NSET=TOP
5,6
*SURFACE, NAME=LID, TYPE=ELEMENT
2, S3
"""

#: Both directions of the bottom; a third one that plane nodes lack.
FIXED = "*BOUNDARY\nBOTTOM, 1, 3\n"

LID = step("*DSLOAD\nLID, P, 0.01\n")


def plane_deck(folder, *, kind="CPE4", thickness="4.,\n", model=FIXED, steps=LID):
    file = folder / "plane.inp"
    section = f"*MATERIAL, NAME=SOFT\n{RUBBER}*SOLID SECTION, ELSET=BODY, MATERIAL=SOFT\n{thickness}"
    file.write_text(MESH.replace("CPE4", kind) + section + model + steps)
    return file


def job_of(file, folder):
    return tg.jobs.read_job(tg.files.import_deck(file).write(folder, force=True))


def solved(job):
    model = model_of(job, mesh_of(job, job.geometry()))
    return model.mesh.points, tg.solve(model, job.procedure).states[-1].displacement


def test_plane_strain_has_its_thickness_and_is_pressed_on_an_edge(tmp_path):
    job = job_of(plane_deck(tmp_path), tmp_path)
    assert job.actuator.plane.thickness == pytest.approx(4e-3)
    (lid,) = job.loads
    assert (lid.face, lid.pressure) == ("LID", pytest.approx(10e3))
    points = mesh_of(job, job.geometry()).points
    assert np.ptp(points, axis=0)[:2] == pytest.approx((10e-3, 10e-3))


def test_without_a_thickness_it_is_one(tmp_path):
    assert job_of(plane_deck(tmp_path, thickness=""), tmp_path).actuator.plane.thickness == pytest.approx(1e-3)


def test_forces_of_a_uniform_traction_act_on_the_edge_and_others_on_their_nodes(tmp_path):
    (force,) = job_of(plane_deck(tmp_path, steps=step("*CLOAD\nTOP, 2, 0.25\n")), tmp_path).loads
    assert (force.face, force.vector) == ("pulled", pytest.approx((0, 0.5, 0)))
    (single,) = job_of(plane_deck(tmp_path, steps=step("*CLOAD\n5, 2, 0.25\n")), tmp_path).loads
    assert single.place == "node_5"


def test_rings_are_fixed_across_the_axis_and_move_along_it(tmp_path):
    shift = "*BOUNDARY\nTOP, 1\nTOP, 2, 2, 0.1\n"
    job = job_of(plane_deck(tmp_path, kind="CAX4", steps=step(shift)), tmp_path)
    assert job.actuator.plane.axis == "y"
    assert {each.directions for each in job.supports} == {"y", "xz"}
    points, moved = solved(job)
    top = points[:, 1] > 9.999e-3
    np.testing.assert_allclose(moved[top], [[0, 0.1e-3, 0]] * top.sum(), atol=1e-12)


def test_all_nodes_of_a_plane_model_are_all_of_its_thickness(tmp_path):
    slide = "*BOUNDARY\nALL, 1\nBOTTOM, 2\n"
    _, moved = solved(job_of(plane_deck(tmp_path, model=slide), tmp_path))
    assert abs(moved[:, 0]).max() == 0 < abs(moved[:, 1]).max()


@pytest.mark.parametrize(
    ("given", "facts"),
    [
        ({"kind": "CPS4"}, ("plane.inp:8", "CPS4", "CPE", "CAX")),
        ({"kind": "CAX4", "steps": step("*CLOAD\n5, 1, 0.1\n")}, ("*CLOAD", "y")),
        ({"kind": "CAX4", "steps": step("*DLOAD\nBODY, GRAV, 9810., 1., 0., 0.\n")}, ("*DLOAD", "y")),
        ({"kind": "CAX4", "steps": step("*DSLOAD, FOLLOWER=NO\nLID, TRVEC, 1., 1., 0., 0.\n")}, ("*DSLOAD", "y")),
        ({"kind": "CAX4", "steps": step("*BOUNDARY\nTOP, 1, 1, 0.1\n")}, ("*BOUNDARY", "missing")),
        ({"steps": step("*CLOAD\n5, 3, 0.1\n")}, ("*CLOAD", 3, "1 to 2")),
        ({"model": FIXED + "*SOLID SECTION, ELSET=BODY, MATERIAL=SOFT\n5.,\n"}, ("SECTION", 5, 4)),
    ],
)
def test_what_has_no_form_is_named(tmp_path, given, facts):
    with refused(*facts):
        tg.files.import_deck(plane_deck(tmp_path, **given))
