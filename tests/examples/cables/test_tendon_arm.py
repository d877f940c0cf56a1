"""The bar bends as its cable pulls, less with friction."""

import runpy
from pathlib import Path

ROOT = Path(__file__).parents[3]


def test_friction_takes_its_share_of_the_angle(capsys):
    result = runpy.run_path(str(ROOT / "examples" / "tendon_arm.py"))
    assert 0.85 < result["rubbed"] / result["free"] < 0.95
    assert "a thin bar 48.5 deg" in capsys.readouterr().out
