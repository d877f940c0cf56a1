"""The bar bends as its heated wire contracts."""

import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]


def test_the_heated_wire_bends_the_bar(capsys):
    result = runpy.run_path(str(ROOT / "examples" / "shape_memory_wire.py"))
    assert result["angle"] == pytest.approx(0.569, rel=0.01)  # rad
    assert "a thin bar 33.1 deg" in capsys.readouterr().out
