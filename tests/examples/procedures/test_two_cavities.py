"""The example with two cavities runs as it stands, and the job of the guide asks a question that can be answered."""

import re
import runpy
from pathlib import Path

import pytest

import turgor as tg
from turgor.units import deg, kPa

ROOT = Path(__file__).parents[3]


@pytest.mark.slow
def test_one_cavity_bends_and_the_other_straightens(capsys):
    response = runpy.run_path(str(ROOT / "examples" / "two_cavities.py"))["response"]
    angle = response.column("bending_angle") / deg
    half_way = list(response.column("load_factor")).index(0.5)
    assert angle.argmax() == half_way
    assert angle[half_way] == pytest.approx(12.0, rel=0.03)
    assert response.column("cavity_2_pressure")[half_way] == 0
    assert "Reached cavity_1 50 kPa, cavity_2 50 kPa (load factor 1)" in capsys.readouterr().out


def test_the_job_of_the_guide_is_read(tmp_path):
    text = (ROOT / "docs" / "howto" / "several-cavities.md").read_text(encoding="utf-8")
    job = re.findall(r"```toml\n(.*?)```", text, re.DOTALL)[0]
    (tmp_path / "job.toml").write_text(job, encoding="utf-8")
    one, two = tg.jobs.read_job(tmp_path / "job.toml").loads
    assert one == tg.Pressure("cavity_1", 50 * kPa, history=((0, 0), (0.5, 1), (1, 0)))
    assert two == tg.Pressure("cavity_2", 20 * kPa, history=((0, 0), (0.5, 0), (1, 1)))
    (statement,) = re.findall(r"```python\nloads = (.*?)```", text, re.DOTALL)
    assert eval(statement, {"tg": tg, "kPa": kPa}) == [one, two]
