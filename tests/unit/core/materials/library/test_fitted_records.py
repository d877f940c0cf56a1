"""Records that turgor has fitted itself: their curves give them again, and their license lies next to the curves."""

from importlib.resources import files

import pytest

from refused import refused
from turgor.core.materials.fitting.fit_laws import fit
from turgor.core.materials.laws.stability import instabilities
from turgor.core.materials.library.choose import choose, material_rows
from turgor.core.materials.library.doubts import find_doubts
from turgor.core.materials.library.record import Record
from turgor.core.materials.library.record_files import all_records, library, read_records
from turgor.core.materials.library.records import find_record, recommended
from turgor.foundation.finding import Severity

FITTED = [record for record in all_records() if record.fitted]


@pytest.mark.parametrize("record", FITTED, ids=lambda each: f"{each.library}-{each.name}")
def test_the_curves_give_the_record_again(record: Record) -> None:
    assert record.fitted is not None
    again = fit(record.fitted.law, record.fitted.read(), stretch=record.stretch_range)
    law, test = record.build_law(), record.fitted.read()[0]
    inside = (test.stretch >= 1.02) & (test.stretch <= record.stretch_range[1])
    assert test.predicted(law)[inside] == pytest.approx(test.predicted(again.law)[inside], rel=2e-3)
    assert again.relative < 0.13
    assert not instabilities(law, "uniaxial", record.stretch_range[1])


def test_every_curve_is_used_and_its_folder_states_its_license() -> None:
    folder = files("turgor.core.materials.library").joinpath("curves")
    used = {name for record in FITTED for name in record.fitted.names}
    there = {f"{part.name}/{file.name}" for part in folder.iterdir() for file in part.iterdir()}
    licenses = {name for name in there if name.endswith("LICENSE.txt")}
    assert there - licenses == used
    assert {name.split("/")[0] for name in used} == {name.split("/")[0] for name in licenses}


def test_every_rubber_with_several_sets_has_one_to_take() -> None:
    for name in library():
        record = recommended(name)
        assert record is not None, name
        warned = {doubt.kind for doubt in find_doubts(record) if doubt.severity is Severity.WARNING} - {"stated"}
        alone = all(
            any(doubt.severity is Severity.WARNING for doubt in find_doubts(each))
            for each in all_records()
            if each.library == name
        )
        assert not warned or alone, (name, warned)


def test_the_message_without_a_record_names_the_one_to_take() -> None:
    with refused("'ecoflex-00-30'", "13", "yeoh-kulkarni-2015", "Recommended"):
        find_record("ecoflex-00-30")


def test_a_recommendation_of_an_unknown_record_is_refused(tmp_path) -> None:
    file = tmp_path / "mine.toml"
    text = 'name = "Mine"\n[recommended]\nrecord = "yeo"\nwhy = "It is ours."\n[records.yeoh]\nlaw = "yeoh"\n'
    file.write_text(text + 'parameters = { C10 = "1 kPa" }\nconvention = "two_index"\nsource = "us"\n', "utf-8")
    with refused("'yeo'", "yeoh"):
        read_records(file)


def test_rows_and_choice() -> None:
    rows = {row.name: row for row in material_rows()}
    assert rows["ecoflex-00-30"].modulus == pytest.approx(6 * 12.7e3)
    assert rows["ecoflex-00-30"].spread[0] < rows["ecoflex-00-30"].modulus < rows["ecoflex-00-30"].spread[1]
    near = choose(400e3, stretch=1.5)
    ratios = [max(value / 400e3, 400e3 / value) for row, value in near if (row.stretch_range or (1, 9))[1] >= 1.5]
    assert ratios == sorted(ratios)
    assert ratios[0] < 1.25
    with refused("stretch", "0.5", 1):
        choose(400e3, stretch=0.5)
    with refused("modulus", "-1", 0):
        choose(-1.0)
