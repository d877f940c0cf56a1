"""``turgor actuators`` and ``turgor init``: families, their keys, and a job to start from."""

import re
import shutil
from pathlib import Path

import pytest

import meshes
from refused import states
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.core.results.files.mesh_vtu import write_mesh_vtu
from turgor.job.job import ACTUATORS
from turgor.job.read import read_job

EXAMPLES = Path(__file__).parents[3] / "examples"


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("command", ["actuators", "init"])
def test_families_are_listed(command, capsys):
    assert main([command]) == DONE
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines[: len(ACTUATORS)]] == list(ACTUATORS)


def test_a_family_is_shown_with_its_source_and_its_keys(capsys):
    assert main(["actuators", "fast_pneunet"]) == DONE
    said = capsys.readouterr().out
    assert "Mosadegh et al. (2014) publish 11 chambers" in said
    assert '\ngap = "1 mm"\n    Distance between neighboring chamber blocks. (length; allowed: 0.01 mm to' in said


@pytest.mark.parametrize("command", ["actuators", "init"])
def test_an_unknown_family_is_answered_with_the_nearest_one(command, capsys):
    assert main([command, "fast_pnuenet"]) == BAD_INPUT
    assert states(capsys.readouterr().err, "'fast_pnuenet'", "'fast_pneunet'")


def test_a_job_is_written_once(folder, capsys):
    assert main(["init", "slow_pneunet"]) == DONE
    assert "run it with 'turgor run slow_pneunet.toml'" in capsys.readouterr().out
    assert type(read_job(folder / "slow_pneunet.toml").actuator) is ACTUATORS["slow_pneunet"]
    assert main(["init", "slow_pneunet"]) == BAD_INPUT
    assert states(capsys.readouterr().err, "'slow_pneunet.toml'", "--output", "--force")
    assert main(["init", "slow_pneunet", "--force"]) == DONE
    assert main(["init", "slow_pneunet", "--output", "other.toml"]) == DONE
    assert (folder / "other.toml").read_text("utf-8") == (folder / "slow_pneunet.toml").read_text("utf-8")


@pytest.mark.parametrize("name", ["cad_file", "mesh_file"])
def test_actuators_from_files_are_families_too(name, capsys):
    assert main(["actuators", name]) == DONE
    assert f'Keys of [actuator] with type = "{name}":\n\nfile = \n' in capsys.readouterr().out
    assert main(["actuators", name, "--json"]) == DONE
    capsys.readouterr()
    assert main(["init", name]) == BAD_INPUT
    assert states(capsys.readouterr().err, name, "turgor init")


@pytest.mark.usefixtures("read_here")
def test_a_cad_file_becomes_a_job_that_can_be_checked(folder, capsys):
    shutil.copy(EXAMPLES / "print.stl", folder / "Finger.STL")
    (folder / "jobs").mkdir()
    assert main(["init", "Finger.STL", "--unit", "mm", "--output", "jobs/one.toml"]) == DONE
    job = read_job(folder / "jobs" / "one.toml")
    assert {"fixed", "tip", "cavity", "outside"} <= set(job.actuator.build().faces)
    text = (folder / "jobs" / "one.toml").read_text("utf-8")
    assert 'file = "../Finger.STL"' in text and 'unit = "mm"' in text
    assert re.search(r"#   outside +100\.2  \[50, 0, 3\.39\] +\[1, 0, 0\]\n", text)
    assert main(["check", "jobs/one.toml"]) == DONE


@pytest.mark.usefixtures("read_here")
def test_a_table_of_cad_files_becomes_a_job_of_its_first_part(folder):
    shutil.copy(EXAMPLES / "cad_file.step", folder / "one.step")
    (folder / "parts.csv").write_text("wall (mm),kind,file\n1.5,a,one.step\n2,b,one.step\n")
    assert main(["init", "parts.csv"]) == DONE
    assert read_job(folder / "parts.toml").actuator.dimensions == {"wall": "1.5 mm", "kind": "a"}


def test_a_mesh_file_becomes_a_job(folder):
    write_mesh_vtu(folder / "bar.vtu", meshes.hollow_box(3))
    assert main(["init", "bar.vtu"]) == DONE
    job = read_job(folder / "bar.toml")
    assert "fixed" in job.actuator.build().faces
    assert [load.face for load in job.loads] == ["cavity"]
    assert main(["init", "bar.vtu"]) == BAD_INPUT  # the job exists


def test_a_file_that_holds_no_part_is_refused(folder, capsys):
    (folder / "notes.txt").write_text("none")
    for name, said in (("part.stl", "there is no file 'part.stl'"), ("notes.txt", "'notes.txt' is no CAD file and no")):
        assert main(["init", name]) == BAD_INPUT
        assert said in capsys.readouterr().err
