"""The guide on sweeps runs, and its study file is that of the examples."""

import re
import tomllib
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest

import turgor as tg
from turgor.units import kPa, mm

ROOT = Path(__file__).parents[2]
GUIDE = (ROOT / "docs" / "howto" / "sweep.md").read_text(encoding="utf-8")


def test_the_code_of_the_guide(tmp_path, monkeypatch, capsys):
    """The stretch of a sphere is a function of the ratio of its radii alone: 8 mm with 2 mm is 16 mm with 4 mm."""
    monkeypatch.chdir(tmp_path)
    mpl.use("agg")
    known = {"__name__": "guide"}
    first, second = re.findall(r"```python\n(.*?)```", GUIDE, re.DOTALL)
    exec(first, known)
    study = known["study"]
    assert len(study) == 6
    result = study.column("inner_stretch", ("pressure", 20 * kPa))
    stretch = dict(zip(map(tuple, np.round(study.inputs / mm, 6)), result, strict=True))
    assert stretch[2.0, 10.0] == pytest.approx(1.076, abs=1e-3)
    same = tg.sweep(known["inflated"], known["sphere"], wall=[4 * mm], inner_radius=[20 * mm])
    assert same.column("inner_stretch")[0] == pytest.approx(stretch[2.0, 10.0], rel=1e-6)
    assert (tmp_path / "spheres.png").stat().st_size > 1000
    assert len(tg.studies.load_study("spheres.csv")) == 6
    exec(second, known)
    assert capsys.readouterr().out.splitlines()[-1] == "16 ()"


def test_the_study_file_of_the_guide():
    shown = tomllib.loads(re.findall(r"```toml\n(.*?)```", GUIDE, re.DOTALL)[0])
    assert shown == tomllib.loads((ROOT / "examples" / "bellows_study.toml").read_text(encoding="utf-8"))
    plan = tg.studies.read_study_file(ROOT / "examples" / "bellows_study.toml").sweep
    assert len(plan.designs) == 12
    assert plan.at == ("pressure", 3 * kPa)
