"""Strength of a material: numbers with sources, read from the files of records and passed on to the material."""

from dataclasses import replace
from pathlib import Path

import pytest

from refused import refused
from turgor.core.materials.library.records import find_record, from_library, read_records
from turgor.core.materials.strength import STRENGTHS, Strength

OURS = """\
name = "Our silicone"

[strength]
elongation_at_break = { value = 9.0, source = "sheet, revision 3" }
tensile_strength = { value = "200 psi", source = "sheet, revision 3", doubts = ["One specimen."] }
tear_strength = { value = "38 pli", source = "sheet, ASTM D624 die B" }

[records.one]
law = "neo_hooke"
convention = "two_index"
parameters = { C10 = "11 kPa" }
source = "us"
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "ours.toml"
    path.write_text(OURS, encoding="utf-8")
    return path


def test_a_file_states_it_and_the_material_has_it(file: Path) -> None:
    strength = find_record(str(file)).strength
    assert strength == from_library(str(file)).strength
    assert strength.elongation_at_break == 9.0
    assert strength.ultimate_stretch == 10.0
    assert strength.tensile_strength == pytest.approx(1.379e6, rel=1e-3)
    assert strength.tear_strength == pytest.approx(6655, rel=1e-3)  # N/m; 1 pound-force per inch is 175.1 N/m
    assert set(strength.sources) == set(STRENGTHS)
    assert strength.sources["tear_strength"].endswith("die B")
    assert strength.doubts == ("One specimen.",)


@pytest.mark.parametrize(
    ("old", "new", "facts"),
    [
        ("value = 9.0", 'value = "900 %"', ("strength.elongation_at_break.value", "'900 %'")),
        ("value = 9.0", "value = -1.0", ("ours.toml: strength", "elongation_at_break", "-1", 0)),
        ('"200 psi"', '"200 mm"', ("strength.tensile_strength.value", "'200 mm'", "pressure")),
        ('"38 pli"', '"38 psi"', ("strength.tear_strength.value", "pli")),
        (', source = "sheet, ASTM D624 die B"', "", ("strength.tear_strength", "'source'")),
        ("tear_strength =", "tear_strengh =", ("strength", "'tear_strengh'", "'tear_strength'")),
    ],
)
def test_a_mistake_is_named(file: Path, old: str, new: str, facts: tuple) -> None:
    assert old in OURS
    file.write_text(OURS.replace(old, new), encoding="utf-8")
    with refused(*facts):
        read_records(file)


def test_a_number_without_a_source_is_refused() -> None:
    with refused("tear_strength", "source"):
        Strength(tear_strength=5e3)
    with refused("'tear_strengh'", "'tear_strength'"):
        replace(Strength(), sources={"tear_strengh": "us"})
    assert Strength().ultimate_stretch is None
