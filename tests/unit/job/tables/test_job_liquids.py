"""Liquids and motion in water in job files: read, written into the lock file, refused."""

from dataclasses import replace
from pathlib import Path

import pytest
import results_cases as cases

from refused import any_states, refused
from turgor.core.model.continued_model import at_start
from turgor.core.model.loads import HydrostaticPressure, Load, Morison, Pressure
from turgor.core.model.model import Model
from turgor.core.solvers.checks.early_findings import early_findings
from turgor.core.solvers.procedures.dynamic import Dynamic
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.procedures.stabilized import Stabilized
from turgor.core.solvers.procedures.static import Static
from turgor.foundation.finding import Severity
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job
from turgor.job.text.problems import JobError

JOB = """
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "4 mm"

[materials]
body = { law = "neo_hooke", C10 = "50 kPa" }
base = { law = "neo_hooke", C10 = "50 kPa" }

[[loads.liquids]]
face = "cavity"
density = "1 g/cm³"
level = "3 cm"
history = "constant"

[[loads.liquids]]
face = "outside"
density = "1000 kg/m³"
level = "1 m"
free_surface = true

[[loads.morison]]
face = "outside"
density = "1000 kg/m³"
axis = [1, 0, 0]
drag = 3
"""


def read(folder: Path, text: str):
    (folder / "job.toml").write_text(text, encoding="utf-8")
    return read_job(folder / "job.toml")


def test_liquids_are_read_and_written(tmp_path: Path) -> None:
    job = read(tmp_path, JOB)
    inside, outside, moving = job.loads
    assert inside == HydrostaticPressure(face="cavity", density=1000, level=0.03, history="constant")
    assert outside == HydrostaticPressure(face="outside", density=1000, level=1, free_surface=True)
    assert moving == Morison(face="outside", density=1000, axis=(1, 0, 0), drag=3)
    assert moving.text() == "Liquid of 1000 kg/m³ around outside, by strip theory: added mass 1, drag 3."
    assert inside.gradient == pytest.approx((0, 0, -9806.65))
    assert outside.text().endswith("no pressure at a height of 1000 mm, dry above, following the surface.")
    assert read(tmp_path, lock_text(job, {})).loads == job.loads


@pytest.mark.parametrize(
    ("before", "after", "facts"),
    [
        ("1 g/cm³", "1 g", ["loads.liquids.density:", "'1 g'", "density"]),
        ('density = "1 g/cm³"', 'density = "0 kg/m³"', ["loads.liquids", "density is 0", "above 0"]),
        ('"cavity"', '"cavty"', ["cavty", "cavity"]),
        ("free_surface", "free_surfac", ["free_surfac", "free_surface"]),
        ("axis = [1, 0, 0]", "axis = [0, 0, 0]", ["loads.morison", "zero vector"]),
        ("[[loads.morison]]", "[loads.morison]", ["loads.morison:", "double brackets", "[[morison]]"]),
        ("drag = 3", "drag = -3", ["loads.morison", "drag is -3", "0 or more"]),
        ('level = "3 cm"', 'direction = [0, 1, -1]\nlevel = "3 cm"', ["mirror", "actuator.symmetric = false"]),
    ],
)
def test_a_mistake_is_named(tmp_path: Path, before: str, after: str, facts: list[str]) -> None:
    with pytest.raises(JobError) as error:
        read(tmp_path, JOB.replace(before, after))
    assert any_states(error.value.problems, facts), error.value.problems


def test_numbers_of_a_liquid() -> None:
    with refused("free_surface", "'yes'"):
        HydrostaticPressure(face="cavity", density=1000, level=0, free_surface="yes")
    with refused("acceleration", "-1", "above 0"):
        HydrostaticPressure(face="cavity", density=1000, level=0, acceleration=-1)


def test_water_that_comes_is_written(tmp_path: Path) -> None:
    job = read(tmp_path, JOB + "history = [[0, 0], [1, 1]]\n")
    assert job.loads[-1].share(0.5) == 0.5
    assert read(tmp_path, lock_text(job, {})).loads == job.loads


def test_water_that_acts_in_motion_only_needs_a_motion() -> None:
    def severities(procedure: Procedure, *loads: Load) -> list[Severity]:
        model = Model(cases.body(), {"body": cases.RUBBER, "base": cases.RUBBER}, "fixed", list(loads))
        return [each.severity for each in early_findings(model, procedure) if each.code == "L13"]

    moving = Morison(face="outside", density=1000, axis=(1, 0, 0))
    assert severities(Static(), moving) == severities(Stabilized(), moving) == [Severity.WARNING]
    assert severities(Static(), moving, Pressure("cavity", 1e3)) == [Severity.NOTE]
    assert severities(Static(), Pressure("cavity", 1e3)) == []
    assert severities(Dynamic(duration=1.0), moving) == []


def test_water_that_acts_in_motion_only_has_no_state_of_its_own_at_the_start() -> None:
    moving = Morison(face="outside", density=1000, axis=(1, 0, 0))
    weight = HydrostaticPressure(face="cavity", density=1000, level=0, history="constant")
    materials = {"body": cases.RUBBER, "base": cases.RUBBER}
    assert at_start(Model(cases.body(), materials, "fixed", [moving])) is None
    before = at_start(Model(cases.body(), materials, "fixed", [moving, weight]))
    assert before is not None and [load.kind for load in before.loads] == [weight.kind]


@pytest.mark.parametrize(
    ("face", "facts"),
    [
        ("cavity", ["'cavity'", "loads.liquids", "'outside'"]),
        ("tip", ["'tip'", "across", "'outside'"]),
        ("fixed", ["'fixed'", "across", "'outside'"]),
        ("bottom", ["'bottom'", "one side", "'outside'"]),
    ],
)
def test_water_goes_around_a_body(face: str, facts: list[str]) -> None:
    mesh = cases.body()
    sides = mesh.face("outside")
    lowest = mesh.points[sides, 2].max(axis=1) <= mesh.points[:, 2].min() + 1e-9
    mesh = replace(mesh, faces={**mesh.faces, "bottom": sides[lowest]})
    with refused("morison", *facts):
        Model(
            mesh,
            {"body": cases.RUBBER, "base": cases.RUBBER},
            "fixed",
            [Morison(face=face, density=1000, axis=(1, 0, 0))],
        )
