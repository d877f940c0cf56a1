"""Surrogates of studies with choices, such as rubbers: forward, from a file, backward, and what is refused."""

import json

import numpy as np
import pytest

import surrogate_cases as cases
from refused import refused, states
from turgor.cli import main
from turgor.studies.runs.factor import Factor
from turgor.studies.sensitivity.indices import sobol_indices
from turgor.studies.surrogates.fit import surrogate
from turgor.studies.surrogates.invert import invert
from turgor.studies.surrogates.learn import Goal, learn
from turgor.studies.surrogates.next_design import next_design
from turgor.studies.surrogates.surrogate import Surrogate
from turgor.units import deg, mm

ANGLE = "bending_angle"


def angle(wall, rubber):
    return float(cases.finger_of(wall, rubber)[ANGLE][-1])


@pytest.fixture(scope="module")
def fitted():
    study = cases.study_of(cases.finger_of, [cases.WALL, cases.RUBBER], 32)
    return surrogate(study, [ANGLE])


@pytest.mark.parametrize("rubber", cases.RUBBERS)
def test_each_choice_is_predicted_as_it_is(fitted, rubber):
    """The three rubbers differ by 21 degrees and more; none is taken for another or for a mean of others."""
    for wall in (1.1 * mm, 1.55 * mm, 1.9 * mm):
        result = fitted.predict({"wall": wall, "rubber": rubber})
        assert result[ANGLE] == pytest.approx(angle(wall, rubber), abs=0.3 * deg)
        assert result.deviations[ANGLE] < 1 * deg
    slope = (angle(1.501 * mm, rubber) - angle(1.499 * mm, rubber)) / (0.002 * mm)
    slopes = fitted.slopes({"wall": 1.5 * mm, "rubber": rubber})
    assert slopes[ANGLE] == {"wall": pytest.approx(slope, rel=0.05)}, "a choice has none"


def test_its_file_knows_the_choices(fitted, tmp_path):
    again = Surrogate.load(fitted.save(tmp_path / "rubbers"))
    asked = {"wall": 1.3 * mm, "rubber": "firm"}
    assert again.predict(asked).values == fitted.predict(asked).values
    assert "rubber soft or firm or stiff" in repr(again)
    with refused("'rubber'", "'stif'", "'stiff'"):
        again.predict({"wall": 1.3 * mm, "rubber": "stif"})
    with refused("'wall'", "'thin'", "a number"):
        again.predict({"wall": "thin", "rubber": "stiff"})
    with refused("'rubber'", "0 to 2"):
        again.means(np.array([[1.3 * mm, 0.5]]))


def test_the_inverse_goes_through_all_choices(fitted):
    """Every rubber that can bend so far with a wall in the range is a solution; the others are not."""
    wanted = 50 * deg  # the firm finger with a wall of 1 mm bends by 47 degrees
    result = invert(fitted, {ANGLE: wanted})
    assert result.reached
    assert (result.values["rubber"], result.others) == ("soft", ())
    assert angle(**result.values) == pytest.approx(wanted, abs=0.3 * deg)
    assert set(result.deviations) == {"wall"}
    assert "rubber soft" in result.sentence()
    both = invert(fitted, {ANGLE: 28 * deg})
    assert {both.values["rubber"], *(each["rubber"] for each in both.others)} == {"firm", "stiff"}
    for each in (both.values, *both.others):
        assert angle(**each) == pytest.approx(28 * deg, abs=0.3 * deg)
    for rubber in ("firm", "stiff"):
        assert invert(fitted, {ANGLE: 28 * deg}, prefer={"rubber": rubber}).values["rubber"] == rubber
        held = invert(fitted, {ANGLE: 28 * deg}, fixed={"rubber": rubber})
        assert (held.values["rubber"], held.others) == (rubber, ())


def test_a_choice_alone_is_sought(fitted):
    wanted = angle(1.5 * mm, "stiff")
    result = invert(fitted, {ANGLE: wanted}, fixed={"wall": 1.5 * mm})
    assert (result.values["rubber"], result.deviations) == ("stiff", {})
    assert result.prediction[ANGLE] == pytest.approx(wanted, abs=0.3 * deg)
    with refused("wall, rubber"):
        invert(fitted, {ANGLE: wanted}, fixed={"wall": 1.5 * mm, "rubber": "soft"})


def test_choices_are_learned(fitted):
    asked = next_design(fitted, 4)
    assert {each["rubber"] for each in asked} <= set(cases.RUBBERS)
    result = learn(cases.finger_of, [cases.WALL, cases.RUBBER], Goal(measures=(ANGLE,), error=0.01, runs=40))
    assert result.reached, result.sentence()


def test_a_choice_is_held_for_indices(fitted):
    gap = Factor(name="gap", low=0.0, high=1.0)
    with refused("'rubber'", "choice", "`anova`"):
        sobol_indices(fitted)
    study = cases.study_of(three, [cases.WALL, gap, cases.RUBBER], 32)
    (result,) = sobol_indices(surrogate(study, [ANGLE]), fixed={"rubber": "soft"}, samples=64)
    assert result.factors == ("wall", "gap")
    assert result.total[0] > 0.95


def three(wall, gap, rubber):
    """The finger, in which a gap does nothing."""
    return cases.finger_of(wall, rubber)


def test_the_command_takes_names(fitted, tmp_path, capsys):
    file = str(fitted.save(tmp_path / "rubbers"))
    assert main(["predict", file, "--at", "wall=1.5 mm", "--at", "rubber=soft", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["result"]
    assert told["at"] == {"wall": 1.5 * mm, "rubber": "soft"}
    assert told["values"][ANGLE] == pytest.approx(45 * deg, abs=0.3 * deg)  # arctan(p/C10)
    assert main(["predict", file, "--want", "bending_angle=28 deg", "--prefer", "rubber=stiff"]) == 0
    assert "rubber stiff give bending angle 28" in capsys.readouterr().out
    assert main(["predict", file, "--at", "rubber=sof", "--at", "wall=1.5 mm"]) == 1
    assert states(capsys.readouterr().err, "'sof'", "'soft'")
