"""`turgor sweep` beyond one process: shares of tasks, a real SLURM array, real Dask workers."""

import csv
from dataclasses import replace

import pytest

from calibration_cases import JOB
from refused import states
from slurm_cluster import missing, run_array, slurm_cluster
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE, NOT_CONVERGED
from turgor.studies.runs.executors import dask_workers
from turgor.studies.runs.settings import RUNS

STUDY = """
job = "tube.toml"

[factors]
actuator.wall = ["2 mm", "2.25 mm", "2.5 mm"]

[sweep]
measures = ["tip_displacement_x"]
at = { pressure = "10 kPa" }
mesh_error = false
"""


@pytest.fixture
def call(tmp_path, monkeypatch, capsys):
    (tmp_path / "tube.toml").write_text(JOB, encoding="utf-8")
    (tmp_path / "walls.toml").write_text(STUDY, encoding="utf-8")
    monkeypatch.chdir(tmp_path)

    def run(*arguments):
        code = main(["sweep", "walls.toml", *arguments])
        said = capsys.readouterr()
        return code, said.out, said.err

    return run


def rows(folder):
    with (folder / "study.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def moved(folder):
    (name,) = (name for name in rows(folder)[0] if name.startswith("tip_displacement_x") and "error" not in name)
    return [row[name] for row in rows(folder)]


def test_tasks_compute_their_shares_and_the_table_is_that_of_one_call(call, tmp_path):
    code, _, _ = call("--output", "whole")
    assert code == DONE
    code, said, _ = call("--output", "shared", "--index", "1", "--of", "2")
    assert code == DONE
    assert "Task 1: 2 designs, 0 failed" in said
    assert not (tmp_path / "shared" / "study.csv").exists()

    code, said, _ = call("--output", "shared", "--gather")
    assert code == NOT_CONVERGED
    assert "2.25 mm failed: not computed yet" in said
    assert [row["status"] for row in rows(tmp_path / "shared")] == ["converged", "failed", "converged"]

    call("--output", "shared", "--index", "2", "--of", "2")
    code, _, _ = call("--output", "shared", "--gather")
    assert code == DONE
    assert moved(tmp_path / "shared") == moved(tmp_path / "whole")


def test_a_job_script_holds_names_as_data(call, tmp_path, monkeypatch):
    """Blanks are quoted, line breaks refused, and files of others are not replaced."""
    (tmp_path / "walls.sh").write_text("mine")
    code, _, error = call("--sbatch", "walls.sh")
    assert code == BAD_INPUT
    assert "--sbatch is 'walls.sh', which exists" in error
    assert (tmp_path / "walls.sh").read_text() == "mine"
    code, _, _ = call("--sbatch", "walls.sh", "--force", "--output", 'my "own" folder')
    assert code == DONE
    lines = (tmp_path / "walls.sh").read_text().splitlines()
    assert '#SBATCH --output="my \\"own\\" folder/slurm-%A-%a.log"' in lines
    evil = tmp_path / "a\n#SBATCH --wrap=evil\ntouch PWNED\n#.toml"
    (tmp_path / "walls.toml").rename(evil)
    assert main(["sweep", str(evil), "--sbatch", "evil.sh"]) == BAD_INPUT
    assert not (tmp_path / "evil.sh").exists()


@pytest.mark.parametrize("name", ['"../../escaped"', '"/tmp/escaped"', "3", '"a b"'])
def test_a_study_cannot_leave_its_folder(call, tmp_path, name):
    (tmp_path / "walls.toml").write_text(f"name = {name}\n{STUDY}", encoding="utf-8")
    code, _, error = call("--dry-run")
    assert code == BAD_INPUT
    assert states(error, "letters", "digits")


@pytest.mark.skipif(bool(missing()), reason=missing())
def test_a_slurm_array_computes_the_study(call, tmp_path):
    code, said, _ = call("--sbatch", "walls.sh", "--of", "2", "--output", "walls study")
    assert code == DONE
    assert "3 designs in 2 tasks. Submit them: sbatch walls.sh" in said
    with slurm_cluster() as environment:
        run_array("walls.sh", tmp_path, environment)
    folder = tmp_path / "walls study"
    assert len(list(folder.glob("slurm-*.log"))) == 2
    assert len(list((folder / "runs").glob("*.csv"))) == 3
    code, _, _ = call("--gather", "--output", "walls study")
    assert code == DONE
    assert len(set(moved(folder))) == 3


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--index", "5"), "--index is 5; allowed is 1 to 3"),
        (("--index", "4", "--of", "9"), "there are 3 designs only"),
        (("--of", "2"), "--of is the number of tasks for --index or --sbatch"),
        (("--index", "1", "--gather"), "--index and --gather exclude each other"),
        (("--scheduler", "tcp://127.0.0.1:9"), "scheduler at 'tcp://127.0.0.1:9' does not answer"),
        (("--scheduler", "nonsense"), "scheduler at 'nonsense' does not answer"),
    ],
)
def test_mistakes_are_told(call, options, said, monkeypatch):
    monkeypatch.setattr(dask_workers, "RUNS", replace(RUNS, patience=0.5))
    code, _, error = call(*options)
    assert code == BAD_INPUT
    assert said in error
