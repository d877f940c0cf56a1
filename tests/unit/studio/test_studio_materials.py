"""Materials of the studio: curves of the library, tests of a user, fits, and the entry that a choice becomes."""

import shutil
import tomllib
from pathlib import Path

import numpy as np
import pytest
from served import needs_browser, open_page, served

import turgor as tg
from refused import refused
from turgor.core.materials.experiments.read_tests import read_test
from turgor.core.materials.library.record_files import all_records
from turgor.job.tables.materials import read_materials
from turgor.job.text.problems import Problems
from turgor.studio.edits import with_values
from turgor.studio.tasks import materials
from turgor.units import MPa

DATA = Path(__file__).parents[2] / "validation" / "data"
RUBBER = DATA / "jones-treloar-1975-rubber" / "uniaxial.csv"
HOW = {"mode": "", "stress": "", "specimen": "", "cycle": "first"}

JOB = """[actuator]
type = "fast_pneunet" # a finger

[materials]
body = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }
base = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }

[materials.strain_limiting_layer]
library = "paper"
record = "hooke-polygerinos-2020"
thickness = "0.1 mm" # measured

[loads]
pressure = "10 kPa"
"""


def test_library_has_every_record_with_its_doubts():
    rows = materials.library_table()
    assert len(rows) == len(all_records())
    doubted = next(row for row in rows if row["record"] == "yeoh-yan-2016")
    assert "M04" in {each["code"] for each in doubted["doubts"]}
    assert all(row["source"] for row in rows)


def test_curve_is_that_of_the_law():
    found = materials.curves([["smooth-sil-950", "neo-hooke-connolly-2017"]], "uniaxial", 2.0)[0]
    assert found["stretch"][-1] == 2.0
    assert found["stress"][-1] == pytest.approx(1.19)
    with refused("sideways", "uniaxial, planar, equibiaxial"):
        materials.curves([], "sideways", 2.0)


def test_columns_of_own_test_are_said_or_why_not(tmp_path):
    found = materials.read_own(RUBBER, HOW)
    assert [each["role"] for each in found["columns"]] == ["stretch", "nominal stress"]
    assert found["tests"][0]["count"] == len(read_test(RUBBER).stretch)
    unknown = tmp_path / "strip.csv"
    unknown.write_text("stretch,stress (MPa)\n1,0\n1.5,0.1\n2,0.2\n", encoding="utf-8")
    refused = materials.read_own(unknown, HOW)
    assert refused["tests"] == []
    assert "does not say how" in refused["refused"]
    known = materials.read_own(unknown, HOW | {"mode": "uniaxial", "stress": "nominal"})
    assert known["refused"] == ""
    assert known["tests"][0]["stress"] == pytest.approx([0, 0.1, 0.2])


def test_fit_of_chosen_points_is_that_of_turgor():
    found = materials.fitted([RUBBER], HOW, None, ["yeoh", "neo-hooke"])
    whole = tg.fit("yeoh", read_test(RUBBER))
    yeoh = next(each for each in found["fits"] if each["law"] == "yeoh")
    assert yeoh["relative"] == pytest.approx(whole.relative, rel=1e-9)
    assert yeoh["aic"] == pytest.approx(whole.aic)
    assert found["fits"][0]["aic"] <= found["fits"][1]["aic"]
    part = materials.fitted([RUBBER], HOW, [1.0, 1.5], ["neo-hooke"])["fits"][0]
    assert max(part["curves"][0]["stretch"]) <= 1.5
    assert part["relative"] < next(each for each in found["fits"] if each["law"] == "neo-hooke")["relative"]


@pytest.mark.parametrize("law", ["neo-hooke", "mooney-rivlin", "yeoh", "gent", "ogden-2", "arruda-boyce", "rivlin-2"])
def test_entry_of_a_fit_gives_the_same_law(law):
    fit = tg.fit(law, read_test(RUBBER), starts=2)
    problems = Problems(file="a.toml", lines={})
    text = with_values("", {"materials.body": materials.stated(fit)})
    read = read_materials(tomllib.loads(text)["materials"], None, problems)["body"]
    stretch = np.linspace(1.0, 2.5, 7)
    same = tg.laws.curve(read.law, "uniaxial", stretch).nominal_stress
    assert same == pytest.approx(tg.laws.curve(fit.law, "uniaxial", stretch).nominal_stress, rel=1e-9)
    assert read.stretch_range == pytest.approx(fit.stretch_range, abs=1e-6)
    assert "fitted to uniaxial" in read.source.text


def test_choice_leaves_the_rest_of_the_job_as_it_was():
    choice = {"library": "ecoflex-00-30", "record": "yeoh-steck-2019"}
    entry = materials.entry_for(JOB, "strain_limiting_layer", choice)
    assert entry == {**choice, "thickness": "0.1 mm"}
    text = with_values(JOB, {"materials.strain_limiting_layer": entry, "materials.body": choice})
    content = tomllib.loads(text)
    assert content["materials"]["body"] == choice
    assert content["materials"]["strain_limiting_layer"] == entry
    assert content["materials"]["base"] == tomllib.loads(JOB)["materials"]["base"]
    assert content["loads"] == {"pressure": "10 kPa"}
    assert "# a finger" in text
    assert 'body = {library = "ecoflex-00-30"' in text


@needs_browser
def test_fit_in_the_page_becomes_the_material_of_the_job(tmp_path):
    (tmp_path / "finger.toml").write_text(JOB, encoding="utf-8")
    sent = tmp_path / "elsewhere"
    sent.mkdir()
    shutil.copy(RUBBER, sent / "uniaxial.csv")
    with served(tmp_path) as studio, open_page(studio, "#/materials/finger.toml") as shown:
        page = shown.page
        page.wait_for_selector(".rubber-library .plot-line")
        page.fill("input[type=search]", "ecoflex steck")
        shown.until("document.querySelectorAll('.rubber-library tbody tr').length < 4")
        page.get_by_role("button", name="use ecoflex-00-30 yeoh-steck-2019").click()
        page.wait_for_selector("dd:has-text('yeoh-steck-2019')")
        page.set_input_files("input[type=file]", sent / "uniaxial.csv")
        page.wait_for_selector(".rubber-tests .plot-point")
        assert (tmp_path / "uniaxial.csv").is_file()
        _drag_range(page)
        assert 1.0 < float(page.input_value("[aria-label='largest stretch that counts']")) < 2.2
        page.get_by_role("button", name="Fit and compare").click()
        page.wait_for_selector(".rubber-tests .plot-line")
        page.get_by_role("button", name="use yeoh").click()
        page.wait_for_selector("dd:has-text('fitted to uniaxial')")
        shown.check()
    body = tomllib.loads((tmp_path / "finger.toml").read_text("utf-8"))["materials"]["body"]
    assert body["law"] == "yeoh"
    assert body["C10"].endswith("kPa")
    assert body["stretch_range"][1] < 2.2


@needs_browser
def test_damaged_table_is_refused_with_its_sentence(tmp_path):
    (tmp_path / "finger.toml").write_text(JOB, encoding="utf-8")
    bad = tmp_path / "elsewhere"
    bad.mkdir()
    (bad / "bad.csv").write_bytes(b"\x00\x01 no table")
    with served(tmp_path) as studio, open_page(studio, "#/materials/finger.toml") as shown:
        shown.page.set_input_files("input[type=file]", bad / "bad.csv")
        shown.page.wait_for_selector(".message.wrong:has-text('bad.csv')")
    assert not (tmp_path / "bad.csv").exists()


def _drag_range(page):
    box = page.locator(".rubber-tests .plot").bounding_box()
    page.mouse.move(box["x"] + 0.1 * box["width"], box["y"] + 0.5 * box["height"])
    page.mouse.down()
    page.mouse.move(box["x"] + 0.4 * box["width"], box["y"] + 0.5 * box["height"])
    page.mouse.move(box["x"] + 0.6 * box["width"], box["y"] + 0.5 * box["height"])
    page.mouse.up()


def test_stress_is_shown_in_megapascals():
    test = read_test(RUBBER)
    assert max(materials.read_own(RUBBER, HOW)["tests"][0]["stress"]) <= test.nominal_stress.max() / MPa + 1e-9
