"""Doubts about library records: exactly the expected ones are found, and made-up mistakes are caught."""

import re
from dataclasses import replace

import numpy as np
import pytest

from turgor.core.materials.laws.homogeneous import equibiaxial, nominal_stress, planar, uniaxial
from turgor.core.materials.laws.laws import NeoHooke
from turgor.core.materials.laws.pull import pull
from turgor.core.materials.laws.stability import first_instability
from turgor.core.materials.library import doubt_checks
from turgor.core.materials.library.doubt_checks import USUAL_RANGE, Case, Doubt, falls_at
from turgor.core.materials.library.doubts import doubts_of, find_doubts
from turgor.core.materials.library.records import all_records, find_record, from_library
from turgor.core.materials.material import Material
from turgor.foundation.finding import Severity
from turgor.foundation.source import Source

FAR, BORROWED, UNSTABLE = ("M04", "far from the supplier"), ("M04", "borrowed"), ("M06", "unstable")
NEGATIVE_ELSEWHERE, SETTLED = ("M05", "wrong convention negative"), ("M05", "convention settled")
AMBIGUOUS, SECANT, DENSITY = ("M05", "convention ambiguous"), ("M07", "linear elastic rubber"), ("M04", "density")

#: Rubbers whose density has not been checked against the supplier's bulletin, or is that of a class or another version.
DENSITY_UNCHECKED = {
    "elastosil-m4601", "smooth-sil-950", "polymaker-tpu90", "overture-hs-tpu", "ninjatek-eel", "hatchbox-tpu",
    "sainsmart-tpu", "matterhackers-tpu", "overture-tpu", "formlabs-elastic-50a", "formlabs-flexible-80a", "rtv615",
    "sylgard-184", "natural-rubber", "natural-rubber-unfilled", "isoprene-rubber",
}  # fmt: skip

#: Every other doubt about records of the review; those that are not here have none.
EXPECTED = {
    ("dragon-skin-10", "ogden-nuthi-2018"): {FAR, NEGATIVE_ELSEWHERE},
    ("dragon-skin-10", "hooke-bilodeau-2018"): {SECANT},
    ("dragon-skin-20", "ogden-nuthi-2018"): {NEGATIVE_ELSEWHERE},
    ("dragon-skin-30", "mooney-rivlin-elsayed-2014"): {FAR},
    ("dragon-skin-30", "ogden-milana-2019"): {AMBIGUOUS, ("M04", "stated")},
    ("dragon-skin-30", "ogden-nuthi-2018"): {NEGATIVE_ELSEWHERE},
    ("ecoflex-00-10", "generalized-rivlin-kulkarni-2015"): {UNSTABLE},
    ("ecoflex-00-30", "yeoh-elsayed-2014"): {UNSTABLE, FAR},
    ("ecoflex-00-30", "yeoh-yan-2016"): {BORROWED, FAR},
    ("ecoflex-00-30", "ogden-agarwal-2016"): {SETTLED},
    ("ecoflex-00-30", "ogden-moseley-2016"): {SETTLED},
    ("ecoflex-00-30", "ogden-steck-2019"): {AMBIGUOUS},
    ("ecoflex-00-30", "mooney-rivlin-steck-2019"): {("M06", "negative modulus")},
    ("ecoflex-00-50", "yeoh-chen-2018"): {BORROWED, FAR},
    ("ecoflex-00-50", "yeoh-xue-2018"): {BORROWED, FAR},
    ("ecoflex-00-50", "ogden-elsayed-2014"): {UNSTABLE, AMBIGUOUS},
    ("elastosil-m4601", "hooke-alici-2018"): {SECANT},
    ("fiberglass", "yeoh-polygerinos-2015"): {("M04", "combined layer")},
    ("pbo-fiber", "hooke-nordin-2013"): {FAR},
    ("silicone-o-ring", "hooke-yan-2016"): {BORROWED, ("M04", "no rubber")},
}


def kinds(record, others=None) -> set[tuple[str, str]]:
    return {(doubt.code, doubt.kind) for doubt in find_doubts(record, others)}


def message(library: str, record: str, kind: str) -> str:
    return next(doubt.message for doubt in find_doubts(find_record(library, record)) if doubt.kind == kind)


def test_the_doubts_of_the_library_are_the_expected_ones() -> None:
    results = {(record.library, record.name): kinds(record) for record in all_records()}
    for (library, _), doubts in results.items():
        assert (DENSITY in doubts) == (library in DENSITY_UNCHECKED)
        doubts.discard(DENSITY)
    printed = {(record.library, record.name) for record in all_records() if record.quoted_in}
    assert {key: doubts for key, doubts in results.items() if doubts and key in printed} == EXPECTED
    computed = {code for key in results.keys() - printed for code in results[key] if code[1] != "stated"}
    assert computed == {FAR, SECANT}, "of the records that the review lacks"


def test_what_the_doubts_say() -> None:
    """The numbers that the review's contradictions come down to."""
    assert "are those of Elastosil M4601 (C1 = 0.11 MPa" in message("ecoflex-00-30", "yeoh-yan-2016", "borrowed")
    assert "9.65 times the 68.95 kPa" in message("ecoflex-00-30", "yeoh-yan-2016", "far from the supplier")
    assert "nearly those of Elastosil M4601" in message("ecoflex-00-50", "yeoh-chen-2018", "borrowed")
    assert "nearly those of Elastosil M4601" in message("ecoflex-00-50", "yeoh-xue-2018", "borrowed")
    assert "are those of Kevlar fiber" in message("silicone-o-ring", "hooke-yan-2016", "borrowed")
    assert "modulus is -208 kPa" in message("ecoflex-00-30", "mooney-rivlin-steck-2019", "negative modulus")
    assert "uniaxial tension at stretch 1.9" in message("ecoflex-00-30", "yeoh-elsayed-2014", "unstable")
    assert "1/13.3 of the 592.9 kPa" in message("dragon-skin-30", "mooney-rivlin-elsayed-2014", "far from the supplier")
    assert "would be -41.55 kPa" in message("dragon-skin-10", "ogden-nuthi-2018", "wrong convention negative")
    assert "ratio of 0.48 in the first" in message("ecoflex-00-30", "ogden-moseley-2016", "convention settled")
    secant = message("elastosil-m4601", "hooke-alici-2018", "linear elastic rubber")
    assert "720 kPa" in secant
    assert "134% strain" in secant
    assert "nu = 0.499 is not printed but assumed" in secant


def test_the_secant_strain_is_where_the_neo_hookean_curve_meets_the_line() -> None:
    """At the strain in the message, 0.24 MPa (λ - 1/λ²) = 0.38666 MPa (λ - 1)."""
    (strain,) = re.findall(r"(\d+)% strain", message("elastosil-m4601", "hooke-alici-2018", "linear elastic rubber"))
    stretch = 1 + int(strain) / 100
    assert 0.24 * (stretch - stretch**-2) / (stretch - 1) == pytest.approx(0.38666, rel=2e-3)


def test_made_up_mistakes_are_caught() -> None:
    good = find_record("ecoflex-00-30", "yeoh-kulkarni-2015")
    assert kinds(good) == set()
    of_another_rubber = replace(good, constants={"C1": 340e3, "C2": 0.0, "C3": 0.0})
    lender = replace(of_another_rubber, material_name="Smooth-Sil 950", supplier=None)
    assert kinds(of_another_rubber, [lender]) == {BORROWED, FAR}
    assert kinds(lender, [of_another_rubber]) == set(), "the one that lends is not blamed"
    assert kinds(replace(good, constants={"C1": 12.7e6, "C2": 423e3, "C3": -1460.0})) == {FAR}, "kPa taken for MPa"
    assert kinds(replace(good, constants={"C1": 12.7e3, "C2": -423.0, "C3": -1.46})) == {UNSTABLE}
    negative = replace(good, constants={"C1": -12.7e3, "C2": 423.0, "C3": -1.46})
    (doubt,) = find_doubts(negative)
    assert doubt.kind == "negative modulus"
    assert "-25.4 kPa" in doubt.message
    assert kinds(replace(good, stated_doubts=("The batch was old.",))) == {("M04", "stated")}


def test_the_wrong_convention_of_ogden_is_caught() -> None:
    good = find_record("dragon-skin-20", "ogden-nuthi-2018")
    assert ("M06", "negative modulus") in kinds(replace(good, convention="mu/alpha"))
    moseley = find_record("ecoflex-00-30", "ogden-moseley-2016")
    assert AMBIGUOUS in kinds(replace(moseley, convention="mu/alpha")), "D1 speaks against it"


@pytest.mark.parametrize("record", ["yeoh-kulkarni-2015", "ogden-moseley-2016"])
@pytest.mark.parametrize(("mode", "deform"), [("uniaxial", uniaxial), ("planar", planar), ("equibiaxial", equibiaxial)])
def test_the_pull_is_the_nominal_stress(record: str, mode: str, deform) -> None:
    law = find_record("ecoflex-00-30", record).build_law()
    stretch = np.array([0.6, 1.0, 1.3, 2.0, 4.0])
    exact = nominal_stress(law, deform(stretch))[:, 0, 0]
    np.testing.assert_allclose(pull(law, mode, stretch), exact, rtol=1e-6, atol=1e-2)


def test_doubts_travel_with_the_material_as_findings() -> None:
    findings = doubts_of(from_library("ecoflex-00-30", "yeoh-yan-2016"))
    assert [finding.code for finding in findings] == ["M04", "M04"]
    assert all(finding.severity is Severity.WARNING for finding in findings)
    assert findings[0].message.startswith("Ecoflex 00-30: The constants")
    assert "Prefer another record" in findings[0].advice
    (note,) = doubts_of(from_library("elastosil-m4601", "yeoh-mosadegh-2014"))
    assert note.severity is Severity.NOTE
    material = from_library("dragon-skin-20", "ogden-nuthi-2018")
    unchecked = replace(material.source, doubts=(*material.source.doubts, "M04 density: Of a transcript."))
    notes = doubts_of(replace(material, source=unchecked))
    assert [(note.code, note.severity) for note in notes] == [("M05", Severity.NOTE), ("M04", Severity.NOTE)]
    assert doubts_of(from_library("kevlar-fiber")) == ()


def test_doubts_in_plain_words_count_as_m04() -> None:
    source = Source(text="a notebook", doubts=("Room temperature: not noted.",))
    (finding,) = doubts_of(Material(name="ours", law=NeoHooke(C10=1e5), source=source))
    assert (finding.code, finding.message) == ("M04", "ours: Room temperature: not noted.")


def test_a_doubt_reads_back_as_it_was_written() -> None:
    text = str(Doubt(code="M06", kind="unstable", message="It falls: soon."))
    source = Source(text="x", doubts=(text,))
    (finding,) = doubts_of(Material(name="ours", law=NeoHooke(C10=1e5), source=source))
    assert (finding.code, finding.message) == ("M06", "ours: It falls: soon.")


def test_lost_stability_is_where_the_derivatives_of_the_energy_say() -> None:
    """The quick search by differences of the energy finds what `first_instability` finds from its derivatives."""
    compared = 0
    for record in all_records():
        law = Case(record, ()).rubber
        for mode, (low, high) in USUAL_RANGE.items() if law is not None else ():
            exact = first_instability(law, mode, upper=high, lower=low)
            results = [limit for limit in (falls_at(law, mode, high), falls_at(law, mode, low)) if limit is not None]
            nearest = min(results, key=lambda limit: abs(np.log(limit)), default=None)
            assert (nearest is None) == (exact is None), (record.library, record.name, mode)
            if exact is not None:
                assert nearest == pytest.approx(exact, abs=0.01)
                compared += 1
    assert compared == 7


@pytest.mark.parametrize(("name", "reads"), [("neo-hooke-polygerinos-2020", False), ("ogden-nuthi-2018", True)])
def test_the_library_is_read_only_for_constants_that_do_not_suit_the_name(name, reads, monkeypatch) -> None:
    record, asked = find_record("dragon-skin-10", name), []
    monkeypatch.setattr(doubt_checks, "all_records", lambda: asked.append(record) or (record,))
    find_doubts(record)
    assert bool(asked) == reads
