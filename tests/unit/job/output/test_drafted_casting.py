"""The part that a mold with draft casts is a file that a job computes; its thinner walls let it bend further."""

from math import pi, tan

import pytest
from scipy.integrate import quad

import turgor as tg
from turgor.cli import main
from turgor.units import deg

JOB = """
[actuator]
type = "rectangular_bender"
length = "30 mm"
inlet_diameter = "3 mm"
symmetric = false

[mesh]
size = "6 mm"
cells = "tetrahedra"

[materials]
body = { library = "elastosil-m4601", record = "neo-hooke-polygerinos-2020" }
base = { library = "elastosil-m4601", record = "neo-hooke-polygerinos-2020" }
strain_limiting_layer = { library = "paper", record = "hooke-polygerinos-2020", thickness = "0.1 mm" }

[loads]
pressure = "5 kPa"

[output]
measures = ["bending_angle"]
"""
FAMILY = JOB[JOB.index("type") : JOB.index("[mesh]")]


def bent(folder, text):
    (folder / "bender.toml").write_text(text)
    run = tg.jobs.run_job(tg.jobs.read_job(folder / "bender.toml"), folder / "results", force=True)
    return run.response["bending_angle"][-1] / deg


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("molds")
    (place / "bender.toml").write_text(JOB)
    files = ["--step", "--mold", "--draft", "5 deg", "--output", str(place)]
    assert main(["export", str(place / "bender.toml"), *files]) == 0
    return place


def test_the_text_states_the_volume_that_the_dimensions_give(folder):
    """Three of four walls recede; the one with the core stays upright."""
    filled = quad(lambda t: (30 - t) * (14 - 2 * t), 0, 12.5 * tan(5 * deg))[0] / tan(5 * deg)
    cavity = 20 * 10 * 7.5 + pi * 1.5**2 * 5
    assert f"the part has {filled - cavity:.5g} mm³" in (folder / "bender-mold.txt").read_text(encoding="utf-8")
    part = tg.cad.read_cad(folder / "bender-mold-casting.step")
    assert part.solid_volume * 1e9 == pytest.approx(filled - cavity, rel=1e-6)
    assert part.regions == ("body", "base")


@pytest.mark.slow
def test_the_casting_bends_further_than_the_drawing(folder):
    read = 'type = "cad_file"\nfile = "{}"\nsymmetry = "y"\n\n'
    files = ("bender.step", "bender-mold-casting.step")
    drawn, cast = (bent(folder, JOB.replace(FAMILY, read.format(file))) for file in files)
    assert cast / drawn == pytest.approx(1.2, abs=0.1)
