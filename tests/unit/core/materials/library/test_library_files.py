"""Files of records of one's own: they work like the library, and mistakes in them are named with file and key."""

import re
from pathlib import Path

import pytest

from refused import refused
from turgor.core.materials.laws.laws import LAWS, Ogden, Yeoh
from turgor.core.materials.library.doubts import doubts_of
from turgor.core.materials.library.records import find_record, from_library, read_records

OURS = """\
name = "Our silicone"
shore_hardness = "20 A"
density = "1070 kg/m³"

[supplier]
stress_at_stretch_2 = "0.3 MPa"
source = "the maker's datasheet"

[records.may]
law = "yeoh"
convention = "single_index"
parameters = { C1 = "80 kPa", C2 = "1.5 kPa" }
stretch_range = [1.0, 2.5]
source = "our tensile tests of May"

[records.june]
law = "ogden"
convention = "abaqus"
parameters = { mu_1 = "0.16 MPa", alpha_1 = 2.5 }
compressibility = { D1 = "0.5 MPa^-1" }
source = "our tensile tests of June"
cited_by = ["a thesis"]
doubts = ["The room was cold."]
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "ours.toml"
    path.write_text(OURS, encoding="utf-8")
    return path


def test_a_file_works_like_the_library(file: Path) -> None:
    may = from_library(str(file), record="may")
    assert may.law == Yeoh(C10=80e3, C20=1500.0)
    assert (may.name, may.density, may.stretch_range) == ("Our silicone", 1070.0, (1.0, 2.5))
    assert may.source.text == "our tensile tests of May"
    assert may.source.doubts == ()
    assert "Xavier" not in may.source.detail
    june = from_library(str(file), record="june")
    assert june.law == Ogden.from_abaqus(mu=(0.16e6,), alpha=(2.5,))
    assert june.bulk_modulus == 4e6
    assert [doubt.split(":")[0] for doubt in june.source.doubts] == ["M04 stated"]
    assert find_record(str(file), "june").cited_by == ("a thesis",)
    with refused("ours.toml", "2 records", "may", "june"):
        from_library(str(file))


MISTAKES = [
    # (in the file, changed to, what the answer states)
    ('source = "our tensile tests of May"', "references = [inf]", ("records.may", "'references'", "[inf]")),
    ('source = "the maker\'s datasheet"', "reference = [1]", ("supplier", "'references'", "[[1]]")),
    ('name = "Our silicone"\n', "", ("ours.toml", "'name'")),
    ("shore_hardness", "shore_hardnes", ("ours.toml", "'shore_hardnes'", "'shore_hardness'")),
    ('law = "yeoh"', "", ("ours.toml", "records.may", "'law'")),
    ('law = "yeoh"', 'law = "yeo"', ("single_index", "'yeo'", "'yeoh'")),
    ('"80 kPa"', "80", ("ours.toml", "records.may.parameters.C1", 80, "'60 kPa'")),
    ('"80 kPa"', '"80 kpa"', ("records.may.parameters.C1", "'kpa'", "'80 kpa'", "'kPa'")),
    ('"80 kPa"', '"-80 kPa"', ("'may'", "'ours.toml'", "M06", "-160")),
    ('C1 = "80 kPa", ', "", ("'C1'", "yeoh")),
    ('"1070 kg/m³"', '"1070"', ("ours.toml", "records.may.density", "'1070'", "unit")),
    ("[1.0, 2.5]", "[1.5, 2.5]", ("records.may", "stretch_range", "[1.5, 2.5]", "[smallest, largest]")),
    ('source = "our tensile tests of May"', "", ("ours.toml", "records.may", "'source'")),
    ('"0.3 MPa"', '"0.3 mm"', ("ours.toml", "supplier.stress_at_stretch_2", "'0.3 mm'", "pressure")),
    ("alpha_1 = 2.5", 'alpha_1 = "2.5"', ("records.june.parameters.alpha_1", "'2.5'")),
    ('"0.5 MPa^-1"', '"0.5 MPa"', ("records.june.compressibility.D1", "'0.5 MPa'", "'2.93 MPa^-1'")),
    ('"0.5 MPa^-1"', '"-0.5 MPa^-1"', ("records.june.compressibility", "D1", "positive")),
    ('"0.5 MPa^-1"', '"a MPa^-1"', ("records.june.compressibility.D1", "'a MPa^-1'", "unit")),
    ('doubts = ["The', 'doubts = "The', ("ours.toml:23", "TOML")),
    ('cited_by = ["a thesis"]', 'cited_by = "a thesis"', ("records.june", "'cited_by'", "'a thesis'")),
    ("[supplier]", "kind = 'gum'\n[supplier]", ("ours.toml", "kind", "'gum'", "rubber, fiber", "composite")),
]


@pytest.mark.parametrize(("old", "new", "facts"), MISTAKES, ids=[new or old for old, new, _ in MISTAKES])
def test_a_mistake_is_named(file: Path, monkeypatch: pytest.MonkeyPatch, old: str, new: str, facts: tuple) -> None:
    assert old in OURS
    monkeypatch.chdir(file.parent)
    file.write_text(OURS.replace(old, new), encoding="utf-8")
    with refused(*facts):
        _read_all("ours.toml")


def _read_all(path: str) -> None:
    for record in read_records(path):
        from_library(path, record.name)


def test_a_record_of_each_law_is_read(tmp_path: Path) -> None:
    """Gent and Arruda–Boyce come in the form that fits are saved in, their limits without a unit."""
    path = tmp_path / "ours.toml"
    parameters = {"gent": 'mu = "40 kPa", Jm = 39.6', "arruda_boyce": 'mu = "40 kPa", locking_stretch = 3.3'}
    for law, constants in parameters.items():
        record = f'law = "{law}"\nconvention = "canonical"\nsource = "us"\nparameters = {{ {constants} }}\n'
        path.write_text(f'name = "Ours"\n[records.one]\n{record}doubts = ["M02 warning: One mode."]\n')
        material = from_library(str(path))
        assert material.law == LAWS[law](**{"mu": 40e3} | ({"Jm": 39.6} if law == "gent" else {"locking_stretch": 3.3}))
        assert material.source.doubts == ("M02 warning: One mode.",)
        (finding,) = doubts_of(material)
        assert (finding.code, finding.message) == ("M02", "Ours: One mode.")


@pytest.mark.parametrize("law", ["neo_hooke", "neo-hooke", "Neo Hooke"])
def test_a_law_is_spelled_in_a_record_as_on_the_command_line(tmp_path: Path, law: str) -> None:
    path = tmp_path / "ours.toml"
    record = f'law = "{law}"\nconvention = "two_index"\nsource = "us"\nparameters = {{ C10 = "40 kPa" }}\n'
    path.write_text(f'name = "Ours"\n[records.one]\n{record}')
    assert from_library(str(path)).law == LAWS["neo_hooke"](C10=40e3)
    assert read_records(str(path))[0].law == "neo_hooke"


def test_no_file_and_no_text(tmp_path: Path) -> None:
    with refused("none.toml", "no file"):
        from_library("none.toml")
    binary = tmp_path / "binary.toml"
    binary.write_bytes(b"\xff\xfe\x00")
    with refused(binary, "UTF-8"):
        from_library(str(binary))
    empty = tmp_path / "empty.toml"
    empty.write_text("")
    with refused(empty, "table", "one key"):
        from_library(str(empty))


def test_the_file_of_the_guide_is_read(tmp_path: Path) -> None:
    """The indented file in ``docs/howto/own-material.md``."""
    guide = (Path(__file__).parents[5] / "docs" / "howto" / "own-material.md").read_text(encoding="utf-8")
    blocks = re.findall(r"(?:^    .*\n|^\n)+", guide, re.MULTILINE)
    (block,) = (block for block in blocks if "# our-silicone.toml" in block)
    path = tmp_path / "our-silicone.toml"
    path.write_text("\n".join(line[4:] for line in block.splitlines()), encoding="utf-8")
    assert [record.name for record in read_records(path)] == ["yeoh-may", "ogden-thesis"]
    assert from_library(str(path), "yeoh-may").law == Yeoh(C10=80e3, C20=1500.0)
    assert from_library(str(path), "ogden-thesis").law.shear_modulus == pytest.approx(0.16e6)
