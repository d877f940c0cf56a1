"""`turgor export RUN --to FILE` writes the motion of a run."""

import json

import pytest
import results_cases as cases
from PIL import Image

import turgor as tg
from refused import states
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """The folder of a solve of two steps."""
    folder = tmp_path_factory.mktemp("run") / "finger-results"
    model = cases.model(cases.body(half=True), pressure=5e3)
    tg.solve(model, tg.Static(first_step=0.5, max_step=0.5), folder=folder)
    return folder


def test_motion_of_a_run_is_written(run, tmp_path, capsys):
    gif, glb = tmp_path / "m.gif", tmp_path / "m.glb"
    asked = ["export", str(run), "--to", str(gif), "--to", str(glb), "--width", "400", "--seconds", "0.3"]
    assert main([*asked, "--color-by", "stretch", "--json"]) == DONE
    assert json.loads(capsys.readouterr().out)["result"]["files"] == [str(gif), str(glb)]
    assert Image.open(gif).width == 400
    assert glb.read_bytes()[:4] == b"glTF"
    assert main(asked) == BAD_INPUT
    assert states(capsys.readouterr().err, "--force")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--to", "m.mov"], "unknown ending of a file with motion '.mov'"),
        (["--to", "m.gif", "--color-by", "stres"], "unknown field to color pictures by 'stres'"),
        (["--to", "m.gif", "--width", "20"], "width of a motion is 20; allowed is 400 to 4000"),
    ],
)
def test_bad_wishes_are_sentences(run, tmp_path, monkeypatch, capsys, arguments, said):
    monkeypatch.chdir(tmp_path)
    assert main(["export", str(run), *arguments]) == BAD_INPUT
    assert said in capsys.readouterr().err


def test_a_job_has_no_motion(tmp_path, capsys):
    assert main(["export", str(tmp_path / "job.toml"), "--to", "m.gif"]) == BAD_INPUT
    assert states(capsys.readouterr().err, "job.toml", "folder")
