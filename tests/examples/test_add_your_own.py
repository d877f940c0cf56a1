"""A law, an actuator and a measure from outside the package, in one file, go through every door."""

import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def test_own_parts_need_no_change_in_the_package():
    found = runpy.run_path(str(ROOT / "examples" / "add_your_own.py"))
    assert found["risen"]["Exponential"] == pytest.approx(3.20, rel=0.02)
    # a law whose exponent is tiny is the neo-Hookean one
    law = found["Exponential"](mu=0.2e6, b=1e-6)
    assert float(law.energy(4.0, 4.0)) == pytest.approx(0.1e6, rel=1e-5)
