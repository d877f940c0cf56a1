"""Tables and numbers of studies that are damaged, in another encoding, or ask for too much: a sentence each."""

from pathlib import Path

import pytest

from turgor.core.results.files.response_csv import read_response
from turgor.foundation.errors import TurgorError
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
    ("text", "said"),
    [
        ("wall (mm)\n1\nnan\n", "line 3: wall: 'nan' is not finite"),
        ("wall (mm)\ninf\n1\n", "line 2: wall: 'inf' is not finite"),
        ("wall (mm)\n1\n1e400\n", "line 3: wall: '1e400' is not finite"),
        (f'wall (mm)\n"{"1" * 200_000}"\n2\n', "this is no table: field larger than field limit"),
        ("wall (mm)\n\0\n", "is no text file"),
        ("", "is empty"),
    ],
)
def test_damaged_designs_are_answered(tmp_path: Path, text: str, said: str):
    (tmp_path / "designs.csv").write_text(text, encoding="utf-8")
    with pytest.raises(TurgorError, match=said):
        read_designs(tmp_path / "designs.csv")


@pytest.mark.parametrize("rule", [latin_hypercube, sobol])
@pytest.mark.parametrize(("samples", "seed"), [(0, 0), (100_000_000, 0), (10**12, 0), (4, -1)])
def test_numbers_of_samples_have_limits(rule, samples, seed):
    with pytest.raises(TurgorError, match=r"is -?\d+; allowed is"):
        rule([Factor(name="wall", low=1e-3, high=2e-3)], samples, seed)


def test_another_limit_of_designs_can_be_stated(monkeypatch):
    monkeypatch.setenv("TURGOR_MOST_DESIGNS", "3")
    with pytest.raises(TurgorError, match="samples is 4; allowed is 1 to 3;"):
        latin_hypercube([Factor(name="wall", low=1e-3, high=2e-3)], 4, 0)
    monkeypatch.setenv("TURGOR_MOST_DESIGNS", "200000")
    assert len(Factor(name="wall", low=1e-3, high=2e-3).spaced(150_000)) == 150_000


def test_factors_are_finite_and_have_a_limit_of_levels():
    with pytest.raises(TurgorError, match="'wall' has a value that is not finite"):
        Factor(name="wall", low=1e-3, high=float("inf"))
    with pytest.raises(TurgorError, match="levels of 'wall' is 1000000000; allowed is 1 to 100000"):
        Factor(name="wall", low=1e-3, high=2e-3).spaced(10**9)
