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
