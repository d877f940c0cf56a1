"""Commands at once on empty caches, also while these are emptied: all end, with the same response.

``TURGOR_KILLS=200 python -m pytest tests/kills -m slow`` repeats them five times.
"""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest
from kill_cases import FILES

REPEATED = 5 if int(os.environ.get("TURGOR_KILLS", "0")) >= 200 else 1

pytestmark = pytest.mark.slow


def started(folder: Path, *arguments: str) -> "subprocess.Popen[str]":
    """Start a command whose caches are in a folder."""
    caches = {"TURGOR_CACHE": str(folder / "caches"), "NUMBA_CACHE_DIR": str(folder / "caches" / "compiled")}
    return subprocess.Popen(
        [sys.executable, "-m", "turgor", *arguments], cwd=folder, env={**os.environ, **caches}, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
    )  # fmt: skip


def responses(folder: Path, runs: "list[subprocess.Popen[str]]") -> set[bytes]:
    """Wait for runs, check that all are done without a complaint, and return their different responses."""
    for run in runs:
        said, _ = run.communicate(timeout=600)
        assert run.returncode == 0 and "cache" not in said, said
    return {(folder / str(number) / "response.csv").read_bytes() for number in range(len(runs))}


@pytest.fixture
def folder(tmp_path):
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    return tmp_path


def runs_at_once(folder: Path, count: int) -> "list[subprocess.Popen[str]]":
    return [started(folder, "run", "pull.toml", "--threads", "1", "--output", str(each)) for each in range(count)]


@pytest.mark.parametrize("number", range(REPEATED))
def test_four_runs_on_a_cold_cache(number, folder):
    assert len(responses(folder, runs_at_once(folder, 4))) == 1


@pytest.mark.parametrize("number", range(REPEATED))
def test_two_runs_while_the_caches_are_emptied(number, folder):
    runs = runs_at_once(folder, 2)
    cleared = 0
    while any(run.poll() is None for run in runs):
        said, _ = started(folder, "cache", "--clear").communicate(timeout=60)
        cleared += int(said.split()[-3])
        time.sleep(1.0)
    assert len(responses(folder, runs)) == 1
    assert cleared > 0, "nothing was there to be removed"
