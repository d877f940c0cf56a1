"""The command ``turgor section``: what it prints, writes and refuses."""

import json

import numpy as np
import pytest
from PIL import Image

from refused import states
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE, NOT_CONVERGED
from turgor.core.results.files.response_csv import read_response

JOB = """
[actuator]
type = "eccentric_bender"

[materials]
body = { law = "neo_hooke", C10 = "120 kPa" }

[loads]
pressure = "PRESSURE"

[procedure]
type = "static"
"""


@pytest.fixture
def job(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "finger.toml"

    def write(pressure="40 kPa", text=JOB):
        file.write_text(text.replace("PRESSURE", pressure), encoding="utf-8")
        return str(file)

    return write


def test_table_plot_and_folder(job, tmp_path, capsys):
    assert main(["section", job(), "--rows", "4", "--size", "3 mm"]) == DONE
    said = capsys.readouterr().out
    assert "curvature_y_1/m" in said
    assert "twist" not in said  # zero all along
    response = read_response(tmp_path / "finger-section" / "section.csv")
    assert response["pressure"] == pytest.approx([10e3, 20e3, 30e3, 40e3])
    assert (np.diff(response["curvature_y"]) > 0).all()
    with Image.open(tmp_path / "finger-section" / "section.png") as picture:
        assert min(picture.size) > 400
    assert main(["section", job(), "--rows", "4"]) == BAD_INPUT
    assert "--force" in capsys.readouterr().err


def test_json_holds_the_columns(job, capsys):
    assert main(["section", job(), "--rows", "2", "--size", "4 mm", "--json"]) == DONE
    result = json.loads(capsys.readouterr().out)["result"]
    assert result["status"] == "converged"
    assert result["stable"] == [True, True]
    assert [column["name"] for column in result["columns"]][:2] == ["pressure", "curvature"]


def test_path_that_ends_early_is_written(job, tmp_path, capsys):
    assert main(["section", job("400 kPa"), "--rows", "8", "--size", "5 mm"]) == NOT_CONVERGED
    assert states(capsys.readouterr().err, "of 8")
    assert len(read_response(tmp_path / "finger-section" / "section.csv")) >= 1


@pytest.mark.parametrize(
    ("more", "text"),
    [
        (["--rows", "0"], "rows is 0; allowed is 1 to 1000"),
        (["--size", "3"], "--size: "),
        (["--ends", "opened"], "unknown ends of a section 'opened'; did you mean 'open'"),
    ],
)
def test_wrong_options_are_refused(job, capsys, more, text):
    assert main(["section", job(), *more]) == BAD_INPUT
    assert text in capsys.readouterr().err


def test_actuator_without_a_section_is_refused(job, tmp_path, capsys):
    pneunet = JOB.replace("eccentric_bender", "fast_pneunet").replace(
        "body =", "base = { law = 'neo_hooke', C10 = '50 kPa' }\nbody ="
    )
    assert main(["section", job(text=pneunet)]) == BAD_INPUT
    assert states(capsys.readouterr().err, "uniform cross-section", "mm")
    assert not (tmp_path / "finger-section").exists()
