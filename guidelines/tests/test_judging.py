"""Guidelines: values with mesh errors, verdicts, what is chosen, and pages."""

import numpy as np
import pytest

import turgor as tg
from guideline_cases import a_guideline, line, refuses
from turgor_guidelines.catalog import chosen, guidelines
from turgor_guidelines.guideline import Judgement, Verdict, overall
from turgor_guidelines.judge import judged, run_guidelines
from turgor_guidelines.page import write_markdown, write_page
from turgor_guidelines.values import Value, at, falls, largest, last, linearity, rises


def test_a_value_between_two_states_has_its_error():
    response = line(1e-5).response
    value = at(response, "bending_angle", "pressure", 7.5e3)
    assert value.number == pytest.approx(np.degrees(0.075))
    assert value.error == pytest.approx(np.degrees(1.5e-6))
    assert str(Value(92.84, 0.91, "deg")) == "92.84 ± 0.91 deg"
    assert np.isnan(at(response, "bending_angle", "pressure", 11e3).number)
    assert at(response, "bending_angle", "pressure", 0.0).number == 0
    assert last(response, "bending_angle").number == pytest.approx(np.degrees(0.1))


def test_values_differ_by_more_than_their_errors_or_not():
    apart, close = [Value(1, 0.1), Value(2, 0.2), Value(4, 0.1)], [Value(1, 0.6), Value(2, 0.6)]
    assert rises(apart)
    assert falls(apart[::-1])
    assert not falls(apart)
    assert not rises(close)
    assert largest(apart) == 2
    assert not rises([Value(1), Value(np.nan)])


def test_a_straight_line_is_straight():
    assert linearity(line(1e-5).response, "bending_angle", "pressure", 10e3) == pytest.approx(1)


@pytest.mark.parametrize(
    ("verdicts", "expected"),
    [
        (("confirmed", "confirmed"), "confirmed"),
        (("confirmed", "not reproduced"), "confirmed under these conditions"),
        (("not reproduced",), "not reproduced"),
        (("confirmed", "not judged"), "not judged"),
        ((), "not judged"),
    ],
)
def test_the_verdict_of_several_studies(verdicts, expected):
    assert overall(tuple(Judgement(verdict=Verdict(each), finding="") for each in verdicts)) == expected


def test_a_guideline_is_run_judged_and_reported(tmp_path):
    steep, flat = a_guideline(), a_guideline(slopes=(2e-5, 1e-5))
    first, second = run_guidelines([steep, flat], tmp_path / "runs")
    assert (first.verdict, second.verdict) == ("confirmed", "not reproduced")
    assert first.studies[0].judgement.finding == "5.73 ± 0.00011, 11.46 ± 0.00011 deg"
    page = write_page([first, second], tmp_path).read_text(encoding="utf-8")
    assert "Steeper is more &amp; better." in page
    assert "a &lt; b" in page
    assert page.count("<svg") == 2
    text = write_markdown([first], tmp_path).read_text(encoding="utf-8")
    assert "## 9.9-1: confirmed" in text
    assert (tmp_path / "figures" / "guideline-9-9-1-1.png").read_bytes().startswith(b"\x89PNG")


def test_what_was_not_run_or_failed_is_not_judged(tmp_path):
    not_run = judged(a_guideline(), tmp_path, "full")
    assert not_run.verdict == "not judged"
    assert "slope 5e-05: not run yet" in not_run.studies[0].judgement.finding
    (failed,) = run_guidelines([a_guideline(function=refuses)], tmp_path)
    assert failed.verdict == "not judged"
    assert "wall is -1 mm" in failed.studies[0].judgement.finding
    assert "<svg" not in write_page([failed], tmp_path).read_text(encoding="utf-8")


def test_guidelines_are_chosen_by_key_or_section():
    everything = list(guidelines())
    assert everything == [each.key for each in chosen(())]
    assert all(each.key.startswith("7.4-") for each in chosen(["7.4"]))
    assert [each.key for each in chosen(["7.4-5", "7.4-5"])] == ["7.4-5"]
    with pytest.raises(tg.TurgorError) as caught:
        chosen(["7.4-55"])
    assert "'7.4-5'" in str(caught.value)
    with pytest.raises(tg.TurgorError):
        chosen(["7"])


def test_every_guideline_is_complete():
    for key, guideline in guidelines().items():
        assert guideline.key == key
        assert guideline.rule.endswith("."), key
        for study in guideline.studies:
            for setting in ("quick", "full"):
                names = [run.name for run in study.runs(setting)]
                assert names, key
                assert len(set(names)) == len(names), key
