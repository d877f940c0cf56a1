"""``python -m turgor`` is the command line: the same words, the same exit codes."""

import os
import subprocess
import sys

import pytest

import turgor


def run(*arguments):
    environment = os.environ | {"COLUMNS": "120", "NO_COLOR": "1"}
    command = [sys.executable, "-m", "turgor", *arguments]
    return subprocess.run(command, capture_output=True, text=True, encoding="utf-8", env=environment, check=False)


def test_the_module_is_the_command_line():
    said = run("--version")
    assert said.returncode == 0
    assert turgor.__version__ in said.stdout


def test_a_wrong_word_ends_with_one_sentence_and_exit_code_1(tmp_path):
    said = run("run", str(tmp_path / "missing.toml"))
    assert said.returncode == 1
    assert "missing.toml" in said.stdout + said.stderr
    assert "Traceback" not in said.stderr


@pytest.mark.parametrize(
    ("stated", "seen"),
    [
        ({}, "1 None"),
        ({"OPENBLAS_NUM_THREADS": "3"}, "3 None"),
        ({"OMP_NUM_THREADS": "3"}, "None 3"),
    ],
    ids=["not stated", "stated", "stated for all libraries"],
)
def test_openblas_has_one_thread_unless_the_user_says_otherwise(stated, seen):
    asked = "print(*(os.environ.get(f'{name}_NUM_THREADS') for name in ('OPENBLAS', 'OMP')))"
    script = f"import os, sys; from turgor.cli import command; sys.argv[1:] = ['--version']; command(); {asked}"
    clean = {name: value for name, value in os.environ.items() if not name.endswith("_NUM_THREADS")}
    said = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, env=clean | stated, check=True
    )
    assert said.stdout.splitlines()[-1] == seen


def test_a_call_from_python_leaves_the_process_as_it_is():
    script = "import gc, os; from turgor.cli import main; before = gc.get_threshold(), dict(os.environ); "
    script += "main(['--version']); print((gc.get_threshold(), dict(os.environ)) == before, gc.get_freeze_count())"
    said = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert said.stdout.splitlines()[-1] == "True 0"


@pytest.mark.parametrize(
    ("encoding", "arguments"), [("ascii", "fit strip.csv --mode uniaxial --laws neo-hooke"), ("latin-1", "materials")]
)
def test_letters_that_the_output_cannot_hold_are_question_marks(tmp_path, encoding, arguments):
    """``turgor fit`` writes R², and ``turgor materials`` a dash between pages."""
    (tmp_path / "strip.csv").write_text("stretch,nominal_stress_MPa\n1,0\n1.5,0.2\n2,0.35\n")
    environment = os.environ | {"PYTHONIOENCODING": encoding}
    command = [sys.executable, "-m", "turgor", *arguments.split()]
    said = subprocess.run(command, capture_output=True, check=False, cwd=tmp_path, env=environment)
    assert (said.returncode, said.stderr) == (0, b"")
    assert b"?" in said.stdout


def test_a_warning_is_a_sentence():
    program = "import warnings, turgor.cli.app as app; app.prepare_output(); warnings.warn('damaged', stacklevel=1)"
    said = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert said.stderr == "turgor: damaged\n"
