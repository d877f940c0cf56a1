"""Damaged files of all kinds, 150, are read or refused; `make fuzz` tries 10,000."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

#: Files that the usual tests try; they take ten seconds.
FILES = 150


@pytest.mark.skipif(not hasattr(os, "fork"), reason="each batch of files is tried in a forked process")
def test_damaged_files_are_read_or_refused_with_a_sentence(tmp_path: Path) -> None:
    program = Path(__file__).with_name("fuzz_all.py")
    environment = os.environ | {"TURGOR_CACHE": str(tmp_path), "PYTHONPATH": os.pathsep.join(sys.path)}
    ended = subprocess.run(
        [sys.executable, str(program), str(FILES)], env=environment, capture_output=True, text=True, check=False
    )
    assert ended.returncode == 0, f"{ended.stdout}\n{ended.stderr}"
    rows = [line.split("|") for line in ended.stdout.splitlines() if line.startswith("| ")][1:]
    tried, refused, accepted = (sum(int(row[column]) for row in rows) for column in (2, 3, 4))
    assert tried > 0.9 * FILES
    assert refused > tried / 3 and accepted > tried / 20, "damage that is always refused, or never, tests nothing"
