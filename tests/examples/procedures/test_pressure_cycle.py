"""The bender of the example loses what its guide says, and the job of the guide can be asked."""

import re
import runpy
from pathlib import Path

import pytest

import turgor as tg
from turgor.core.materials.history.softening import Mullins
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.model.history import over_time
from turgor.core.solvers.procedures.static import Static

ROOT = Path(__file__).parents[3]
HEAD = """
[actuator]
type = "rectangular_bender"
[mesh]
size = "6 mm"
[materials]
base = { law = "neo_hooke", C10 = "0.1 MPa" }
"""


@pytest.mark.slow
def test_the_first_cycle_loses_more_than_the_second(capsys):
    result = runpy.run_path(str(ROOT / "examples" / "pressure_cycle.py"))
    assert result["lost"] == pytest.approx([28.3, 8.0], abs=0.3)
    assert "the first cycle loses 28.3 %" in capsys.readouterr().out


def test_the_job_of_the_guide_is_read(tmp_path):
    text = (ROOT / "docs" / "howto" / "viscoelasticity.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"```toml\n(.*?)```", text, re.DOTALL)
    (tmp_path / "job.toml").write_text(HEAD + block, encoding="utf-8")
    job = tg.jobs.read_job(tmp_path / "job.toml")
    assert job.procedure == Static(duration=20.0, first_step=0.02, max_step=0.02)
    history = over_time([(0, 0), (5, 1), (10, 0), (15, 1), (20, 0)], 20.0)
    assert job.loads == (tg.Pressure("cavity", 50e3, history),)
    body = job.materials["body"]
    assert body.viscoelasticity == Prony(g=(0.08, 0.05), tau=(2.0, 40.0), moduli="long_term")
    assert body.stress_softening == Mullins(r=4.0, m=5e3)
