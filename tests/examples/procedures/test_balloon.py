"""The balloon goes past its limit point."""

import runpy
from pathlib import Path

import pytest

from turgor.units import kPa

ROOT = Path(__file__).parents[3]


def test_the_pressure_of_the_balloon_has_a_maximum(capsys):
    result = runpy.run_path(str(ROOT / "examples" / "balloon.py"))
    # 49.3 kPa in an endless tube (exact); caps at its ends make a short one a little stiffer
    assert result["limit"].pressure / kPa == pytest.approx(50.9, rel=0.02)
    assert "The tube holds" in capsys.readouterr().out
