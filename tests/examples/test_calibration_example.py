"""The example and the guides on calibration and uncertainty run, and say what they say."""

import re
import runpy
from pathlib import Path

import matplotlib as mpl
import pytest

ROOT = Path(__file__).parents[2]


def code(page):
    text = (ROOT / "docs" / "howto" / f"{page}.md").read_text(encoding="utf-8")
    return "\n".join(re.findall(r"```python\n(.*?)```", text, re.DOTALL))


def test_a_balloon_is_calibrated(capsys):
    held = runpy.run_path(str(ROOT / "examples" / "calibrated_balloon.py"))
    assert held["found"].values["C10"] == pytest.approx(0.126e6, rel=0.02)  # Pa
    assert held["found"].values["pressure_offset"] == pytest.approx(1.5e3, abs=700)  # Pa, ± 440
    assert "inner stretch at 60 kPa: 1.11 ± 0.0015 (wall) ± 0.0014 (rubber)" in capsys.readouterr().out


def test_the_code_of_the_guide_on_calibration(capsys):
    known = {"__name__": "guide"}
    exec(code("calibrate"), known)
    assert known["found"].values["C10"] == pytest.approx(0.12e6, rel=1e-3)
    assert "C10 = 0.12 MPa" in capsys.readouterr().out


def test_the_code_of_the_guide_on_uncertainty(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    mpl.use("agg")
    known = {"__name__": "guide"}
    text = code("uncertainty")
    exec(text, known)
    (told,) = re.findall(r"# (inner stretch at .*)", text)
    assert told in capsys.readouterr().out
    assert known["found"].band("inner_stretch").shares()["rubber"] == pytest.approx(0.94, abs=0.01)
    assert (tmp_path / "band.png").stat().st_size > 1000
