"""Tables and numbers of studies that are damaged, in another encoding, or ask for too much: a sentence each."""

from pathlib import Path

import pytest

from refused import refused
from turgor.core.results.files.response_csv import read_response
from turgor.studies.runs.designs import latin_hypercube, sobol
from turgor.studies.runs.factor import Factor
from turgor.studies.runs.files.designs_csv import read_designs


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1", "utf-16", "utf-16-le"])
def test_tables_are_read_in_the_encodings_of_spreadsheets(tmp_path, encoding):
    (tmp_path / "designs.csv").write_bytes("wall (µm)\n100\n200\n".encode(encoding))
    assert [each["wall"] for each in read_designs(tmp_path / "designs.csv").values] == pytest.approx([1e-4, 2e-4])
    (tmp_path / "response.csv").write_bytes("pressure_kPa,größe\n0,1\n1,2\n".encode(encoding))
    assert read_response(tmp_path / "response.csv").names == ("pressure", "größe")


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("wall (mm)\n1\nnan\n", ["line 3", "wall", "'nan'"]),
        ("wall (mm)\ninf\n1\n", ["line 2", "wall", "'inf'"]),
        ("wall (mm)\n1\n1e400\n", ["line 3", "wall", "'1e400'"]),
        (f'wall (mm)\n"{"1" * 200_000}"\n2\n', ["line 2", "field limit", 131072]),
        ("wall (mm)\n\0\n", ["byte 0", "UTF-8"]),
        ("", ["empty"]),
    ],
)
def test_damaged_designs_are_answered(tmp_path: Path, text: str, facts: list[str]):
    (tmp_path / "designs.csv").write_text(text, encoding="utf-8")
    with refused("designs.csv", *facts):
        read_designs(tmp_path / "designs.csv")


@pytest.mark.parametrize("rule", [latin_hypercube, sobol])
@pytest.mark.parametrize(("samples", "seed"), [(0, 0), (100_000_000, 0), (10**12, 0), (4, -1)])
def test_numbers_of_samples_have_limits(rule, samples, seed):
    name, value, allowed = ("seed", seed, "0 or more") if seed < 0 else ("samples", samples, "1 to 100000")
    with refused(name, value, allowed):
        rule([Factor(name="wall", low=1e-3, high=2e-3)], samples, seed)


def test_another_limit_of_designs_can_be_stated(monkeypatch):
    monkeypatch.setenv("TURGOR_MOST_DESIGNS", "3")
    with refused("samples", 4, "1 to 3"):
        latin_hypercube([Factor(name="wall", low=1e-3, high=2e-3)], 4, 0)
    monkeypatch.setenv("TURGOR_MOST_DESIGNS", "200000")
    assert len(Factor(name="wall", low=1e-3, high=2e-3).spaced(150_000)) == 150_000


def test_factors_are_finite_and_have_a_limit_of_levels():
    with refused("'wall'", "inf", "finite"):
        Factor(name="wall", low=1e-3, high=float("inf"))
    with refused("'wall'", 1000000000, "1 to 100000"):
        Factor(name="wall", low=1e-3, high=2e-3).spaced(10**9)
