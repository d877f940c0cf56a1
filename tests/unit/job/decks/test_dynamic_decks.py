"""Decks and .feb files with inertia: the procedure, sudden loads, damping, and what is refused."""

import pytest

import turgor as tg
from deck_cases import RUBBER, deck, step
from febio_cases import SOFT, feb
from refused import refused


def job_of(file, folder):
    return tg.jobs.read_job(tg.files.import_deck(file, units="mm, N, MPa").write(folder, force=True))


PULL = "*DSLOAD\nLID, P, -0.03\n"


def moving(text, **more):
    return step(text, **more).replace("*STATIC", "*DYNAMIC")


def heavy(more=""):
    return RUBBER + "*DENSITY\n1.1E-9\n" + more


@pytest.mark.parametrize("kind", ["", ", EXPLICIT", ", DIRECT"])
def test_a_load_without_an_amplitude_is_sudden(tmp_path, kind):
    steps = moving(PULL, period=0.2).replace("*DYNAMIC", "*DYNAMIC" + kind)
    job = job_of(deck(tmp_path, material=heavy(), steps=steps), tmp_path)
    assert isinstance(job.procedure, tg.Dynamic)
    assert (job.procedure.duration, job.procedure.mass_damping) == (0.2, 0.0)
    assert job.loads[0].history == ((0, 0), (1e-4, 1), (1, 1))  # turgor begins in equilibrium with what is there


def test_an_amplitude_from_zero_stays(tmp_path):
    rise = "*AMPLITUDE, NAME=UP\n0, 0, 0.1, 1, 0.2, 1\n"
    steps = moving(PULL.replace("*DSLOAD", "*DSLOAD, AMPLITUDE=UP"), period=0.2)
    job = job_of(deck(tmp_path, material=heavy("*DAMPING, ALPHA=40., BETA=0.\n"), model=rise, steps=steps), tmp_path)
    assert job.loads[0].history == ((0, 0), (0.5, 1), (1, 1))
    assert job.procedure.mass_damping == 40.0


@pytest.mark.parametrize(
    ("damping", "steps", "words"),
    [
        ("*DAMPING, ALPHA=1., BETA=0.01\n", moving(PULL), ["*DAMPING", "BETA", "ALPHA", "stiffness_damping"]),
        ("", step(PULL) + moving(PULL), ["*DYNAMIC", "inertia"]),
    ],
)
def test_what_inertia_has_no_form_for(tmp_path, damping, steps, words):
    with refused(*words):
        tg.files.import_deck(deck(tmp_path, material=heavy(damping), steps=steps), units="mm, N, MPa")


def test_damping_changes_no_static_result(tmp_path):
    file = deck(tmp_path, material=heavy("*DAMPING, BETA=0.01\n"))
    rows = tg.files.import_deck(file, units="mm, N, MPa").rows
    assert [row.verdict for row in rows if "DAMPING" in str(row)] == ["not needed"]


def test_dynamic_files_of_febio(tmp_path):
    heavy_one = SOFT.replace("<G>", "<density>1.1e-9</density><G>")
    job = job_of(feb(tmp_path, material=heavy_one, control="<analysis>DYNAMIC</analysis>"), tmp_path)
    assert isinstance(job.procedure, tg.Dynamic)
    assert job.procedure.duration == pytest.approx(1.0)
    assert job.materials["BLOCK"].density == pytest.approx(1100)
