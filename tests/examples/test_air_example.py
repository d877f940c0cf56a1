"""The example of a network asserts its numbers; the code of the guide runs and does what it says."""

import re
from pathlib import Path

import pytest

import turgor as tg

ROOT = Path(__file__).parents[2]
GUIDE = ROOT / "docs" / "howto" / "air.md"


def test_the_finger_is_limited_by_its_tube():
    given = tg.air.read_air(ROOT / "examples" / "air_finger.toml")
    result = tg.air.performance(given.network, **given.performance)
    assert result.fill_time == pytest.approx(0.0566, rel=0.01)  # s, with 8 ms of delay
    assert result.vent_time == pytest.approx(0.225, rel=0.01)  # s
    assert result.limiting.part == "tube"
    for line in re.findall(r"    (.* twice as wide: .*)", GUIDE.read_text("utf-8")):
        assert line in result.text


def test_the_code_of_the_guide(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    known = {}
    for block in re.findall(r"```python\n(.*?)```", GUIDE.read_text(encoding="utf-8"), re.DOTALL):
        if "tg.reduce" not in block:  # test_air_motion trains one
            exec(block, known)
    assert (tmp_path / "air.csv").exists()
    assert (tmp_path / "air.png").exists()
    assert known["result"].limiting.part == "tube"
    assert known["run"].pressure("actuator").max() > 10e3
    assert known["fan"].pressure("box")[-1] == pytest.approx(500.0, abs=1.0)
