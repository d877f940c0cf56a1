"""The extender of the guide on tearing lives as long as the guide shows; the tables of the guide are read."""

import re
import tomllib
from pathlib import Path

import pytest
from run_example import JOBS, solve_job

import turgor as tg
from turgor.core.materials.failure_tables import read_crack_growth
from turgor.job.read import read_job

GUIDE = Path(__file__).parents[2] / "docs" / "howto" / "tearing.md"


def test_an_extender_in_hoops_lives_for_a_hundred_thousand_cycles():
    response = solve_job(read_job(JOBS.parent / "extender_life.toml"))
    assert response["pressure"][-1] == pytest.approx(40e3)
    assert response["tearing_energy"][-1] == pytest.approx(107, rel=0.02)  # J/m² at 40 kPa
    assert response["log_cycles_to_tear"][-1] == pytest.approx(5.0, abs=0.05)  # 10⁵ cycles
    assert response["break_share"][-1] == pytest.approx(0.206, rel=0.02)


def test_the_tables_of_the_guide_are_read():
    text = GUIDE.read_text(encoding="utf-8")
    blocks = re.findall(r"```toml\n(.*?)```", text, re.DOTALL)
    parts = tg.jobs.read_job(JOBS.parent / "extender_life.toml")
    stated = tomllib.loads(blocks[0])
    assert stated["materials"]["body"]["strength"]["elongation_at_break"] == 9.0
    assert parts.materials["body"].strength.elongation_at_break == 9.0
    assert parts.fibers["hoops"].material.strength.tensile_strength == 3e9
    growths = [read_crack_growth(tomllib.loads(block)["crack_growth"]) for block in blocks[1:3]]
    assert growths[0] == parts.materials["body"].crack_growth
    assert growths[1].exponent == 2.5
    names = {}
    exec(re.findall(r"```python\n(.*?)```", text, re.DOTALL)[0], names)
    assert names["rubber"].strength.ultimate_stretch == 10.0
