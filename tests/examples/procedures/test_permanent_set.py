"""The bender of the example stays as bent as its guide says."""

import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]


@pytest.mark.slow
def test_the_bender_does_not_come_back(capsys):
    result = runpy.run_path(str(ROOT / "examples" / "permanent_set.py"))
    assert (result["top"], result["emptied"], result["rested"]) == pytest.approx((3.76, 0.90, 0.32), abs=0.02)
    assert result["stays"] == pytest.approx(1.035, abs=1e-3)
    assert "stays 3.5 % longer" in capsys.readouterr().out
