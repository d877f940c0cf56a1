"""Caches are this user's alone, and a damaged file of one never stops a run."""

import os
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

from turgor.cli import main
from turgor.core.meshing.tetwild.mesh_cache import cached_cells
from turgor.foundation.startup import kernel_folder
from turgor.foundation.store.caches import PARTS, cache_folder, private

posix = pytest.mark.skipif(not hasattr(os, "getuid"), reason="owners and modes are those of POSIX")
root = pytest.mark.skipif(not hasattr(os, "getuid") or os.getuid() != 0, reason="only root can make files of others")


@posix
def test_a_folder_of_the_user_is_closed_to_others(tmp_path):
    folder = tmp_path / "cache"
    assert private(folder)
    assert folder.stat().st_mode & 0o777 == 0o700
    folder.chmod(0o777)
    assert private(folder)
    assert folder.stat().st_mode & 0o022 == 0


@root
def test_a_folder_of_another_user_is_not_used(tmp_path):
    folder = tmp_path / "cache"
    folder.mkdir()
    os.chown(folder, 4321, 4321)
    assert not private(folder)


@posix
def test_a_link_is_not_used(tmp_path):
    (tmp_path / "theirs").mkdir()
    (tmp_path / "cache").symlink_to(tmp_path / "theirs")
    assert not private(tmp_path / "cache")


@root
def test_loops_of_another_user_are_not_loaded(tmp_path, monkeypatch):
    """Neither package nor cache can be written, and somebody else has made the folder whose name can be predicted."""
    (tmp_path / "file").touch()
    monkeypatch.setattr(kernel_folder, "usual", lambda: (tmp_path / "file" / "a", tmp_path / "file" / "b"))
    monkeypatch.delenv("TURGOR_CACHE")
    monkeypatch.setenv(kernel_folder.VARIABLE, "")
    monkeypatch.setattr(kernel_folder.tempfile, "tempdir", str(tmp_path))
    planted = tmp_path / f"turgor-compiled-{os.getuid()}"
    planted.mkdir()
    os.chown(planted, 4321, 4321)
    used = kernel_folder.folder()
    assert used is not None
    assert used != planted
    assert used.stat().st_uid == os.getuid()
    assert used.stat().st_mode & 0o077 == 0
    assert kernel_folder.folder() == used, "processes that are started use the same"


def test_one_variable_moves_all_caches(tmp_path, monkeypatch):
    monkeypatch.setenv("TURGOR_CACHE", str(tmp_path))
    monkeypatch.delenv(kernel_folder.VARIABLE, raising=False)
    assert kernel_folder.folder() == tmp_path / "compiled"
    assert {cache_folder(part) for part in PARTS} == {tmp_path / part for part in PARTS}


PROGRAM = """
import warnings
warnings.simplefilter("error")
warnings.filterwarnings("default", message="a damaged file")
from turgor.core.engine.warmup.numba_cache import prepare_kernel_cache
prepare_kernel_cache()
import lone
print(lone.double(3))
"""


@pytest.mark.parametrize("ending", ["nbi", "nbc"])
def test_damaged_compiled_loops_are_compiled_again(tmp_path, ending):
    (tmp_path / "lone.py").write_text("import numba\n@numba.njit(cache=True)\ndef double(x):\n    return 2 * x\n")
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / "loops"), "PYTHONPATH": os.pathsep.join(sys.path)}

    def run() -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-c", PROGRAM], cwd=tmp_path, env=environment, capture_output=True, text=True, check=True
        )

    assert run().stdout == "6\n"
    files = list((tmp_path / "loops").rglob(f"*.{ending}"))
    assert files
    for file in files:
        file.write_bytes(b"" if ending == "nbi" else b"\x80\x05nonsense")
    mended = run()
    assert mended.stdout == "6\n"
    assert "a damaged file in the cache of compiled kernels was removed" in mended.stderr
    again = run()
    assert (again.stdout, again.stderr) == ("6\n", "")


def test_damaged_meshes_are_made_again(tmp_path, monkeypatch):
    monkeypatch.setenv("TURGOR_CACHE", str(tmp_path))
    points, cells = np.random.default_rng(0).random((40, 3)), np.arange(160).reshape(40, 4)
    made: list[int] = []

    def make():
        made.append(1)
        return points, cells

    cached_cells({"a": 1}, make)
    (file,) = (tmp_path / "meshes").iterdir()
    whole = file.read_bytes()
    random = np.random.default_rng(1)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        for _ in range(300):
            damaged = bytearray(whole)
            for place in random.integers(len(whole), size=4):
                damaged[place] = random.integers(256)
            file.write_bytes(bytes(damaged))
            got = cached_cells({"a": 1}, make)
            assert got[0].shape == points.shape
    assert len(made) > 100
    assert told


def test_caches_are_shown_and_emptied(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("TURGOR_CACHE", str(tmp_path))
    monkeypatch.delenv(kernel_folder.VARIABLE, raising=False)
    cached = [tmp_path / "meshes" / "a.turgor", tmp_path / "compiled" / "cells_1" / "b.nbi"]
    theirs = [tmp_path / "notes.txt", tmp_path / "other" / "c.npz"]
    for file in (*cached, *theirs):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(bytes(2_000_000))
    assert main(["cache"]) == 0
    assert f"Caches in {tmp_path}" in capsys.readouterr().out
    assert all(map(Path.exists, cached))
    assert main(["cache", "--clear"]) == 0
    assert "2 files removed" in capsys.readouterr().out
    assert not any(map(Path.exists, cached))
    assert all(map(Path.exists, theirs))
