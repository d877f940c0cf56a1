"""Caches are this user's alone, and a damaged file of one never stops a run."""

import os
import subprocess
import sys
import warnings
from pathlib import Path
from zipfile import ZipFile

import numpy as np
import pytest

from turgor.cli import main
from turgor.core.materials.laws.derived_formulas import cached_formulas
from turgor.core.materials.laws.laws import NeoHooke
from turgor.core.meshing.tetwild.mesh_cache import cached_cells
from turgor.foundation.startup import kernel_folder
from turgor.foundation.startup import kernel_folder as loops
from turgor.foundation.store.cached_values import Cache
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


@posix
@pytest.mark.parametrize(("mode", "used"), [(0o777, False), (0o1777, True), (0o700, True)])
def test_a_folder_that_others_can_rename_is_not_used(tmp_path, mode, used):
    """Who may rename it can put one of his own in its place after it was checked; not so where it is sticky."""
    (tmp_path / "all").mkdir()
    (tmp_path / "all").chmod(mode)
    assert private(tmp_path / "all" / "cache") is used
    assert private(tmp_path / "all" / "more" / "cache") is used


@root
def test_a_folder_that_a_group_can_rename_is_not_used(tmp_path):
    for group, used in ((4321, False), (0, True)):  # of others, and of this user alone
        os.chown(tmp_path, 0, group)
        tmp_path.chmod(0o770)
        assert private(tmp_path / "cache") is used


@posix
@pytest.mark.parametrize("variable", ["NUMBA_CACHE_DIR", "TURGOR_CACHE"])
def test_a_stated_folder_that_others_can_write_is_not_used(tmp_path, monkeypatch, variable):
    """A process that this one started, or a later one, finds the name in its environment."""
    (tmp_path / "all").mkdir()
    (tmp_path / "all").chmod(0o777)
    monkeypatch.setattr(loops.tempfile, "tempdir", str(tmp_path))
    for name in ("NUMBA_CACHE_DIR", "TURGOR_CACHE"):
        monkeypatch.setenv(name, str(tmp_path / "all" / "mine") if name == variable else "")
    monkeypatch.setattr(loops, "usual", lambda: 2 * (Path("/dev/null/none"),))
    with pytest.warns(UserWarning, match="compiled code goes to"):
        assert loops.folder() == tmp_path / f"turgor-compiled-{os.getuid()}"


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
    with pytest.warns(UserWarning, match="compiled code goes to"):
        used = loops.folder()
    assert used is not None
    assert used != planted
    assert used.stat().st_uid == os.getuid()
    assert used.stat().st_mode & 0o077 == 0
    assert loops.folder() == used, "processes that are started use the same"


def test_one_variable_moves_all_caches(tmp_path, monkeypatch):
    monkeypatch.setenv("TURGOR_CACHE", str(tmp_path))
    monkeypatch.delenv(kernel_folder.VARIABLE, raising=False)
    assert loops.folder() == tmp_path / "compiled"
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


def test_one_wrong_bit_of_compiled_code_is_found(tmp_path):
    """Machine code with a wrong bit may crash or give another number, and numba has no sum to check."""
    (tmp_path / "lone.py").write_text("import numba\n@numba.njit(cache=True)\ndef double(x):\n    return 2 * x\n")
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / "loops"), "PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, "-c", PROGRAM]

    def run() -> subprocess.CompletedProcess[str]:
        return subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=True)

    run()
    (file,) = (tmp_path / "loops").rglob("*.nbc")
    content = bytearray(file.read_bytes())
    content[content.index(b"\x7fELF") + 100 if b"\x7fELF" in content else len(content) // 2] ^= 1
    file.write_bytes(bytes(content))
    mended = run()
    assert mended.stdout == "6\n"
    assert "was removed (ValueError)" in mended.stderr
    assert run().stderr == ""


def test_another_digit_in_a_cached_law_is_found(tmp_path, monkeypatch):
    monkeypatch.setenv("TURGOR_CACHE", str(tmp_path))
    first = cached_formulas(NeoHooke, "digits", lambda: thrice)(2.0)
    (file,) = (tmp_path / "laws").iterdir()
    content = file.read_bytes()
    assert b"[3]" in content
    file.write_bytes(content.replace(b"[3]", b"[4]"))
    with pytest.warns(UserWarning, match="damaged entry in the cache of laws"):
        assert cached_formulas(NeoHooke, "digits", lambda: thrice)(2.0) == first == [6.0]


def thrice(x):
    return [3 * x]


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


def test_an_entry_with_another_number_is_dropped(tmp_path, monkeypatch):
    """The file is a whole archive, and a number in it is another one: without a hash it would be believed."""
    monkeypatch.setenv("TURGOR_CACHE", str(tmp_path))
    entries = Cache("meshes", 1e6)
    entries.put([1.0, 2.0], "key")
    (file,) = (tmp_path / "meshes").iterdir()
    with ZipFile(file) as archive:
        members = {name: archive.read(name).replace(b"2.0", b"3.0") for name in archive.namelist()}
    with ZipFile(file, "w") as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    with pytest.warns(UserWarning, match="damaged entry in the cache of meshes was removed"):
        assert entries.get("key") is None
    assert not file.exists()
