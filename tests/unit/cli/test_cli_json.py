"""``--json``: one document on standard output, findings and errors included, with the exit code of the command."""

import json
from dataclasses import fields
from pathlib import Path

import pytest

from turgor.cli import main
from turgor.cli.answers import file_results, results
from turgor.cli.exits import BAD_INPUT, DONE, NOT_CONVERGED

ROOT = Path(__file__).parents[3]
FINGER = str(ROOT / "examples" / "actuators" / "slow_pneunet.toml")
SMALL = ["--set", "actuator.chambers=2", "--set", "actuator.length='24 mm'", "--set", "mesh.size='6 mm'"]
CURVE = "stretch,stress [kPa]\n" + "".join(
    f"{1 + n / 10},{100 * (1 + n / 10 - (1 + n / 10) ** -2):.6g}\n" for n in range(1, 11)
)


@pytest.fixture
def answer(capsys, tmp_path, monkeypatch):
    """Run a command with --json, and read what it prints."""
    monkeypatch.chdir(tmp_path)

    def run(*arguments, code=DONE):
        assert main([*arguments, "--json"]) == code
        printed = capsys.readouterr()
        result = json.loads(printed.out)
        assert list(result) == ["turgor", "exit_code", "error", "findings", "result"]
        assert result["exit_code"] == code
        return result

    return run


def keys(kind):
    return [item.name for item in fields(kind)]


def test_check(answer):
    result = answer("check", FINGER, *SMALL)
    assert list(result["result"]) == keys(results.CheckResult)
    assert result["result"]["unknowns"] > 500
    assert result["error"] is None


def test_findings_and_mistakes_stand_in_the_document(answer):
    doubtful = ["--set", "materials.body.record=ogden-steck-2019", "--set", "materials.body.library=ecoflex-00-30"]
    result = answer("check", FINGER, *SMALL, *doubtful)
    assert len(result["findings"]) > 0
    assert all(list(each) == ["code", "severity", "message", "advice"] for each in result["findings"])
    result = answer("check", FINGER, "--set", "mesh.siz=1", "--set", "loads.presure=1", code=BAD_INPUT)
    assert len(result["error"]["problems"]) == 2


def test_run(answer, tmp_path):
    quick = [f"output.{name}=false" for name in ("fields", "pictures", "report", "mesh_error")]
    changed = [part for text in ("loads.pressure=1 kPa", *quick) for part in ("--set", text)]
    result = answer("run", FINGER, *SMALL, *changed)["result"]
    assert list(result) == keys(results.RunResult)
    assert (result["status"], result["columns"][0]["name"]) == ("converged", "load_factor")
    pressure = next(each for each in result["columns"] if each["name"] == "pressure")
    assert (pressure["unit"], pressure["values"][-1]) == ("kPa", pytest.approx(1.0))
    assert (tmp_path / result["folder"] / result["files"][0]).exists()


def test_a_run_that_stops_early_says_so(answer):
    stops = ["procedure.max_steps=1", "output.fields=false", "output.pictures=false", "output.report=false"]
    changed = [part for text in (*stops, "output.mesh_error=false") for part in ("--set", text)]
    result = answer("run", FINGER, *SMALL, *changed, code=NOT_CONVERGED)
    assert result["result"]["status"] != "converged"
    assert result["result"]["message"]


def test_mesh(answer):
    result = answer("mesh", FINGER, *SMALL)["result"]
    assert list(result) == keys(results.MeshResult)
    assert 0 < result["min_edge_m"] < result["max_edge_m"] < 0.02


@pytest.mark.parametrize("what", [["list"], ["show", "ecoflex-00-30"]])
def test_materials(answer, what):
    records = answer("materials", *what)["result"]["materials"]["ecoflex-00-30"]
    assert {"yeoh-steck-2019"} <= {each["record"] for each in records}
    assert any(each["doubts"] for each in records)


def test_actuators(answer):
    assert answer("actuators")["result"]["keys"] == []
    result = answer("actuators", "fast_pneunet")["result"]
    assert result["keys"][1]["name"] == "length"
    assert result["keys"][1]["default"] == '"110 mm"'


def test_inspect(answer):
    result = answer("inspect", str(ROOT / "examples" / "cad_file.step"))["result"]
    assert list(result) == keys(file_results.InspectResult)
    assert result["cavities"][0]["volume"] > 1e-7


def test_fit(answer, tmp_path):
    file = tmp_path / "test.csv"
    file.write_text(CURVE, encoding="utf-8")
    result = answer(
        "fit", str(file), "--mode", "uniaxial", "--stress", "nominal", "--laws", "neo-hooke", "--starts", "2"
    )
    fit = result["result"]["materials"][0]["fits"][0]
    assert fit["law"] == "neo-hooke"
    assert fit["parameters"]["C10"] == pytest.approx(50e3, rel=1e-3)
    assert result["result"]["tests"][0]["mode"] == "uniaxial"


def test_export(answer):
    result = answer("export", FINGER, *SMALL, "--step")["result"]
    assert result["files"][0].endswith(".step")


@pytest.mark.parametrize(
    "arguments", [["check", "no.toml"], ["chek", "a"], ["inspect", "no.step"], ["run", "--nonsense"]]
)
def test_mistakes_are_documents_too(answer, arguments):
    result = answer(*arguments, code=BAD_INPUT)
    assert result["result"] is None
    assert result["error"]["message"]
