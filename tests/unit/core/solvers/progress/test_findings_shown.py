"""Findings reach whoever solves in Python: as warnings, in the message of a failure, in one line of the solution."""

import warnings
from dataclasses import replace

import solver_cases
from turgor.solutions import FindingWarning

import turgor as tg
from refused import refused
from turgor.foundation.finding import Severity

#: A rubber whose constant was meant in MPa, as in Abaqus.
FORGOTTEN = tg.Material(name="x", law=tg.laws.NeoHooke(C10=0.11))
SAID = "Material 'x': the initial shear modulus of a rubber is 0.22 Pa; usual is 3 kPa to 20 MPa"


def forgotten() -> tg.Model:
    return replace(solver_cases.model(), materials={"body": FORGOTTEN})


def test_a_failed_solve_begins_with_the_finding_that_explains_it() -> None:
    with refused("step_too_small: Material 'x'", "0.22 Pa", "3 kPa to 20 MPa", "P01", error=tg.SolveError) as error:
        tg.solve(forgotten())
    solution = error.value.solution
    assert "(P01). No equilibrium was found beyond" in solution.message
    assert solution.advice.startswith("Check the unit of the coefficients")
    assert repr(solution).count("the initial shear modulus") == 1


def test_a_failure_that_no_finding_explains_is_told_as_it_is() -> None:
    solution = tg.solve(solver_cases.model(), tg.Static(first_step=0.01, max_step=0.01, max_steps=3), throw=False)
    assert solution.message.startswith("Stopped at")


def test_findings_are_warnings_before_the_solve_at_the_line_of_the_script() -> None:
    steps: list[object] = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("default")
        for _ in range(2):
            tg.solve(forgotten(), throw=False, progress=lambda *each: steps.append(len(caught)))
    assert [each.category for each in caught] == [FindingWarning] * len(caught)
    assert [str(each.message).partition(" ")[0] for each in caught].count("P01") == 1  # once for a line
    assert {each.filename for each in caught} == {__file__}
    assert steps[0] >= 1


def test_a_warning_can_be_filtered() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.filterwarnings("ignore", category=FindingWarning)
        tg.solve(forgotten(), throw=False)


def test_the_line_of_a_solution_has_its_warnings() -> None:
    solution = tg.solve(forgotten(), tg.Static(), throw=False)
    solution = replace(solution, message="Ended.")
    assert f"Ended; P01 warning: {SAID}" in repr(solution)
    notes = tuple(replace(each, severity=Severity.NOTE) for each in solution.findings)
    assert repr(replace(solution, findings=notes)).endswith(": Ended)")
