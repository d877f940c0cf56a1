"""Bands of a fit in the uncertainty of a job: the file of the fit says how far its constants are off."""

import pytest

from calibration_cases import JOB
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.core.results.files.response_csv import read_response

OURS = """
name = "ours"
[records.neo-hooke]
law = "neo_hooke"
convention = "two_index"
parameters = { C10 = "120 kPa" }
source = "our tests"
[records.neo-hooke.spread]
of = "5 batches"
deviations = { C10 = "6 kPa" }
correlation = [[1.0]]
[records.ogden]
law = "ogden"
convention = "mu/alpha"
parameters = { mu_1 = "120 kPa", alpha_1 = 2.0 }
source = "our tests"
[records.ogden.spread]
of = "5 batches"
deviations = { mu_1 = "6 kPa", alpha_1 = 0.1 }
correlation = [[1.0, 0.5], [0.5, 1.0]]
[records.bare]
law = "neo_hooke"
convention = "two_index"
parameters = { C10 = "120 kPa" }
source = "a paper"
"""
STATED = 'body = { law = "neo_hooke", C10 = "0.12 MPa" }'


@pytest.fixture
def call(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "ours.toml").write_text(OURS, encoding="utf-8")

    def run(record, *arguments):
        entry = f'body = {{ library = "ours.toml", record = "{record}" }}' if record else STATED
        (tmp_path / "tube.toml").write_text(JOB.replace(STATED, entry), encoding="utf-8")
        code = main(["uncertainty", "tube.toml", "--no-mesh-error", *arguments])
        said = capsys.readouterr()
        return code, said.out, said.err

    return run


def test_the_band_is_that_of_the_deviation(call, tmp_path):
    """One constant: the same standard deviation as with a spread that states it, from sets on both sides."""
    code, said, _ = call("neo-hooke", "--spread", "materials.body=fitted as rubber", "--output", "fit")
    assert code == DONE and "(rubber)" in said
    assert "The spread of materials.body is that of the fit: 5 batches." in said
    code, _, _ = call("neo-hooke", "--spread", "materials.body.C10=6 kPa as rubber", "--output", "stated")
    assert code == DONE
    fit, stated = (read_response(tmp_path / each / "uncertainty.csv") for each in ("fit", "stated"))
    own, other = (each["tip_displacement_x_spread"][-1] for each in (fit, stated))
    assert own == pytest.approx(other, rel=0.02)


def test_exponents_move_with_their_moduli(call):
    code, said, _ = call("ogden", "--spread", "materials.body=fitted as rubber", "--output", "fit")
    assert code == DONE and "5 runs" in said


@pytest.mark.parametrize(
    ("record", "key", "sentence"),
    [
        ("bare", "materials.body", "states no spread"),
        ("", "materials.body", "states its constants itself"),
        ("neo-hooke", "materials.bodi", "did you mean 'materials.body'"),
    ],
)
def test_what_has_no_spread_is_answered(call, record, key, sentence):
    code, _, told = call(record, "--spread", f"{key}=fitted", "--output", "refused")
    assert code == BAD_INPUT
    assert sentence in told and "Traceback" not in told


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (("correlation = [[1.0]]", "correlation = [[1.0, 0.0]]"), "as many rows"),
        (("correlation = [[1.0]]", "correlation = [[2.0]]"), "from -1 to 1"),
        (('deviations = { C10 = "6 kPa" }', 'deviations = { C10 = "-6 kPa" }'), "allowed is 0 or more"),
        (('deviations = { C10 = "6 kPa" }', 'deviations = { C10 = "6 mm" }'), "deviations.C10"),
        (("of =", "off ="), "unknown key 'off'"),
    ],
)
def test_a_wrong_spread_is_named(call, tmp_path, change, sentence):
    (tmp_path / "ours.toml").write_text(OURS.replace(*change, 1), encoding="utf-8")
    code, _, told = call("neo-hooke", "--spread", "materials.body=fitted", "--output", "refused")
    assert code == BAD_INPUT
    assert sentence in told and "records.neo-hooke.spread" in told
