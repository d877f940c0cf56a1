"""Studies as folders and tables: what was written is read again, failed rows included."""

import numpy as np
import pytest
from study_cases import Beam, deflection

import turgor as tg
from refused import refused
from turgor.units import mm

AT = ("force", 0.005)


@pytest.fixture
def study():
    return tg.sweep(deflection, Beam(), height=[-1 * mm, 1 * mm, 2 * mm], parts=[1, 2])


def test_a_folder_has_whole_curves(study, tmp_path):
    assert tg.studies.write_study(study, tmp_path / "beams", at=AT) == tmp_path / "beams" / "study.csv"
    read = tg.studies.load_study(tmp_path / "beams")
    assert read.factors == study.factors
    assert [row.status for row in read.rows] == [row.status for row in study.rows]
    assert read.problems == study.problems
    np.testing.assert_allclose(read.inputs, study.inputs)
    for at in (AT, None):
        np.testing.assert_allclose(read.column("deflection", at), study.column("deflection", at), rtol=1e-14)
    assert len(read.rows[-1].response) == 5


def test_a_table_has_a_state_of_each_row(study, tmp_path):
    study.to_csv(tmp_path / "a.csv", at=AT)
    read = tg.studies.load_study(tmp_path / "a.csv")
    np.testing.assert_allclose(read.inputs, study.inputs)
    np.testing.assert_allclose(read.column("deflection"), study.column("deflection", AT), rtol=1e-9)
    assert [row.status for row in read.rows][:3] == ["failed", "failed", "converged"]
    assert read.rows[0].problem == "height is -1 mm; allowed is above 0 mm."


def test_runs_that_were_read_cannot_be_called(study, tmp_path):
    tg.studies.write_study(study, tmp_path)
    with refused("file", "function"):
        tg.studies.load_study(tmp_path).rows[0].ended.run.function()


def test_mistakes_are_answered(study, tmp_path):
    with refused(tmp_path, "study.json"):
        tg.studies.load_study(tmp_path)
    (tmp_path / "study.json").write_text("{}", encoding="utf-8")
    with refused(tmp_path / "study.json", "'factors'"):
        tg.studies.load_study(tmp_path)
    (tmp_path / "a.csv").write_text("wall,angle\n1,2\n", encoding="utf-8")
    with refused(tmp_path / "a.csv", "status, problem", "cpu_seconds"):
        tg.studies.load_study(tmp_path / "a.csv")
