"""A reduced model in the page: moved by sliders and by its tip, and sequences that are recorded, saved and played."""

import csv
import json
from functools import cache

import numpy as np
import pytest
import reduced_cases
from served import needs_browser, open_page, served

import turgor as tg
from refused import refused
from turgor.cli.app import main
from turgor.core.results.files.response_csv import read_response
from turgor.reduced.measures import with_measures
from turgor.studio.tasks import reduced as moved
from turgor.studio.tasks import sequences
from turgor.units import deg, kPa

KEY = reduced_cases.KEY
MOST = reduced_cases.PRESSURE / kPa


@cache
def model():
    """A reduced finger that states its bending angle."""
    return with_measures(reduced_cases.reduced_of(6), ["bending_angle"])


@pytest.fixture
def folder(tmp_path):
    """A folder with the finger."""
    model().save(tmp_path / "finger.reduced")
    return tmp_path


def test_state_of_page_is_that_of_reduced_model(folder):
    answer = moved.at_inputs(folder / "finger.reduced", {KEY: 8.0})
    same = model().solve(8 * kPa)
    assert answer["tip"] == pytest.approx(same.tip.tolist(), rel=1e-5, abs=1e-8)  # a file has four digits
    angle = tg.bending_angle(same.state())
    words = dict(answer["rows"])["bending angle"]
    assert float(words.split(" ")[0]) == pytest.approx(angle / deg, abs=0.06)
    assert "±" in words


def test_state_outside_of_trained_range_is_refused(folder):
    with refused(KEY, "0 kPa to 12 kPa"):
        moved.at_inputs(folder / "finger.reduced", {KEY: 1.01 * MOST})
    with refused(KEY, "much"):
        moved.at_inputs(folder / "finger.reduced", {KEY: "much"})


def test_dragged_tip_finds_pressure_and_stops_at_limit(folder):
    file = folder / "finger.reduced"
    there = model().solve(7 * kPa).tip
    answer = moved.at_tip(file, there, {KEY: 2.0}, [KEY], True)
    assert answer["inputs"][KEY] == pytest.approx(7.0, rel=1e-3)
    assert answer["distance"] < 1e-6
    assert answer["limits"] == []
    beyond = moved.at_tip(file, 3 * model().solve(MOST * kPa).tip, answer["inputs"], [KEY], True)
    assert beyond["limits"] == [f"{KEY} high"]
    assert beyond["distance"] == pytest.approx(2 * float((model().solve(MOST * kPa).tip ** 2).sum() ** 0.5), rel=0.05)
    with refused("no input"):
        moved.at_tip(file, there, {KEY: 2.0}, [], True)


def test_modes_of_page_give_the_surface(folder):
    table, numbers = moved.described(folder / "finger.reduced")
    shape = table["shapes"][0]
    surface = np.frombuffer(numbers, dtype=np.float32, count=int(np.prod(shape))).reshape(shape)
    state = model().solve(MOST * kPa)
    points = surface[0] + np.tensordot(state.q, surface[1:], 1)
    every = model().model.mesh.points + state.displacement
    away = [np.linalg.norm(every - point, axis=1).min() for point in points[::40]]
    assert max(away) < 1e-6
    assert table["plane"] == pytest.approx([0, 1, 0], abs=1e-6) or table["plane"] == pytest.approx([0, -1, 0], abs=1e-6)


def test_sequence_comes_back_from_its_file_and_can_be_tracked(folder):
    file, saved = folder / "finger.reduced", folder / "wave.csv"
    knots = [[0, [0.0]], [1, [6.0]], [1.5, [6.0]], [2.5, [0.0]], [3.5, [6.0]], [4, [6.0]], [5, [0.0]]]
    made = sequences.write_sequence(file, saved, knots)
    assert made["rows"] > 50
    back = sequences.read_sequence(file, saved)
    assert back["repeats"] == 2
    assert back["start"] == [0.0]
    assert [each["seconds"] for each in back["steps"]] == pytest.approx([1, 0.5, 1])
    assert [each["inputs"][0] for each in back["steps"]] == pytest.approx([6, 6, 0])
    header = next(csv.reader(saved.open(encoding="utf-8")))
    assert header[:5] == ["time_s", "loads_pressure_kPa", "tip_x_mm", "tip_y_mm", "tip_z_mm"]
    code = main(["track", str(file), str(saved), "-o", str(folder / "track")])
    assert code == 0
    track = read_response(folder / "track" / "track.csv")
    assert track["distance"].max() < 1e-5


def test_sequence_that_model_cannot_follow_is_refused(folder):
    file = folder / "finger.reduced"
    with refused(KEY, "99 kPa", "0 kPa to 12 kPa"):
        sequences.write_sequence(file, folder / "a.csv", [[0, [0.0]], [1, [99.0]]])
    with refused("times", "rise"):
        sequences.write_sequence(file, folder / "a.csv", [[0, [0.0]], [0, [1.0]]])
    (folder / "b.csv").write_text("time_s,tip_x_mm\n0,0\n1,1\n", encoding="utf-8")
    with refused("b.csv", "loads_pressure", "time_s"):
        sequences.read_sequence(file, folder / "b.csv")
    assert not (folder / "a.csv").exists()


def _angle(page) -> float:
    return float(page.locator(".live-rows dd").first.inner_text().split(" ")[0])


@needs_browser
def test_slider_tip_and_sequence_in_the_page(folder):
    with served(folder / "finger.reduced", command="live") as studio, open_page(studio) as shown:
        page = shown.page
        page.wait_for_selector(".live-grip")
        assert not page.locator("nav").is_visible()  # a window of its own
        shown.until("document.querySelector('.live-readings').innerText.includes('reduction')")
        page.get_by_role("button", name="Record").click()
        _slide(page, 9.0)
        shown.until("document.querySelector('.live-number').value === '9'")
        assert _angle(page) == pytest.approx(
            float(tg.bending_angle(model().solve(9 * kPa).state())) * 57.29578, abs=0.1
        )
        page.wait_for_timeout(300)
        _drag_tip(page, -4000, 0)  # far away, so that a limit is reached
        shown.until("/pressure (low|high)/.test(document.querySelector('.live-far').textContent)")
        assert "mm away" in page.inner_text(".live-far")
        page.wait_for_timeout(300)  # the last answer is recorded, too
        page.get_by_role("button", name="Stop recording").click()
        entries = page.locator(".live-steps li").all_inner_texts()
        assert [entry.split()[0] for entry in entries] == ["Start", "Move", "Wait", "Move"]
        page.get_by_role("button", name="Save").click()
        page.wait_for_selector(".message:has-text('rows with the tip')")
        assert read_response(folder / "finger-sequence.csv")["loads_pressure"].max() > 8.9 * kPa
        page.get_by_role("button", name="Play").click()
        shown.until("document.querySelector('main').live.sequence.playing > 0")
        shown.until("document.querySelector('main').live.sequence.playing === 0")
        page.get_by_role("button", name="Clear").click()
        page.select_option(".live-row select", "finger-sequence.csv")
        page.get_by_role("button", name="Load").click()
        shown.until("document.querySelectorAll('.live-steps li').length === 4")
        shown.check()


@needs_browser
def test_value_outside_is_refused_with_its_sentence(folder):
    with served(folder) as studio, open_page(studio, "#/live/finger.reduced") as shown:
        page = shown.page
        page.wait_for_selector(".live-grip")
        page.fill(".live-input .live-number", "99")
        page.keyboard.press("Enter")
        page.wait_for_selector("[role=alert]:has-text('outside of the trained range')")
        shown.until("document.querySelector('.live-input .live-number').value === '0'")


def _slide(page, value: float) -> None:
    page.evaluate(
        """(value) => {
          const slider = document.querySelector('.live-input input[type=range]');
          slider.value = value;
          for (const kind of ["input", "change"]) slider.dispatchEvent(new Event(kind, { bubbles: true }));
        }""",
        value,
    )


def _drag_tip(page, dx: float, dy: float) -> None:
    box = page.locator(".live-grip").bounding_box()
    x, y = box["x"] + 12, box["y"] + 12
    page.mouse.move(x, y)
    page.mouse.down()
    for share in (0.2, 0.5, 1.0):
        page.mouse.move(x + share * dx, y + share * dy)
    page.wait_for_selector(".live-far:has-text('mm away')")  # while the button is down
    page.mouse.up()


def test_messages_of_page_that_make_no_sense_are_answered(folder):
    connect = pytest.importorskip("websockets.sync.client").connect
    with served(folder) as studio:
        address = studio.origin.replace("http", "ws") + "/ws/live/finger.reduced"
        headers = {"Cookie": studio.cookie()}
        with connect(address, origin=studio.origin, additional_headers=headers, max_size=None) as socket:
            socket.recv(), socket.recv()
            for text in ("no json", "[1]", '{"inputs": 3}', json.dumps({"inputs": {KEY: 1.0}, "wanted": ["a"]})):
                socket.send(text)
                assert "refused" in json.loads(socket.recv()), text
            socket.send(json.dumps({"number": 7, "inputs": {KEY: 1.0}}))
            assert json.loads(socket.recv())["number"] == 7
