"""The example of a section asserts its number; the code of the guide runs and does what it says."""

import re
import runpy
from pathlib import Path

import pytest

GUIDE = Path(__file__).parents[2] / "docs" / "howto" / "section.md"
EXAMPLES = Path(__file__).parents[2] / "examples"


def test_the_bender_bends_as_its_section_does(capsys):
    runpy.run_path(str(EXAMPLES / "bender_section.py"))
    assert "At 50 kPa, 160 mm of it bend by 28.1 deg, and the cavity is 17% wider." in capsys.readouterr().out


def test_the_code_of_the_guide(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    known = {}
    for block in re.findall(r"```python\n(.*?)```", GUIDE.read_text(encoding="utf-8"), re.DOTALL):
        exec(block, known)
    assert (tmp_path / "section.csv").exists()
    assert known["response"]["curvature_y"][-1] == pytest.approx(0.830, rel=1e-3)  # 0.8300 1/m at 40 kPa
    moments = known["bent"].response["moment_y"]
    assert moments[0] < moments[1] < moments[2]
    assert known["pulled"].response["axial_force"] == pytest.approx(0.5)
    bending = known["pressed"].response
    assert bending["cavity_1_pressure"] == pytest.approx([2e3, 4e3])
    assert bending["curvature"][1] > bending["curvature"][0] > 0
