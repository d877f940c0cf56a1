"""A reduced model answers as the full one does at inputs that it never saw, from a file that needs few packages."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from reduced_cases import KEY, PRESSURE, finger, other_path, reduced

import turgor as tg
from refused import refused
from turgor.core.engine.runtime import EngineOptions
from turgor.reduced.path import solution_of
from turgor.reduced.training.compare import compared
from turgor.reduced.verify import verified

LOADS_ALONE = """
import sys

class Blocked:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {"scipy", "basix", "netgen", "rslab", "OCP", "matplotlib", "pydantic", "typer"}:
            raise ImportError(name)

sys.meta_path.insert(0, Blocked())
from turgor.reduced.states.reduced import Reduced
print(float(abs(Reduced.load(sys.argv[1]).solve(7000.0).displacement).max()))
"""


def test_held_out_states_agree():
    errors = reduced().held_out
    assert len(errors.inputs) >= 8
    assert errors.worst < 0.005
    assert errors.tip.max() < 0.005
    assert errors.volume.max() < 0.002


def test_held_out_errors_are_those_of_solves():
    """Modes that hold a state are not enough: rubber that is a tenth too stiff is a large error."""
    made = reduced()
    rubber, *others = made.equations.parts
    stiff = replace(rubber, weights=1.1 * rubber.weights)
    wrong = replace(made, equations=replace(made.equations, parts=(stiff, *others)))
    errors = [compared(each, other_path(), reached_only=False).worst for each in (made, wrong)]
    assert errors[0] < 0.005
    assert errors[1] > 0.02


def test_rates_are_derivatives():
    one = reduced().solve({"pressure": 7000.0})
    ends = [reduced().solve(7000.0 + step, start=one) for step in (10.0, -10.0)]
    assert one.tip_rates[:, 0] == pytest.approx((ends[0].tip - ends[1].tip) / 20, rel=1e-4, abs=1e-13)
    slope = (ends[0].volumes["cavity"] - ends[1].volumes["cavity"]) / 20
    assert one.volume_rates["cavity"][0] == pytest.approx(slope, rel=1e-4)


def test_the_full_model_verifies_an_answer():
    """Its equilibrium is that of a path of its own, and the error of a worse model is larger."""
    answer = reduced().solve(9500.0)
    found = verified(answer, EngineOptions(threads=1))
    loads = [replace(load, pressure=9500.0) for load in finger().loads]
    end = tg.solve(replace(finger(), loads=loads)).states[-1]
    largest = np.abs(end.displacement).max()
    assert found.state.displacement == pytest.approx(end.displacement, abs=1e-5 * largest)
    assert 0 < found.displacement < 0.005
    assert found.volume < 0.002
    worse = replace(answer, y=answer.y * 1.02)
    assert verified(worse, EngineOptions(threads=1)).displacement == pytest.approx(0.02, rel=0.5)


def test_measures_read_its_states():
    answer = reduced().solve(9000.0)
    state = answer.state()
    assert tg.cavity_volume(state) == pytest.approx(answer.volumes["cavity"], rel=1e-6)
    assert tg.tip_displacement(state) == pytest.approx(np.linalg.norm(answer.tip), rel=1e-5)
    assert state.pressures == {"cavity": 9000.0}
    response = tg.measure(solution_of([reduced().solve(4000.0), answer]), "cavity_volume", mesh_error=False)
    assert response.column("cavity_volume")[-1] == pytest.approx(answer.volumes["cavity"], rel=1e-6)


def test_random_jumps_are_all_answered():
    for pressure in np.random.default_rng(3).uniform(0, PRESSURE, 50):
        assert reduced().solve(pressure).iterations < 30


def test_file_answers_the_same_with_few_packages(tmp_path):
    file = reduced().save(tmp_path / "finger")
    assert file.name == "finger.reduced"
    assert file.stat().st_size < 0.65e6
    largest = float(np.abs(reduced().solve(7000.0).displacement).max())
    loaded = tg.load(file).solve(7000.0)
    assert float(np.abs(loaded.displacement).max()) == pytest.approx(largest, rel=3e-5)  # modes of 16 bits
    assert loaded.volumes["cavity"] == pytest.approx(reduced().solve(7000.0).volumes["cavity"], rel=1e-5)
    done = subprocess.run([sys.executable, "-c", LOADS_ALONE, str(file)], capture_output=True, text=True, check=True)
    assert float(done.stdout) == pytest.approx(float(np.abs(loaded.displacement).max()), rel=1e-9)


def test_inputs_outside_are_refused():
    with refused(KEY, "13 kPa", "12 kPa"):
        reduced().solve({"pressure": 13e3})
    with refused("presure", KEY):
        reduced().solve({"presure": 1.0})
    with refused(KEY, "0 kPa", "12 kPa"):
        reduced().solve({})


def test_what_is_left_out_is_refused_by_name():
    model = finger()
    with refused("materials.body.C10"):
        tg.reduce(model, {"materials.body.C10": (1e5, 2e5)})
    with refused(KEY, "2 kPa", "1 kPa"):
        tg.reduce(model, {KEY: (2e3, 1e3)})
    with refused("loads.presure", KEY):
        tg.reduce(model, {"loads.presure": (0.0, 1.0)})
    rubbing = tg.Contact(tg.obstacles.SelfContact(friction=0.3))
    with refused("friction", "0.3"):
        tg.reduce(_with(model, contact=rubbing), {KEY: (0.0, 1e3)})
    load = tg.Pressure("cavity", 1e3, history=((0, 0), (0.5, 1), (1, 0.5)))
    with refused("cavity"):
        tg.reduce(_with(model, loads=[load]), {KEY: (0.0, 1e3)})
    pouch = tg.mesh(tg.actuators.MiuraTube(rows=1).build(), size=20e-3)
    film = tg.Shell(tg.laws.Hooke(E=20e6, nu=0.45), 1e-3)
    sheets = {"film": film, "tip": film}
    with refused("films"):
        tg.reduce(tg.Model(pouch, sheets, ["fixed"], [tg.Pressure("cavity", 1e3)]), {KEY: (0.0, 1e3)})


def _with(model: tg.Model, **changes: object) -> tg.Model:
    """The model with other parts."""
    parts = {"materials": dict(model.materials), "loads": model.loads, "contact": model.contact} | changes
    supports = [each for each in model.supports if not each.mirror]
    return tg.Model(model.mesh, supports=supports, **parts)
