"""Rigid bodies of decks: a face with a reference point that is moved and turned."""

import numpy as np
import pytest

import turgor as tg
from deck_cases import CELLS, FIXED, NODES, deck, step
from refused import refused
from turgor.job.meshes import mesh_of
from turgor.job.prepare import model_of

MESH = NODES.replace("*NODE, NSET=ALL\n", "*NODE\n90, 5., 5., 20.\n91, 0., 0., 0.\n") + CELLS

RIGID = FIXED + "*RIGID BODY, NSET=TOP, REF NODE=90, ROT NODE=91\n"


def job_of(folder, lines, model=RIGID):
    file = deck(folder, mesh=MESH, model=model, steps=step(lines))
    return tg.jobs.read_job(tg.files.import_deck(file).write(folder, force=True))


def test_a_face_that_is_lifted_and_turned(tmp_path):
    job = job_of(tmp_path, "*BOUNDARY\n90, 1, 2\n90, 3, 3, 0.5\n91, 1, 2\n91, 3, 3, 0.1\n")
    model = model_of(job, mesh_of(job, job.geometry()))
    moved = tg.solve(model, job.procedure).states[-1].displacement
    top = model.mesh.points[:, 2] > 19.99e-3
    arm = model.mesh.points[top][:, :2] - 5e-3
    turn = np.array([[np.cos(0.1), -np.sin(0.1)], [np.sin(0.1), np.cos(0.1)]])
    np.testing.assert_allclose(moved[: len(top)][top, :2], arm @ turn.T - arm, atol=1e-9)
    np.testing.assert_allclose(moved[: len(top)][top, 2], 0.5e-3, atol=1e-9)


def test_one_turn_alone_leaves_the_face_free_to_tilt_and_to_move(tmp_path):
    (rig,) = job_of(tmp_path, "*BOUNDARY\n91, 3, 3, 0.1\n").points.values()
    (turn,) = rig.holds
    assert (turn.tilts, turn.angle) == (True, pytest.approx(0.1))


@pytest.mark.parametrize(
    ("lines", "model", "facts"),
    [
        ("*BOUNDARY\n90, 3, 3, 0.5\n", RIGID.replace("TOP", "X0Y"), ("*RIGID BODY", "NSET")),
        (
            "*BOUNDARY\n90, 3, 3, 0.5\n",
            RIGID.replace("=TOP", "=EDGE") + "*NSET, NSET=EDGE\n9, 10\n",
            ("*RIGID BODY", "face"),
        ),
        ("*BOUNDARY\n90, 6, 6, 0.5\n", RIGID, ("*RIGID BODY", 6, "ROT NODE")),
        ("*BOUNDARY\n91, 1, 1, 0.5\n91, 3, 3, 0.5\n", RIGID, ("*RIGID BODY", "axis")),
        ("*CLOAD\n90, 3, 0.5\n", RIGID, ("*CLOAD", "*RIGID BODY")),
    ],
)
def test_what_has_no_form_is_named(tmp_path, lines, model, facts):
    with refused(*facts):
        job_of(tmp_path, lines, model)
