"""The inverse network bends the full model as wanted; the code of the guide on learning runs with its reduced model."""

import re
import runpy
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from turgor.units import deg, kPa

ROOT = Path(__file__).parents[2]
GUIDE = ROOT / "docs" / "howto" / "learning.md"


@cache
def example():
    return runpy.run_path(str(ROOT / "examples" / "inverse_network.py"))


def test_the_network_bends_the_full_model_along_the_path():
    names = example()
    assert names["rms"] < 0.02 * names["MOST"]
    assert len(names["full"]) == 4
    for row, angle in names["full"].items():
        assert angle == pytest.approx(names["path"][row], abs=0.02 * names["MOST"])
    assert names["free"] == pytest.approx(4.14 * kPa, rel=0.01)  # for 5°
    assert names["loaded"] == pytest.approx(4.76 * kPa, rel=0.01)  # against 5 mN


def test_derivatives_of_the_network_are_exact():
    names = example()
    weights, way, step = names["trained"].x, np.random.default_rng(0).normal(size=33), 1e-6
    ends = [names["errors"](weights + sign * step * way) for sign in (1, -1)]
    difference = (ends[0] - ends[1]) / (2 * step)
    assert names["slopes"](weights) @ way == pytest.approx(difference, abs=3e-5 * np.abs(difference).max())


def test_the_code_of_the_guide(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    example()["reduced"].save("finger.reduced")
    blocks = re.findall(r"```python\n(.*?)```", GUIDE.read_text("utf-8"), re.DOTALL)
    known = {}
    for block in blocks:
        if "to_torch" not in block:  # these have tests of their own
            exec(block, known)
    assert known["values"].shape == (2, 4)
    assert known["rates"].shape == (2, 4, 2)
    assert known["seen"].shape == known["env"].observation_space.shape
    assert known["vector"].num_envs == 4
    assert known["reduced"].solve({"pressure": 5 * kPa, "tip.vector.3": 0.0}).tip[2] < 0
    assert 1 * deg < np.abs(example()["reached"]).max()
