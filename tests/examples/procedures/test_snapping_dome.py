"""The dome snaps, and the path comes back to no load with the dome turned over."""

import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]


def test_the_dome_turns_over(capsys):
    result = runpy.run_path(str(ROOT / "examples" / "snapping_dome.py"))
    assert result["snap"].kind == "maximum"
    assert result["force"] * result["snap"].load_factor == pytest.approx(1.28, rel=0.02)
    assert "its crown moves by" in capsys.readouterr().out
