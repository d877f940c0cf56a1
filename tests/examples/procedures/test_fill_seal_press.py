"""The tube of the example rises in pressure as its guide says."""

import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]


def test_a_squeeze_raises_the_pressure(capsys):
    result = runpy.run_path(str(ROOT / "examples" / "fill_seal_press.py"))
    assert (result["force"], result["rise"]) == (pytest.approx(6.52, rel=0.02), pytest.approx(13.7, rel=0.02))
    assert "Each jaw pushes with" in capsys.readouterr().out
