"""``turgor actuators`` and ``turgor init``: families, their keys, and a job to start from."""

import pytest

from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.job.job import ACTUATORS
from turgor.job.read import read_job


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("command", ["actuators", "init"])
def test_families_are_listed(command, capsys):
    assert main([command]) == DONE
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines[: len(ACTUATORS)]] == list(ACTUATORS)


def test_a_family_is_shown_with_its_source_and_its_keys(capsys):
    assert main(["actuators", "fast_pneunet"]) == DONE
    said = capsys.readouterr().out
    assert "Mosadegh et al. (2014) publish 11 chambers" in said
    assert '\ngap = "1 mm"\n    Distance between neighboring chamber blocks. (length; allowed: 0.01 mm to' in said


@pytest.mark.parametrize("command", ["actuators", "init"])
def test_an_unknown_family_is_answered_with_the_nearest_one(command, capsys):
    assert main([command, "fast_pnuenet"]) == BAD_INPUT
    assert "unknown actuator family 'fast_pnuenet'; did you mean 'fast_pneunet'?" in capsys.readouterr().err


def test_a_job_is_written_once(folder, capsys):
    assert main(["init", "slow_pneunet"]) == DONE
    assert "run it with 'turgor run slow_pneunet.toml'" in capsys.readouterr().out
    assert type(read_job(folder / "slow_pneunet.toml").actuator) is ACTUATORS["slow_pneunet"]
    assert main(["init", "slow_pneunet"]) == BAD_INPUT
    assert "'slow_pneunet.toml' exists; name another file with --output" in capsys.readouterr().err
    assert main(["init", "slow_pneunet", "--force"]) == DONE
    assert main(["init", "slow_pneunet", "--output", "other.toml"]) == DONE
    assert (folder / "other.toml").read_text("utf-8") == (folder / "slow_pneunet.toml").read_text("utf-8")
