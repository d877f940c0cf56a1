"""The spread between laboratories of a rubber of the library, by name: ``--spread materials.body=library``."""

import json
from math import exp
from pathlib import Path

import pytest

from calibration_cases import JOB
from refused import refused
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.core.materials.library.spread import spread_of
from turgor.studies.study_file.job_base import JobBase
from turgor.studies.uncertainty.library_spread import laboratory_alternatives

STATED = 'body = { law = "neo_hooke", C10 = "0.12 MPa" }'
OGDEN = 'body = { library = "dragon-skin-10", record = "ogden-nuthi-2018" }'
YEOH = 'body = { library = "dragon-skin-10", record = "yeoh-caasenbrood-2020" }'


@pytest.fixture
def job(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)

    def write(body: str) -> Path:
        path = tmp_path / "tube.toml"
        path.write_text(JOB.replace(STATED, body).replace("20 kPa", "8 kPa"), encoding="utf-8")
        return path

    return write


def test_all_moduli_are_scaled_together_and_nothing_else(job) -> None:
    base = JobBase(job(OGDEN), {})
    nominal, soft, stiff = laboratory_alternatives("materials.body", "rubber", base.job, base.numbers).sets
    assert set(nominal) == {f"materials.body.mu.{term}" for term in (1, 2, 3)}, "no exponent, bulk modulus or strength"
    factor = exp(spread_of("dragon-skin-10").deviation)
    for key, value in nominal.items():
        assert stiff[key] / value == value / soft[key] == pytest.approx(factor)


def test_the_command_takes_it_by_name(job, capsys: pytest.CaptureFixture[str]) -> None:
    job(YEOH)
    assert main(["uncertainty", "tube.toml", "--spread", "materials.body=library as rubber", "--json"]) == DONE
    result = json.loads(capsys.readouterr().out)["result"]
    assert "(rubber)" in result["sentences"][0]
    assert result["shares"]["tip_displacement_x"]["rubber"] == pytest.approx(1.0)
    main(["uncertainty", "tube.toml", "--spread", "materials.body.C10=11 % as rubber", "--output", "one", "--json"])
    alone = json.loads(capsys.readouterr().out)["result"]
    there, here = (each["sentences"][0].split(" ± ")[-1].split()[0] for each in (alone, result))
    assert float(here) == pytest.approx(float(there), rel=0.25), "C10 alone makes most of it: 11 % between laboratories"


def test_what_has_no_spread_is_answered(job, capsys: pytest.CaptureFixture[str]) -> None:
    job(STATED)
    assert main(["uncertainty", "tube.toml", "--spread", "materials.body=library"]) == BAD_INPUT
    assert "is no record of the library" in capsys.readouterr().err
    assert main(["uncertainty", "tube.toml", "--spread", "materials.body=libary"]) == BAD_INPUT
    assert "write library, for the spread between laboratories, or fitted" in capsys.readouterr().err
    base = JobBase(job(YEOH), {})
    with refused("'materials.bod'", "'materials.body'"):
        laboratory_alternatives("materials.bod", "", base.job, base.numbers)
