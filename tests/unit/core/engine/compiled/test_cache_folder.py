"""Compiled loops are kept somewhere, and a folder that cannot be written is answered by another and a sentence."""

import warnings
from pathlib import Path

import numba
import pytest

from turgor.core.engine import cache_folder
from turgor.foundation import kernel_cache as loops


@pytest.fixture
def config(monkeypatch):
    monkeypatch.setattr(numba.config, "CACHE_DIR", "")
    monkeypatch.setenv(cache_folder.VARIABLE, "")
    monkeypatch.delenv("TURGOR_CACHE")
    return monkeypatch


def test_usual_folders_serve(config):
    assert cache_folder.keep_compiled_loops() is None
    assert numba.config.CACHE_DIR == ""


@pytest.mark.parametrize("full", [False, True])
def test_another_folder_where_none_can_be_written(config, tmp_path, full):
    file = tmp_path / "file"
    file.touch()  # no folder can be made below a file, not even by root
    config.setattr(loops, "usual", lambda: (file / "a", file / "b"))
    config.setenv(cache_folder.VARIABLE, str(file / "stated"))
    config.setattr(loops.tempfile, "tempdir", str(tmp_path))
    if full:  # something else stands where the folder would be
        for name in (f"turgor-compiled-{loops.os.getuid()}",):
            (tmp_path / name).touch()
    with pytest.warns(UserWarning, match="compiled code goes to .*TURGOR_CACHE"):
        other = cache_folder.keep_compiled_loops()
    assert other is not None
    assert other.is_dir()
    assert other.parent == tmp_path
    assert Path(numba.config.CACHE_DIR) == other


def test_a_folder_that_is_stated_serves(config, tmp_path):
    config.setattr(loops, "usual", tuple)
    config.setenv(cache_folder.VARIABLE, str(tmp_path / "mine"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert cache_folder.keep_compiled_loops() == tmp_path / "mine"
