"""The commands ``turgor mesh`` and ``turgor convergence``: what they say, write and refuse."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import turgor as tg
from refused import states
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE, NOT_CONVERGED
from turgor.core.meshing.quality.checks import check_mesh
from turgor.core.results.files.response_csv import read_response
from turgor.job.prepare import prepare
from turgor.units import mm

JOB = """
[actuator]
type = "fast_pneunet"
chambers = 1
length = "20 mm"

[mesh]
size = "5 mm"

[materials]
body = { law = "neo_hooke", C10 = "50 kPa" }
base = { law = "neo_hooke", C10 = "50 kPa" }

[loads]
pressure = "1 kPa"

[procedure]
type = "static"
first_step = 1.0
max_step = 1.0
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "one.toml").write_text(JOB, encoding="utf-8")
    return tmp_path


def test_mesh_tells_counts_quality_and_findings(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["mesh", "one.toml"]) == DONE
    captured = capsys.readouterr()
    lines = captured.out.splitlines()
    assert lines[0] == "fast PneuNet, 1 chamber, half"
    cells = int(re.search(r"([\d,]+) cells \(ten-node tetrahedron\)", captured.out)[1].replace(",", ""))
    bars = [line.split() for line in lines if re.match(r"    \d\.\d to ", line)]
    assert sum(int(words[3].replace(",", "")) for words in bars) == cells  # every cell is in one bar
    assert max(len(words[4]) for words in bars if len(words) > 4) == 40
    assert captured.err.startswith("G01 warning: One cell reaches through the wall in ")
    assert list(folder.iterdir()) == [folder / "one.toml"]


def test_mesh_says_where_walls_have_two_cells(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "one.toml").write_text(JOB.replace('"5 mm"', '"5 mm"\nwall_cells = 2'), encoding="utf-8")
    assert main(["mesh", "one.toml"]) == DONE
    captured = capsys.readouterr()
    assert "walls: two cells or more through every wall" in captured.out
    assert captured.err == ""


def test_mesh_takes_another_size(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "one.toml").write_text(JOB.replace('"5 mm"', '"5 mm"\nface_sizes = { tip = "4 mm" }'), encoding="utf-8")
    counts = []
    for size in ([], ["--size", "2.5 mm"]):
        assert main(["mesh", "one.toml", *size]) == DONE
        counts.append(int(re.search(r"([\d,]+) cells", capsys.readouterr().out)[1].replace(",", "")))
    assert counts[1] > 2 * counts[0]


def test_mesh_writes_and_draws(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

    assert main(["mesh", "one.toml", "--output", "one.vtu", "--picture", "one.png"]) == DONE
    out = capsys.readouterr().out
    assert "Mesh in one.vtu." in out
    assert "Picture in one.png." in out
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName("one.vtu")
    reader.Update()
    grid = reader.GetOutput()
    assert f"{grid.GetNumberOfCells():,} cells" in out
    shape = vtk_to_numpy(grid.GetCellData().GetArray("shape"))
    assert 0.2 < shape.min() < shape.max() <= 1
    assert vtk_to_numpy(grid.GetCellData().GetArray("jacobian_ratio")) == pytest.approx(1)
    picture = np.asarray(Image.open("one.png").convert("L"))
    assert picture.shape[1] == 1600
    assert 0.005 < (picture < 140).mean() < 0.5  # edges of cells, not a black picture


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["mesh", "one.toml", "--size", "9 kg"], "--size: '9 kg' is a mass, but a length is needed."),
        (["mesh", "one.toml", "--size", "99 mm"], "mesh size is 99 mm, larger than the part; allowed is"),
        (["mesh", "one.toml", "--output", "one.stl"], "--output is 'one.stl'; the name must end in .vtu."),
        (["mesh", "one.toml", "--picture", "one.jpg"], "--picture is 'one.jpg'; the name must end in .png."),
        (["mesh", "on.toml"], "there is no job file 'on.toml'; did you mean 'one.toml'"),
        (["convergence", "one.toml", "--sizes", "2"], "2 mesh sizes are requested; allowed is 3 to 6."),
        (["convergence", "one.toml", "--sizes", "4 mm, 3"], "--sizes: '3' needs a unit"),
        (["convergence", "one.toml", "--sizes", "4 mm, 3 mm, 9 mm"], "mesh size is 9 mm; allowed for this job is"),
        (["convergence", "one.toml", "--measure", "angle"], "unknown measure 'angle'"),
        (["convergence", "one.toml", "--output", "one.toml"], "the output folder 'one.toml' is a file"),
    ],
)
def test_mistakes_are_sentences(folder: Path, capsys: pytest.CaptureFixture[str], arguments, sentence: str) -> None:
    assert main(arguments) == BAD_INPUT
    assert sentence in capsys.readouterr().err
    assert list(folder.iterdir()) == [folder / "one.toml"]


def test_what_the_guide_shows_works(folder: Path) -> None:
    guide = (Path(__file__).parents[3] / "docs" / "howto" / "mesh.md").read_text(encoding="utf-8")
    settings, *others = re.findall(r"```toml\n(.*?)```", guide, re.DOTALL)
    (target,) = (text for text in others if "target" in text)
    (folder / "guide.toml").write_text(JOB.replace('[mesh]\nsize = "5 mm"', settings), encoding="utf-8")
    job = tg.jobs.read_job(folder / "guide.toml")
    assert (job.mesh_size, job.mesh.face_sizes, job.mesh.wall_cells) == (3 * mm, {"cavity": 1.5 * mm}, 2)
    (folder / "guide.toml").write_text(JOB.replace('[mesh]\nsize = "5 mm"', target), encoding="utf-8")
    assert tg.jobs.read_job(folder / "guide.toml").mesh_target == 0.02
    model = prepare(tg.jobs.read_job(folder / "one.toml"))[0]
    names: dict[str, Any] = {"model": model, "solution": tg.solve(model)}
    for block in re.findall(r"```python\n(.*?)```", guide, re.DOTALL):
        exec(block.replace("0.02", "0.4"), names)  # a target that the small model meets at once
    assert check_mesh(names["mesh"]) == ()
    assert names["error"][-1] > 0
    assert names["found"].reached
    assert names["inflate"](4 * mm).converged


FILE_JOB = """
[mesh]
file = "one.vtu"
unit = "m"

[mesh.faces]
fixed = { normal = "-x" }
tip = { normal = "+x" }
symmetry_y = { normal = "-y" }

[materials]
body = { law = "neo_hooke", C10 = "50 kPa" }
base = { law = "neo_hooke", C10 = "50 kPa" }

[loads]
pressure = "1 kPa"
"""


def test_a_mesh_file_is_told_about_but_has_no_other_size(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["mesh", "one.toml", "--output", "one.vtu"]) == DONE
    counts = re.search(r"[\d,]+ cells .*unknowns", capsys.readouterr().out)[0]
    (folder / "file.toml").write_text(FILE_JOB, encoding="utf-8")
    assert main(["mesh", "file.toml"]) == DONE
    captured = capsys.readouterr()
    assert counts in captured.out
    assert "G01 warning" in captured.err  # what was noticed when the file was read
    assert main(["mesh", "file.toml", "--size", "2 mm"]) == BAD_INPUT
    assert states(capsys.readouterr().err, "one.vtu'", "--size")
    assert main(["convergence", "file.toml"]) == BAD_INPUT
    assert states(capsys.readouterr().err, "one.vtu'", "one size", "three sizes")


def test_convergence_writes_table_plot_and_sentence(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["convergence", "one.toml", "--sizes", "6 mm, 4 mm, 2.5 mm", "--measure", "cavity_volume"]) == DONE
    out = capsys.readouterr().out
    written = folder / "one-convergence"
    assert sorted(file.name for file in written.glob("[!.]*")) == [
        "convergence.csv",
        "convergence.png",
        "convergence.txt",
    ]
    table = read_response(written / "convergence.csv")
    assert list(table.find("mesh_size").in_unit) == [6, 4, 2.5]
    assert (np.diff(table.column("unknowns")) > 0).all()
    summary = (written / "convergence.txt").read_text(encoding="utf-8")
    assert summary in out
    assert "cavity volume" in summary
    assert main(["convergence", "one.toml"]) == BAD_INPUT  # nothing is replaced unasked
    assert "--force" in capsys.readouterr().err


def test_a_study_whose_solve_ends_early_is_not_converged(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = JOB.replace("first_step = 1.0", "first_step = 0.5").replace(
        "max_step = 1.0", "max_step = 0.5\nmax_steps = 1"
    )
    (folder / "one.toml").write_text(text, encoding="utf-8")
    assert main(["convergence", "one.toml", "--sizes", "6 mm, 4 mm, 3 mm"]) == NOT_CONVERGED
    assert states(capsys.readouterr().err, "6 mm")
    assert not (folder / "one-convergence").exists()
