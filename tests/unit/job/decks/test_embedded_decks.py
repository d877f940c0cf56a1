"""Embedded trusses of decks: they become threads, run as such, and come back from a written deck."""

import numpy as np
import pytest

import turgor as tg
from deck_cases import deck, step
from refused import refused
from turgor.job.meshes import mesh_of
from turgor.job.prepare import model_of

RODS = """\
*NODE
101, {0}., 5., 0.
102, 5., 5., 10.
103, 5., 5., 20.
*ELEMENT, TYPE={1}, ELSET=RODS
{2}
*EMBEDDED ELEMENT, HOST ELSET=BLOCK
RODS
*MATERIAL, NAME=STEEL
*ELASTIC
10., 0.3
*SOLID SECTION, ELSET=RODS, MATERIAL=STEEL
2.
"""

LINES = "201, 101, 102\n202, 102, 103"

ROLLERS = "*BOUNDARY\nBOTTOM, 3\nX0, 1\nY0, 2\n"

PULLED = step("*BOUNDARY\nTOP, 3, 3, 0.2\n")


def rods(begin=5, kind="T3D2", lines=LINES):
    return RODS.format(begin, kind, lines)


def read(folder, lines):
    file = deck(folder, model=ROLLERS + lines, steps=PULLED)
    job = tg.jobs.read_job(tg.files.import_deck(file).write(folder, force=True))
    return model_of(job, mesh_of(job, job.geometry()))


def pull(model):
    """Force on the pulled face [N] and the state."""
    state = tg.solve(model).states[-1]
    top = np.isclose(model.mesh.points[:, 2], 20e-3)
    return state.nodal_force[top, 2].sum(), state


@pytest.mark.parametrize("given", [("T3D2", LINES), ("T3D3", "201, 101, 103, 102")])
def test_a_straight_rod_is_parallel_to_the_block(tmp_path, given):
    model = read(tmp_path, rods(5, *given))
    (fibers,) = model.reinforcements
    assert (fibers.name, fibers.compression) == ("RODS", 1)
    assert fibers.winding.through == pytest.approx(np.array([[(5e-3, 5e-3, z) for z in (0, 10e-3, 20e-3)]]))
    (alone, _), (together, state) = pull(tg.Model(model.mesh, model.materials, model.supports, [])), pull(model)
    assert together - alone == pytest.approx(10 * 2 * 0.01, rel=1e-6)
    assert tg.measures.fiber_results(state)[0].tension == pytest.approx([0.2, 0.2], rel=1e-6)


def test_a_written_deck_comes_back(tmp_path):
    model = read(tmp_path, rods(1))
    tg.files.write_inp(model, tmp_path / "written.inp", program="abaqus")
    back = tg.jobs.read_job(tg.files.import_deck(tmp_path / "written.inp").write(tmp_path))
    (force, _), (again, _) = pull(model), pull(model_of(back, mesh_of(back, back.geometry())))
    assert again == pytest.approx(force, rel=1e-6)
    notes = tg.files.write_inp(model, tmp_path / "springs.inp")
    assert "cells" in next(note.text for note in notes if note.what == "fibers.RODS")
    text = (tmp_path / "springs.inp").read_text()
    assert "*EMBEDDED ELEMENT" not in text
    assert text.count("*EQUATION") == 9


def test_rods_that_bear_tension_only(tmp_path):
    slack = rods().replace("10., 0.3\n", "10., 0.3\n*NO COMPRESSION\n")
    (fibers,) = read(tmp_path, slack).reinforcements
    assert fibers.compression == 0


@pytest.mark.parametrize(
    ("lines", "facts"),
    [
        (rods().replace("HOST ELSET=BLOCK\nRODS", "HOST ELSET=BLOCK\nBLOCK"), ("BLOCK", "T3D2")),
        (rods().replace("*ELASTIC\n10., 0.3", "*HYPERELASTIC, NEO HOOKE\n1., 0."), ("STEEL", "*ELASTIC")),
        (rods(lines="201, 101, 109"), ("109",)),
        (rods().replace("*EMBEDDED ELEMENT, HOST ELSET=BLOCK\nRODS\n", ""), ("T3D2",)),
    ],
)
def test_what_is_no_embedded_truss_is_refused(tmp_path, lines, facts):
    with refused(*facts):
        tg.files.import_deck(deck(tmp_path, model=ROLLERS + lines, steps=PULLED))


def test_rods_outside_the_body_are_refused(tmp_path):
    with refused("RODS", "point 1", "5 mm"):
        tg.solve(read(tmp_path, rods(15)))
