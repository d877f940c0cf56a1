"""The example script runs as it stands, and bends as far as the mesh study says."""

import runpy
from pathlib import Path

import pytest

from turgor.units import deg, mL

EXAMPLE = Path(__file__).parents[2] / "examples" / "fast_pneunet.py"


def test_fast_pneunet_bends_a_right_angle_at_6_kPa(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)  # the script writes response.csv where it runs
    response = runpy.run_path(str(EXAMPLE))["response"]
    assert response.column("bending_angle")[-1] / deg == pytest.approx(92.8, rel=0.005)  # 94.6 on the finest mesh
    assert response.column("cavity_volume")[0] / mL == pytest.approx(12.34, rel=1e-6)  # from the dimensions
    assert "Reached 6 kPa" in capsys.readouterr().out
    assert (
        (tmp_path / "response.csv").read_text(encoding="utf-8").startswith("load_factor,pressure_kPa,bending_angle_deg")
    )
