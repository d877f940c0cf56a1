"""The commands ``turgor guidelines list | run | report``: what they print, write and refuse."""

import json

import pytest

from guideline_cases import a_guideline
from turgor.cli import main
from turgor_guidelines import catalog
from turgor_guidelines.catalog import guidelines

DONE, BAD_INPUT, NOT_CONVERGED = 0, 1, 3


@pytest.fixture
def one_rule(monkeypatch):
    """Make a guideline about a line the only one there is."""
    monkeypatch.setattr(catalog, "guidelines", lambda: {"9.9-1": a_guideline()})


@pytest.mark.parametrize("arguments", [[], ["list"]])
def test_every_rule_is_listed(arguments, capsys):
    assert main(["guidelines", *arguments]) == DONE
    printed = capsys.readouterr().out
    for key, guideline in guidelines().items():
        assert f"{key:7}{guideline.rule}" in printed


def test_listed_for_programs(capsys):
    assert main(["guidelines", "list", "7.4-5", "--json"]) == DONE
    (row,) = json.loads(capsys.readouterr().out)["result"]["guidelines"]
    assert (row["key"], row["families"][0]) == ("7.4-5", "fast_pneunet")


def test_an_unknown_rule_is_answered_with_the_near_match(capsys):
    assert main(["guidelines", "run", "7.4-55"]) == BAD_INPUT
    assert "guideline '7.4-55'; did you mean '7.4-5'?" in capsys.readouterr().err


@pytest.mark.usefixtures("one_rule")
def test_what_was_run_is_judged_reported_and_not_run_again(tmp_path, capsys):
    assert main(["guidelines", "run", "--output", str(tmp_path)]) == DONE
    printed = capsys.readouterr()
    assert printed.err.count(": done,") == 2
    assert "9.9-1  CONFIRMED" in printed.out
    assert main(["guidelines", "run", "9.9-1", "--output", str(tmp_path)]) == DONE
    assert capsys.readouterr().err.count(": read,") == 2
    assert main(["guidelines", "report", "--output", str(tmp_path), "--json"]) == DONE
    (row,) = json.loads(capsys.readouterr().out)["result"]["guidelines"]
    assert (row["verdict"], row["studies"][0]["found"]) == ("confirmed", "5.73 ± 0.00011, 11.46 ± 0.00011 deg")
    assert (tmp_path / "guidelines.html").read_text(encoding="utf-8").count("9.9-1") > 1


def test_without_runs_there_is_no_report(tmp_path, capsys):
    assert main(["guidelines", "report", "--output", str(tmp_path / "none")]) == BAD_INPUT
    assert "which has no runs; 'turgor guidelines run' makes them" in capsys.readouterr().err
