"""The examples of blocked force and grasp run as they stand, and the jobs beside them ask the same questions."""

import runpy
from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from turgor.job.prepare import prepare
from turgor.units import N, kPa

EXAMPLES = Path(__file__).parents[3] / "examples"


def run(name):
    return runpy.run_path(str(EXAMPLES / f"{name}.py"))


def asks_the_same(name, solution):
    """Whether the job beside a script leads to the model that the script solved."""
    job = tg.jobs.read_job(EXAMPLES / f"{name}.toml")
    assert job.procedure == solution.procedure
    model, _ = prepare(job)
    assert model.loads == solution.model.loads
    assert model.contact == solution.model.contact
    assert np.array_equal(model.mesh.points, solution.model.mesh.points)


def test_the_tip_presses_on_the_plate(capsys):
    made = run("blocked_force")
    assert "The tip presses with 0.17 N." in capsys.readouterr().out
    solution = made["solution"]
    asks_the_same("blocked_force", solution)
    response = tg.measure(solution, tg.measures.blocked_force, tg.measures.reaction)
    force, pressure = response.column("blocked_force"), response.column("pressure")
    assert force[-1] == pytest.approx(0.17 * N, rel=0.05)
    assert force == pytest.approx(response.column("reaction"), abs=1e-5 * N), "the clamp takes what the plate gives"
    assert force[pressure < 1.2 * kPa].max() == 0, "the plate is 1 mm away at first"
    assert (np.diff(force) >= 0).all()


@pytest.mark.parametrize("name", ["film", "stiff_film"])
def test_the_plate_is_below_what_wrinkles(name, tmp_path):
    """A film that bears tension only has hardly any stiffness at rest: there the tip would be pushed out along +x."""
    job = tmp_path / "job.toml"
    text = (EXAMPLES / f"{name}.toml").read_text("utf-8")
    job.write_text(f'{text}\n[procedure]\ntype = "blocked_force"\n', encoding="utf-8")
    model, _ = prepare(tg.jobs.read_job(job))
    assert model.contact.obstacles[-1].shape.normal == (0, 0, 1)


def test_the_fingers_hold_the_bar(capsys):
    made = run("grasp")
    assert "Each finger grips with 0.09 N; together they hold 0.1" in capsys.readouterr().out
    asks_the_same("grasp", made["solution"])
    response = made["response"]
    pull, grip, holding = (response.column(name) for name in ("pull_distance", "grip_force", "holding_force"))
    closing = pull == 0
    assert grip[closing][-1] == pytest.approx(0.093 * N, rel=0.05)
    assert holding.max() == pytest.approx(0.13 * N, rel=0.1)
    assert (np.diff(grip[closing]) >= 0).all()
    assert holding[~closing].min() > holding[closing].max(), "friction holds what is pulled"
    assert holding.max() < 2 * np.hypot(1, 0.5) * grip.max(), "Coulomb's friction holds no more"
