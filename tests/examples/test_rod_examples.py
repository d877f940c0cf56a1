"""The example of a rod and the code of its how-to page run, and do what they say."""

import re
import runpy
from pathlib import Path

import numpy as np
import pytest

from turgor.units import deg, mm

ROOT = Path(__file__).parents[2]


def test_the_arm_moves_its_tip_aside(capsys):
    result = runpy.run_path(str(ROOT / "examples" / "soft_arm_rod.py"))
    assert result["aside"] / mm == pytest.approx(-34, rel=0.02)
    assert result["joint"] / deg == pytest.approx(29, rel=0.03)
    assert "the tip moves aside by -34 mm" in capsys.readouterr().out
    assert all(result["solution"].stable)


def test_code_of_the_guide_on_rods():
    page = (ROOT / "docs" / "howto" / "rods.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    known: dict = {}
    for block in blocks:
        exec(block, known)
    assert len(blocks) == 3
    assert known["response"]["tip_displacement_z"][-1] < -5 * mm
    platform = known["tg"].rods.static(known["platform"]).tip[-1]
    assert platform[1] < -1e-4, "pressure in the leg at +y bends the platform away from it"
    lying = known["tg"].rods.static(known["lying"])
    weight = 9.80665 * known["section"].mass_per_length * 120 * mm
    assert lying.states[-1].contact.sum() + lying.reaction("base")[2] == pytest.approx(weight)
    assert np.ptp(known["release"].tip[:, 2]) > 5 * mm
