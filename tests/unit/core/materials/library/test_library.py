"""Library records: what the published rows become, and how a wrong name is answered."""

import re
import tomllib
from importlib.resources import files
from math import inf

import numpy as np
import pytest

from refused import refused
from turgor.core.materials.laws.conventions import ogden_moduli, ogden_terms
from turgor.core.materials.laws.laws import GeneralizedRivlin, Hooke, MooneyRivlin, NeoHooke, Ogden, Yeoh
from turgor.core.materials.library.record import FILE_KEYS, RECORD_KEYS, Record
from turgor.core.materials.library.record_files import references
from turgor.core.materials.library.records import (
    all_records,
    describe,
    find_record,
    from_library,
    law_from_printed,
    library,
    records,
)

#: Rows of Tables 2 and 3 of the review, converted by hand: number of the first reference, then the law in SI units.
#: Ogden's constants of Abaqus are kept as they are there; `Ogden.to_abaqus` must give them back.
ROWS = {
    ("elastosil-m4601", "neo-hooke-polygerinos-2020"): (128, NeoHooke(C10=0.12e6)),
    ("elastosil-m4601", "neo-hooke-connolly-2015"): (127, NeoHooke(C10=0.12e6)),  # printed as mu = 240 kPa
    ("elastosil-m4601", "yeoh-mosadegh-2014"): (47, Yeoh(C10=0.11e6, C20=0.02e6)),
    ("elastosil-m4601", "hooke-alici-2018"): (161, Hooke(E=386.66e3, nu=0.499)),
    ("dragon-skin-10", "neo-hooke-polygerinos-2020"): (128, NeoHooke(C10=42.5e3)),
    ("dragon-skin-10", "neo-hooke-connolly-2017"): (102, NeoHooke(C10=42.5e3)),  # printed as mu = 0.085 MPa
    ("dragon-skin-10", "yeoh-caasenbrood-2020"): (163, Yeoh(C10=36e3, C20=250.0, C30=23.0)),
    ("dragon-skin-10", "ogden-nuthi-2018"): (164, ((180.2e3, -553.8e3, 409.9e3), (-0.1997, 1.4793, 1.8837))),
    ("dragon-skin-10", "hooke-bilodeau-2018"): (165, Hooke(E=120e3, nu=0.499)),
    ("dragon-skin-20", "ogden-nuthi-2018"): (164, ((1307.7e3, -2349.7e3, 1207.5e3), (1.1087, -0.0317, -1.6291))),
    ("dragon-skin-30", "mooney-rivlin-elsayed-2014"): (80, MooneyRivlin(C10=1190.0, C01=23028.0)),
    ("dragon-skin-30", "yeoh-chen-2018"): (158, Yeoh(C10=96e3, C20=9.5e3)),
    ("dragon-skin-30", "yeoh-yang-2020"): (148, Yeoh(C10=114.88e3, C20=1262.0)),
    ("dragon-skin-30", "ogden-milana-2019"): (166, ((75.5e3,), (5.84,))),
    ("dragon-skin-30", "ogden-nuthi-2018"): (164, ((1180.6e3, 874.3e3, -1939.6e3), (1.0698, -1.2370, 0.1347))),
    ("ecoflex-00-10", "generalized-rivlin-kulkarni-2015"): (
        168,
        GeneralizedRivlin.from_names({"C10": -7.48e3, "C01": 19.6e3, "C20": -198.0, "C02": -539.0, "C11": 3210.0}),
    ),
    ("ecoflex-00-30", "yeoh-kulkarni-2015"): (168, Yeoh(C10=12.7e3, C20=423.0, C30=-1.46)),
    ("ecoflex-00-30", "yeoh-elsayed-2014"): (80, Yeoh(C10=5072.0, C20=-331.0, C30=-15.0)),
    ("ecoflex-00-30", "yeoh-yan-2016"): (106, Yeoh(C10=0.11e6, C20=0.02e6)),
    ("ecoflex-00-30", "yeoh-polygerinos-2015"): (81, Yeoh(C10=12662.0, C20=0.0)),
    ("ecoflex-00-30", "yeoh-steck-2019"): (170, Yeoh(C10=17e3, C20=-200.0, C30=23.0)),
    ("ecoflex-00-30", "ogden-agarwal-2016"): (171, ((1887.0, 22250.0, 3574.0), (-3.848, 0.663, 4.225))),
    ("ecoflex-00-30", "ogden-moseley-2016"): (79, ((24361.0, 66.703, 453.81), (1.7138, 7.0679, -3.3659))),
    ("ecoflex-00-30", "ogden-steck-2019"): (170, Ogden(mu=(22e3, 400.0, -2000.0), alpha=(1.3, 5.0, -2.0))),
    ("ecoflex-00-30", "mooney-rivlin-steck-2019"): (170, None),  # 48 and -152 kPa: the initial modulus is negative
    ("ecoflex-00-50", "yeoh-kulkarni-2015"): (168, Yeoh(C10=19e3, C20=900.0, C30=-4.75)),
    ("ecoflex-00-50", "yeoh-chen-2018"): (175, Yeoh(C10=120e3, C20=20e3)),
    ("ecoflex-00-50", "yeoh-xue-2018"): (176, Yeoh(C10=100e3, C20=20e3)),
    ("ecoflex-00-50", "ogden-elsayed-2014"): (80, ((107.9e3, 21.47, -87.1e3), (1.55, 7.86, -1.91))),
    ("smooth-sil-950", "neo-hooke-polygerinos-2020"): (128, NeoHooke(C10=340e3)),
    ("smooth-sil-950", "neo-hooke-connolly-2017"): (102, NeoHooke(C10=340e3)),  # printed as mu = 0.68 MPa
    ("smooth-sil-950", "generalized-rivlin-ellis-2019"): (
        177,
        GeneralizedRivlin.from_names({"C10": 279.3e3, "C01": 10.5e3, "C20": 59.1e3}),
    ),
    ("kevlar-fiber", "hooke-connolly-2015"): (127, Hooke(E=31.067e9, nu=0.36)),
    ("fiber-yarn", "hooke-wang-2016"): (144, Hooke(E=103e9, nu=0.34)),
    ("pbo-fiber", "hooke-nordin-2013"): (145, Hooke(E=5.8e9, nu=0.3)),
    ("silicone-o-ring", "hooke-yan-2016"): (106, Hooke(E=31.067e9, nu=0.36)),
    ("paper", "hooke-polygerinos-2020"): (129, Hooke(E=6.5e9, nu=0.2)),
    ("paper", "hooke-yang-2020"): (148, Hooke(E=1.2e9, nu=0.2)),
    ("fiberglass", "yeoh-polygerinos-2015"): (81, Yeoh(C10=7.9e6, C20=0.0)),
}

#: Number of rows that the tables print for each material, and the references of all its rows together.
PRINTED = {
    "elastosil-m4601": (4, {128, 159, 127, 47, 81, 129, 146, 149, 160, 147, 161}),
    "dragon-skin-10": (5, {128, 102, 162, 163, 164, 165}),
    "dragon-skin-20": (1, {164}),
    "dragon-skin-30": (5, {80, 158, 148, 166, 167, 164}),
    "ecoflex-00-10": (1, {168}),
    "ecoflex-00-30": (9, {139, 168, 80, 169, 106, 81, 170, 149, 171, 172, 79, 173}),
    "ecoflex-00-50": (4, {162, 168, 174, 175, 176, 80, 169}),
    "smooth-sil-950": (3, {128, 102, 177}),
    "kevlar-fiber": (1, {81, 102, 127, 143}),
    "fiber-yarn": (1, {144}),
    "pbo-fiber": (1, {145}),
    "silicone-o-ring": (1, {106}),
    "paper": (2, {129, 143, 148}),
    "fiberglass": (1, {81}),
}

#: D1 as printed [1/MPa].
PRINTED_D1 = {
    ("dragon-skin-10", "ogden-nuthi-2018"): 2.2373,
    ("dragon-skin-20", "ogden-nuthi-2018"): 0.4900,
    ("dragon-skin-30", "ogden-nuthi-2018"): 0.7029,
    ("ecoflex-00-30", "ogden-agarwal-2016"): 2.93,
    ("ecoflex-00-30", "ogden-moseley-2016"): 3.2587,
}


def published(name: str | None = None) -> list[Record]:
    """Records that the review prints; the others are in `test_fitted_records` and `test_larger_library`."""
    return [each for each in (all_records() if name is None else records(name)) if each.quoted_in]


def test_every_record_has_a_row_here() -> None:
    assert [(record.library, record.name) for record in published()] == sorted(
        ROWS, key=lambda row: (row[0], list(ROWS).index(row))
    )


def test_every_row_of_the_tables_is_there() -> None:
    counts = {name: len(published(name)) for name in library() if published(name)}
    assert counts == {name: count for name, (count, _) in PRINTED.items()}
    for name, (_, numbers) in PRINTED.items():
        assert {number for record in records(name) for number in record.references} == numbers, name


@pytest.mark.parametrize(("name", "record"), ROWS)
def test_record_is_the_published_row(name: str, record: str) -> None:
    number, expected = ROWS[name, record]
    printed = find_record(name, record)
    assert printed.references[0] == number
    assert printed.source == references()[number]
    assert re.search(r"(19|20)\d\d", printed.source), "a source has a year"
    assert len(printed.cited_by) == len(printed.references) - 1
    if expected is None:
        return
    material = from_library(name, record=record)
    if isinstance(expected, tuple):  # in Abaqus's convention
        assert printed.convention == "abaqus"
        for given, wanted in zip(material.law.to_abaqus(), expected, strict=True):
            np.testing.assert_allclose(given, wanted, rtol=1e-12)
        assert material.law.shear_modulus == pytest.approx(sum(expected[0]), rel=1e-9)
    elif isinstance(expected, GeneralizedRivlin):
        assert [term[:2] for term in material.law.coefficients] == [term[:2] for term in expected.coefficients]
        np.testing.assert_allclose(
            [term[2] for term in material.law.coefficients], [term[2] for term in expected.coefficients], rtol=1e-12
        )
    else:
        assert type(material.law) is type(expected)
        for field in type(expected).__dataclass_fields__:
            np.testing.assert_allclose(getattr(material.law, field), getattr(expected, field), rtol=1e-12)
    assert printed.quoted_in in material.source.detail
    assert "Xavier" in material.source.detail


def test_bulk_modulus_is_two_over_d1() -> None:
    for record in all_records():
        d1 = PRINTED_D1.get((record.library, record.name))
        assert record.bulk_modulus == (pytest.approx(2e6 / d1, rel=1e-12) if d1 else inf), record.name
    assert from_library("ecoflex-00-30", "ogden-agarwal-2016").bulk_modulus == pytest.approx(682.6e3, rel=1e-4)


def test_a_record_without_a_law_quotes_its_doubt() -> None:
    with refused("mooney-rivlin-steck-2019", "ecoflex-00-30", "M06", "-208 kPa"):
        from_library("ecoflex-00-30", "mooney-rivlin-steck-2019")
    assert find_record("ecoflex-00-30", "mooney-rivlin-steck-2019").printed == "C1 = 48 kPa, C2 = -152 kPa"


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


def test_every_rubber_has_a_density() -> None:
    rubbers = [record for record in published() if record.kind == "rubber" and record.library != "silicone-o-ring"]
    assert len(rubbers) > 30
    assert all(1000 < record.density < 1300 for record in rubbers)


def test_kevlar_has_density_and_diameter() -> None:
    fiber = find_record("kevlar-fiber")
    assert (fiber.density, fiber.diameter) == (1440.0, pytest.approx(0.1778e-3, rel=1e-12))


def test_rubbers_have_the_hardness_of_the_review() -> None:
    """Section 5: Ecoflex 00-10 to 00-50, DragonSkin 10 to 30 A, Smooth-Sil 36 to 60 A, Elastosil M4601 28 A."""
    hardness = {record.library: record.shore_hardness for record in published() if record.shore_hardness}
    assert hardness == {
        "dragon-skin-10": "10 A",
        "dragon-skin-20": "20 A",
        "dragon-skin-30": "30 A",
        "ecoflex-00-10": "00-10",
        "ecoflex-00-30": "00-30",
        "ecoflex-00-50": "00-50",
        "elastosil-m4601": "28 A",
        "smooth-sil-950": "50 A",
    }


def test_no_record_is_chosen_silently() -> None:
    with refused("elastosil-m4601", "4 records", *(record.name for record in records("elastosil-m4601"))):
        from_library("elastosil-m4601")
    assert from_library("kevlar-fiber") == from_library("kevlar-fiber", "hooke-connolly-2015")


@pytest.mark.parametrize(
    ("name", "record", "facts"),
    [
        ("elastosil", None, ("'elastosil'", "'elastosil-m4601'")),
        ("Elastosil M4601", None, ("'Elastosil M4601'", "'elastosil-m4601'")),
        ("Ecoflex 30", None, ("'Ecoflex 30'", "'ecoflex-00-30'")),
        ("steel", None, ("'steel'", "dragon-skin-10", "smooth-sil-950")),
        ("paper", "hooke-yang", ("'hooke-yang'", "'paper'", "'hooke-yang-2020'")),
    ],
)
def test_a_wrong_name_is_answered_with_the_near_match(name: str, record: str | None, facts: tuple) -> None:
    with refused(*facts):
        from_library(name, record=record)


def test_the_second_coefficient_depends_on_the_law() -> None:
    """ "C2" multiplies I1 - 3 squared in Yeoh's law and I2 - 3 in Mooney and Rivlin's."""
    printed = {"C1": 2e3, "C2": 1e3}
    assert law_from_printed("yeoh", "single_index", printed) == Yeoh(C10=2e3, C20=1e3)
    assert law_from_printed("mooney_rivlin", "single_index", printed) == MooneyRivlin(C10=2e3, C01=1e3)


def test_both_conventions_of_ogden() -> None:
    """One term: the energies differ by the factor 2/alpha, and so do the initial moduli."""
    printed = {"mu_1": 10e3, "alpha_1": 4.0}
    assert law_from_printed("ogden", "mu/alpha", printed) == Ogden(mu=(10e3,), alpha=(4.0,))
    assert law_from_printed("ogden", "abaqus", printed) == Ogden(mu=(5e3,), alpha=(4.0,))
    assert ogden_moduli(printed) == {"abaqus": 10e3, "mu/alpha": 20e3}
    for convention, modulus in ogden_moduli(printed).items():
        assert law_from_printed("ogden", convention, printed).shear_modulus == modulus
    with refused("mu_1", "alpha_1", "mu_2", "alpha_2"):
        ogden_terms({"mu_1": 1.0, "alpha_2": 2.0})


@pytest.mark.parametrize(
    ("law", "convention", "printed", "facts"),
    [
        ("yeoh", "single", {"C1": 1.0}, ("'single'", "'single_index'")),
        ("hooke", "shear_modulus", {"E": 1.0}, ("shear_modulus", "'hooke'", "'neo_hooke'")),
        ("neo_hooke", "single_index", {"C2": 1.0}, ("neo_hooke", "single_index", "'C2'")),
        ("yeoh", "single_index", {"C1": 1.0}, ("'C2'", "yeoh")),
        ("hooke", "elastic", {"E": 1.0}, ("'nu'", "hooke")),
        ("ogden", "abaqus", {}, ("Ogden", "mu_1, alpha_1, mu_2, alpha_2", "none")),
    ],
)
def test_a_wrong_convention_is_refused(law: str, convention: str, printed: dict[str, float], facts: tuple) -> None:
    with refused(*facts):
        law_from_printed(law, convention, printed)


def test_files_hold_no_key_that_nothing_reads() -> None:
    folder = files("turgor.core.materials.library").joinpath("data")
    for name in library():
        content = tomllib.loads(folder.joinpath(f"{name}.toml").read_text(encoding="utf-8"))
        assert set(content) <= set(FILE_KEYS)
        for entry in content["records"].values():
            assert set(entry) <= set(RECORD_KEYS)


def test_every_reference_is_used() -> None:
    used = {number for record in all_records() for number in record.references}
    datasheets = {122, 123, 124}
    assert set(references()) == used | datasheets


def test_ogden_records_say_why_their_convention() -> None:
    for record in all_records():
        assert bool(record.convention_reason) == (record.law == "ogden"), record.name


def test_describe_leaves_out_zero_coefficients() -> None:
    assert describe(Yeoh(C10=0.11e6, C20=0.02e6)) == "C10 = 0.11 MPa, C20 = 0.02 MPa"
    assert describe(Hooke(E=6.5e9, nu=0.2)) == "E = 6.5 GPa, nu = 0.2"
    assert describe(Hooke(E=120e3, nu=0.499)) == "E = 0.12 MPa, nu = 0.499"
    assert describe(Ogden(mu=(1e3,), alpha=(2.0,))) == "mu_1 = 0.001 MPa, alpha_1 = 2"
    assert describe(GeneralizedRivlin.from_names({"C10": 1e6, "C11": 2e3})) == "C10 = 1 MPa, C11 = 0.002 MPa"
