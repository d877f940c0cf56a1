"""Commands that fit and ask surrogates and tell sensitivities."""

import json

import pytest

import surrogate_cases as cases
from refused import states
from turgor.cli.app import main
from turgor.studies.runs.files.study_folder import write_study
from turgor.studies.runs.sweep import sweep
from turgor.studies.surrogates.surrogate import Surrogate
from turgor.units import deg, kPa, mm


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    result = tmp_path_factory.mktemp("sampled")
    write_study(cases.study_of(cases.finger, [cases.WALL, cases.C10], 12), result)
    assert main(["surrogate", str(result), "--along", "pressure", "--measure", "bending_angle"]) == 0
    return result


def test_a_folder_gets_a_surrogate(folder):
    fitted = Surrogate.load(folder / "surrogate.turgor")
    assert [each.name for each in fitted.factors] == ["wall", "C10", "pressure"]
    assert (folder / "surrogate.png").stat().st_size > 5000
    assert "RMS in held-out rows" in (folder / "surrogate.txt").read_text(encoding="utf-8")


def test_it_is_asked_forward(folder, capsys):
    file = str(folder / "surrogate.turgor")
    at = ["--at", "wall=1.5 mm", "--at", "C10=75 kPa", "--at", "pressure=30 kPa"]
    assert main(["predict", file, *at]) == 0
    value = float(capsys.readouterr().out.removeprefix("bending angle ").split()[0])
    assert value * deg == pytest.approx(cases.finger(1.5 * mm, 75 * kPa)["bending_angle"][6], rel=0.01)
    assert main(["predict", file, *at[:-1], "pressure=60 kPa"]) == 1
    assert states(capsys.readouterr().err, "pressure", "60 kPa", "0 kPa to 50 kPa")
    assert main(["predict", file, *at[:-1], "pressure=60 kPa", "--extrapolate", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["findings"][0]["code"] == "U01"
    assert told["result"]["values"]["bending_angle"] > 0


def test_it_is_asked_backward(folder, capsys):
    file = str(folder / "surrogate.turgor")
    held = ["--at", "wall=1.5 mm", "--at", "C10=75 kPa"]
    assert main(["predict", file, *held, "--want", "bending_angle=20 deg", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["result"]
    exact = cases.finger(told["at"]["wall"], told["at"]["C10"], told["at"]["pressure"])["bending_angle"][-1]
    assert exact == pytest.approx(20 * deg, rel=0.01)
    assert list(told["factor_deviations"]) == ["pressure"]
    assert main(["predict", file, *held, "--want", "bending_angle=80 deg"]) == 3
    assert "Nothing in the range gives that" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--at", "wal=1 mm"], "unknown name in --at 'wal'; did you mean 'wall'?"),
        (["--at", "wall"], "--at is 'wall'; write NAME=VALUE"),
        (["--at", "wall=1 kPa"], "--at wall: "),
        (["--prefer", "wall=1 mm"], "--prefer goes with --want"),
        (["--want", "bending_angle=20 deg", "--extrapolate"], "--extrapolate does not go with --want"),
    ],
)
def test_bad_options_are_sentences(folder, options, sentence, capsys):
    assert main(["predict", str(folder / "surrogate.turgor"), *options]) == 1
    assert sentence in capsys.readouterr().err


def test_samples_get_sobol_indices(folder, capsys):
    asked = ["sensitivity", str(folder), "--at", "pressure=40 kPa", "--measure", "bending_angle", "--samples", "64"]
    assert main([*asked, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["result"]
    assert told["method"] == "sobol"
    assert [each["factor"] for each in told["terms"]] == ["wall", "C10"]
    assert all(0 <= each["total_low"] <= each["total"] for each in told["terms"])
    assert (folder / "sensitivity.png").is_file()
    assert main([*asked, "--spread", "wall=1.5 mm+-0.1 mm", "--spread", "C10=5 %"]) == 0
    assert "with wall, C10 normal" in capsys.readouterr().out
    assert main([*asked, "--spread", "wal=0.1 mm"]) == 1
    assert states(capsys.readouterr().err, "--spread", "'wal'", "'wall'")
    assert main([*asked, "--method", "anova", "--spread", "wall=0.1 mm"]) == 1
    assert states(capsys.readouterr().err, "--spread", "sobol")
    assert main([*asked, "--method", "sobl"]) == 1
    assert states(capsys.readouterr().err, "'sobl'", "'sobol'")


def test_a_factorial_gets_an_analysis_of_variance(tmp_path, capsys):
    study = sweep(cases.finger, wall=[1 * mm, 1.5 * mm, 2 * mm], C10=[50 * kPa, 100 * kPa])
    write_study(study, tmp_path)
    assert main(["sensitivity", str(tmp_path), "--at", "pressure=40 kPa", "--measure", "bending_angle"]) == 0
    said = capsys.readouterr().out
    assert said.startswith("bending angle: C10 ")
    assert "wall × C10" in said
    assert main(["sensitivity", str(tmp_path), "--at", "presure=40 kPa"]) == 1
    assert states(capsys.readouterr().err, "'presure'", "'pressure'")
