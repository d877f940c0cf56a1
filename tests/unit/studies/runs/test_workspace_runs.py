"""Runs at combinations of pressures, and the workspace around the places that they reach."""

import csv

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.results.measures.shape.workspaces import COLUMNS
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.units import kPa, mm


def beam(cavity_1: float, cavity_2: float) -> Response:
    """A tip that goes along y with one pressure, along z with the other, 0.1 mm for each kPa, up to 55 kPa in all."""
    if cavity_1 + cavity_2 > 55 * kPa:
        raise TurgorError("the beam bursts.")
    ends = (0.0, cavity_1 * 1e-7, cavity_2 * 1e-7)
    columns = [Column(name, "mm", np.array([0.0, end])) for name, end in zip(COLUMNS, ends, strict=True)]
    message = "It buckles." if cavity_1 == 30 * kPa else ""
    return Response(columns=tuple(columns), source=Source(text="a beam"), message=message)


PRESSURES = {"cavity_1": np.array([0, 20, 40]) * kPa, "cavity_2": [0, 10 * kPa]}


def test_the_area_of_a_rectangle(tmp_path):
    result = tg.studies.workspace_of(beam, PRESSURES)
    assert len(result.ended) == 6
    assert result.reached.flat
    assert result.reached.area == pytest.approx(4 * mm * 1 * mm)
    assert result.problems == ()
    result.write(tmp_path / "points.csv")
    with (tmp_path / "points.csv").open(encoding="utf-8") as file:
        rows = list(csv.reader(file))
    assert rows[0][:3] == ["cavity_1 (kPa)", "cavity_2 (kPa)", "tip_displacement_x (mm)"]
    assert rows[-1] == ["40", "10", "0", "4", "1", ""]


def test_runs_that_fail_are_told(tmp_path):
    result = tg.studies.workspace_of(beam, {"cavity_1": [0, 30 * kPa], "cavity_2": [0, 30 * kPa]})
    assert result.reached.area == pytest.approx(4.5 * mm**2)  # a triangle: the fourth corner failed
    assert result.problems == (
        "The run with cavity_1 30 kPa, cavity_2 0 kPa ended early: It buckles.",
        "The run with cavity_1 30 kPa, cavity_2 30 kPa failed: the beam bursts.",
    )
    result.write(tmp_path / "points.csv")
    assert (tmp_path / "points.csv").read_text(encoding="utf-8").rstrip().endswith("30,30,,,,the beam bursts.")


def test_runs_are_kept(tmp_path):
    kept = tg.studies.saved_in(tmp_path)
    area = tg.studies.workspace_of(beam, PRESSURES, evaluations=kept).reached.area
    again = tg.studies.workspace_of(beam, PRESSURES, evaluations=tg.studies.saved_in(tmp_path))
    assert all(each.again for each in again.ended)
    assert again.reached.area == pytest.approx(area)


def test_mistakes_are_answered():
    with refused("pressures", "empty"):
        tg.studies.workspace_of(beam, {})
    with refused("'cavity_1'", "[]", "Pa"):
        tg.studies.workspace_of(beam, {"cavity_1": []})
    with refused("'cavity_1'", "[nan]", "Pa"):
        tg.studies.workspace_of(beam, {"cavity_1": [float("nan")], "cavity_2": [0.0]})
    with refused("1 runs", "beam bursts"):
        tg.studies.workspace_of(beam, {"cavity_1": [60 * kPa], "cavity_2": [0.0]})
    with refused("line", "pressure"):
        tg.studies.workspace_of(beam, {"cavity_1": [0, 10 * kPa], "cavity_2": [0]})


def reach(per_pascal: float, cavity_1: float, cavity_2: float) -> Response:
    """The same tip, as far for each pascal as a design says."""
    ends = (0.0, cavity_1 * per_pascal, cavity_2 * per_pascal)
    columns = [Column(name, "mm", np.array([0.0, end])) for name, end in zip(COLUMNS, ends, strict=True)]
    return Response(columns=tuple(columns), source=Source(text="a beam"))


def test_a_design_has_a_workspace_as_a_response():
    asked = {"cavity_1": [0, 20 * kPa], "cavity_2": [0, 10 * kPa]}
    near, far = (tg.studies.workspace_of(reach, asked, values={"per_pascal": each * 1e-7}) for each in (1, 3))
    result = far.to_response()
    assert result["workspace_area"] == pytest.approx([9 * near.reached.area])
    assert result.find("workspace_area").in_unit == pytest.approx([18])
    assert result["workspace_volume"] == [0.0]
    assert result.message == ""
    bursts = tg.studies.workspace_of(beam, {"cavity_1": [0, 30 * kPa], "cavity_2": [0, 30 * kPa]}).to_response()
    assert "cavity_2 30 kPa failed: the beam bursts." in bursts.message


JOB = """
[actuator]
type = "bidirectional_bender"

[mesh]
size = "12 mm"
wall_cells = 1

[materials]
body = { library = "elastosil-m4601", record = "neo-hooke-polygerinos-2020" }
strain_limiting_layer = { library = "paper", record = "hooke-polygerinos-2020", thickness = "0.1 mm" }

[loads]
pressure = "20 kPa"
"""


@pytest.fixture
def bender(tmp_path):
    (tmp_path / "bender.toml").write_text(JOB, encoding="utf-8")
    return tg.jobs.read_job(tmp_path / "bender.toml")


def solved_like(job, digest, numbers, measures):
    """Stand for a solve of the bender."""
    assert measures == list(COLUMNS)
    assert digest
    pressures = [numbers[f"loads.cavity_{number}.pressure"] for number in (1, 2)]
    return reach(1e-10 / numbers["actuator.outer_wall"], *pressures)


def test_numbers_of_a_job_have_other_values(bender, monkeypatch):
    monkeypatch.setattr("turgor.studies.runs.workspaces.solved_job", solved_like)
    asked = {"cavity_1": [0, 20 * kPa], "cavity_2": [0, 20 * kPa]}
    result = tg.studies.workspace_of(bender, asked, values={"actuator.outer_wall": 2 * mm})
    assert result.reached.area == pytest.approx(1 * mm**2)
    with refused("'actuator.outer_wal'", "'actuator.outer_wall'"):
        tg.studies.workspace_of(bender, asked, values={"actuator.outer_wal": 2 * mm})


def test_a_cavity_that_the_job_lacks(bender):
    with refused("'cavity_3'", "'cavity_2'", "cavity_1, cavity_2"):
        tg.studies.workspace_of(bender, {"cavity_3": [1e3]})
    with refused("job", "cavity_1, cavity_2", "zero"):
        tg.studies.workspace_of(bender, {"cavity_1": [0.0], "cavity_2": [0.0]})


@pytest.mark.slow
def test_a_bender_to_both_sides(bender, tmp_path):
    """One cavity bends it down, the other one up by the same, but for its mesh; both together hardly bend it."""
    kept = tg.studies.saved_in(tmp_path / "runs")
    values = [0, 20 * kPa]
    result = tg.studies.workspace_of(bender, {"cavity_1": values, "cavity_2": values}, evaluations=kept)
    assert result.problems == ()
    assert len(result.ended) == 3  # rest takes no run
    up, down, both = (each.result.response["tip_displacement_z"][-1] for each in result.ended)
    assert up > 1 * mm
    assert down == pytest.approx(-up, rel=0.1)
    assert abs(both) < 0.1 * up
    assert result.reached.flat
    assert result.reached.area > 0
