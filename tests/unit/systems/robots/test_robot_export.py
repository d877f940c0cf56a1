"""`turgor export FILE.reduced --to FORMAT` writes files and says how good they are."""

import json

import pytest
from reduced_cases import reduced
from robot_chains import fitted

from turgor.cli.app import main
from turgor.cli.exits import BAD_INPUT
from turgor.systems.exports import formats


@pytest.fixture
def file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(formats, "chain_of", lambda *_, **__: fitted())  # made once for all tests
    return reduced().save(tmp_path / "finger.reduced")


def test_every_format_states_its_error(file, capsys):
    asked = ["export", str(file), "--to", "mujoco", "--to", "urdf", "--to", "table", "--to", "fmu", "--to", "sofa"]
    assert main(asked) == 0
    text = capsys.readouterr().out
    for name in (
        "finger.xml",
        "finger.urdf",
        "finger-table.csv",
        "finger-polynomials.json",
        "finger.fmu",
        "finger-sofa",
    ):
        assert (file.parent / "finger-export" / name).exists()
        assert name in text
    assert f"{100 * fitted().error:.2g} % of the length" in text
    assert main(asked) == BAD_INPUT, "they are there already"
    assert "--force" in capsys.readouterr().err
    assert main([*asked, "--force", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["result"]["errors"][0] == fitted().text


@pytest.mark.parametrize(
    ("options", "facts"),
    [
        (["--to", "mujuco"], ("mujuco", "mujoco")),
        ([], ("--to", "mujoco")),
        (["--to", "table", "--stl"], ("--to", "table")),
    ],
)
def test_what_cannot_be_written_is_refused(file, capsys, options, facts):
    assert main(["export", str(file), *options]) == BAD_INPUT
    text = capsys.readouterr().err
    assert [fact for fact in facts if fact not in text] == []
