"""Designs: full factorials, Latin hypercubes, Sobol points and tables."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.studies import Factor, factorial, latin_hypercube, read_designs, sobol
from turgor.studies.runs.jobs.job_numbers import numbers_of
from turgor.units import mm

WALL = Factor(name="wall", low=1 * mm, high=3 * mm, unit="mm")
CHAMBERS = Factor(name="chambers", low=3, high=6, whole=True)
RUBBER = Factor(name="rubber", levels=("soft", "stiff"))


def test_all_combinations_the_last_factor_first():
    result = factorial([Factor(name="wall", levels=(1 * mm, 2 * mm)), RUBBER])
    assert [tuple(each.values()) for each in result.values] == [
        (1 * mm, "soft"), (1 * mm, "stiff"), (2 * mm, "soft"), (2 * mm, "stiff"),
    ]  # fmt: skip
    with refused("100 × 100 × 100", 1000000, 100000, "TURGOR_MOST_DESIGNS"):
        factorial([Factor(name=name, levels=tuple(range(100))) for name in "abc"])


def test_each_slice_of_a_latin_hypercube_holds_one_sample():
    result = latin_hypercube([WALL, CHAMBERS, RUBBER], 20, seed=3)
    slices = np.floor((result.inputs[:, 0] / mm - 1) / 2 * 20)
    assert sorted(slices) == list(range(20))
    counts = [[each["chambers"] for each in result.values].count(n) for n in (3, 4, 5, 6)]
    assert counts == [5, 5, 5, 5]  # whole numbers have equal room
    assert sum(each["rubber"] == "soft" for each in result.values) == 10
    assert result.values == latin_hypercube([WALL, CHAMBERS, RUBBER], 20, seed=3).values
    assert result.values != latin_hypercube([WALL, CHAMBERS, RUBBER], 20, seed=4).values


@pytest.mark.filterwarnings("error")
def test_sobol_points_fill_every_box_and_go_on():
    """16 points of two factors: one in each of the 4 × 4 boxes, and in each of the 16 slices of either factor."""
    other = Factor(name="height", low=0.0, high=1.0)
    result = sobol([WALL, other], 16, seed=5)
    shares = np.stack([(result.inputs[:, 0] / mm - 1) / 2, result.inputs[:, 1]])
    boxes = set(zip(*np.floor(4 * shares).astype(int).tolist(), strict=True))
    assert len(boxes) == 16
    assert all(sorted(np.floor(16 * each)) == list(range(16)) for each in shares)
    assert sobol([WALL, other], 11, seed=5).values == result.values[:11]


def test_a_table_of_a_user(tmp_path):
    (tmp_path / "designs.csv").write_text("wall (mm),chambers,rubber\n1.5,4,soft\n\n2,6,stiff\n", encoding="utf-8")
    result = read_designs(tmp_path / "designs.csv")
    assert result.values == (
        {"wall": 1.5 * mm, "chambers": 4, "rubber": "soft"}, {"wall": 2 * mm, "chambers": 6, "rubber": "stiff"},
    )  # fmt: skip
    assert [each.unit for each in result.factors] == ["mm", "", ""]
    assert result.factors[1].whole


def test_a_table_with_keys_of_a_job(tmp_path):
    numbers = numbers_of({"actuator": {"wall": "1 mm", "chambers": 4}})
    (tmp_path / "a.csv").write_text("actuator.wall (um),actuator.chambers\n1500,6\n", encoding="utf-8")
    assert read_designs(tmp_path / "a.csv", numbers).values == ({"actuator.wall": 1.5 * mm, "actuator.chambers": 6},)


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("actuator.wall\n1\n", ["'actuator.wall'", "m, cm, mm"]),
        ("actuator.wall (kPa)\n1\n", ["'actuator.wall'", "m, cm, mm"]),
        ("actuator.wall (mm)\nthick\n", ["line 2", "actuator.wall", "'thick'"]),
        ("actuator.wall (mm),b\n1\n", ["line 2", "1 cells", 2]),
        ("actuator.wall (mm)\n", ["no designs"]),
        ("height (millimeter)\n1\n", ["'height'", "'millimeter'", "mm"]),
    ],
)
def test_mistakes_in_a_table(tmp_path, text, facts):
    (tmp_path / "a.csv").write_text(text, encoding="utf-8")
    with refused("a.csv", *facts):
        read_designs(tmp_path / "a.csv", numbers_of({"actuator": {"wall": "1 mm"}}))


def test_mistakes_are_answered(tmp_path):
    with refused("samples", 0, "1 to 100000"):
        sobol([WALL], 0)
    with refused("samples", -1, "1 to 100000"):
        latin_hypercube([WALL], -1)
    with refused("study", "factor"):
        tg.studies.latin_hypercube([], 4)
    with refused(tmp_path / "none.csv"):
        read_designs(tmp_path / "none.csv")
