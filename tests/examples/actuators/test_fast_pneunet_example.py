"""The example script curls up; with three chambers and a quarter of its pressure it runs always."""

import runpy
from pathlib import Path

import pytest

from turgor.units import deg, kPa, mL

EXAMPLE = Path(__file__).parents[3] / "examples" / "fast_pneunet.py"


def test_three_chambers_bend_at_6_kPa(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)  # the script writes response.csv where it runs
    script = EXAMPLE.read_text(encoding="utf-8")
    for old, new in (("22.5 * kPa", "6 * kPa"), ("FastPneuNet()", "FastPneuNet(chambers=3, length=31 * mm)")):
        assert script.count(old) == 1
        script = script.replace(old, new)
    Path("fast_pneunet.py").write_text(script, encoding="utf-8")
    response = runpy.run_path("fast_pneunet.py")["response"]
    assert response.column("bending_angle")[-1] / deg == pytest.approx(15.16, rel=0.005)
    assert response.column("cavity_volume")[0] / mL == pytest.approx(3.396, rel=1e-6)  # from the dimensions
    assert "Reached 6 kPa" in capsys.readouterr().out
    assert Path("response.csv").read_text(encoding="utf-8").startswith("load_factor,pressure_kPa,bending_angle_deg")


@pytest.mark.slow
def test_fast_pneunet_turns_two_thirds(tmp_path, monkeypatch):
    """Its walls meet at 6 kPa and push each other apart from there."""
    monkeypatch.chdir(tmp_path)
    ran = runpy.run_path(str(EXAMPLE))
    response, solution = ran["response"], ran["solution"]
    assert response.column("bending_angle")[-1] / deg == pytest.approx(250.1, rel=0.005)
    assert response.column("cavity_volume")[0] / mL == pytest.approx(12.34, rel=1e-6)  # from the dimensions
    touching = [state.touches["self"].area > 0 for state in solution.states[1:]]
    meet = response.column("pressure")[1:][touching][0] / kPa
    assert 5 < meet < 7
    assert all(touching[touching.index(True) :])
    assert max(state.touches["self"].share for state in solution.states[1:]) <= 1.0  # 1 % of the cell behind
    assert solution.findings == ()
