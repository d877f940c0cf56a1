"""A full disk: one sentence for each run, no traceback, and the study goes on once there is room."""

import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from refused import states
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies.runs.executors.run_outcome import compute
from turgor.studies.runs.run import Computed, Run


def doubled(x: float) -> Computed:
    response = Response(columns=(Column("y", "", [2 * x]),), source=Source(text="a test"))
    return Computed(response=response, picture=bytes(40_000))


def written_to_a_full_disk() -> Computed:
    Path("/dev/full").write_bytes(b"1")
    return doubled(1.0)


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of 16 kB."""
    place = tmp_path / "small"
    place.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", str(place)]
    try:
        if subprocess.run(mount, capture_output=True, check=False).returncode:
            pytest.skip("only root can make a small file system")
    except FileNotFoundError:
        pytest.skip("this system has no mount")
    yield place
    subprocess.run(["umount", str(place)], check=True)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no full device")
def test_a_function_that_finds_no_room_is_told_in_a_sentence(tmp_path):
    ended = compute(Run(name="full", function=written_to_a_full_disk), tmp_path)
    assert ended.result is None
    assert states(ended.problem, "No space")
    assert not ended.final, "the next call tries again"


def test_results_that_find_no_room_are_told_in_a_sentence(small_disk):
    run = Run(name="two", function=doubled, values={"x": 1.0})
    ended = compute(run, small_disk / "runs")
    assert ended.result is None
    assert states(ended.problem, "No space")
    assert "Traceback" not in ended.problem
    subprocess.run(["mount", "-o", "remount,size=1m", str(small_disk)], check=True)
    assert compute(run, small_disk / "runs").result is not None
