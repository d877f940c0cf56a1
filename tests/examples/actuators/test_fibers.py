"""The examples with fibers: scripts assert their number, jobs twist, contract, extend and bend."""

import runpy
from pathlib import Path

import pytest
from run_example import example, run_example

from turgor.core.model.sheets import Shell
from turgor.units import deg, mm

EXAMPLES = Path(__file__).parents[3] / "examples"


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("twisting_tube", "The tip turns by -39.5 deg"),
        (
            "formula_and_finite_elements",
            "At 20 kPa the muscle shortens by 2.08 mm, a muscle without ends by 2.24 mm.",
        ),
        ("mckibben_muscle", "30 deg from the axis: 3.5 % shorter. 70 deg: 4.5 % longer."),
        pytest.param(
            *("fiber_reinforced_bender", "Bending angle 4.26 deg; the chamber grew by 13 %."), marks=pytest.mark.slow
        ),
    ],
)
def test_the_script_says_and_asserts_its_number(name, said, capsys):
    runpy.run_path(str(EXAMPLES / f"{name}.py"))
    assert said in capsys.readouterr().out


def test_the_tube_in_a_helix_twists_against_its_hand():
    twist = run_example("twisting_tube").column("twist_angle")
    assert twist[-1] / deg == pytest.approx(-25.2, rel=0.02)


def test_the_muscle_contracts():
    assert run_example("contracting_tube").column("tip_displacement_x")[-1] / mm == pytest.approx(-2.77, rel=0.02)


def test_the_cylinder_in_hoops_extends():
    extension = run_example("fiber_reinforced_cylinder").column("tip_displacement_x")[-1] / mm
    assert extension == pytest.approx(7.02, rel=0.02)


def test_the_bender_in_hoops_is_that_of_the_script():
    job = example("fiber_reinforced_bender")
    assert isinstance(job.materials["strain_limiting_layer"], Shell)
    assert job.fibers["hoops"].faces == ("outside", "strain_limiting_layer")
    assert run_example("fiber_reinforced_bender").column("bending_angle")[-1] / deg == pytest.approx(4.29, rel=0.02)
