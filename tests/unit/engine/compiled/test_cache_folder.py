"""Compiled loops are kept somewhere, and a folder that cannot be written is answered by another and a sentence."""

from pathlib import Path

import numba
import pytest

from turgor.engine import cache_folder


@pytest.fixture
def config(monkeypatch):
    monkeypatch.setattr(numba.config, "CACHE_DIR", "")
    monkeypatch.setenv(cache_folder.VARIABLE, "")
    return monkeypatch


def test_usual_folders_serve(config):
    assert cache_folder.keep_compiled_loops() is None
    assert numba.config.CACHE_DIR == ""


@pytest.mark.parametrize("full", [False, True])
def test_another_folder_where_none_can_be_written(config, tmp_path, full):
    file = tmp_path / "file"
    file.touch()  # no folder can be made below a file, not even by root
    config.setattr(cache_folder, "usual", lambda: (file / "a", file / "b"))
    config.setenv(cache_folder.VARIABLE, str(file / "stated"))
    config.setattr(cache_folder.tempfile, "tempdir", str(tmp_path))
    if full:  # something else stands where the folder would be
        for name in (f"turgor-compiled-{cache_folder.os.getuid()}",):
            (tmp_path / name).touch()
    with pytest.warns(UserWarning, match="compiled code is kept in .*NUMBA_CACHE_DIR"):
        other = cache_folder.keep_compiled_loops()
    assert other is not None
    assert other.is_dir()
    assert other.parent == tmp_path
    assert Path(numba.config.CACHE_DIR) == other


def test_a_folder_that_is_stated_serves(config, tmp_path):
    config.setattr(cache_folder, "usual", tuple)
    config.setenv(cache_folder.VARIABLE, str(tmp_path / "mine"))
    assert cache_folder.keep_compiled_loops() is None
