"""Files that appear whole or not at all, also where a process is killed as it writes, or two write at once."""

import os
import signal
import subprocess
import sys
from contextlib import suppress

import pytest

from turgor.foundation.store.atomic_files import whole, write_whole

KILLED = """
import os, signal
from pathlib import Path
from turgor.foundation.store.atomic_files import whole

with whole(Path("a.txt")) as part:
    part.write_text("half")
    os.kill(os.getpid(), signal.SIGKILL)
"""


def names(folder):
    return sorted(each.name for each in folder.iterdir())


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_what_a_killed_process_left_is_written_over(tmp_path):
    for _ in range(2):
        code = subprocess.run(
            [sys.executable, "-c", KILLED], cwd=tmp_path, env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
            check=False,
        ).returncode  # fmt: skip
        assert code == -signal.SIGKILL
        assert len(names(tmp_path)) == 1 and names(tmp_path) != ["a.txt"]
    write_whole(tmp_path / "a.txt", "whole")
    assert names(tmp_path) == ["a.txt"]
    assert (tmp_path / "a.txt").read_text() == "whole"


def test_two_write_at_once(tmp_path):
    file = tmp_path / "a.txt"
    with whole(file) as first:
        first.write_text("first")
        with whole(file) as second:
            second.write_text("second")
            assert first != second
        assert file.read_text() == "second"
        write_whole(file, "third")
    assert file.read_text() == "first"
    assert names(tmp_path) == ["a.txt"]


def test_what_fails_leaves_nothing(tmp_path):
    file = tmp_path / "a.txt"
    write_whole(file, "before")
    with suppress(KeyboardInterrupt), whole(file) as part:
        part.write_text("half")
        raise KeyboardInterrupt
    assert names(tmp_path) == ["a.txt"] and file.read_text() == "before"
