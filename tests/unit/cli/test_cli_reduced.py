"""``turgor reduce`` makes a file, and ``turgor predict`` reads it."""

import json
import re

import pytest
from reduced_cases import CHANGES, JOB, reduced
from typer.testing import CliRunner

import turgor as tg
from turgor.cli.start.commands import command_line
from turgor.reduced.measures import with_measures
from turgor.reduced.states.controlled import at_gas


def run(*arguments: str) -> tuple[int, str]:
    done = CliRunner().invoke(command_line(arguments[0]), list(arguments))
    return done.exit_code, done.output


def test_predict_answers_from_the_file_of_a_reduced_model(tmp_path):
    file = str(reduced().save(tmp_path / "finger"))
    code, text = run("predict", file, "--at", "pressure=7 kPa", "--json")
    assert code == 0
    answer = json.loads(text)["result"]
    assert answer["volumes"]["cavity"] == pytest.approx(reduced().solve(7000.0).volumes["cavity"], rel=1e-6)
    assert answer["estimate"] == pytest.approx(tg.load(file).solve(7000.0).estimate)
    assert answer["doubtful"] is False
    code, text = run("predict", file, "--at", "pressure=70 kPa")
    assert code == 1
    assert "70 kPa" in text
    assert "12 kPa" in text


def test_predict_states_measures_with_both_errors(tmp_path):
    made = with_measures(reduced(), ["bending_angle", "cavity_volume"])
    file = str(made.save(tmp_path / "finger"))
    code, text = run("predict", file, "--at", "pressure=7 kPa")
    assert code == 0, text
    assert re.search(r"bending angle [0-9.]+ ± [0-9.]+ deg, reduction ± [0-9.]+ deg", text)
    code, text = run("predict", file, "--at", "pressure=7 kPa", "--json")
    read = json.loads(text)["result"]["measures"]["bending_angle"]
    assert read["value"] == pytest.approx(tg.bending_angle(reduced().solve(7e3).state()), rel=2e-5)
    true = tg.bending_angle(tg.real_time.verified(reduced().solve(7e3)).state)
    assert abs(read["value"] - true) < 3 * read["reduction_error"] + 1e-6
    assert read["reduction_error"] < read["mesh_error"] < read["value"]


def test_predict_takes_volumes_and_gas(tmp_path):
    file = str(reduced().save(tmp_path / "finger"))
    code, text = run("predict", file, "--at", "cavity.volume=0.4 mL", "--json")
    assert code == 0, text
    answer = json.loads(text)["result"]
    volume = answer["volumes"]["cavity"]
    assert volume - reduced().solve(0.0).volumes["cavity"] == pytest.approx(0.4e-6)
    assert reduced().solve(answer["inputs"]["loads.pressure"]).volumes["cavity"] == pytest.approx(volume, rel=1e-6)
    code, text = run("predict", file, "--at", "mass_ratio=1.2", "--json")
    assert code == 0, text
    inputs = json.loads(text)["result"]["inputs"]
    assert inputs["loads.pressure"] == pytest.approx(at_gas(reduced(), {"cavity": 1.2}).inputs[0], rel=2e-6)


@pytest.mark.parametrize(
    ("options", "facts"),
    [
        (("cavty.volume=1 mL",), ["cavty", "cavity"]),
        (("volume=1 kPa",), ["--at volume", "1 kPa", "mL"]),
        (("volume=0.5 mL",), ["12 kPa", "loads.pressure"]),
        (("mass_ratio=-1",), ["-1", "more than 0"]),
        (("mass_ratio=1.1", "volume=0.1 mL"), ["--at", "both"]),
        (("volume=0.1 mL", "pressure=5 kPa"), ["loads.pressure", "volume"]),
    ],
)
def test_volumes_and_gas_that_are_none_are_refused(options, facts, tmp_path):
    file = str(reduced().save(tmp_path / "finger"))
    code, text = run("predict", file, *(item for each in options for item in ("--at", each)))
    assert code == 1
    for fact in facts:
        assert fact in text


def test_predict_follows_a_history_and_writes_its_table(tmp_path):
    file = str(reduced().save(tmp_path / "finger"))
    history = ("--at", "pressure=10 kPa", "--history", "pressure=[[0, 0], [0.5, 1], [1, 0.5]]", "--step", "0.25 s")
    code, text = run("predict", file, *history, "--json")
    assert code == 0, text
    answer = json.loads(text)["result"]
    assert answer["times"] == pytest.approx([0, 0.25, 0.5, 0.75, 1])
    assert answer["tip"][-1] == pytest.approx(reduced().solve(5e3).tip, rel=5e-6)
    lines = (tmp_path / "finger.csv").read_text().splitlines()
    assert "tip_z" in "".join(lines)
    code, text = run("predict", file, "--at", "pressure=10 kPa", "--history", "pressure=t", "--duration", "1 s")
    assert code == 0, text


@pytest.mark.parametrize(
    ("options", "facts"),
    [
        (("--history", "pressure=sin(t)"), ["--duration"]),
        (("--history", "pressure=[0, 1]"), ["--history pressure", "[0, 1]"]),
        (("--history", "pressure=[[0, 0], [1, 1]]", "--step", "1 mm"), ["--step", "1 mm"]),
        (("--history", "pressure=[[0, 0], [1, 1]]", "--motion"), ["motion"]),
        (("--history", "pressure=[[0, 0], [1, 1]]", "--damping", "1 ms"), ["--damping", "--motion"]),
        (("--duration", "1 s"), ["--duration", "--history"]),
        (("--at", "volume=0.1 mL", "--history", "pressure=[[0, 0], [1, 1]]"), ["--at volume", "--history"]),
    ],
)
def test_histories_that_are_none_are_refused(options, facts, tmp_path):
    code, text = run("predict", str(reduced().save(tmp_path / "finger")), "--at", "pressure=10 kPa", *options)
    assert code == 1
    for fact in facts:
        assert fact in text


@pytest.mark.slow
def test_reduce_makes_a_file(tmp_path):
    file = tmp_path / "finger.reduced"
    sets = [item for key, value in CHANGES.items() for item in ("--set", f"{key}={value}")]
    code, text = run(
        "reduce", str(JOB), *sets, "--along", "loads.pressure=0..3 kPa", "-o", str(file), "--held-out", "0"
    )
    assert code == 0, text
    assert file.exists()
    code, text = run("predict", str(file), "--at", "pressure=2 kPa")
    assert code == 0, text


@pytest.mark.parametrize(
    ("given", "facts"),
    [
        ("loads.pressure", ["--along", "KEY=FROM..TO"]),
        ("loads.pressure=3 kPa", ["--along", "KEY=FROM..TO"]),
        ("loads.pressure=0..3 kPaa", ["--along loads.pressure", "kPaa", "kPa"]),
        ("loads.pressure=0..3 mm", ["--along loads.pressure", "mm", "kPa"]),
        ("loads.pressure=0..3", ["--along loads.pressure", "unit"]),
        ("loads.presure=0..3 kPa", ["loads.presure", "loads.pressure"]),
        ("loads.pressure=3..0 kPa", ["loads.pressure", "3 kPa", "0 kPa"]),
    ],
)
def test_a_range_that_is_none_is_refused(given, facts):
    sets = [item for key, value in CHANGES.items() for item in ("--set", f"{key}={value}")]
    code, text = run("reduce", str(JOB), *sets, "--along", given)
    assert code == 1
    for fact in facts:
        assert fact in text


@pytest.mark.parametrize("option", [("--at", "pressure=7 mm"), ("--want", "tip=1 mm"), ("--extrapolate",)])
def test_predict_refuses_what_a_reduced_model_does_not_take(option, tmp_path):
    code, text = run("predict", str(reduced().save(tmp_path / "finger")), *option)
    assert code == 1
    assert option[0] in text


@pytest.mark.parametrize("command", ["reduce", "section", "buckling"])
def test_stages_are_refused_where_their_loads_would_be_passed_over(tmp_path, monkeypatch, command):
    monkeypatch.chdir(tmp_path)  # where results go by default
    job = tmp_path / "job.toml"
    text = JOB.read_text(encoding="utf-8").replace("[procedure]", "[[stages]]").replace('type = "static"', 'name = "a"')
    job.write_text(text, encoding="utf-8")
    code, text = run(command, str(job), *(("--along", "loads.pressure=0..3 kPa") if command == "reduce" else ()))
    assert code == 1
    assert "[[stages]]" in text
