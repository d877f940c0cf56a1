"""Functional mock-up units pass FMPy's validation and give what turgor gives."""

import sys
from dataclasses import replace

import fmpy
import numpy as np
import pytest
from fmpy.validation import validate_fmu
from learning_cases import chamber, pushed

import turgor as tg
from refused import any_states, refused
from turgor.core.engine.system import System
from turgor.reduced.training.masses import masses_of

pytestmark = pytest.mark.skipif(sys.platform == "darwin", reason="pythonfmu has no binary for macOS")

#: Inputs of a run of 20 steps that begins with a step at rest.
TIMES = np.linspace(0.0, 0.2, 21)
LATER = np.maximum(TIMES - 0.01, 0.0)
PRESSURES, FORCES = 400 * (1 - np.cos(15 * LATER)), 8e-3 * np.sin(20 * LATER)


def simulated(file, pressures, forces, logger=None):
    """Run of FMPy; inputs at a time are those of the step that begins there."""
    kinds = [("time", float), ("loads.pressure", float), ("loads.tip.vector[3]", float)]
    signals = np.array(list(zip(TIMES, pressures, forces, strict=True)), dtype=kinds)
    return fmpy.simulate_fmu(
        str(file), stop_time=0.2, output_interval=0.01, input=signals, debug_logging=True, logger=logger
    )


def test_a_unit_gives_the_equilibria_of_the_reduced_model(tmp_path):
    outputs = (tg.control.Tip(), tg.learning.Volumes(), tg.control.Angle(), tg.control.Points([(0.006, 0.0, 0.0)]))
    file = tg.files.write_fmu(pushed(), tmp_path / "two inputs", outputs)
    assert file == tmp_path / "two inputs.fmu"
    assert validate_fmu(str(file)) == []
    rows = simulated(file, PRESSURES, FORCES)
    assert rows["time"] == pytest.approx(TIMES)
    made = tg.learning.function(pushed(), outputs)
    inputs = np.column_stack([PRESSURES, FORCES])
    expected = made(np.vstack([inputs[:1], inputs[:-1]]))  # a step has the inputs that were set before it
    for name, column in zip(made.names, expected.T, strict=True):
        assert rows[name] == pytest.approx(column, abs=1e-4 * np.abs(column).max() + 1e-18)  # of four digits
    assert (rows["estimate"] < 0.02).all() and (rows["estimate"] > 0).all()


def test_a_unit_in_motion_gives_what_follow_gives(tmp_path):
    masses = masses_of(System(chamber()), pushed().modes.astype(np.float64))
    reduced = replace(pushed(), masses=masses)
    moving = tg.real_time.Moving(step=0.01, stiffness_damping=1e-3)
    file = tg.files.write_fmu(reduced, tmp_path / "moving.fmu", [tg.control.Tip()], moving=moving)
    rows = simulated(file, np.append(PRESSURES[1:], 0.0), np.append(FORCES[1:], 0.0))
    expected = reduced.follow(TIMES, {"pressure": PRESSURES, "tip.vector.3": FORCES}, moving).tip
    size = np.abs(expected).max()
    assert np.column_stack([rows[f"tip_{axis}"] for axis in "xyz"])[1:] == pytest.approx(expected[1:], abs=1e-4 * size)
    still = pushed().follow(TIMES, {"pressure": PRESSURES, "tip.vector.3": FORCES}).tip
    assert np.abs(expected - still).max() > 1e-3 * size


def test_what_no_unit_can_have_is_refused(tmp_path):
    with refused("Volumes", "Coordinates"):
        tg.files.write_fmu(pushed(), tmp_path / "a", [object()])
    with refused("motion"):
        tg.files.write_fmu(pushed(), tmp_path / "a", moving=tg.real_time.Moving())
    assert not list(tmp_path.iterdir())


def test_a_step_outside_of_the_range_is_refused_with_a_sentence(tmp_path):
    file, said = tg.files.write_fmu(pushed(), tmp_path / "range"), []
    rows = simulated(file, PRESSURES + 500.0, FORCES, lambda *given: said.append(given[-1].decode()))
    assert PRESSURES[np.searchsorted(TIMES, rows["time"][-1]) - 1] < 500.0 < PRESSURES.max()
    assert rows["time"][-1] < 0.15
    assert any_states(said, ["loads.pressure", "1 kPa"])
