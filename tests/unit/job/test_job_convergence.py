"""A job is solved on finer and finer meshes; sizes that cannot be compared are refused before anything is solved."""

from dataclasses import replace

import numpy as np
import pytest

from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.materials.laws.laws import NeoHooke
from turgor.core.materials.material import Material
from turgor.core.meshing.settings import MeshSettings
from turgor.core.model.loads import Pressure
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.solution import Solution, SolveError
from turgor.core.solvers.solve import solve
from turgor.foundation.errors import TurgorError
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

    study = convergence(question, (2.5 * mm, 6 * mm, 4 * mm), wanted="cavity_volume")
    assert asked == [6 * mm, 4 * mm, 2.5 * mm]  # from coarse to fine
    assert study.measure.name == "cavity_volume"


def test_a_path_that_ends_early_is_not_compared() -> None:
    cut = replace(JOB, procedure=Static(first_step=0.5, max_step=0.5, max_steps=1))
    with pytest.raises(SolveError) as error:
        convergence(cut)
    assert error.value.__notes__ == ["This was the mesh of size 5.6 mm; a study compares complete paths."]


def test_nor_is_one_that_a_function_returns() -> None:
    cut = Static(first_step=0.5, max_step=0.5, max_steps=1)

    def question(size: float) -> Solution:
        return solve(prepare(replace(JOB, mesh=MeshSettings(size=size)))[0], cut, throw=False)

    with pytest.raises(SolveError, match="step"):
        convergence(question, (6 * mm, 4 * mm, 3 * mm))


@pytest.mark.parametrize(
    ("sizes", "sentence"),
    [
        (2, "2 mesh sizes are requested; allowed is 3 to 6"),
        (7, "7 mesh sizes are requested; allowed is 3 to 6"),
        (True, "mesh sizes are requested"),
        ([4 * mm, 2 * mm], "2 mesh sizes are requested"),
        ([4 * mm, 2 * mm, -1 * mm], "mesh size is -1 mm; allowed is more than 0"),
        ([4 * mm, 2 * mm, float("nan")], "mesh size is nan mm"),
        ([4 * mm, 2 * mm, 2 * mm], "two of the mesh sizes are equal"),
        ([40 * mm, 4 * mm, 2 * mm], r"mesh size is 40 mm; allowed for this job is 0\.\d+ mm to 6 mm"),
        ([4 * mm, 2 * mm, 0.01 * mm], r"mesh size is 0.01 mm; allowed for this job is"),
    ],
)
def test_sizes_that_cannot_be_compared_are_refused(sizes, sentence: str) -> None:
    with pytest.raises(TurgorError, match=sentence):
        convergence(JOB, sizes)


def test_a_coarse_job_stays_within_what_its_walls_allow() -> None:
    assert study_sizes(replace(JOB, mesh=MeshSettings(size=6 * mm)), 3) == pytest.approx(
        (6 * mm, 4.286 * mm, 3.061 * mm)
    )


def test_a_function_needs_its_sizes() -> None:
    with pytest.raises(TurgorError, match="a function needs its mesh sizes, such as"):
        convergence(lambda size: None, 3)  # type: ignore[arg-type, return-value]


def test_an_unknown_measure_is_answered_at_once() -> None:
    with pytest.raises(TurgorError, match="unknown measure 'bend_angle'; did you mean 'bending_angle'"):
        convergence(JOB, wanted="bend_angle")
