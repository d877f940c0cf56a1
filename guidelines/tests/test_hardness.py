"""A guideline from end to end: its quick runs in a process of their own, the judgement, the page, and a second call.

Guideline 7.0-2, softer rubber deforms more, on four of its records of the library. Expected stretch of the tube in
hoops of Elastosil M4601 at 20 kPa: 1.0454, the exact tube in rigid hoops of case V07 of tests/verification; tolerance
0.1 % of it, for the hoops stretch a little.
"""

from dataclasses import replace

import pytest

from turgor.units import kPa
from turgor_guidelines.catalog import guidelines
from turgor_guidelines.guideline import Verdict
from turgor_guidelines.judge import run_guidelines
from turgor_guidelines.page import write_page
from turgor_guidelines.values import at

RUBBERS = ("ecoflex-00-30, yeoh", "dragon-skin-10, neo", "elastosil-m4601, neo", "dragon-skin-30, mooney")


def shortened():
    """The guideline with four runs."""
    guideline = guidelines()["7.0-2"]
    (study,) = guideline.studies
    runs = tuple(run for run in study.runs("quick") if run.name.startswith(RUBBERS))
    return replace(guideline, studies=(replace(study, runs=lambda setting: runs),))


def test_hardness_from_end_to_end(tmp_path, monkeypatch):
    monkeypatch.setenv("TURGOR_CACHE_MB", "0")  # no mesh of an earlier run
    ended, guideline = [], shortened()
    (judged,) = run_guidelines([guideline], tmp_path / "runs", progress=ended.append)
    (study,) = judged.studies
    assert len(ended) == len(study.runs) == 4
    assert not any(each.problem or each.again for each in ended)
    tube = study.runs["elastosil-m4601, neo-hooke-polygerinos-2020"].response
    assert at(tube, "stretch", "pressure", 20 * kPa).number == pytest.approx(1.0454, rel=1e-3)
    assert judged.verdict is Verdict.CONDITIONAL  # one record of a harder rubber is softer
    assert "dragon-skin-30, mooney-rivlin-elsayed-2014" in study.judgement.conditions
    assert "<svg" in write_page([judged], tmp_path).read_text("utf-8")
    run_guidelines([guideline], tmp_path / "runs", progress=ended.append)
    assert [each.again for each in ended[4:]] == [True] * 4
