"""Command line: exit codes, one sentence for each mistake and no traceback, and one small job from end to end."""

import csv
import json
import os
import re
import signal
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from typer.main import get_command

import turgor.job.prepare
import turgor.job.run
from refused import states
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE, FOUND_ERROR, NOT_CONVERGED
from turgor.cli.start.commands import command_line
from turgor.core.solvers.checkpoints.record import Question, RunRecord
from turgor.core.solvers.listeners import Listeners
from turgor.core.solvers.solve import follow_question

JOB = """\
[actuator]
type = "fast_pneunet"
chambers = 2
length = "20 mm"
gap = "2 mm"

[mesh]
size = "4 mm"

[materials]
body = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }
base = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }
strain_limiting_layer = { library = "paper", record = "hooke-polygerinos-2020", thickness = "0.1 mm" }

[loads]
pressure = "2 kPa"

[procedure]
type = "static"
first_step = 0.5
max_step = 0.5
"""

QUICK = "fields = false\npictures = false\nreport = false\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in an empty folder that holds the job file ``finger.toml``."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "finger.toml").write_text(JOB, encoding="utf-8")
    return tmp_path


MISTAKES = [
    # (in the file, changed to, the one line that answers it)
    ("gap =", "gab =", "finger.toml:5: actuator.gab: unknown key 'gab'; did you mean 'gap'? Known keys: type, chamber"),
    ('"2 kPa"', '"60 kP"', "finger.toml:16: loads.pressure: unknown unit 'kP' in '60 kP'; did you mean 'kPa'? Known p"),
    ('"2 kPa"', '"1.5"', "finger.toml:16: loads.pressure: '1.5' needs a unit, for example '60 kPa'. Known pressure un"),
    ('"2 mm"', '"-1 mm"', "finger.toml:5: actuator.gap: -1 mm; allowed is 0.01 mm to 19.94 mm, so that 2 chambers fit"),
    ('gap = "2 mm"', 'side_wall = "11 mm"', "finger.toml:5: actuator.side_wall: 11 mm; allowed is 0.01 mm to 9.995 mm, "
     "less than half the width of 20 mm."),
    ('body = { library = "elastosil-m4601"', 'body = { library = "elastosil-m4600"', "finger.toml:11: materials."
     "body.library: unknown library material 'elastosil-m4600'; did you mean 'elastosil-m4601'? Known: "),
    ('"4 mm"', '"0 mm"', "finger.toml:8: mesh.size: 0 mm; allowed is 0.2"),
    ('"4 mm"', '"-4 mm"', "finger.toml:8: mesh.size: -4 mm; allowed is 0.2"),
    ('"4 mm"', '"99 mm"', "finger.toml:8: mesh.size: 99 mm, larger than the part; allowed is 0.2"),
]  # fmt: skip


@pytest.mark.parametrize("command", ["run", "check"])
@pytest.mark.parametrize(("old", "new", "line"), MISTAKES, ids=[new for _, new, _ in MISTAKES])
def test_bad_input_is_one_sentence(
    folder: Path, capsys: pytest.CaptureFixture[str], command: str, old: str, new: str, line: str
) -> None:
    assert old in JOB
    (folder / "finger.toml").write_text(JOB.replace(old, new))
    assert main([command, "finger.toml"]) == BAD_INPUT
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert err.startswith(line)
    assert "Traceback" not in err
    assert [file.name for file in folder.iterdir()] == ["finger.toml"], "nothing was written"


def test_debug_shows_the_traceback(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "finger.toml").write_text(JOB.replace("gap =", "gab ="))
    assert main(["run", "finger.toml", "--debug"]) == BAD_INPUT
    err = capsys.readouterr().err
    assert "Traceback" in err
    assert "JobError" in err
    assert states(err.splitlines()[-1], "'gab'", "'gap'")


def test_a_folder_that_holds_something_is_not_touched(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    results = folder / "finger-results"
    results.mkdir()
    (results / "thesis.tex").write_text("mine")
    assert main(["run", "finger.toml"]) == BAD_INPUT
    out, err = capsys.readouterr()
    assert states(err, "'finger-results'", "--output OTHER", "--force")
    assert "meshing" not in out, "it is refused before anything is computed"
    assert [file.name for file in results.iterdir()] == ["thesis.tex"]
    assert main(["run", "finger.toml", "--output", "finger.toml"]) == BAD_INPUT
    assert states(capsys.readouterr().err, "'finger.toml'", "a file")


def test_a_folder_that_cannot_be_made_is_named(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "file").write_text("")
    assert main(["run", "finger.toml", "--output", "file/results"]) == BAD_INPUT
    assert states(capsys.readouterr().err, "'file/results'", "Not a directory")


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["run"], "turgor: Missing argument 'JOB'. See 'turgor run --help'."),
        (["rum", "finger.toml"], "turgor: No such command 'rum'."),
        (["run", "finger.toml", "--thread", "2"], "turgor: No such option: --thread"),
        (["run", "finger.toml", "--threads", "0"], "turgor: Invalid value for '--threads':"),
        (
            ["run", "fingr.toml"],
            "there is no job file 'fingr.toml'; did you mean 'finger.toml'? TOML files there: finger.toml.",
        ),
        (["run", "nofile.toml"], "there is no job file 'nofile.toml'. TOML files there: finger.toml."),
        (["run", "."], "'.' is a folder; name a job file"),
    ],
)
def test_usage_errors_exit_with_1(
    folder: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], sentence: str
) -> None:
    assert main(arguments) == BAD_INPUT
    err = capsys.readouterr().err
    assert err.startswith(sentence)
    assert err.count("\n") == 1


def test_what_nobody_expected_is_a_sentence_too(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object, **__: object) -> None:
        raise ZeroDivisionError("by zero")

    monkeypatch.setattr(turgor.job.prepare, "mesh_of", broken)
    assert main(["run", "finger.toml", "--quiet"]) == BAD_INPUT
    err = capsys.readouterr().err
    assert states(err, "ZeroDivisionError: by zero")
    assert err.count("\n") == 1
    assert not (folder / "finger-results").exists(), "no empty folder is left behind"


def test_a_full_disk_is_a_sentence(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device", "response.csv")

    monkeypatch.setattr(turgor.job.run, "prepare", full)
    assert main(["run", "finger.toml", "--quiet"]) == BAD_INPUT
    assert states(capsys.readouterr().err, "'response.csv'", "No space")


def test_version_actuators_and_materials(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version"]) == DONE
    assert re.match(r"turgor \d+\.\d+", capsys.readouterr().out)
    assert main(["actuators", "fast_pneunet"]) == DONE
    out = capsys.readouterr().out
    assert '\nwall = "1 mm"\n' in out
    assert "\nsymmetric = true\n" in out
    assert main(["materials"]) == DONE
    out = capsys.readouterr().out
    assert re.search(r"^elastosil-m4601 .* yeoh-mosadegh-2014$", out, re.MULTILINE)
    assert main([]) == BAD_INPUT
    assert "Exit codes:" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        (["-V"], ["--version"]),
        (["version"], ["--version"]),
        (["-h"], ["--help"]),
        (["help"], ["--help"]),
        (["help", "run"], ["run", "--help"]),
        (["materials", "-h"], ["materials", "--help"]),
    ],
)
def test_usual_words_for_help_and_version(
    capsys: pytest.CaptureFixture[str], typed: list[str], meant: list[str]
) -> None:
    assert main(typed) == DONE
    said = capsys.readouterr().out
    assert main(meant) == DONE
    assert said == capsys.readouterr().out != ""


def test_every_output_has_a_short_option() -> None:
    commands = get_command(command_line()).commands  # type: ignore[attr-defined]
    named = [option.opts for each in commands.values() for option in each.params if "--output" in option.opts]
    assert len(named) > 12
    assert all("-o" in opts for opts in named)


def test_a_model_that_nothing_holds_is_an_error_of_a_check(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "finger.toml").write_text(JOB + '[supports]\nfixed = "z"\n')
    assert main(["check", "finger.toml"]) == FOUND_ERROR
    err = capsys.readouterr().err
    assert states(err, "B01", "'fixed'", "fixed, outside"), "no Python on the command line"


def test_help_and_usage_errors_import_nothing_heavy() -> None:
    """They must answer at once: measured by what is imported, because a loaded machine tells no times."""
    script = "import sys; from turgor.cli import main; main(['--help']); main(['rum']); print(*sys.modules)"
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    modules = set(run.stdout.splitlines()[-1].split())
    assert "typer" in modules
    assert modules & {"numpy", "numba", "scipy", "netgen", "matplotlib", "rich"} == set()


def test_the_program_itself_answers_a_mistake(folder: Path) -> None:
    """Once as a process of its own: exit code, stderr and stdout as a shell sees them."""
    (folder / "finger.toml").write_text(JOB.replace('"2 kPa"', '"60 kP"'))
    run = subprocess.run([sys.executable, "-m", "turgor.cli", "run", "finger.toml"], capture_output=True, text=True)
    assert run.returncode == BAD_INPUT
    assert run.stdout == ""
    assert states(run.stderr, "finger.toml:16: loads.pressure:", "'kP'", "'60 kP'", "'kPa'")
    assert run.stderr.count("\n") == 1


def test_check_reads_and_meshes_without_solving(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "finger.toml"]) == DONE
    out, err = capsys.readouterr()
    assert re.match(r"finger.toml is a valid job: fast PneuNet, 2 chambers, half; \d+ cells, \d+ unknowns\.\n", out)
    assert err == ""  # a wall of one cell (G01) is reported after the solve, where the mesh error is large
    assert [file.name for file in folder.iterdir()] == ["finger.toml"]


# --- one small job from end to end ---------------------------------------------------------------------------------


def rows(file: Path) -> list[dict[str, float]]:
    with file.open(newline="") as stream:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(stream)]


def lock_version(results: Path) -> str:
    return str(tomllib.loads((results / "job.lock.toml").read_text())["written_by"]["numpy"])


def test_a_job_runs_and_its_lock_file_repeats_it(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", "finger.toml", "--threads", "1"]) == DONE
    out = capsys.readouterr().out
    results = folder / "finger-results"
    response = rows(results / "response.csv")
    assert [row["pressure_kPa"] for row in response] == [0, 1, 2]
    assert response[-1]["bending_angle_deg"] > response[1]["bending_angle_deg"] > 0
    assert response[-1]["cavity_volume_mL"] > response[0]["cavity_volume_mL"]

    assert re.search(r"mesh: \d+ cells, \d+ unknowns", out)
    assert re.search(
        r"step 2: load factor 1\.0000, 2 kPa, \d+ iterations, residual .*, bending \d+\.\d\d deg, 0:00", out
    )
    assert "Reached 2 kPa (load factor 1) in 2 steps" in out
    shown = re.search(r"At 2 kPa: bending angle ([\d.]+) ± ([\d.]+) deg", out)
    error = response[-1]["bending_angle_mesh_error_deg"]
    assert float(shown[1]) == pytest.approx(response[-1]["bending_angle_deg"], abs=0.25 * error)  # one digit of it
    assert float(shown[2]) == pytest.approx(error, rel=0.4)
    assert "Results in finger-results: " in out
    assert {file.name for file in results.iterdir()} == {
        "report.html", "response.csv", "job.lock.toml", "steps.csv", "run.log", "vtu",
        "response.png", "undeformed.png", "deformed.png", "path", ".turgor-files.json",
    }  # fmt: skip
    report = (results / "report.html").read_text(encoding="utf-8")
    assert report.count("data:image/png;base64,") == 2
    for told in ("15 mm", "Mosadegh", "G01", lock_version(results), "job.lock.toml"):
        assert told in report
    assert len(re.findall(r"\.vtu$", "\n".join(str(file) for file in (results / "vtu").iterdir()), re.MULTILINE)) == 3

    lock = tomllib.loads((results / "job.lock.toml").read_text())
    assert lock["engine"]["threads"] == 1
    assert lock["written_by"]["numpy"]
    assert lock["written_by"]["linear_solver"]
    assert "solved to the end: Reached 2 kPa" in (results / "run.log").read_text()
    assert len((results / "steps.csv").read_text().splitlines()) == 3

    text = (results / "job.lock.toml").read_text().replace("pictures = true", "pictures = false")  # to save seconds
    (folder / "job.lock.toml").write_text(text)
    assert main(["run", "job.lock.toml", "--output", "again", "--quiet"]) == DONE
    assert capsys.readouterr().out == ""
    assert (folder / "again" / "response.csv").read_bytes() == (results / "response.csv").read_bytes()
    assert (folder / "again" / "job.lock.toml").read_text() == text


def test_a_run_that_stops_early_writes_the_path_so_far(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """One step allowed where two are needed; --force replaces the results of an earlier run and keeps other files."""
    results = folder / "finger-results"
    (results / "vtu").mkdir(parents=True)
    for stale in ("response.csv", "undeformed.png", "vtu/state_0099.vtu", "notes.txt"):
        (results / stale).write_text("old")
    listed = ["response.csv", "undeformed.png", "vtu/state_0099.vtu"]
    (results / ".turgor-files.json").write_text(json.dumps({"files": listed}))
    (folder / "finger.toml").write_text(JOB + "max_steps = 1\n[output]\nmeasures = ['reaction']\n" + QUICK)
    assert main(["run", "finger.toml", "--force"]) == NOT_CONVERGED
    err = capsys.readouterr().err
    assert states(err, "1 kPa", "load factor 0.5", "1 steps", "procedure.max_steps")
    assert [row["load_factor"] for row in rows(results / "response.csv")] == [0, 0.5]
    assert "step limit: Stopped" in (results / "run.log").read_text()
    assert (results / "notes.txt").read_text() == "old"
    assert not (results / "vtu").exists()


def test_an_interrupted_run_writes_the_path_so_far(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(question: Question, _: Listeners, record: RunRecord, throw: bool) -> object:
        def press_ctrl_c(iteration: object, state: object) -> None:
            if state is not None:
                raise KeyboardInterrupt

        return follow_question(question, Listeners(press_ctrl_c), record, throw)

    monkeypatch.setattr(turgor.job.run, "follow_question", interrupted)
    (folder / "finger.toml").write_text(JOB + "[output]\n" + QUICK)
    assert main(["run", "finger.toml", "--quiet"]) == 128 + signal.SIGINT
    assert states(capsys.readouterr().err, "1 kPa", "load factor 0.5")
    assert [row["load_factor"] for row in rows(folder / "finger-results" / "response.csv")] == [0, 0.5]


def test_the_summary_says_what_was_asked(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The force of a blocked tip comes first and is measured whatever else is; what is round-off is no result."""
    asked = 'measures = ["bending_angle"]\nmesh_error = false\n'
    (folder / "finger.toml").write_text(
        JOB.replace('"static"', '"blocked_force"\ndirection = "-z"') + "[output]\n" + QUICK + asked
    )
    assert main(["run", "finger.toml"]) == DONE
    assert re.search(r"(?m)^At 2 kPa: blocked force 0\.0\d+ N, bending angle \d", capsys.readouterr().out)
    last = rows(folder / "finger-results" / "response.csv")[-1]
    assert next(float(value) for name, value in last.items() if name.startswith("blocked_force")) > 0
    (folder / "finger.toml").write_text(JOB + "[output]\n" + QUICK + asked.replace('"]', '", "reaction"]'))
    assert main(["run", "finger.toml", "--force"]) == DONE
    out = capsys.readouterr().out
    assert re.search(r"(?m)^At 2 kPa: bending angle [\d.]+ deg\.$", out)
    assert "\nZero throughout: reaction.\n" in out


def test_walls_that_meet_are_an_error_after_everything_is_written(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    job = JOB.replace('gap = "2 mm"', 'gap = "0.1 mm"') + "[contact]\nself_contact = false\n\n[output]\n" + QUICK
    (folder / "finger.toml").write_text(job)
    assert main(["run", "finger.toml", "--quiet"]) == FOUND_ERROR
    err = capsys.readouterr().err
    assert states(err, "B02 error:", "kPa")
    assert rows(folder / "finger-results" / "response.csv")[-1]["load_factor"] == 1


def test_doubtful_constants_and_a_law_beyond_its_tests_are_said(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "mine.toml").write_text(
        'name = "mine"\nkind = "rubber"\n\n[records.short]\nlaw = "neo_hooke"\nparameters = { C10 = "0.1 MPa" }\n'
        'convention = "two_index"\nstretch_range = [1.0, 1.001]\nsource = "a short test"\n'
    )
    borrowed = 'library = "ecoflex-00-30", record = "yeoh-yan-2016"'
    job = JOB.replace('library = "elastosil-m4601", record = "yeoh-mosadegh-2014"', borrowed)
    job = job.replace(f"body = {{ {borrowed}", 'body = { library = "./mine.toml", record = "short"')
    (folder / "finger.toml").write_text(job + "[output]\n" + QUICK)
    assert main(["run", "finger.toml", "--quiet"]) == DONE
    err = capsys.readouterr().err
    assert err.count("are those of Elastosil M4601") == 1
    assert states(err, "M01 warning:", "'mine'")


def test_the_shell_completes_commands() -> None:
    asked = {"_TURGOR_COMPLETE": "complete_bash", "COMP_WORDS": "turgor che", "COMP_CWORD": "1"}
    command = [sys.executable, "-m", "turgor"]
    run = subprocess.run(command, env={**os.environ, **asked}, capture_output=True, text=True, check=True)
    assert run.stdout.split() == ["check"]
