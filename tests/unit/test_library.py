"""Library records: what the published rows become, and how a wrong name is answered."""

import re
import tomllib
from importlib.resources import files

import pytest

from turgor.errors import TurgorError
from turgor.materials.laws import Hooke, MooneyRivlin, NeoHooke, Yeoh
from turgor.materials.records import LAWS, describe, from_library, law_from_printed, library, records

#: Rows of Tables 2 and 3 of the review, converted by hand.
ROWS = {
    ("elastosil-m4601", "yeoh-mosadegh-2014"): Yeoh(C10=0.11e6, C20=0.02e6),
    ("elastosil-m4601", "neo-hooke-polygerinos-2020"): NeoHooke(C10=0.12e6),
    ("elastosil-m4601", "neo-hooke-connolly-2015"): NeoHooke(C10=0.12e6),  # printed as mu = 240 kPa
    ("paper", "hooke-polygerinos-2020"): Hooke(E=6.5e9, nu=0.2),
    ("paper", "hooke-yang-2020"): Hooke(E=1.2e9, nu=0.2),
}


def test_every_record_has_a_row_here() -> None:
    assert {(name, record.name) for name in library() for record in records(name)} == set(ROWS)


@pytest.mark.parametrize(("name", "record"), ROWS)
def test_record_is_the_published_row(name: str, record: str) -> None:
    material = from_library(name, record=record)
    assert material.law == ROWS[name, record]
    assert material.incompressible
    assert re.search(r"(19|20)\d\d", material.source.text), "a source has a year"
    assert "Table" in material.source.detail
    assert "Xavier" in material.source.detail


def test_the_same_rubber_has_the_same_shear_modulus_in_both_neo_hookean_rows() -> None:
    """Table 2 prints one as C1 = 0.12 MPa and the other as mu = 240 kPa: conversion must make them equal."""
    one = from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020").law
    other = from_library("elastosil-m4601", record="neo-hooke-connolly-2015").law
    assert one.shear_modulus == other.shear_modulus == 240e3


def test_source_shows_printed_and_canonical_constants() -> None:
    detail = from_library("elastosil-m4601", record="neo-hooke-connolly-2015").source.detail
    assert "mu = 240 kPa" in detail
    assert "C10 = 0.12 MPa" in detail


def test_density_comes_with_its_doubt_and_only_where_it_is_known() -> None:
    rubber = from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
    assert rubber.density == 1130.0
    assert any("second-hand" in doubt for doubt in rubber.source.doubts)
    assert from_library("paper", record="hooke-polygerinos-2020").density == 750.0
    assert from_library("paper", record="hooke-yang-2020").density is None


def test_no_record_is_chosen_silently() -> None:
    with pytest.raises(TurgorError, match="has 3 records; choose one with record: yeoh-mosadegh-2014") as error:
        from_library("elastosil-m4601")
    assert all(record.name in str(error.value) for record in records("elastosil-m4601"))


@pytest.mark.parametrize(
    ("name", "record", "sentence"),
    [
        ("elastosil", None, "unknown library material 'elastosil'; did you mean 'elastosil-m4601'?"),
        ("Elastosil M4601", None, "unknown library material 'Elastosil M4601'; did you mean 'elastosil-m4601'?"),
        ("steel", None, "unknown library material 'steel'. Known: elastosil-m4601, paper."),
        (
            "paper",
            "hooke-yang",
            "unknown record 'hooke-yang' of 'paper'; did you mean 'hooke-yang-2020'? Known: hooke-",
        ),
    ],
)
def test_a_wrong_name_is_answered_with_the_near_match(name: str, record: str | None, sentence: str) -> None:
    with pytest.raises(TurgorError, match=f"^{re.escape(sentence)}"):
        from_library(name, record=record)


def test_the_second_coefficient_depends_on_the_law() -> None:
    """ "C2" multiplies I1 - 3 squared in Yeoh's law and I2 - 3 in Mooney and Rivlin's."""
    printed = {"C1": 2e3, "C2": 1e3}
    assert law_from_printed("yeoh", "single_index", printed) == Yeoh(C10=2e3, C20=1e3)
    assert law_from_printed("mooney_rivlin", "single_index", printed) == MooneyRivlin(C10=2e3, C01=1e3)


@pytest.mark.parametrize(
    ("law", "convention", "printed", "sentence"),
    [
        ("yeoh", "single", {"C1": 1.0}, "unknown convention 'single'; did you mean 'single_index'?"),
        ("hooke", "shear_modulus", {"E": 1.0}, "unknown law for the convention shear_modulus 'hooke'"),
        ("neo_hooke", "single_index", {"C2": 1.0}, "unknown constant of neo_hooke in the convention single_index 'C2'"),
    ],
)
def test_a_wrong_convention_is_refused(law: str, convention: str, printed: dict[str, float], sentence: str) -> None:
    with pytest.raises(TurgorError, match=f"^{re.escape(sentence)}"):
        law_from_printed(law, convention, printed)


def test_files_hold_no_key_that_nothing_reads() -> None:
    material = {"name", "density", "records"}
    record = {"law", "parameters", "convention", "software", "source", "quoted_in", "also_in", "density", "doubts"}
    folder = files("turgor.materials").joinpath("library")
    for name in library():
        content = tomllib.loads(folder.joinpath(f"{name}.toml").read_text(encoding="utf-8"))
        assert set(content) <= material
        for entry in content["records"].values():
            assert set(entry) <= record
            assert entry["law"] in LAWS


def test_describe_leaves_out_zero_coefficients() -> None:
    assert describe(Yeoh(C10=0.11e6, C20=0.02e6)) == "C10 = 0.11 MPa, C20 = 0.02 MPa"
    assert describe(Hooke(E=6.5e9, nu=0.2)) == "E = 6.5 GPa, nu = 0.2"
