"""Fits for an actuator on the command line: its stretches, the zero, batches with their spread, and the library."""

import json

import numpy as np
import pytest

from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.core.materials.library.records import find_record


def rows(factor, zero=1.0, upto=4.0, count=80):
    x = np.linspace(1.02, upto / zero, count)
    stress = factor * (x - x**-2) * (1 + 0.02 * (x - 1) ** 2)
    return [f"{stretch:.6f},{value:.6f}" for stretch, value in zip(zero * x, stress, strict=True)]


@pytest.fixture
def call(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    head = "stretch,nominal stress (kPa)"
    (tmp_path / "ecoflex_00_30.csv").write_text("\n".join([head, *rows(20.0, 1.04)]) + "\n", encoding="utf-8")
    batches = [f"{name},{row}" for name, factor in (("A", 18), ("B", 20), ("C", 22)) for row in rows(factor)]
    (tmp_path / "all.csv").write_text("\n".join([f"batch,{head}", *batches]) + "\n", encoding="utf-8")
    (tmp_path / "run").mkdir()
    response = "load_factor,pressure_kPa,principal_stretch_p99\n0,0,1\n0.5,10,1.3\n1,20,1.8\n"
    (tmp_path / "run" / "response.csv").write_text(response, encoding="utf-8")

    def run(*arguments):
        code = main(["fit", *arguments, "--mode", "uniaxial", "--laws", "neo-hooke,yeoh", "--starts", "2"])
        said = capsys.readouterr()
        return code, said.out, said.err

    return run


def test_the_stretches_of_a_run_and_an_estimated_zero(call):
    code, said, _ = call("ecoflex_00_30.csv", "--for", "run", "--zero", "auto")
    assert code == DONE
    assert "Outside stretch 1 to 1.8" in said and "Stretch counted from the length at 1.0" in said
    assert "P10" not in said and "P11" not in said
    assert "median of" in said and "sets of ecoflex-00-30" in said
    code, said, _ = call("ecoflex_00_30.csv", "--for", "stretch 1:2.5", "--rubber", "dragon-skin-10", "--json")
    result = json.loads(said)
    assert "dragon-skin-10" in next(each["message"] for each in result["findings"] if each["code"] == "M20")
    fit = result["result"]["materials"][0]["fits"][0]
    assert fit["stretch_range"][1] == pytest.approx(2.5, rel=0.02)


def test_batches_have_one_fit_and_a_spread(call, tmp_path):
    code, said, _ = call("all.csv", "--by", "batch", "--for", "stretch 1:2.5", "--output", "ours")
    assert code == DONE
    assert "Constants of neo-hooke by batches:" in said and "between 3 batches by 10 %" in said
    record = find_record(str(tmp_path / "ours" / "all.toml"), "neo-hooke")
    assert record.spread.of == "3 batches" and "by even least squares" in record.source
    assert record.spread.deviations["C10"] == pytest.approx(0.1 * record.constants["C10"], rel=0.02)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--for", "stretch 1-2.5"], "--for is 'stretch 1-2.5'"),
        (["--for", "stretch 2.5:1"], "the smaller stretch comes first"),
        (["--range", "-1:2"], "both are above 0"),
        (["--directions", "alng,across"], "did you mean 'along'"),
        (["--for", "1:2", "--range", "1:2"], "give one of them"),
        (["--for", "."], "holds no response.csv"),
        (["--zero", "soon"], "--zero is 'soon'"),
        (["--zero", "auto", "--preload", "1 kPa"], "--zero goes with neither --preload"),
        (["--by", "batch", "--each"], "--by goes with neither --each"),
        (["--by", "stretch"], "stretch"),
        (["--by", "bach"], "did you mean 'batch'"),
        (["--rubber", "ecoflex-00-31"], "ecoflex-00-30"),
    ],
)
def test_mistakes_are_answered(call, arguments, sentence):
    code, _, told = call("all.csv", *(["--average"] if "--rubber" in arguments else []), *arguments)
    assert code == BAD_INPUT
    assert sentence in told and "Traceback" not in told


def test_each_file_has_its_own_specimen(tmp_path, capsys):
    """A dumb-bell and a sheet that is slack for a fifth of its nominal length: forces over their own sections."""
    law, files = 10e3, []
    for name, power, area, zero in (("dumb", 2, 15e-6, 1.0), ("sheet", 3, 150e-6, 1.2)):
        x = np.linspace(0.97 / zero, 2.0, 80)
        stress = np.where(x > 1, 2 * law * (x - x**-power), -300.0)
        rows = [f"{9 * zero * a},{b}" for a, b in zip(x, stress * area, strict=True)]
        files.append(tmp_path / f"{name}.csv")
        files[-1].write_text("\n".join(["length (mm),force (N)", *rows]) + "\n", encoding="utf-8")
    sizes = ["--specimen", "9 mm, 5 mm, 3 mm; 9 mm, 50 mm, 3 mm"]
    arguments = ["fit", *map(str, files), "--mode", "uniaxial,planar", "--zero", "auto", "--laws", "neo-hooke"]
    assert main([*arguments, *sizes, "--json"]) == DONE
    fit = json.loads(capsys.readouterr().out)["result"]["materials"][0]["fits"][0]
    assert fit["parameters"]["C10"] == pytest.approx(law, rel=0.02)
    assert main([*arguments, "--specimen", "1 mm, 1 mm, 1 mm; 1 mm, 1 mm, 1 mm; 1 mm, 1 mm, 1 mm"]) == BAD_INPUT
    assert "3 specimens for 2 files" in capsys.readouterr().err
