"""Jobs that buckle: ``turgor buckling``, the key ``mesh.imperfection``, branches of arc length."""

import json
from pathlib import Path

import numpy as np
import pytest

from refused import any_states
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.core.solvers.procedures.arc_length import ArcLength
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.job.text.problems import JobError

JOB = """
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "4 mm"

[materials]
body = { law = "neo_hooke", C10 = "50 kPa" }
base = { law = "neo_hooke", C10 = "50 kPa" }

[loads]
pressure = "-10 kPa"
"""
IMPERFECT = JOB.replace('size = "4 mm"', 'size = "4 mm"\nimperfection = ["0.1 mm", "-0.05 mm"]')


def written(folder: Path, text: str) -> Path:
    file = folder / "job.toml"
    file.write_text(text, encoding="utf-8")
    return file


def test_an_imperfection_moves_the_mesh_and_is_written_again(tmp_path: Path) -> None:
    perfect, _ = prepare(read_job(written(tmp_path, JOB)))
    job = read_job(written(tmp_path, IMPERFECT))
    assert job.imperfection == pytest.approx((1e-4, -5e-5))
    model, _ = prepare(job)
    moved = np.linalg.norm(model.mesh.points - perfect.mesh.points, axis=1).max()
    assert 0.05e-3 < moved < 0.15e-3
    assert model.mesh.cells is perfect.mesh.cells or (model.mesh.cells == perfect.mesh.cells).all()
    again = read_job(written(tmp_path, lock_text(job, {})))
    assert again.imperfection == pytest.approx(job.imperfection)


@pytest.mark.parametrize(
    ("before", "after", "facts"),
    [
        ('["0.1 mm", "-0.05 mm"]', '"0.1 kPa"', ["mesh.imperfection", "0.1 kPa", "length"]),
        ('["0.1 mm", "-0.05 mm"]', '"0.1"', ["mesh.imperfection", "0.1", "unit"]),
        ("imperfection", "imperfecton", ["imperfecton", "imperfection"]),
    ],
)
def test_a_mistake_in_an_imperfection_is_named(tmp_path: Path, before: str, after: str, facts: list[str]) -> None:
    with pytest.raises(JobError) as error:
        read_job(written(tmp_path, IMPERFECT.replace(before, after)))
    assert any_states(error.value.problems, facts), error.value.problems


def test_buckling_loads_are_listed_and_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    written(tmp_path, JOB)
    monkeypatch.chdir(tmp_path)
    assert main(["buckling", "job.toml", "--count", "2", "--output", "shapes"]) == DONE
    shown = capsys.readouterr().out
    assert "Buckles at load factors" in shown
    assert "symmetric about its mirror planes" in shown
    assert "load factor [-]" in (tmp_path / "shapes" / "mode.pvd").read_text(encoding="utf-8")
    assert main(["buckling", "job.toml", "--count", "1", "--at", "0.1", "--json"]) == DONE
    near = json.loads(capsys.readouterr().out)["result"]
    assert near["load_factor"] == pytest.approx(0.1)
    assert near["load_factors"][0] > 0.1


@pytest.mark.parametrize(
    ("options", "facts"),
    [
        (["--at", "1.2"], ["--at is 1.2", "less than 1"]),
        (["--count", "0"], ["count is 0", "1 to 20"]),
        (["--set", "mesh.imperfection=9 mm"], ["mesh.imperfection", "9 mm"]),
        (["--set", "procedure.type=dynamic", "--set", "procedure.branch=1"], ["branch"]),
    ],
)
def test_what_cannot_buckle_is_refused(
    options: list[str],
    facts: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    written(tmp_path, JOB)
    monkeypatch.chdir(tmp_path)
    assert main(["buckling", "job.toml", *options]) == BAD_INPUT
    shown = capsys.readouterr().err
    for fact in facts:
        assert fact in shown


def test_a_branch_is_a_key_of_arc_length(tmp_path: Path) -> None:
    job = read_job(written(tmp_path, JOB + '[procedure]\ntype = "arc_length"\nbranch = -1\n'))
    assert isinstance(job.procedure, ArcLength)
    assert job.procedure.branch == -1
    assert "branch = -1" in lock_text(job, {})
