"""What `solve` tells by itself: findings before and after the solve, each once, and rejected steps as they happen."""

from dataclasses import replace

import pytest
from solver_cases import RUBBER, bar, model

from turgor.core.materials.laws.laws import Yeoh
from turgor.core.materials.library.doubts import doubts_of
from turgor.core.materials.library.records import from_library
from turgor.core.materials.material import Material
from turgor.core.model.loads import Gravity, Traction
from turgor.core.model.model import Model
from turgor.core.model.supports import Fixed
from turgor.core.solvers.procedures.arc_length import ArcLength
from turgor.core.solvers.procedures.stages import Stage, Stages
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.solve import solve
from turgor.core.solvers.step_reasons import Cause

UNSTABLE = Material(name="typed", law=Yeoh(C10=0.1e6, C20=-0.02e6))


def pulled(rubber, pressure=1e3, **more):
    return Model(bar(), {"body": rubber}, [Fixed("fixed")], [Traction("top", (0.0, 0.0, pressure))], **more)


def codes(findings):
    return [finding.code for finding in findings]


def test_a_stated_law_is_checked_for_its_stability():
    (finding,) = doubts_of(UNSTABLE)
    assert finding.code == "M06"
    assert "uniaxial tension at stretch 1.57" in finding.message
    assert doubts_of(RUBBER) == ()


def test_the_doubt_of_a_record_is_not_told_twice():
    record = from_library("ecoflex-00-30", record="yeoh-elsayed-2014")
    assert codes(doubts_of(record)).count("M06") == 1


def test_solve_tells_what_is_known_before_it():
    solution = solve(pulled(UNSTABLE), Static())
    assert codes(solution.findings) == ["M06"]
    heavy = Model(bar(), {"body": replace(RUBBER, density=1.07)}, [Fixed("fixed")], [Gravity(acceleration=1e3)])
    assert codes(solve(heavy).findings) == ["P01", "P02"]
    assert solve(model()).findings == ()


def test_solve_warns_beyond_the_stretches_of_the_tests():
    tested = replace(RUBBER, stretch_range=(0.9, 1.02))
    solution = solve(pulled(tested, 60e3))
    assert codes(solution.findings) == ["M01"]
    assert "but its tests end at 1.02" in solution.findings[0].message
    assert solve(pulled(replace(RUBBER, stretch_range=(0.5, 3.0)), 60e3)).findings == ()


def test_a_sequence_of_stages_tells_each_finding_once():
    tested = replace(UNSTABLE, stretch_range=(0.9, 1.02))
    stages = Stages([Stage("pull", Static()), Stage("hold", Static())])
    assert codes(solve(pulled(tested, 60e3), stages, throw=False).findings) == ["M06", "M01"]


@pytest.mark.parametrize("procedure", [Static(min_step=0.05, first_step=0.5), ArcLength(first_step=0.5, max_steps=4)])
def test_progress_is_told_of_every_rejected_step(procedure):
    told = []
    solution = solve(pulled(UNSTABLE, 500e3), procedure, progress=lambda *each: told.append(each), throw=False)
    rejected = [(iteration.step, iteration.rejected) for iteration, _ in told if iteration.rejected is not None]
    assert rejected == [(n, step.why) for n, step in enumerate(solution.steps, start=1) if not step.accepted]
    assert rejected
    assert all(state is None for iteration, state in told if iteration.rejected is not None)
    assert all(isinstance(why.cause, Cause) for _, why in rejected)
