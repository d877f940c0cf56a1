"""The bender of the example swings with the frequency of its lowest mode; the job of the guide can be asked."""

import re
import runpy
from pathlib import Path

import pytest

import turgor as tg

ROOT = Path(__file__).parents[3]
HEAD = """
[actuator]
type = "rectangular_bender"
[mesh]
size = "6 mm"
[materials]
body = { law = "neo_hooke", C10 = "0.1 MPa", density = "1070 kg/m³" }
base = { law = "neo_hooke", C10 = "0.1 MPa", density = "1070 kg/m³" }
"""


@pytest.mark.slow
def test_it_swings_beyond_where_it_rests(capsys):
    result = runpy.run_path(str(ROOT / "examples" / "vibrating_bender.py"))
    assert result["swing"] == pytest.approx(20.9, rel=0.02)
    assert 0.25 < result["overshoot"] < 0.4
    assert "the energies balance to 0.0" in capsys.readouterr().out


def test_the_job_of_the_guide_is_read(tmp_path):
    text = (ROOT / "docs" / "howto" / "dynamics.md").read_text(encoding="utf-8")
    (motion,) = re.findall(r"```toml\n(.*?)```", text, re.DOTALL)
    (tmp_path / "motion.toml").write_text(HEAD + motion, encoding="utf-8")
    moving = tg.jobs.read_job(tmp_path / "motion.toml")
    assert moving.procedure == tg.Dynamic(duration=0.5, stiffness_damping=1e-3)
    assert moving.loads == (tg.Pressure("cavity", 20e3, tg.over_time([(0, 0), (0.02, 1), (0.5, 1)], 0.5)),)
