"""The records of a rubber in the library as alternatives: each a run, with its doubts and its problem."""

import csv
import json

import numpy as np
import pytest

import turgor as tg
from calibration_cases import JOB
from refused import refused
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies.uncertainty.cases import library_alternatives
from turgor.studies.uncertainty.propagate import propagate

ECOFLEX = "ecoflex-00-30"


def slope_of(record: str) -> Response:
    """A force in proportion to the shear modulus of a record."""
    modulus = tg.from_library(ECOFLEX, record=record).law.shear_modulus
    x = np.array([0.0, 1e3]) if record != "ogden-moseley-2016" else np.array([0.0, 0.5e3])
    columns = Column("pressure", "kPa", x), Column("force", "N", modulus * x / 1e6)
    return Response(columns=columns, source=Source(text="a slope"), message="Too soft. Stop.")


def test_records_are_told_one_by_one():
    asked = library_alternatives("record", ECOFLEX)
    result = propagate(slope_of, [asked])
    assert result.runs == len(asked.sets) == 13
    kept = [each for each in result.cases if not each.problem]
    modulus = {each.name: tg.from_library(ECOFLEX, record=each.name).law.shear_modulus / 1e3 for each in kept}
    ends = np.array(list(modulus.values()))
    assert result.band("force").deviation[-1] == pytest.approx(ends.std(ddof=1))
    assert result.drive.values[-1] == pytest.approx(1e3)  # a record that ends early does not cut the band
    told = result.case_sentences()
    assert told[0] == f"{ECOFLEX}: 13 records, 11 of them in the band."
    low, high = min(modulus, key=modulus.get), max(modulus, key=modulus.get)
    assert f"({low}), highest " in told[1].split(";")[0]
    assert f"({high})" in told[1].split(";")[0]
    sound = [modulus[each.name] for each in kept if not each.doubts]
    assert f"standard deviation {np.std(sound, ddof=1):.3g} N." in told[1].split(";")[1]
    assert "mooney-rivlin-steck-2019 (M06)" in told[2]
    assert any("ogden-moseley-2016: ends at 0.5 kPa of 1 kPa. Too soft." in each for each in told)
    assert any("mooney-rivlin-steck-2019" in each and "negative modulus" in each for each in told)
    assert result.summary().count("Not in the band") == 2


def test_doubtful_records_are_left_out():
    asked = library_alternatives("record", ECOFLEX, leave_out_doubtful=True, nominal="ogden-steck-2019")
    assert asked.names[0] == "ogden-steck-2019"  # the nominal one stays
    assert not any(asked.doubts[1:])
    assert len(asked.names) == 8


def test_what_has_no_alternatives_is_answered():
    with refused("'dragon-skin-15'", "'neo-hooke-maker'", "two"):
        library_alternatives("record", "dragon-skin-15")
    with refused("'ecoflex-00-50'", "'yeoh-kulkarni-2015'", "doubts"):
        library_alternatives("record", "ecoflex-00-50", leave_out_doubtful=True)
    with refused("'ecoflex-00-30'", "'yeoh-stek-2019'", "'yeoh-steck-2019'"):
        library_alternatives("record", ECOFLEX, nominal="yeoh-stek-2019")


STATED = 'body = { law = "neo_hooke", C10 = "0.12 MPa" }'


@pytest.fixture
def call(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    own = 'body = { library = "dragon-skin-10", record = "yeoh-caasenbrood-2020" }'
    lonely = 'body = { library = "dragon-skin-15", record = "neo-hooke-maker" }'
    for name, body in (("tube", own), ("stated", STATED), ("lonely", lonely)):
        (tmp_path / f"{name}.toml").write_text(JOB.replace(STATED, body).replace("20 kPa", "8 kPa"), encoding="utf-8")

    def run(job, *arguments):
        code = main(["uncertainty", f"{job}.toml", "--output", job, *arguments])
        said = capsys.readouterr()
        return code, said.out, said.err

    return run


def test_the_records_of_a_job(call, tmp_path):
    code, said, _ = call("tube", "--records", "materials.body as rubber", "--json")
    assert code == DONE
    result = json.loads(said)["result"]
    results = {each["name"]: each for each in result["records"]}
    assert next(iter(results)) == "yeoh-caasenbrood-2020"  # that of the job
    assert "linear elastic" in results["hooke-bilodeau-2018"]["problem"]
    ends = [each["values"]["tip_displacement_x"] for each in results.values() if each["values"]]
    assert len(ends) == 5
    soft, stiff = results["neo-hooke-connolly-2017"], results["neo-hooke-polygerinos-2020"]
    moduli = [tg.from_library("dragon-skin-10", record=each["name"]).law.shear_modulus for each in (soft, stiff)]
    ratio = stiff["values"]["tip_displacement_x"] / soft["values"]["tip_displacement_x"]
    assert (ratio > 1) == (moduli[0] > moduli[1])
    assert "± " in result["sentences"][0]
    assert "(mesh)" in result["sentences"][0]
    assert "(rubber)" in result["sentences"][0]
    with (tmp_path / "tube" / "records.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["record"] for row in rows] == list(results)


@pytest.mark.parametrize(
    ("job", "arguments", "sentence"),
    [
        ("tube", ["--records", "materials.bod"], "did you mean 'materials.body'"),
        ("tube", ["--records", "materials.body", "--spread", "materials.body.C10=5 %"], "two spreads"),
        ("tube", ["--records", "materials.body", "--records", "materials.body"], "two spreads"),
        ("stated", ["--records", "materials.body"], "is no record of the library"),
        ("lonely", ["--records", "materials.body"], "has one record, 'neo-hooke-maker'"),
    ],
)
def test_mistakes_are_answered(call, job, arguments, sentence):
    code, _, told = call(job, *arguments)
    assert code == BAD_INPUT
    assert sentence in told
    assert "Traceback" not in told
