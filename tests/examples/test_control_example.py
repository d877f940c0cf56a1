"""The example on control: a path is followed to round-off, and a loop with a stiffer finger to a few percent."""

import runpy
from pathlib import Path

import pytest

EXAMPLE = Path(__file__).parents[2] / "examples" / "follow_a_path.py"


def test_follow_a_path():
    names = runpy.run_path(str(EXAMPLE))
    assert names["track"].distance.max() < 1e-5  # rad
    assert names["run"].rms() < 0.02 * names["most"]
    assert names["track"].inputs.max() == pytest.approx(2500.0, rel=1e-3)  # Pa, the pressure of the largest angle
