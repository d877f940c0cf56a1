"""A job is solved on finer and finer meshes; sizes that cannot be compared are refused before anything is solved."""

from dataclasses import replace

import numpy as np
import pytest

from refused import refused, states
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.materials.laws.laws import NeoHooke
from turgor.core.materials.material import Material
from turgor.core.meshing.settings import MeshSettings
from turgor.core.model.loads import Pressure
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.solution import Solution, SolveError
from turgor.core.solvers.solve import solve
from turgor.job.convergence import RATIO, convergence, study_sizes
from turgor.job.job import Job
from turgor.job.prepare import prepare
from turgor.units import kPa, mm

RUBBER = Material(name="rubber", law=NeoHooke(C10=50 * kPa), bulk_modulus=np.inf)
JOB = Job(
    name="one",
    actuator=FastPneuNet(chambers=1, length=20 * mm),
    mesh=MeshSettings(size=4 * mm, face_sizes={"cavity": 3 * mm}),
    materials={"body": RUBBER, "base": RUBBER},
    loads=(Pressure("cavity", 1 * kPa),),
    procedure=Static(first_step=1.0, max_step=1.0),
    threads=1,
)


def test_a_job_is_solved_at_three_sizes_around_its_own() -> None:
    said: list[str] = []
    study = convergence(JOB, notify=said.append)
    assert study.sizes == pytest.approx(np.array([4 * RATIO, 4, 4 / RATIO]) * mm, rel=1e-4)
    assert (np.diff(study.cells) > 0).all()
    assert np.degrees(study.values[-1]) == pytest.approx(0.041, abs=0.004)
    assert sum(text.startswith("mesh ") and "size" in text for text in said) == 3


def test_a_function_may_be_asked_instead() -> None:
    asked = []

    def question(size: float) -> Solution:
        asked.append(size)
        return solve(prepare(replace(JOB, mesh=MeshSettings(size=size)))[0], JOB.procedure)

    study = convergence(question, (2.5 * mm, 6 * mm, 4 * mm), measure="cavity_volume")
    assert asked == [6 * mm, 4 * mm, 2.5 * mm]  # from coarse to fine
    assert study.measure.name == "cavity_volume"


def test_a_path_that_ends_early_is_not_compared() -> None:
    cut = replace(JOB, procedure=Static(first_step=0.5, max_step=0.5, max_steps=1))
    with pytest.raises(SolveError) as error:
        convergence(cut)
    assert states(*error.value.__notes__, "5.6 mm")


def test_nor_is_one_that_a_function_returns() -> None:
    cut = Static(first_step=0.5, max_step=0.5, max_steps=1)

    def question(size: float) -> Solution:
        return solve(prepare(replace(JOB, mesh=MeshSettings(size=size)))[0], cut, throw=False)

    with refused("step_limit", "0.5 kPa", "procedure.max_steps", error=SolveError):
        convergence(question, (6 * mm, 4 * mm, 3 * mm))


@pytest.mark.parametrize(
    ("sizes", "facts"),
    [
        (2, ["2 mesh sizes", "3 to 6"]),
        (7, ["7 mesh sizes", "3 to 6"]),
        (True, ["True", "3 to 6"]),
        ([4 * mm, 2 * mm], ["2 mesh sizes", "3 to 6"]),
        ([4 * mm, 2 * mm, -1 * mm], ["-1 mm", 0]),
        ([4 * mm, 2 * mm, float("nan")], ["nan mm", 0]),
        ([4 * mm, 2 * mm, 2 * mm], ["mesh sizes", "4, 2, 2 mm", 1.3]),
        ([40 * mm, 4 * mm, 2 * mm], ["40 mm", "0.284 mm to 6 mm"]),
        ([4 * mm, 2 * mm, 0.01 * mm], ["0.01 mm", "0.284 mm to 6 mm"]),
    ],
)
def test_sizes_that_cannot_be_compared_are_refused(sizes, facts: list[object]) -> None:
    with refused(*facts):
        convergence(JOB, sizes)


def test_a_coarse_job_stays_within_what_its_walls_allow() -> None:
    assert study_sizes(replace(JOB, mesh=MeshSettings(size=6 * mm)), 3) == pytest.approx(
        (6 * mm, 4.286 * mm, 3.061 * mm)
    )


def test_a_function_needs_its_sizes() -> None:
    with refused("function", "(4*mm, 2.8*mm, 2*mm)"):
        convergence(lambda size: None, 3)  # type: ignore[arg-type, return-value]


def test_an_unknown_measure_is_answered_at_once() -> None:
    with refused("'bend_angle'", "'bending_angle'"):
        convergence(JOB, measure="bend_angle")
