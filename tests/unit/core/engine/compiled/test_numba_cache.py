"""Compiled kernels are cached somewhere, and a folder that cannot be written is answered by another and a sentence."""

import warnings
from pathlib import Path

import numba
import pytest

from turgor.core.engine.warmup import numba_cache
from turgor.foundation.startup import kernel_folder


@pytest.fixture
def config(monkeypatch):
    monkeypatch.setattr(numba.config, "CACHE_DIR", "")
    monkeypatch.setenv(kernel_folder.VARIABLE, "")
    monkeypatch.delenv("TURGOR_CACHE")
    return monkeypatch


def test_usual_folders_serve(config):
    assert numba_cache.prepare_kernel_cache() is None
    assert numba.config.CACHE_DIR == ""


@pytest.mark.parametrize("full", [False, True])
def test_another_folder_where_none_can_be_written(config, tmp_path, full):
    file = tmp_path / "file"
    file.touch()  # no folder can be made below a file, not even by root
    config.setattr(kernel_folder, "usual", lambda: (file / "a", file / "b"))
    config.setenv(kernel_folder.VARIABLE, str(file / "stated"))
    config.setattr(kernel_folder.tempfile, "tempdir", str(tmp_path))
    if full:  # something else stands where the folder would be
        for name in (f"turgor-compiled-{kernel_folder.os.getuid()}",):
            (tmp_path / name).touch()
    with pytest.warns(UserWarning, match="TURGOR_CACHE"):
        other = numba_cache.prepare_kernel_cache()
    assert other is not None
    assert other.is_dir()
    assert other.parent == tmp_path
    assert Path(numba.config.CACHE_DIR) == other


def test_a_folder_that_is_stated_serves(config, tmp_path):
    config.setattr(kernel_folder, "usual", tuple)
    config.setenv(kernel_folder.VARIABLE, str(tmp_path / "mine"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert numba_cache.prepare_kernel_cache() == tmp_path / "mine"
