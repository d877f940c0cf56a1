"""The strips of the example bend as Timoshenko says, and a core that froze keeps its bend."""

import runpy
from pathlib import Path

import pytest

import turgor as tg
from turgor.units import deg

EXAMPLE = runpy.run_path(str(Path(__file__).parents[3] / "examples" / "states_before_loading.py"))


@pytest.mark.parametrize("load", [tg.loads.Shrinkage("upper", 0.005), tg.loads.PreStretch("upper", 1.005)])
def test_layers_bend_like_a_bimetal(load):
    got, exact = EXAMPLE["bent_by"](load)
    assert exact / deg == pytest.approx(-8.59, abs=0.01)
    assert got == pytest.approx(exact, rel=0.04)  # the clamped end holds the width, too


def test_a_frozen_core_keeps_its_bend():
    angles = {name: value / deg for name, value in EXAMPLE["at_the_ends"](EXAMPLE["frozen"]()).items()}
    assert list(angles) == ["melt", "bend", "freeze", "release"]
    assert angles["melt"] == pytest.approx(0, abs=1e-6)
    assert angles["bend"] == pytest.approx(35.2, rel=0.03)
    assert angles["freeze"] == pytest.approx(angles["bend"], abs=1e-6)
    assert angles["release"] == pytest.approx(34.6, rel=0.03)
    assert angles["release"] > 0.95 * angles["freeze"]


def test_hoops_lose_tension_as_the_wall_gives_way():
    at_first, left = EXAMPLE["wound"]()
    assert at_first == pytest.approx(157, abs=0.5)
    assert left == pytest.approx(74, rel=0.03)
