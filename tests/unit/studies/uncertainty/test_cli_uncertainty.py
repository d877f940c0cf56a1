"""The command ``turgor uncertainty``: what it prints, writes and refuses."""

import json

import pytest
from PIL import Image

from calibration_cases import JOB
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.core.results.files.response_csv import read_response


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("uncertainty")
    (folder / "tube.toml").write_text(JOB, encoding="utf-8")
    (folder / "specimens.csv").write_text("materials.body.C10 (kPa)\n120\n110\n\n135\n", encoding="utf-8")
    return folder


@pytest.fixture
def call(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)

    def run(*arguments):
        code = main(["uncertainty", "tube.toml", *arguments])
        said = capsys.readouterr()
        return code, said.out, said.err

    return run


def test_bands_of_a_job(call, folder):
    asked = [
        "--spread",
        "actuator.wall=0.1 mm as wall",
        "--spread",
        "pressure=0.3 kPa",
        "--sets",
        "rubber=specimens.csv",
    ]
    code, said, _ = call(*asked, "--output", "bands", "--at", "15 kPa")
    assert code == DONE
    assert said.startswith("tip displacement x at 15 kPa: 0.")
    for label in ("(mesh)", "(rubber)", "(wall)", "(pressure)"):
        assert label in said.splitlines()[0]
    assert "Linear propagation with central differences at one standard deviation: 6 runs." in said
    table = read_response(folder / "bands" / "uncertainty.csv")
    whole = table["tip_displacement_x_spread"]
    parts = [table[f"tip_displacement_x_spread_from_{name}"] for name in ("rubber", "wall", "pressure")]
    assert whole == pytest.approx(sum(part**2 for part in parts) ** 0.5)
    assert Image.open(folder / "bands" / "uncertainty.png").size[0] > 400
    code, said, _ = call(*asked, "--output", "bands", "--json")  # everything is read
    result = json.loads(said)["result"]
    assert result["shares"]["tip_displacement_x"]["rubber"] > 0.5
    assert sum(result["shares"]["cavity_volume"].values()) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--spread", "actuator.wal=0.1 mm"], "did you mean 'actuator.wall'"),
        (["--spread", "actuator.wall"], "write KEY=DEVIATION"),
        (["--spread", "actuator.wall=0.1"], "--spread: factors.actuator.wall: spread: '0.1' needs a unit"),
        (["--spread", "actuator.wall=0.1 kPa"], "'0.1 kPa' is a pressure"),
        (["--spread", "actuator.wall=0 mm"], "allowed is above 0"),
        (["--spread", "pressure=1 mm"], "--spread: factors.pressure: spread: '1 mm' is a length"),
        (["--sets", "specimens.csv"], "write LABEL=FILE"),
        (["--sets", "rubber=none.csv"], "there is no table of designs 'none.csv'"),
        (["--sets", "rubber=unit.csv"], "'materials.body.C10' needs a unit in brackets: Pa, kPa"),
        (["--sets", "rubber=cell.csv"], "'cell.csv', line 3: materials.body.C10: 'soft' is not a number"),
        (["--sets", "rubber=one.csv"], "'rubber' has 1 sets of numbers"),
        (["--sets", "rubber=wide.csv"], "'wide.csv', line 2: 2 cells; the first line has 1"),
        (["--spread", "actuator.wall=0.1 mm", "--method", "cubic"], "unknown method 'cubic'"),
        (["--spread", "actuator.wall=0.1 mm", "--at", "5"], "at: '5' needs a unit"),
        ([], "nothing has a spread"),
    ],
)
def test_mistakes_are_answered(call, folder, arguments, sentence):
    head = "materials.body.C10 (kPa)\n"
    texts = {"unit": "materials.body.C10\n1\n", "cell": head + "1\nsoft\n", "one": head + "1\n", "wide": head + "1,2\n"}
    for name, text in texts.items():
        (folder / f"{name}.csv").write_text(text, encoding="utf-8")
    code, _, told = call("--output", "refused", *arguments)
    assert code == BAD_INPUT
    assert sentence in told
    assert "Traceback" not in told
