"""A job that starts from a mesh file, and what `turgor export` writes."""

import re
import shutil
from pathlib import Path

import exchange_cases as cases
import pytest

import turgor as tg
from refused import refused, states
from turgor.cli import main
from turgor.core.geometry.cad.selectors import ByName, InBox, WithNormal
from turgor.core.meshing.exchange import MeshFile, read_mesh, read_stl
from turgor.job.output.lock import lock_text
from turgor.units import mm

ROOT = Path(__file__).parents[3]

REST = """
[materials]
body = { law = "neo_hooke", C10 = "50 kPa", bulk_modulus = "2 MPa" }
base = { law = "neo_hooke", C10 = "150 kPa" }

[loads]
pressure = "2 kPa"

[procedure]
type = "static"
at = ["1 kPa"]
"""

MESH = """
[mesh]
file = "cube.vtk"

[mesh.faces]
fixed = { normal = "-x" }
tip = { normal = "+x" }
corner = [{ box = [[0, 0, 0], ["10 mm", "10 mm", "30 mm"]] }, { normal = "+z" }]

[mesh.regions]
base = { name = "material 1" }
"""

PNEUNET = """
[actuator]
type = "fast_pneunet"
chambers = 2
length = "20 mm"

[mesh]
size = "4 mm"
"""


@pytest.fixture
def folder(tmp_path):
    points, cells, low = cases.hollow_cube(True)
    (tmp_path / "cube.vtk").write_bytes(cases.vtk_legacy(points, [(10, cells)], labels=low.astype(int)))
    (tmp_path / "cube.toml").write_text(MESH + REST)
    (tmp_path / "finger.toml").write_text(PNEUNET + REST)
    return tmp_path


def test_mesh_stands_for_actuator_and_mesh(folder):
    job = tg.jobs.read_job(folder / "cube.toml")
    assert isinstance(job.actuator, MeshFile)
    assert job.actuator.faces["fixed"] == WithNormal("-x")
    assert job.actuator.faces["corner"] == (InBox((0, 0, 0), (0.01, 0.01, 0.03)), WithNormal("+z"))
    assert job.actuator.regions["base"] == ByName("material 1")
    geometry = job.actuator.build()
    assert geometry.faces == ("cavity", "corner", "fixed", "outside", "tip")
    assert geometry.cavity_volumes == pytest.approx({"cavity": 1000 * mm**3})
    assert geometry.solid_volume == pytest.approx(26000 * mm**3)
    assert geometry.extent == pytest.approx(30 * mm)


def test_lock_file_repeats_it(folder):
    job = tg.jobs.read_job(folder / "cube.toml")
    (folder / "lock.toml").write_text(lock_text(job, {}))
    assert tg.jobs.read_job(folder / "lock.toml") == job
    (folder / "cube.vtk").write_bytes((folder / "cube.vtk").read_bytes().replace(b"cube", b"Cube"))
    with refused("actuator.sha256", folder / "cube.vtk"):
        tg.jobs.read_job(folder / "lock.toml")


def test_job_of_the_guide_is_read(tmp_path):
    guide = (ROOT / "docs" / "howto" / "import-mesh.md").read_text(encoding="utf-8")
    data = ROOT / "tests" / "validation" / "data" / "sofa-actuator-meshes" / "pneunet"
    shutil.copy(data / "pneunetCutCoarse.vtk", tmp_path / "finger.vtk")
    shutil.copy(data / "pneunetCavityCut.stl", tmp_path / "finger-cavity.stl")
    job, _, cavities = re.findall(r"```toml\n(.*?)```", guide, re.DOTALL)
    (tmp_path / "guide.toml").write_text(job + cavities)
    geometry = tg.jobs.read_job(tmp_path / "guide.toml").actuator.build()
    assert geometry.faces == ("cavity", "fixed", "outside", "tip")
    assert set(geometry.regions) == {"base", "body"}
    assert geometry.cavity_volume == pytest.approx(8887.5 * mm**3)


def test_command_check_reads_it(folder, capsys):
    assert main(["check", str(folder / "cube.toml")]) == 0
    assert "156 cells" in capsys.readouterr().out


def test_command_mesh_shows_it_but_cannot_refine_it(folder, capsys):
    assert main(["mesh", str(folder / "cube.toml")]) == 0
    assert "156" in capsys.readouterr().out
    assert main(["mesh", str(folder / "cube.toml"), "--size", "1 mm"]) == 1
    assert states(capsys.readouterr().err, "cube.vtk'", "--size")


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ('"cube.vtk"', '"cub.vtk"', "did you mean 'cube.vtk'"),
        ('{ normal = "-x" }', '{ colour = "red" }', "unknown key 'colour'"),
        ('"material 1"', '"material 7"', "unknown region in the file 'material 7'; did you mean 'material 1'"),
        ('file = "cube.vtk"', 'file = "cube.vtk"\nunit = "m"', "is 30000 mm long when its unit is m"),
        ('file = "cube.vtk"', 'file = "cube.vtk"\nsize = "2 mm"', "unknown key 'size'"),
    ],
)
def test_mistakes(folder, capsys, old, new, sentence):
    (folder / "cube.toml").write_text((MESH + REST).replace(old, new))
    assert main(["check", str(folder / "cube.toml")]) == 1
    assert sentence in capsys.readouterr().err


def test_export_writes_what_is_named(folder, capsys):
    out = folder / "out"
    job = str(folder / "finger.toml")
    assert main(["export", job, "--inp", "--step", "--stl", "--mold", "--output", str(out), "--poisson", "0.475"]) == 0
    parts = [f"finger-mold-{part}.{ending}" for part in ("core", "cup", "tray") for ending in ("step", "stl")]
    names = ["finger-cavity.stl", "finger.inp", "finger.step", "finger.stl", *parts, "finger-mold.txt"]
    assert sorted(file.name for file in out.iterdir()) == sorted(names)
    said = capsys.readouterr().out
    assert [name for name in names if name not in said] == []
    assert read_stl(out / "finger-cavity.stl").volume == pytest.approx(2098, rel=1e-4)
    assert len(read_mesh(out / "finger.inp").regions) == 2
    text = (out / "finger.inp").read_text()
    assert text.count("*END STEP") == 2
    assert (
        "0.15, 0.338983050847458" in text
    )  # D1 = 2/κ of the base at a Poisson's ratio of 0.475; the body keeps its own
    assert "0.05, 1\n" in text
    assert main(["export", job, "--stl", "--output", str(out)]) == 1
    assert states(capsys.readouterr().err, "--force")
    assert main(["export", job, "--stl", "--output", str(out), "--force"]) == 0


@pytest.mark.parametrize(
    ("job", "options", "sentence"),
    [
        ("finger", [], "name at least one of --inp, --step, --stl, --mold"),
        ("finger", ["--inp"], "CalculiX has no cells for that"),
        ("finger", ["--inp", "--program", "ansys"], "unknown program 'ansys'"),
        ("finger", ["--inp", "--poisson", "0.5"], "allowed is 0 to less than 0.5"),
        ("cube", ["--mold"], "mesh cells has none. Use STEP"),
        ("cube", ["--step"], "has no form in STEP files"),
    ],
)
def test_exports_that_cannot_be(folder, capsys, job, options, sentence):
    assert main(["export", str(folder / f"{job}.toml"), "--output", str(folder / "out"), *options]) == 1
    assert sentence in capsys.readouterr().err
