"""Studies of the studio: a form writes a study file, its table fills as runs end, and a row opens its run."""

import time

import pytest
from served import needs_browser, open_page, served
from talking import Talk, workspace

from turgor.studies.study_file.study_file import SEARCHES
from turgor.studio.tasks.runs.studies import FOLDERS, check, numbers

SWEEP = {
    "factors.actuator.wall": {"low": "1.8 mm", "high": "2.2 mm", "levels": 3},
    "sweep": {"measures": ["tip_displacement_x"], "at": {"pressure": "10 kPa"}},
}


def test_kinds_are_those_of_study_files():
    assert set(FOLDERS) <= {"sweep", *SEARCHES}


def test_numbers_that_may_vary_have_units(tmp_path):
    known = numbers(workspace(tmp_path) / "tube.toml")
    by_key = {each["key"]: each for each in known["numbers"]}
    assert by_key["actuator.wall"] == {"key": "actuator.wall", "value": 2.0, "unit": "mm", "whole": False}
    assert known["measures"][:2] == ["tip_displacement_x", "cavity_volume"]
    assert known["cavities"] == ["cavity"]


def test_a_study_file_tells_how_many_designs_it_has(tmp_path):
    workspace(tmp_path)
    file = tmp_path / "walls.toml"
    file.write_text('job = "tube.toml"\n[factors]\nactuator.wall = ["2 mm", "2.2 mm"]\n[sweep]\n')
    assert check(file, "sweep")["planned"] == 2


def test_a_form_with_a_mistake_writes_no_file(tmp_path):
    workspace(tmp_path)
    with served(tmp_path) as studio:
        talk = Talk(studio)
        values = {**SWEEP, "factors.actuator.wal": {"low": "1 mm", "high": "2 mm"}}
        form = {"name": "a.toml", "kind": "sweep", "job": "tube.toml"}
        sentence = talk.refusal("/api/studies", {**form, "values": values})
        assert "actuator.wal" in sentence
        assert not (tmp_path / "a.toml").exists()
        assert talk.get("/api/runs") == []
        for name in ("../a.toml", "tube.toml"):
            talk.refusal("/api/studies", {**form, "name": name, "values": SWEEP})


#: Columns of the table of the sweep.
READ = ("actuator.wall", "tip_displacement_x")


@needs_browser
@pytest.mark.slow
def test_a_sweep_of_three_fills_its_table_and_a_row_opens_its_run(tmp_path):
    workspace(tmp_path, steps=0.25)
    with served(tmp_path) as studio, open_page(studio, "#/decide/tube.toml") as shown:
        page = shown.page
        page.wait_for_selector("[data-factor='actuator.wall']")
        page.click("form button.primary")
        page.wait_for_selector("[data-state='running']")
        page.wait_for_selector("tr[data-row]")
        page.wait_for_selector("[data-state='ended']")
        assert page.locator("tr[data-row]").count() == 3
        assert page.locator(".series circle").count() == 3
        assert "levels = 3" in (tmp_path / "tube-sweep.toml").read_text()
        page.wait_for_selector(".study-pictures img")
        page.click("tr[data-row] >> nth=0 >> button")
        page.wait_for_selector(".v-picture canvas")
        page.wait_for_selector("table.numbers tbody tr")
        name = page.evaluate("decodeURIComponent(location.hash.split('/')[2])")
        assert (tmp_path / name.replace("-results", ".toml")).is_file()
        assert (tmp_path / name / "response.csv").is_file()
        shown.check()


@pytest.mark.slow
def test_rows_have_what_the_command_writes_and_files_are_those_listed(tmp_path):
    workspace(tmp_path, steps=0.25)
    with served(tmp_path) as studio:
        talk = Talk(studio)
        talk.get("/api/studies", {"name": "walls.toml", "kind": "sweep", "job": "tube.toml", "values": SWEEP})
        query = "study=walls.toml&kind=sweep"
        status = _ended(talk, query)
        rows = {round(row["factors"][0]["value"], 6): row["measures"][0]["value"] for row in status["rows"]}
        table = (tmp_path / "walls-study" / "study.csv").read_text().splitlines()
        heads = table[0].split(",")
        wall, moved = (next(k for k, head in enumerate(heads) if head.startswith(name)) for name in READ)
        lines = [line.split(",") for line in table[1:]]
        assert rows == pytest.approx({round(float(line[wall]), 6): float(line[moved]) for line in lines}, rel=1e-5)
        assert "unknown file of the study" in talk.refusal(f"/api/studies/file?{query}&file=../tube.toml")
        assert talk.raw(f"/api/studies/file?{query}&file=study.csv")[0] == 200


def _ended(talk: Talk, query: str) -> dict:
    end = time.monotonic() + 120
    while time.monotonic() < end:
        status = talk.get(f"/api/studies/status?{query}")
        if status["state"] != "running":
            assert status["state"] == "ended", status
            return status
        time.sleep(0.3)
    raise AssertionError(status)


#: A short bender with two cavities.
TWO = """\
[actuator]
type = "bidirectional_bender"
length = "40 mm"

[mesh]
quality = "draft"
cells = "tetrahedra"

[materials.body]
law = "neo_hooke"
C10 = "0.1 MPa"

[loads.cavity_1]
pressure = "2 kPa"

[loads.cavity_2]
pressure = "2 kPa"

[procedure]
type = "static"
first_step = 0.5
max_step = 1

[output]
measures = ["tip_displacement_x"]
"""


@pytest.mark.slow
def test_the_workspace_of_two_cavities_is_computed_by_a_process_of_its_own(tmp_path):
    (tmp_path / "two.toml").write_text(TWO, encoding="utf-8")
    with served(tmp_path) as studio:
        talk = Talk(studio)
        pressures = {"cavity_1": "0, 2 kPa", "cavity_2": "0, 2 kPa"}
        talk.get("/api/studies/workspace", {"job": "two.toml", "pressures": pressures})
        status = _reached(talk)
        assert len(status["points"]) == 3  # rest needs no run
        assert status["area"] > 0
        assert (tmp_path / "two-workspace" / "workspace.csv").is_file()


def _reached(talk: Talk) -> dict:
    end = time.monotonic() + 300
    while time.monotonic() < end:
        status = talk.get("/api/studies/workspace/two.toml")
        if status["state"] != "running":
            assert status["state"] == "ended", status
            return status
        time.sleep(0.5)
    raise AssertionError(status)
