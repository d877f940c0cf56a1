"""``turgor reduce`` makes a file, and ``turgor predict`` reads it."""

import json

import pytest
from reduced_cases import CHANGES, JOB, reduced
from typer.testing import CliRunner

from turgor.cli.start.commands import command_line


def run(*arguments: str) -> tuple[int, str]:
    done = CliRunner().invoke(command_line(arguments[0]), list(arguments))
    return done.exit_code, done.output


def test_predict_answers_from_the_file_of_a_reduced_model(tmp_path):
    file = str(reduced().save(tmp_path / "finger"))
    code, text = run("predict", file, "--at", "pressure=7 kPa", "--json")
    assert code == 0
    answer = json.loads(text)["result"]
    assert answer["volumes"]["cavity"] == pytest.approx(reduced().solve(7000.0).volumes["cavity"])
    assert answer["estimate"] == pytest.approx(reduced().solve(7000.0).estimate)
    assert answer["doubtful"] is False
    code, text = run("predict", file, "--at", "pressure=70 kPa")
    assert code == 1
    assert "70 kPa" in text
    assert "12 kPa" in text


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
