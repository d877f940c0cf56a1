"""The balloon goes past its limit point, and the jobs of the guide ask questions that can be answered."""

import re
import runpy
from pathlib import Path

import pytest

import turgor as tg
from turgor.solvers.path_procedures import ArcLength, Auto, GasMass, VolumeControl
from turgor.units import kPa, mL

ROOT = Path(__file__).parents[2]
GUIDE = ROOT / "docs" / "howto" / "limit-points.md"


def test_the_pressure_of_the_balloon_has_a_maximum(capsys):
    found = runpy.run_path(str(ROOT / "examples" / "balloon.py"))
    # 49.3 kPa in an endless tube (exact); caps at its ends make a short one a little stiffer
    assert found["limit"].pressure / kPa == pytest.approx(50.9, rel=0.02)
    assert "The tube holds" in capsys.readouterr().out


def test_the_jobs_of_the_guide_are_read(tmp_path):
    blocks = re.findall(r"```toml\n(.*?)```", GUIDE.read_text(encoding="utf-8"), re.DOTALL)
    whole, *procedures = blocks
    (tmp_path / "job.toml").write_text(whole, encoding="utf-8")
    job = tg.read_job(tmp_path / "job.toml")
    assert job.procedure == VolumeControl(volume=32 * mL)
    assert job.loads == ()
    kinds = []
    for block in procedures:
        head, _ = whole.split("[procedure]")
        loads = "" if "gas_mass" in block else '[loads]\npressure = "60 kPa"\n\n'
        (tmp_path / "job.toml").write_text(f"{head}{loads}{block}", encoding="utf-8")
        kinds.append(type(tg.read_job(tmp_path / "job.toml").procedure))
    assert kinds == [GasMass, ArcLength, Auto]
