"""The library beyond the tables of the review: counts, sources, strengths, what is computed from one number, choice."""

import re
from pathlib import Path

import numpy as np
import pytest

from refused import refused
from turgor.core.materials.failure_tables import failure_tables, read_strength
from turgor.core.materials.laws.laws import Hooke, NeoHooke
from turgor.core.materials.laws.pull import pull
from turgor.core.materials.library.choose import choose, material_rows
from turgor.core.materials.library.reasons import why_taken
from turgor.core.materials.library.record_files import all_records, library, records
from turgor.core.materials.library.record_text import describe_material
from turgor.core.materials.library.records import find_record, from_library, recommended
from turgor.core.materials.library.spread import LEAST, spread_of, typical_spread
from turgor.core.materials.material import Material

RUBBERS = [name for name in library() if records(name)[0].kind == "rubber" and name != "silicone-o-ring"]
STIFF = [name for name in library() if records(name)[0].kind != "rubber"]
LAWS = [each for each in all_records() if each.library in RUBBERS and each.stretch_range and each.law != "hooke"]


def test_there_are_thirty_rubbers_and_fifteen_reinforcements() -> None:
    assert len(RUBBERS) >= 45
    assert len(STIFF) >= 20
    page = (Path(__file__).parents[5] / "docs" / "materials.md").read_text(encoding="utf-8")
    assert f"{len(RUBBERS)} rubbers and {len(STIFF)} reinforcements" in page
    families = ("ecoflex", "dragon-skin", "mold-star", "sylgard", "natural-rubber", "ninjaflex", "filaflex", "agilus")
    for family in (*families, "formlabs", "elastosil", "paper", "pet-film", "kevlar", "nylon", "cotton", "carbon"):
        assert any(name.startswith(family) for name in library()), family


def test_every_record_says_where_its_numbers_came_from() -> None:
    for record in all_records():
        named = re.search(r"(19|20)\d\d|maker|Smooth-On|DuPont|Formlabs|Table|repository|github", record.source)
        assert named, (record.library, record.name, record.source)
        assert record.convention_reason or record.law != "ogden"


@pytest.mark.parametrize("record", LAWS, ids=lambda each: f"{each.library}-{each.name}")
def test_a_law_rises_over_the_stretches_of_its_tests(record) -> None:
    stretch = np.linspace(*record.stretch_range, 60)
    stress = pull(record.build_law(), "uniaxial", stretch)
    assert (np.diff(stress) > 0).all()
    assert stress[stretch > 1.01].min() > 0 > stress[stretch < 0.99].min(initial=-1.0)


def test_what_is_computed_from_one_number_of_the_maker() -> None:
    """A neo-Hookean rubber has 2 C10 (2 - 1/4) = 3.5 C10 at stretch 2, and the modulus 6 C10 = 3 mu at rest."""
    for name in ("ecoflex-00-20", "dragon-skin-15"):
        record = find_record(name)
        stress = 3.5 * record.build_law().C10
        assert stress == pytest.approx(record.supplier.stress_at_stretch_2, rel=1e-4)
    stated = [each for each in all_records() if "mu = E / 3" in each.source]
    assert len(stated) == 6
    for record in stated:
        (modulus,) = re.findall(r"([\d.]+) MPa", record.source)
        assert 3 * record.build_law().shear_modulus == pytest.approx(float(modulus) * 1e6, rel=1e-3), record.name
        assert record.stated_doubts


def test_the_rows_of_the_bulletins() -> None:
    """Ecoflex 00-30: 200 psi, 900 %, 38 pli. One pound-force per inch is 175.127 N/m."""
    material = from_library("ecoflex-00-30", "yeoh-kulkarni-2015")
    assert material.strength.ultimate_stretch == 10.0
    assert material.strength.tensile_strength == pytest.approx(1.37895e6, rel=1e-5)
    assert material.strength.tear_strength == pytest.approx(38 * 175.127, rel=1e-5)
    supplier = find_record("dragon-skin-30", "yeoh-chen-2018").supplier
    assert (supplier.mixing, supplier.cure) == ("1A:1B by weight or volume", "pot life 45 min, cured in 16 h, at 23 °C")
    softer = [records(name)[0].strength.elongation_at_break for name in ("dragon-skin-10", "dragon-skin-20")]
    assert softer == [10.0, 6.2]


def test_strengths_have_sources_and_none_is_the_crosshead_of_a_soft_rubber() -> None:
    """Marechal's strains at break are up to 1.8 times those of the makers: no elongation comes from them."""
    known = {record.library: record.strength for record in all_records() if record.strength is not None}
    assert len(known) >= 50
    for name, given in known.items():
        assert all(given.sources[each] for each in given.sources), name
        assert "Marechal" not in given.sources.get("elongation_at_break", ""), name
        tables = failure_tables(Material(name=name, law=NeoHooke(C10=1e5), strength=given))
        assert read_strength(tables["strength"]) == given, "a lock file repeats it"


def test_a_strength_may_have_one_source_for_all_numbers() -> None:
    ours = read_strength({"elongation_at_break": 4.0, "tear_strength": "5 kN/m", "source": "us"})
    assert (ours.elongation_at_break, ours.tear_strength, set(ours.sources.values())) == (4.0, 5e3, {"us"})


@pytest.mark.parametrize("name", ["hatchbox-tpu", "ninjatek-cheetah", "sainsmart-tpu"])
def test_a_print_has_a_set_for_small_and_one_for_large_stretches(name: str) -> None:
    small, large = records(name)
    assert recommended(name) is small
    assert small.stretch_range[1] < large.stretch_range[1]
    inside = [float(pull(each.build_law(), "uniaxial", np.array([1.4]))[0]) for each in (small, large)]
    assert inside[0] == pytest.approx(inside[1], rel=0.2)
    assert next(row.record for row, _ in choose(1e6, 2.0) if row.name == name) == large.name
    assert next(row.record for row, _ in choose(1e6, 1.3) if row.name == name) == small.name


def test_choice_by_hardness_and_by_what_the_actuator_sees() -> None:
    soft = [row.name for row, _ in choose(hardness="00-30")]
    assert soft[0] == "ecoflex-00-30"
    assert set(soft) == {"ecoflex-00-20", "ecoflex-00-30", "ecoflex-00-35"}
    assert next(row.name for row, _ in choose(hardness="OO 35")) == "ecoflex-00-35"
    ten = choose(190e3, hardness="10A")
    assert {row.hardness for row, _ in ten} == {"2 A", "5 A", "10 A", "15 A", "16 A", "20 A"}
    assert ten[0][0].name == "mold-star-16"
    far = [row.name for row, _ in choose(600e3, reach=5.0)]
    assert "dragon-skin-30" not in far, "it breaks at 4.64"
    assert "dragon-skin-20" in far
    order = [row.name for row, _ in choose(180e3)]
    assert order.index("agilus30") > order.index("smooth-sil-950"), "its set ends at a stretch of 1.1"
    for arguments, facts in (((), ("modulus", "hardness")), ((1e5, 2.0, "soft"), ("'soft'", "'10 A'"))):
        with refused(*facts):
            choose(*arguments[:2], hardness=arguments[2] if arguments[2:] else "")
    with refused("reach", "0.5", 1):
        choose(1e5, reach=0.5)


def test_a_rubber_that_breaks_or_was_never_tested_there_is_not_chosen_first() -> None:
    broken = [row for row, _ in choose(100e3, 12.0)]
    assert all(row.ultimate is None or row.ultimate >= 12 for row in broken)
    order = [row.name for row, _ in choose(250e3, reach=2.5)]
    unknown = order.index("mold-star-15")
    assert records("mold-star-15")[0].stretch_range is None
    assert order.index("agilus30") > unknown, "tests of an unknown range count as usual ones"
    far = [row.name for row, _ in choose(100e3, reach=12.0)]
    assert far.index("smooth-sil-950") > far.index("soloplast-150318"), "but as no more than these"
    for hardness in ("500 A", "00-101"):
        with refused(hardness, "0 to 100"):
            choose(hardness=hardness)
    with refused("00-90", "10 points"):
        choose(hardness="00-90")


def test_impossible_constants_are_never_the_ones_to_take() -> None:
    (row,) = (each for each in material_rows() if each.name == "silicone-o-ring")
    assert (row.record, row.modulus) == ("", None)


def test_two_sets_of_the_same_tests_are_one_source() -> None:
    spread = spread_of("overture-hs-tpu")
    assert [name for name, _ in spread.stresses] == ["yeoh-smith-2023-large"], "the other one ends at 1.5"
    assert "MPa" in str(spread_of("smooth-sil-950"))
    assert len(spread_of("agilus30").stresses) == 2, "of other tests it still says how far they lie apart"


def test_spread_between_laboratories() -> None:
    spread = spread_of("ecoflex-00-30")
    values = np.array([value for _, value in spread.stresses])
    assert dict(spread.stresses)["maker"] == pytest.approx(68.95e3, rel=1e-3)
    assert not {"yeoh-yan-2016", "yeoh-elsayed-2014", "mooney-rivlin-steck-2019"} & set(dict(spread.stresses))
    assert spread.deviation == pytest.approx(np.log(values).std(ddof=1))
    assert spread.median == pytest.approx(np.median(values), rel=0.02)
    assert (len(values), spread.others) == (11, 0)
    assert "maker" not in dict(spread_of("ecoflex-00-30", 1.5).stresses)
    typical, rubbers = typical_spread()
    assert rubbers >= 5
    alone = spread_of("mold-star-16")
    assert (alone.deviation, alone.others, len(alone.stresses)) == (typical, rubbers, 1)
    assert "25%" in str(alone) or f"{typical:.0%}" in str(alone)
    wide = spread_of("ecoflex-00-10")
    assert len(wide.stresses) < LEAST
    assert wide.deviation > typical, "two sources a factor of 3.5 apart"
    for name in ("silicone-o-ring", "kevlar-fiber"):
        with refused(f"'{name}'"):
            spread_of(name)
    with refused("stretch", 1, 0):
        spread_of("ecoflex-00-30", 1.0)


def test_reinforcements_are_stiff_and_mostly_know_their_strength() -> None:
    for name in STIFF:
        law = recommended(name).build_law()
        assert not isinstance(law, Hooke) or law.E > 0.2e9, name
    strong = {name: given for name in STIFF if (given := records(name)[0].strength) is not None}
    assert len(strong) >= 12
    for name, given in strong.items():
        law = recommended(name).build_law()
        assert given.tensile_strength < 0.2 * law.E, name


def test_a_hardness_may_begin_with_shore_and_something_must_be_wanted() -> None:
    assert [row.name for row, _ in choose(hardness="Shore 10 A")] == [row.name for row, _ in choose(hardness="10 A")]
    with refused("modulus", "hardness", "'10 A'"):
        choose()


def test_every_rubber_has_a_set_to_take_and_a_reason() -> None:
    for row in material_rows():
        if row.name in RUBBERS:
            assert row.record, row.name
            assert row.why, row.name


def test_the_reason_names_tests_range_and_the_number_of_the_maker(tmp_path: Path) -> None:
    """A neo-Hookean law of C10 pulls 3.5 C10 at stretch 2."""
    own = """name = "ours"\nkind = "rubber"\n[supplier]\nstress_at_stretch_2 = "280 kPa"\nsource = "sheet of 2026"
[records.first]\nlaw = "neo_hooke"\nparameters = { C10 = "100 kPa" }\nconvention = "two_index"
stretch_range = [1.0, 2.0]\nsource = "our tests of 2026"\n"""
    file = tmp_path / "ours.toml"
    file.write_text(own, encoding="utf-8")
    reason = "as published, for stretches from 1 to 2; 350 kPa at stretch 2, 25 % above the maker's 280 kPa."
    assert why_taken(records(str(file))[0]) == f"The only set: {reason}"
    second = own.partition("[records.first]")[2]
    file.write_text(f"{own}[records.second]{second}", encoding="utf-8")
    assert why_taken(records(str(file))[0]) == ""


def test_the_text_of_a_material_checks_each_set_against_the_maker() -> None:
    shown = describe_material("dragon-skin-20")
    assert "check: 324 kPa at stretch 2, 4 % below the maker's 338 kPa" in shown
    assert "check" not in describe_material("ecoflex-00-20")  # computed from this number
    assert "recommended: The only set: fitted by turgor to a curve" in describe_material("mold-star-16")


def test_densities_of_rubbers_are_those_of_rubber() -> None:
    """A slip by ten or by a unit shows: from natural rubber and acrylic tape to filled silicone."""
    stated = [record for record in all_records() if record.kind == "rubber" and record.density]
    densities = {record.library: record.density for record in stated}
    assert len(densities) >= 38
    assert all(930 <= density <= 1300 for density in densities.values()), densities
    assert densities["ninjaflex-85a"] == 1190 and densities["natural-rubber"] == 950


def test_mixing_and_cure_come_with_their_source_once() -> None:
    """Where no stress of the supplier states it above, the line of the mixing does."""
    assert "mixing: 1A:1B by volume (Smooth-On, tutorial of a brush-on mold" in describe_material("rebound-25")
    assert "mixing: 1A:1B by weight or volume\n" in describe_material("ecoflex-00-30")
