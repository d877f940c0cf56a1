"""Folders of results: only what turgor wrote is ever replaced or removed, and a run is known by what it computes."""

import os
from pathlib import Path

import pytest

from refused import refused, states
from turgor.cli import main
from turgor.core.results.files.response_csv import read_response
from turgor.core.solvers.checkpoints.record import INDEX
from turgor.job.output.manifest import (
    MANIFEST,
    PREVIOUS,
    bring_back,
    list_files,
    listed,
    own_files,
    remove,
    set_aside,
)
from turgor.job.postprocess import report_folder
from turgor.job.read import read_job
from turgor.job.run import run_job

JOB = """
[actuator]
type = "extending_cylinder"
length = "20 mm"

[mesh]
size = "7 mm"
cells = "hexahedra"

[materials]
body = { name = "rubber", law = "neo_hooke", C10 = "0.1 MPa" }

[loads]
pressure = "2 kPa"

[procedure]
type = "static"
first_step = 0.5
max_step = 0.5

[output]
measures = ["tip_displacement"]
fields = false
pictures = false
report = false
mesh_error = false
"""


class Killed(BaseException):
    """Ends a run as a signal would."""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "pull.toml"
    path.write_text(JOB, encoding="utf-8")
    return path


def killed_after(steps: int, file: Path, folder: Path, **options: bool) -> None:
    seen: list[object] = []

    def progress(iteration, state):
        if state is not None:
            seen.append(state)
        elif len(seen) == steps:  # in the updates of the next step: the last one is on disk
            raise Killed

    with pytest.raises(Killed):
        run_job(read_job(file), folder, threads=1, progress=progress, **options)


def run(file: Path, folder: Path, **options: bool) -> None:
    assert run_job(read_job(file), folder, threads=1, **options).solution.converged


def files_of_a_user(folder: Path) -> dict[Path, str]:
    """Files with the names of results, and others in the folders of results."""
    names = ("response.csv", "run.log", "path/thesis.docx", "path/sub/more.txt", "vtu/mine.vtu")
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(f"mine: {name}")
    return {folder / name: f"mine: {name}" for name in names}


@pytest.mark.parametrize("how", ["resume", "force"])
def test_files_of_a_user_stay(file, tmp_path, how):
    folder = tmp_path / "lab"
    mine = files_of_a_user(folder)
    with refused(folder):
        run(file, folder, **{how: True})
    assert {path: path.read_text() for path in mine} == mine
    assert not (folder / MANIFEST).exists()


def test_resume_needs_a_run(file, tmp_path):
    (tmp_path / "lab").mkdir()
    (tmp_path / "lab" / "notes.txt").write_text("mine")
    with refused(tmp_path / "lab", "files"):
        run(file, tmp_path / "lab", resume=True)
    assert [each.name for each in (tmp_path / "lab").iterdir()] == ["notes.txt"]


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
@pytest.mark.parametrize("how", ["resume", "force"])
def test_a_link_in_the_place_of_a_file_is_replaced(file, tmp_path, how):
    """What it points to stays, and is no file of a run that could be removed or written."""
    folder = tmp_path / "out"
    killed_after(1, file, folder)
    mine = tmp_path / "thesis.docx"
    mine.write_text("mine")
    for name in ("response.csv", "steps.csv", "run.log"):
        (folder / name).unlink()
        (folder / name).symlink_to(mine)
    run(file, folder, **{how: True})
    assert mine.read_text() == "mine"
    assert not any(each.is_symlink() for each in folder.iterdir())


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
def test_files_behind_links_are_no_files_of_a_run(tmp_path):
    for name in ("path", "vtu"):
        (tmp_path / "theirs").mkdir(exist_ok=True)
        (tmp_path / name).symlink_to(tmp_path / "theirs")
    for name in ("index.json", "model-1.turgor", "state_0000.vtu"):
        (tmp_path / "theirs" / name).write_text("theirs")
    (tmp_path / MANIFEST).write_text('{"files": ["path", "vtu/state_0000.vtu"]}')
    assert own_files(tmp_path) == [tmp_path / "path"]  # the link itself
    remove(tmp_path, own_files(tmp_path))
    assert len(list((tmp_path / "theirs").iterdir())) == 3


def test_measure_replaces_no_file_without_force(file, tmp_path, capsys):
    run(file, tmp_path / "out")
    (tmp_path / "thesis.csv").write_text("mine")
    command = ["measure", str(tmp_path / "out"), "--output", str(tmp_path / "thesis.csv")]
    assert main(command) == 1
    assert states(capsys.readouterr().err, "thesis.csv", "--force")
    assert (tmp_path / "thesis.csv").read_text() == "mine"
    assert main([*command, "--force"]) == 0
    assert (tmp_path / "thesis.csv").read_text() != "mine"


def test_force_replaces_results_and_leaves_the_rest(file, tmp_path):
    folder = tmp_path / "out"
    run(file, folder)
    extra = {folder / name: "mine" for name in ("notes.txt", "path/thesis.docx")}
    for path in extra:
        path.write_text("mine")
    file.write_text(JOB.replace("2 kPa", "1 kPa"), encoding="utf-8")
    run(file, folder, force=True)
    assert {path: path.read_text() for path in extra} == extra
    assert read_response(folder / "response.csv").column("pressure")[-1] == pytest.approx(1000)
    assert not (folder / PREVIOUS).exists()


def test_results_are_there_until_the_new_ones_are(file, tmp_path):
    folder = tmp_path / "out"
    run(file, folder)
    before = (folder / "response.csv").read_bytes()
    killed_after(1, file, folder, force=True)
    assert (folder / PREVIOUS / "response.csv").read_bytes() == before
    killed_after(1, file, folder, force=True)  # the second replaces the unfinished one, not the complete results
    assert (folder / PREVIOUS / "response.csv").read_bytes() == before
    run(file, folder, resume=True)
    assert not (folder / PREVIOUS).exists()
    assert (folder / "response.csv").read_bytes() == before


def test_a_move_that_was_killed_goes_on(file, tmp_path, monkeypatch):
    folder = tmp_path / "out"
    run(file, folder)
    before = {path.relative_to(folder): path.read_bytes() for path in own_files(folder)}
    real, moved = os.replace, []

    def killed(source, target):
        moved.append(source)
        if len(moved) == 5:
            raise Killed
        real(source, target)

    monkeypatch.setattr("turgor.job.output.manifest.os.replace", killed)
    with pytest.raises(Killed):
        set_aside(folder)
    monkeypatch.undo()
    set_aside(folder)
    assert {path.relative_to(folder / PREVIOUS): path.read_bytes() for path in own_files(folder / PREVIOUS)} == before
    assert own_files(folder) == []


@pytest.mark.parametrize("moves", range(1, 5))
def test_results_that_were_on_their_way_back_are_not_lost(tmp_path, monkeypatch, moves):
    """A process is killed in `bring_back`; the next run with ``--force`` sets aside all results of the earlier one."""
    names = ("response.csv", "run.log", "steps.csv")
    list_files(tmp_path, names)
    for name in names:
        (tmp_path / name).write_text(name)
    set_aside(tmp_path)
    left, real = moves, os.replace

    def killed(source, target):
        nonlocal left
        left -= 1
        if left < 0:
            raise KeyboardInterrupt
        real(source, target)

    with monkeypatch.context() as patch:
        patch.setattr("turgor.job.output.manifest.os.replace", killed)
        with pytest.raises(KeyboardInterrupt):
            bring_back(tmp_path)
    set_aside(tmp_path)
    waiting = tmp_path / PREVIOUS
    assert {name: (waiting / name).read_text() for name in names} == dict(zip(names, names, strict=True))
    assert listed(waiting) == frozenset(names)


def test_a_resumed_run_whose_move_was_killed_begins(file, tmp_path, monkeypatch):
    """The index of the earlier path is still there, and not all that it names."""
    folder = tmp_path / "out"
    run(file, folder)
    before = (folder / "response.csv").read_bytes()
    real = os.replace

    def killed(source, target):
        if source.name == INDEX:
            raise Killed
        real(source, target)

    monkeypatch.setattr("turgor.job.output.manifest._of_path", lambda folder: sorted(folder.iterdir(), reverse=True))
    monkeypatch.setattr("turgor.job.output.manifest.os.replace", killed)
    with pytest.raises(Killed):
        run(file, folder, force=True)
    monkeypatch.undo()
    assert [each.name for each in (folder / "path").iterdir()] == [INDEX]
    run(file, folder, resume=True)
    assert (folder / "response.csv").read_bytes() == before
    assert not (folder / PREVIOUS).exists()


def test_complete_results_replace_older_ones_that_wait(file, tmp_path):
    """The process was killed after the new run had ended, before the old results were removed."""
    folder = tmp_path / "out"
    run(file, folder)
    (folder / PREVIOUS).mkdir()
    (folder / PREVIOUS / MANIFEST).write_text('{"files": ["response.csv"]}')
    (folder / PREVIOUS / "response.csv").write_text("old")
    newest = (folder / "response.csv").read_bytes()
    set_aside(folder)
    assert (folder / PREVIOUS / "response.csv").read_bytes() == newest


def test_a_run_that_cannot_begin_leaves_the_results(file, tmp_path, monkeypatch):
    folder = tmp_path / "out"
    run(file, folder)
    before = {path: path.read_bytes() for path in own_files(folder)}

    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("turgor.job.run.RunRecord.create", full)
    with refused("[Errno 28]", error=OSError):
        run(file, folder, force=True)
    assert {path: path.read_bytes() for path in own_files(folder)} == before
    assert not (folder / PREVIOUS).exists()


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
@pytest.mark.parametrize("name", ["path", "vtu"])
def test_links_are_not_followed(file, tmp_path, name):
    theirs = tmp_path / "theirs"
    theirs.mkdir()
    for each in ("data.txt", "index.json", "state-0-000001.turgor", "state_0000.vtu"):
        (theirs / each).write_text("theirs")
    folder = tmp_path / "out"
    folder.mkdir()
    (folder / name).symlink_to(theirs)
    with refused(folder / name, theirs):
        run(file, folder, force=True)
    assert {path.read_text() for path in theirs.iterdir()} == {"theirs"}


def test_a_manifest_names_nothing_outside(tmp_path):
    (tmp_path / "victim").write_text("theirs")
    folder = tmp_path / "out"
    folder.mkdir()
    (folder / MANIFEST).write_text('{"files": ["../victim", "/etc/passwd", "a/../../victim", 3, "response.csv"]}')
    assert listed(folder) == {"response.csv"}
    assert own_files(folder) == []


def test_a_run_is_known_by_what_it_computes(file, tmp_path, monkeypatch):
    folder = tmp_path / "out"
    monkeypatch.chdir(tmp_path)
    killed_after(1, Path("pull.toml"), folder)
    renamed = tmp_path / "elsewhere" / "renamed.toml"
    renamed.parent.mkdir()
    file.rename(renamed)
    monkeypatch.chdir(tmp_path / "elsewhere")
    run(renamed, folder, resume=True)
    assert "continuing the path" in (folder / "run.log").read_text()


@pytest.mark.parametrize("length", [0, 300, 700])
def test_a_truncated_lock_file_is_mended(file, tmp_path, length):
    folder = tmp_path / "out"
    killed_after(1, file, folder)
    lock = folder / "job.lock.toml"
    whole = lock.read_bytes()
    lock.write_bytes(whole[:length])
    with refused(lock, "damaged", "resume=True"):
        report_folder(folder, lambda _: None)
    other = tmp_path / "other.toml"
    other.write_text(JOB.replace("2 kPa", "3 kPa"), encoding="utf-8")
    with refused(folder, "'job.lock.toml'", "force=True"):
        run(other, folder, resume=True)
    run(file, folder, resume=True)
    assert lock.read_bytes()[:200] == whole[:200]
    assert "was damaged or missing" in (folder / "run.log").read_text()
