"""The commands ``turgor guidelines list | run | report``: what they print, write and refuse."""

import json

import pytest
from study_cases import line

from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE, NOT_CONVERGED
from turgor.guidelines.catalog import guidelines
from turgor.studies.runs.files.run_files import keep


def keep_lines(key: str, folder, slopes) -> None:
    """Put straight lines where the runs of a guideline are kept."""
    (study,) = guidelines()[key].studies
    for run, slope in zip(study.runs("quick"), slopes, strict=True):
        keep(run, line(slope), folder / "runs")


@pytest.mark.parametrize("arguments", [[], ["list"]])
def test_every_rule_is_listed(arguments, capsys):
    assert main(["guidelines", *arguments]) == DONE
    said = capsys.readouterr().out
    for key, guideline in guidelines().items():
        assert f"{key:7}{guideline.rule}" in said


def test_listed_for_programs(capsys):
    assert main(["guidelines", "list", "7.4-5", "--json"]) == DONE
    (told,) = json.loads(capsys.readouterr().out)["result"]["guidelines"]
    assert (told["key"], told["families"][0]) == ("7.4-5", "fast_pneunet")


def test_an_unknown_rule_is_answered_with_the_near_match(capsys):
    assert main(["guidelines", "run", "7.4-55"]) == BAD_INPUT
    assert "guideline '7.4-55'" in capsys.readouterr().err


def test_what_was_run_is_judged_and_reported(tmp_path, capsys):
    keep_lines("7.4-5", tmp_path, (1e-5, 2e-5, 3e-5))
    assert main(["guidelines", "report", "7.4-5", "--output", str(tmp_path), "--json"]) == DONE
    (told,) = json.loads(capsys.readouterr().out)["result"]["guidelines"]
    assert told["verdict"] in ("confirmed", "confirmed under these conditions", "not reproduced", "not judged")
    assert (tmp_path / "guidelines.html").read_text(encoding="utf-8").count("7.4-5") > 1


def test_what_has_ended_is_not_run_again(tmp_path, capsys):
    keep_lines("7.4-5", tmp_path, (1e-5, 2e-5, 3e-5))
    assert main(["guidelines", "run", "7.4-5", "--output", str(tmp_path)]) in (DONE, NOT_CONVERGED)
    said = capsys.readouterr()
    assert said.err.count(": read,") == 3
    assert "7.4-5  " in said.out


def test_without_runs_there_is_no_report(tmp_path, capsys):
    assert main(["guidelines", "report", "--output", str(tmp_path / "none")]) == BAD_INPUT
    assert "which has no runs; 'turgor guidelines run' makes them" in capsys.readouterr().err
