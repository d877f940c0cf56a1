"""The command ``turgor calibrate``: what it finds, prints, writes and refuses."""

import json
import tomllib

import numpy as np
import pytest
from PIL import Image

from calibration_cases import JOB
from refused import states
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.job.read import read_job
from turgor.studies.runs.jobs.job_runs import solved_job
from turgor.studies.runs.jobs.whole_job import digest_of, write_whole_job


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A job, and what a rig would measure if the rubber were softer and its wall thicker."""
    folder = tmp_path_factory.mktemp("calibrate")
    (folder / "tube.toml").write_text(JOB, encoding="utf-8")
    start = folder / "true.toml"
    write_whole_job(read_job(folder / "tube.toml"), start)
    true = solved_job(str(start), digest_of(start), {"materials.body.C10": 0.1e6, "actuator.wall": 2.2e-3}).response
    at = np.linspace(1e3, 19e3, 15)
    for name, unit, noise in (("tip_displacement_x", "mm", 2e-6), ("cavity_volume", "mL", 1e-8)):
        values = np.interp(at, true["pressure"], true[name]) + noise * np.random.default_rng(1).standard_normal(15)
        columns = Column("pressure", "kPa", at), Column(name, unit, values)
        Response(columns=columns, source=Source(text="rig")).to_csv(folder / f"{name}.csv")
    return folder


@pytest.fixture
def call(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)

    def run(*arguments):
        code = main(["calibrate", "tube.toml", "tip_displacement_x.csv", *arguments])
        said = capsys.readouterr()
        return code, said.out, said.err

    return run


def test_two_numbers_of_a_job_in_at_most_25_solves(call, folder):
    free = ["--free", "materials.body.C10", "--free", "actuator.wall=2 mm:1.5 mm:3 mm"]
    known = ["--prior", "actuator.wall=2.2 mm +- 1 %", "--spread", "0.002 mm"]
    code, _, _ = call(*free, *known, "--hold-out", "cavity_volume.csv", "--output", "two", "--json")
    assert code == DONE
    told = json.loads((folder / "two" / "calibration.json").read_text(encoding="utf-8"))
    values = {each["name"]: each for each in told["parameters"]}
    assert told["solves"] == told["computed"] <= 25
    assert values["materials.body.C10"]["value"] == pytest.approx(0.1e6, rel=0.04)
    assert values["actuator.wall"]["value"] == pytest.approx(2.2e-3, rel=0.02)
    assert "rests on the prior of actuator.wall" in told["undetermined"][0]
    assert told["held_out"][0]["y"] == "cavity_volume"
    assert told["held_out"][0]["spread"] is None  # 0.002 mm is no volume
    assert told["fits"][0]["spread"] == pytest.approx(2e-6)
    # the same again: everything is read
    code, said, _ = call(*free, *known, "--hold-out", "cavity_volume.csv", "--output", "two", "--json")
    result = json.loads(said)["result"]
    assert (result["computed"], result["solves"]) == (0, told["solves"])
    assert result["parameters"] == told["parameters"]


def test_files_and_sentences(call, folder):
    code, said, told = call("--free", "materials.body.C10", "--rig", "pressure_offset", "--output", "one")
    assert code == DONE
    assert "materials.body.C10 = 0.10" in said
    assert "The spread of the measurement is not given" in said
    assert "Written in one: calibration.json, calibration.csv, calibration.png" in said
    assert "materials.body.C10 1.2e+05: done" in told
    names = {each.name for each in (folder / "one").iterdir()}
    assert names >= {"start.toml", "calibrated.toml", "calibration.csv", "curve-1-tip_displacement_x.csv", "runs"}
    assert Image.open(folder / "one" / "calibration.png").size[0] > 400
    text = (folder / "one" / "calibrated.toml").read_text(encoding="utf-8")
    assert text.startswith("# Calibrated:\n# materials.body.C10 = 0.10")
    result = json.loads((folder / "one" / "calibration.json").read_text(encoding="utf-8"))["parameters"][0]["value"]
    assert pytest.approx(result) == read_job(folder / "one" / "calibrated.toml").materials["body"].law.C10
    assert "pressure_offset" not in tomllib.loads(text)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (
            ["--free", "materials.body.C1"],
            "unknown number of the job 'materials.body.C1'; did you mean 'materials.body.C10'",
        ),
        (["--free", "materials.body.C10=5"], "--free: factors.materials.body.C10: start: '5' needs a unit"),
        (["--free", "materials.body.C10=0.1 MPa:0.2 MPa:0.3 MPa"], "starts at 0.1 MPa; allowed is 0.2 MPa to 0.3 MPa"),
        (["--free", "materials.body.C10:1"], "write KEY, KEY=START, or KEY=START:LOWER:UPPER"),
        (["--free", "mesh.wall_cells"], "'mesh.wall_cells' is a whole number"),
        (["--free", "actuator.wall,materials.body.C10"], "length and pressure cannot have one value"),
        (["--free", "materials.body.C10", "--prior", "actuator.wall=2 mm+-1 mm"], "unknown parameter with a prior"),
        (["--free", "materials.body.C10", "--prior", "materials.body.C10=2 mm"], "'2 mm' is a length"),
        (["--free", "materials.body.C10", "--prior", "materials.body.C10=1 MPa+-x%"], "'x%' is no share in percent"),
        (["--free", "materials.body.C10", "--prior", "materials.body.C10"], "write KEY=MEAN+-DEVIATION"),
        (["--free", "materials.body.C10", "--spread", "3"], "write a number and a unit of the experiments (kPa, mm)"),
        (["--free", "materials.body.C10", "--unit", "pressure"], "--unit is 'pressure'"),
        (["--free", "materials.body.C10", "--loading", "--unloading"], "leave both out to fit both"),
        (["--free", "materials.body.C10", "--remove", "offset"], "name it in rig"),
        (["--free", "materials.body.C10", "--compliance", "0.04 mm"], "'0.04 mm'"),
        (["--free", "materials.body.C10", "--compliance", "0.04 mm/N"], "needs one force in"),
        (["--free", "materials.body.C10", "--by", "specimen"], "unknown column 'specimen'"),
        ([], "a calibration needs a parameter that is free"),
        (["--free", "materials.body.C10", "--output", "."], "holds files of something else"),
        (["--free", "materials.body.C10", "--output", "tube.toml"], "'tube.toml' is a file; name another"),
    ],
)
def test_mistakes_are_answered(call, arguments, sentence):
    code, _, told = call("--output", "refused", *arguments)
    assert code == BAD_INPUT
    assert sentence in told
    assert "Traceback" not in told


def test_a_rubber_of_two_regions_is_noticed(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    text = (
        JOB.replace("extending_cylinder", "fast_pneunet")
        .partition("[materials]")[0]
        .replace('"axisymmetric"', '"tetrahedra"')
    )
    text = text.replace('length = "20 mm"\ncap = "3 mm"\n', "").replace("wall_cells = 1\n", "")
    rubber = 'body = { law = "neo_hooke", C10 = "0.12 MPa" }\nbase = { law = "neo_hooke", C10 = "0.12 MPa" }\n'
    (folder / "finger.toml").write_text(f'{text}[materials]\n{rubber}[loads]\npressure = "1 kPa"\n', encoding="utf-8")
    call = [
        "calibrate",
        "finger.toml",
        "tip_displacement_x.csv",
        "--free",
        "materials.body.C10",
        "--rig",
        "presure_offset",
    ]
    assert main(call) == BAD_INPUT
    assert states(capsys.readouterr().err, "materials.base.C10", "materials.body.C10", "fixed")
