"""The collection of hard cases: well-formed, and its quick cases end as they state."""

import sys
from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from refused import refused

sys.path.append(str(Path(__file__).parents[3]))
from benchmarks.robustness.robustness_cases import CASES
from benchmarks.robustness.robustness_cases.case import DIAGNOSED, OPTIONS, REACHED, WRONG, Case, Found, judge, run

CASE = {case.name: case for case in CASES}


def test_there_are_enough_cases_with_names_of_their_own_and_checks():
    assert len(CASES) >= 40
    assert len(CASE) == len(CASES)
    for case in CASES:
        assert case.hard
        assert callable(case.model)
        assert callable(case.check)


@pytest.mark.parametrize(
    ("name", "end"),
    [
        ("sphere, one step", REACHED),
        ("sphere past its limit, load control", DIAGNOSED),
        ("plate of 10 µm blown up", REACHED),
    ],
)
def test_quick_cases_end_as_they_state(name, end):
    verdict = run(CASE[name])
    assert verdict.end == end, verdict.text
    assert verdict.unknowns > 300
    assert verdict.iterations > 3


def test_an_end_that_the_check_refutes_is_wrong():
    case = CASE["sphere of hexahedra, one step"]
    refuted = Case(name="x", hard="x", model=case.model, check=lambda solution: Found(False, "no"))
    assert run(refuted).end == WRONG
    broken = Case(name="x", hard="x", model=lambda: 1 / 0, check=case.check)
    assert run(broken).text == "ZeroDivisionError: division by zero"


def test_a_limit_point_where_none_is_counts_as_wrong():
    case = CASE["sphere past its limit, load control"]
    solution = tg.solve(case.model(), case.procedure, options=OPTIONS, throw=False)
    reachable = Case(name="x", hard="x", model=case.model, check=case.check)
    assert judge(reachable, solution)[0] == WRONG


def test_ways_of_newton_come_to_the_same_state_and_the_refined_one_is_quicker():
    case = CASE["cantilever bent by 80 %"]
    counts, ends = {}, []
    for way in ("plain", "newton", "mixed"):
        options = tg.EngineOptions(linear_solver="rslab", threads=1, iteration=way)
        solution = tg.solve(case.model(), tg.Static(tolerance=1e-9), options=options)
        counts[way] = solution.iterations
        ends.append(solution.states[-1].displacement)
    assert counts["mixed"] < counts["plain"]
    for end in ends[:-1]:
        assert np.linalg.norm(end - ends[-1]) < 1e-6 * np.linalg.norm(end)
    with refused("'modified'", "'mixed'", "mixed, newton"):
        tg.EngineOptions(iteration="modified")
