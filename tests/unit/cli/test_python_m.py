"""``python -m turgor`` is the command line: the same words, the same exit codes."""

import os
import subprocess
import sys

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
