"""Runs of the studio are processes of their own: they outlive the server, run once, end at once, and go on."""

import json
import os
import re
import time

import pytest
from served import Studio, needs_browser, open_page, served, server
from talking import Talk, workspace

from refused import refused
from turgor.core.results.measures.measures import measure
from turgor.core.results.measures.standard_measures import bending_angle
from turgor.foundation.response import COLUMN_UNITS
from turgor.studio.children.children import Child, Children
from turgor.studio.children.run_folders import listed, status_of
from turgor.studio.children.tables import UNITS, columns_of
from turgor.studio.settings import STUDIO
from turgor.studio.tasks.runs.checks import check, coarse_changes, loads_of
from turgor.studio.tasks.runs.estimates import estimate
from turgor.studio.tasks.runs.fixes import problem_of
from turgor.studio.workspace import Workspace

#: A process that only waits.
WAITS = ("-n", "1", "-r", "1", "import time; time.sleep(60)")


def _waiting(name: str = "a-results", **more) -> Child:
    return Child(name=name, kind="run", job="a.toml", module="timeit", arguments=WAITS, **more)


#: What a busy machine may add [s] to the time after which a run is killed; a run that nobody kills takes longer.
LATE = 4.0


def _until(condition, seconds: float = 20.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.05)


def test_nothing_runs_twice_and_what_does_not_stop_is_killed(tmp_path):
    children = Children(Workspace(tmp_path))
    children.start(_waiting())
    with refused("a-results"):
        children.start(_waiting())
    assert children.get("a-results").alive
    began = time.monotonic()
    children.stop("a-results")
    assert time.monotonic() - began < STUDIO.cancel + LATE
    assert not children.get("a-results").alive


def test_another_server_knows_a_process_and_its_number_alone_is_not_enough(tmp_path):
    begun = Children(Workspace(tmp_path)).start(_waiting())
    other = Children(Workspace(tmp_path))
    try:
        assert other.get("a-results").alive
        file = next(tmp_path.glob(".turgor-studio/runs/*.json"))
        file.write_text(json.dumps({**json.loads(file.read_text()), "born": "1"}))
        assert not other.get("a-results").alive  # another process has its number now
    finally:
        os.killpg(begun.pid, 9)


def test_what_waits_for_a_run_begins_after_it_but_not_after_a_stop(tmp_path):
    children = Children(Workspace(tmp_path))
    after = ({"name": "fine", "kind": "run", "job": "a.toml", "module": "timeit", "arguments": list(WAITS)},)
    short = Child(
        name="coarse", kind="run", job="a.toml", module="timeit", arguments=("-n", "1", "-r", "1", "0"), after=after
    )
    children.start(short)
    _until(lambda: (fine := children.get("fine")) is not None and fine.alive)
    children.stop("fine")
    children.start(_waiting("coarse", after=after))
    children.stop("coarse")
    time.sleep(0.5)
    assert not children.get("fine").alive
    assert children.get("coarse").after == ()


def test_what_waits_begins_after_a_server_was_killed(tmp_path):
    children = Children(Workspace(tmp_path))
    after = ({"name": "fine", "kind": "run", "job": "a.toml", "module": "timeit", "arguments": list(WAITS)},)
    children._save(_waiting("coarse", after=after, pid=2**22 + 1, born="1"))
    children.all()
    try:
        assert children.get("fine").alive
    finally:
        children.stop("fine")


def test_units_of_tables_are_those_of_responses():
    assert {unit for unit in COLUMN_UNITS if unit} == UNITS


def test_columns_with_mesh_errors_and_a_table_of_a_laboratory(tmp_path):
    file = tmp_path / "a.csv"
    file.write_text("pressure_kPa,bending_angle_deg,bending_angle_mesh_error_deg\n0,0,0\n10,5,0.25\n")
    pressure, angle = columns_of(file)
    assert (angle["name"], angle["unit"], angle["error"]) == ("bending_angle", "deg", [0.0, 0.25])
    assert pressure["error"] is None
    file.write_text("pressure (kPa);angle [deg]\n0;1\n1;x\n")
    assert [(each["name"], each["unit"], each["values"]) for each in columns_of(file)] == [
        ("pressure", "kPa", [0.0, 1.0]),
        ("angle", "deg", [1.0, None]),
    ]


def test_a_manifest_cannot_name_files_elsewhere(tmp_path):
    run = tmp_path / "run"
    run.mkdir()
    (tmp_path / "secret.txt").write_text("x")
    (run / "response.csv").write_text("x")
    (run / "link.csv").symlink_to(tmp_path / "secret.txt")
    names = ["response.csv", "../secret.txt", str(tmp_path / "secret.txt"), "link.csv", "missing.csv"]
    (run / ".turgor-files.json").write_text(json.dumps({"files": names}))
    assert listed(run) == {"response.csv"}


@pytest.mark.parametrize(
    ("line", "state"), [("solved to the end: Reached 1 kPa.", "ended"), ("limit point: Fell.", "early")]
)
def test_a_run_that_ended_early_says_so(tmp_path, line, state):
    folder = tmp_path / "a-results"
    (folder / "path").mkdir(parents=True)
    (folder / "path" / "solution.turgor").touch()
    (folder / ".turgor-files.json").write_text("{}")
    (folder / "run.log").write_text(
        f"solving\nstep 1: load factor 0.4, 3 iterations\n{line}\n1 steps accepted, 0 cut back\n"
    )
    workspace = Workspace(tmp_path)
    status = status_of(workspace, Children(workspace), "a-results")
    assert (status["state"], status["message"]) == (state, line.removeprefix("solved to the end: "))
    assert status["progress"] == (1.0 if state == "ended" else 0.4)


def test_a_problem_has_a_line_and_the_near_match_as_a_fix(tmp_path):
    file = workspace(tmp_path) / "tube.toml"
    file.write_text(
        file.read_text().replace("size =", "sise =").replace('"20 kPa"', "20").replace('"neo_hooke"', '"neo_hoke"')
    )
    problems = {each["key"]: each for each in check(file, "tube.toml")["problems"]}
    assert problems["mesh.sise"]["fixes"][0]["values"] == {"mesh.sise": None, "mesh.size": "3 mm"}
    assert problems["materials.body.law"]["fixes"][0]["values"] == {"materials.body.law": "neo_hooke"}
    assert problems["loads.cavity.pressure"]["fixes"][0]["values"] == {"loads.cavity.pressure": "20 kPa"}
    lines = file.read_text().splitlines()
    assert "sise" in lines[problems["mesh.sise"]["line"] - 1]
    assert problem_of("no place at all", "tube.toml", {})["fixes"] == []


def test_loads_that_can_be_dragged():
    content = {
        "loads": {"pressure": "1 kPa", "cavity": {"pressure": "2 kPa", "history": [[0, 0], [1, 1]]}, "gravity": "-z"},
        "procedure": {"at": [0.5, "3 kPa"]},
    }
    history, states = loads_of(content)
    assert (history["key"], history["points"], history["full"]) == ("loads.cavity.history", [[0, 0], [1, 1]], "2 kPa")
    assert (states["at"], states["fixed"]) == ([0.5], True)


def test_coarse_answer_has_fewer_cells_and_only_numbers(tmp_path):
    from turgor.job.read import read_job
    from turgor.job.text.overrides import parse_changes

    file = workspace(tmp_path) / "tube.toml"
    file.write_text(file.read_text().replace('size = "3 mm"', 'size = "0.5 mm"\nwall_cells = 2'))
    job = read_job(file)
    coarse = read_job(file, parse_changes(coarse_changes(job, {"mesh": {"size": "0.5 mm"}})))
    assert coarse.mesh_size > 2 * job.mesh_size
    assert coarse.mesh.wall_cells == 1
    assert not (coarse.output.report or coarse.output.pictures or coarse.output.fields or coarse.output.mesh_error)


def test_an_estimate_names_the_part_that_it_is_of(tmp_path):
    tube = estimate(workspace(tmp_path) / "tube.toml")
    assert tube["part"].startswith("its cross-section")
    assert [each["name"] for each in tube["columns"]][:2] == ["pressure", "stretch"]
    assert tube["columns"][0]["values"][-1] == pytest.approx(20)


@pytest.mark.slow
def test_two_chambers_tell_how_a_finger_of_several_bends(tmp_path):
    """Every gap bends alike: 5 gaps bend five times as far as one, within a tenth or so."""
    from turgor.core.solvers.solve import solve
    from turgor.job.prepare import prepare
    from turgor.job.read import read_job
    from turgor.job.text.overrides import parse_changes
    from turgor.studio.tasks.runs.checks import coarse_of

    file = tmp_path / "finger.toml"
    file.write_text(
        '[actuator]\ntype = "fast_pneunet"\nchambers = 6\nlength = "60 mm"\n\n[materials.body]\nlaw = "neo_hooke"\n'
        'C10 = "0.1 MPa"\n\n[materials.base]\nlaw = "neo_hooke"\nC10 = "0.1 MPa"\n\n'
        '[loads.cavity]\npressure = "2 kPa"\n'
    )
    known = estimate(file)
    assert known["part"] == "two of its chambers"
    angle = next(each for each in known["columns"] if each["name"] == "bending_angle")["values"][-1]
    job = read_job(file, parse_changes(coarse_of(file)))
    whole = measure(solve(prepare(job)[0], job.procedure, progress=False), bending_angle)["bending_angle_deg"][-1]
    assert angle == pytest.approx(whole, rel=0.2)


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    """A studio whose tube is solved in ten steps, and requests to it."""
    folder = workspace(tmp_path_factory.mktemp("solved"), steps=0.25)
    with served(folder) as studio:
        talk = Talk(studio)
        talk.get("/api/runs", {"job": "tube.toml", "way": "fine"})
        talk.wait("tube-results", lambda state: state["state"] != "running")
        yield studio, talk


def test_a_run_is_started_watched_and_its_files_are_those_of_its_manifest(solved):
    _, talk = solved
    state = talk.run("tube-results")
    assert (state["state"], state["coarse"], state["progress"]) == ("ended", False, 1.0)
    assert [each["name"] for each in state["columns"]][:2] == ["load_factor", "pressure"]
    status, headers, body = talk.raw("/api/runs/file?run=tube-results&file=response.csv")
    assert status == 200
    assert body.startswith(b"load_factor")
    assert "attachment" in headers["content-disposition"]
    for name in ("../tube.toml", "path/index.json", "/etc/passwd", "..%2Ftube.toml", ".turgor-files.json"):
        assert "unknown file of the run" in talk.refusal(f"/api/runs/file?run=tube-results&file={name}")
    assert "unknown run" in talk.refusal("/api/runs/file?run=../other&file=response.csv")


def test_a_scene_has_the_states_of_the_run(solved):
    _, talk = solved
    scene = talk.get("/api/runs/scene?run=tube-results")
    assert len(scene["steps"]) == talk.run("tube-results")["states"]
    assert scene["curves"]["y"]


@pytest.mark.slow
def test_a_report_and_other_files_are_made_by_a_button(solved):
    _, talk = solved

    def make(kind: str) -> str:
        return talk.get("/api/runs/make", {"run": "tube-results", "kind": kind, "state": 1})["file"]

    made = {kind: make(kind) for kind in ("report", "picture", "glb", "vtu")}
    assert made == {"report": "report.html", "picture": "state-1.png", "glb": "motion.glb", "vtu": "vtu/state.pvd"}
    status, headers, _ = talk.raw("/api/runs/file?run=tube-results&file=report.html")
    assert status == 200
    assert headers["content-security-policy"].startswith("sandbox allow-scripts")
    assert talk.raw("/api/runs/fields?run=tube-results")[2][:2] == b"PK"
    assert "unknown kind of file" in talk.refusal("/api/runs/make", {"run": "tube-results", "kind": "exe"})


@needs_browser
def test_look_scrubs_shows_numbers_and_complains_about_nothing(solved):
    studio, _ = solved
    with open_page(studio, "#/look/tube-results") as shown:
        page = shown.page
        page.wait_for_selector(".v-picture canvas")
        page.wait_for_selector("table.numbers tbody tr")
        last = page.inner_text("table.numbers thead")
        page.evaluate(
            "const s = document.querySelector('[data-v=slider]'); s.value = 1; s.dispatchEvent(new Event('input'))"
        )
        page.wait_for_function("before => document.querySelector('table.numbers thead').innerText !== before", arg=last)
        shown.check()


@needs_browser
@pytest.mark.slow
def test_a_fix_button_changes_the_file_and_the_check_follows(tmp_path):
    workspace(tmp_path)
    file = tmp_path / "tube.toml"
    file.write_text(file.read_text().replace("size =", "sise ="))
    with served(tmp_path) as studio, open_page(studio, "#/solve/tube.toml") as shown:
        page = shown.page
        assert page.wait_for_selector(".finding a").inner_text() == "line 8"
        page.click("button.fix:has-text('Rename to size')")
        page.wait_for_selector(".finding:has-text('G01') button.fix")
        assert 'size = "3 mm"' in file.read_text()
        page.click("button.fix:has-text('Two cells')")
        page.wait_for_selector("p.good")
        assert "wall_cells = 2" in file.read_text()
        shown.check()


@needs_browser
@pytest.mark.slow
def test_a_solve_is_stopped_at_once_and_goes_on(tmp_path):
    workspace(tmp_path, steps=0.004)
    with served(tmp_path) as studio, open_page(studio, "#/solve/tube.toml") as shown:
        talk, page = Talk(studio), shown.page
        page.click("button:has-text('Fine only'):enabled")
        before = talk.wait("tube-results", lambda state: state["states"] > 5)
        page.wait_for_selector(".run.running progress")
        began = time.monotonic()
        talk.get("/api/runs/stop", {"run": "tube-results"})
        took = time.monotonic() - began
        assert took < STUDIO.cancel + LATE
        stopped = talk.run("tube-results")
        assert stopped["state"] == "paused"
        assert stopped["states"] >= before["states"]
        page.click("button:has-text('Go on')")
        again = talk.wait("tube-results", lambda state: state["states"] > stopped["states"] + 3)
        assert again["state"] == "running"
        assert any("continuing the path" in line for line in again["log"])  # it does not begin again
        page.click("button:has-text('Pause')")
        paused = talk.wait("tube-results", lambda state: state["state"] != "running")
        assert paused["state"] == "paused"
        assert "job.lock.toml" in paused["files"]
        shown.check()


def _restarted(studio: Studio) -> Studio:
    studio.kill()
    return server(studio.workspace, "--port", str(studio.port))


@needs_browser
@pytest.mark.slow
def test_a_killed_server_loses_no_run_and_nothing_runs_twice(tmp_path):
    """Two pages are open; the server is killed in the middle of a run, and another takes its place."""
    workspace(tmp_path, steps=0.01)
    studio = server(tmp_path, "--port", "0")
    try:
        with open_page(studio, "#/solve/tube.toml") as shown:
            page, second = shown.page, shown.page.context.browser.new_page()
            second.goto(studio.url + "#/solve/tube.toml")
            page.click("button:has-text('Fine only'):enabled")
            talk = Talk(studio)
            talk.wait("tube-results", lambda state: state["states"] > 3)
            second.wait_for_selector(".run.running")
            assert "nothing is started twice" in talk.refusal("/api/runs", {"job": "tube.toml", "way": "fine"})
            pid = _pid(tmp_path)
            studio = _restarted(studio)
            talk = Talk(studio)
            state = talk.run("tube-results")
            assert state["state"] == "running"
            assert "nothing is started twice" in talk.refusal("/api/runs", {"job": "tube.toml", "way": "fine"})
            assert _pid(tmp_path) == pid
            page.reload()
            page.wait_for_selector(".run.running")
            ended = talk.wait("tube-results", lambda state: state["state"] != "running", seconds=240)
            assert (ended["state"], ended["progress"]) == ("ended", 1.0)
            assert len(ended["columns"][0]["values"]) == ended["states"]
            for each in (page, second):
                each.wait_for_selector(".run.ended")
    finally:
        studio.kill()


def _pid(folder) -> int:
    return json.loads(next(folder.glob(".turgor-studio/runs/*.json")).read_text())["pid"]


@needs_browser
@pytest.mark.slow
def test_solve_gives_a_coarse_answer_first_and_marks_it(tmp_path):
    workspace(tmp_path, steps=0.1)
    with served(tmp_path) as studio, open_page(studio, "#/solve/tube.toml") as shown:
        page = shown.page
        page.click("button.primary:enabled")
        page.wait_for_selector("[data-run='tube-draft'] .badge.coarse")
        page.wait_for_selector("table.numbers th:has-text('tube-draft') .badge.coarse")
        Talk(studio).wait("tube-results", lambda state: state["state"] == "ended")
        page.wait_for_selector("table.numbers th:has-text('tube-results')")
        assert page.query_selector("[data-run='tube-results'] .badge") is None
        assert page.query_selector(".series.coarse") is not None
        shown.check()


@needs_browser
@pytest.mark.slow
def test_a_dragged_history_is_written_into_the_file(tmp_path):
    workspace(tmp_path)
    with served(tmp_path) as studio, open_page(studio, "#/solve/tube.toml") as shown:
        page = shown.page
        knob = page.wait_for_selector(".knob >> nth=1")
        box = knob.bounding_box()
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        page.mouse.down()
        page.mouse.move(box["x"], box["y"] + 60, steps=4)
        page.mouse.up()
        _until(lambda: "history" in (tmp_path / "tube.toml").read_text())
        text = (tmp_path / "tube.toml").read_text()
        share = float(re.search(r"\[1(?:\.0)?, ([\d.]+)\]", text)[1])
        assert 0.2 < share < 0.95
        shown.check()
