"""Temperatures of decks: bodies that are warmed alike, whatever the scale, and what is refused."""

import numpy as np
import pytest

import turgor as tg
from deck_cases import FIXED, deck, step
from refused import refused
from turgor.core.model.history import share_at
from turgor.job.meshes import mesh_of
from turgor.job.prepare import model_of

WARM = "*ELASTIC\n0.3, 0.25, 0.\n0.3, 0.25, 500.\n*EXPANSION, ZERO=100.\n3e-4, 0.\n3e-4, 500.\n"

ROLLERS = "*BOUNDARY\nBOTTOM, 3\nX0, 1\nY0, 2\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, 290.\n"


def job_of(file, folder):
    return tg.jobs.read_job(tg.files.import_deck(file).write(folder, force=True))


def test_a_free_block_grows_by_the_rise_from_its_initial_temperature(tmp_path):
    heat = step("*TEMPERATURE\nALL, 390.\n")
    job = job_of(deck(tmp_path, material=WARM, model=ROLLERS, steps=heat), tmp_path)
    (load,) = job.loads
    assert load.temperature - load.rest == pytest.approx(100)
    model = model_of(job, mesh_of(job, job.geometry()))
    moved = tg.solve(model, job.procedure).states[-1].displacement
    np.testing.assert_allclose(moved, 0.03 * model.mesh.points, atol=1e-9)


def test_later_steps_go_on_from_the_temperature_of_the_former(tmp_path):
    steps = step("*TEMPERATURE\nALL, 390.\n") + step("*TEMPERATURE\nALL, 340.\n")
    (load,) = job_of(deck(tmp_path, material=WARM, model=ROLLERS, steps=steps), tmp_path).loads
    assert [share_at(load.history, s) for s in (0.25, 0.5, 1.0)] == pytest.approx([0.5, 1, 0.5])


def test_an_amplitude_counts_from_zero(tmp_path):
    late = "*AMPLITUDE, NAME=LATE\n0., 0., 0.5, 0., 1., 1.\n"
    steps = step("*TEMPERATURE, AMPLITUDE=LATE\nALL, 100.\n")
    (load,) = job_of(deck(tmp_path, material=WARM, model=FIXED + late, steps=steps), tmp_path).loads
    assert [share_at(load.history, s) for s in (0.5, 0.75, 1.0)] == pytest.approx([0, 0.5, 1])
    with refused("amplitude", "initial"):
        tg.files.import_deck(deck(tmp_path, material=WARM, model=ROLLERS + late, steps=steps))


def test_without_a_temperature_no_expansion_is_needed(tmp_path):
    (row,) = (row for row in tg.files.import_deck(deck(tmp_path, material=WARM)).rows if "EXPANSION" in row.keyword)
    assert row.verdict == "not needed"


@pytest.mark.parametrize(
    ("material", "lines", "words"),
    [
        (WARM, "TOP, 390.", ("block.inp:46", "TEMPERATURE", "BLOCK")),
        (WARM.replace("3e-4, 500.", "4e-4, 500."), "ALL, 390.", ("EXPANSION", "missing")),
        (WARM.replace("0.3, 0.25, 500.", "0.2, 0.25, 500."), "ALL, 390.", ("ELASTIC", "missing")),
        (WARM.replace("ZERO=100.", "TYPE=ORTHO"), "ALL, 390.", ("ORTHO", "isotropic")),
        (WARM, "ALL, 9000.", ("TEMPERATURE", "allowed")),
    ],
)
def test_what_has_no_form_is_named(tmp_path, material, lines, words):
    with refused(*words):
        tg.files.import_deck(deck(tmp_path, material=material, model=ROLLERS, steps=step(f"*TEMPERATURE\n{lines}\n")))
