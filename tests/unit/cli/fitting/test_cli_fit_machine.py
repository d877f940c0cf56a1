"""`turgor fit --compliance` and `--directions`: files of testers, and what is said about mistakes."""

import json
import tomllib

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

import turgor as tg
from refused import states
from turgor.cli.fitting.fit import fit_command
from turgor.cli.fitting.fit_texts import CUTS, STRIPS
from turgor.core.materials.fitting import fit_directions, fit_woven
from turgor.core.materials.fitting.fit_directions import specimen_stress
from turgor.core.materials.orientation import Orientation

PRINT = tg.laws.Orthotropic(C10=0.8e6, a1=0.5e6, a2=0.2e6)
FIXED = ("--fixed", "a3=0, C20=0 kPa, C30=0 kPa", "--starts", 1)


@pytest.fixture
def run():
    app = typer.Typer()
    app.command()(fit_command)
    return lambda *arguments: CliRunner().invoke(app, [str(argument) for argument in arguments])


@pytest.fixture
def strip(tmp_path):
    stretch = np.linspace(1.0, 1.6, 61)
    force = 2 * 5e6 * 12e-6 * (stretch - stretch**-2)
    way = 25 * (stretch - 1) + 0.04 * force
    rows = "".join(f"{f:.6f},{u:.6f}\n" for f, u in zip(force, way, strict=True))
    path = tmp_path / "strip_uniaxial.csv"
    path.write_text("Force (N),Extension (mm)\n" + rows)
    return path


def pulled(cut, stretch):
    lies = Orientation(along=fit_directions.CUTS[cut][0], across=fit_directions.CUTS[cut][1])
    return specimen_stress(tg.Material(name=cut, law=PRINT, orientation=lies), stretch)


@pytest.fixture
def cuts(tmp_path):
    """Two specimens of one print, each in a file of its own, and both in one file."""
    stretch, files = np.linspace(1.0, 1.5, 21), []
    lines = ["print direction,stretch,nominal stress (MPa)"]
    for cut in ("along", "across"):
        rows = [f"{a:.5f},{b / 1e6:.7f}" for a, b in zip(stretch, pulled(cut, stretch), strict=True)]
        files.append(tmp_path / f"{cut}.csv")
        files[-1].write_text("stretch,nominal stress (MPa)\n" + "\n".join(rows) + "\n")
        lines += [f"{cut},{row}" for row in rows]
    both = tmp_path / "both.csv"
    both.write_text("\n".join(lines) + "\n")
    return [*files, both]


def test_a_stated_compliance_and_a_run_on_steel_correct_alike(run, strip, tmp_path):
    steel = tmp_path / "steel.csv"
    steel.write_text("Force (N),Extension (mm)\n" + "".join(f"{f},{0.04 * f:.5f}\n" for f in range(0, 210, 10)))
    size = ("--specimen", "25 mm, 6 mm, 2 mm", "--laws", "neo-hooke", "--json")
    values = []
    for compliance in ("", "0.04 mm/N", steel):
        result = run(strip, *size, "--compliance", compliance)
        assert result.exit_code == 0, result.output
        document = json.loads(result.output)
        values.append(document["result"]["materials"][0]["fits"][0]["parameters"]["C10"])
    assert values[0] < 0.93 * 5e6
    assert values[1:] == pytest.approx([5e6, 5e6], rel=1e-3)


def test_compliance_is_said_and_its_mistakes_are_named(run, strip):
    said = run(strip, "--specimen", "25 mm, 6 mm, 2 mm", "--laws", "neo-hooke", "--compliance", "0.04 mm/N")
    assert "gave way by 0.04 mm/N" in said.output
    for wrong in ("0.04 N/mm", "stahl.csv"):
        refusal = run(strip, "--specimen", "25 mm, 6 mm, 2 mm", "--compliance", wrong)
        assert refusal.exit_code == 1
        assert states(refusal.output, wrong, "mm/N")


@pytest.mark.parametrize("one_file", [False, True])
def test_a_print_is_fitted_from_files_or_from_a_column(run, cuts, tmp_path, one_file):
    files, how = (cuts[2:], "print direction") if one_file else (cuts[:2], "along,across")
    result = run(*files, "--mode", "uniaxial", "--directions", how, *FIXED, "--output", tmp_path / "out")
    assert result.exit_code == 0, result.output
    assert "a1 = 0.5 MPa" in result.output or "a1 = 500 kPa" in result.output
    (table,) = (tmp_path / "out").glob("*orthotropic.toml")
    body = tomllib.loads(table.read_text())["materials"]["body"]
    assert float(body["a2"].split()[0]) == pytest.approx(200, rel=1e-3)
    assert body["orientation"] == {"along": [1, 0, 0], "across": [0, 1, 0]}
    assert table.with_suffix(".png").read_bytes().startswith(b"\x89PNG")


@pytest.fixture
def woven(tmp_path):
    """Three strips of a fabric, 50 mm wide and 0.2 mm thick."""
    stretch, files = np.linspace(1.0, 1.02, 11), []
    cloth = tg.laws.Woven(E=400e6, E_weft=150e6, G=12e6, nu=0.25)
    for cut, angle in fit_woven.STRIPS.items():
        force = cloth.modulus_along(angle) * fit_woven.strip_strain(stretch) * 50e-3 * 0.2e-3
        rows = "".join(f"{200 * (a - 1):.6f},{f:.6f}\n" for a, f in zip(stretch, force, strict=True))
        files.append(tmp_path / f"{cut}.csv")
        files[-1].write_text("Extension (mm),Force (N)\n" + rows)
    return files


def test_strips_of_a_fabric_become_the_table_of_a_sheet(run, woven, tmp_path):
    asked = ("--mode", "uniaxial", "--specimen", "200 mm, 50 mm, 0.2 mm", "--directions", "warp,weft,bias")
    result = run(*woven, *asked, "--fixed", "nu=0.25", "--output", tmp_path / "out")
    assert result.exit_code == 0, result.output
    assert "G = 12 MPa" in result.output and "bias" in result.output
    (table,) = (tmp_path / "out").glob("*woven.toml")
    sheet = tomllib.loads(table.read_text())["materials"]["strain_limiting_layer"]
    assert [float(sheet[name].split()[0]) for name in ("E", "E_weft", "G")] == pytest.approx(
        [400e3, 150e3, 12e3], rel=1e-4
    )
    assert (sheet["law"], sheet["nu"]) == ("woven", 0.25) and "thickness" in table.read_text()
    assert table.with_suffix(".png").read_bytes().startswith(b"\x89PNG")
    assert (
        json.loads(run(*woven, *asked, "--fixed", "nu=0.25", "--json").output)["result"]["directions"][0]["law"]
        == "Woven"
    )
    for wrong in ((), ("--fixed", "nu=0.25, G=3 MPa")):
        assert states(run(*woven, *asked, *wrong).output, "--fixed nu=0.2")
    assert states(run(*woven, *asked, "--laws", "orthotropic").output, "warp", "along")


def test_mistakes_about_directions_are_named(run, cuts):
    first, second, both = cuts
    mode = ("--mode", "uniaxial")
    assert states(run(first, second, *mode, "--directions", "along").output, "1 direction", "2 files")
    assert states(run(first, *mode, "--directions", "along", "--relaxation", 1).output, "--directions", "--relaxation")
    assert states(run(first, *mode, "--fixed", "a3=0").output, "--fixed", "--directions")
    both.write_text(both.read_text().replace("across", "acros"))
    assert states(run(both, *mode, "--directions", "print direction").output, "acros", "across", "through")


def test_the_directions_are_those_of_python():
    assert tuple(fit_directions.CUTS) == CUTS
    assert tuple(fit_woven.STRIPS) == STRIPS
