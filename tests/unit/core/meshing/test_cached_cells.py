"""Meshes of fTetWild are cached on disk: the same part gets the same mesh again."""

import numpy as np
import pytest

from turgor.core.meshing.tetwild import mesh_cache
from turgor.core.meshing.tetwild.mesh_cache import cached_cells
from turgor.foundation.store.cached_values import Cache

INPUTS = {"vertices": np.zeros((3, 3)), "edge_length_abs": 2.0}


class Mesher:
    """Makes another mesh with every call, as fTetWild does."""

    calls = 0

    def __call__(self):
        self.calls += 1
        return np.full((4, 3), float(self.calls)), np.arange(4)[None]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("TURGOR_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache" / "meshes"


def test_the_same_inputs_give_the_mesh_made_first(folder):
    make = Mesher()
    first, again = cached_cells(INPUTS, make), cached_cells(dict(INPUTS), make)
    assert make.calls == 1
    assert np.array_equal(first[0], again[0])
    assert np.array_equal(first[1], again[1])
    assert [each.suffix for each in folder.iterdir()] == [".turgor"]


@pytest.mark.parametrize("change", [{"edge_length_abs": 2.5}, {"vertices": np.ones((3, 3))}, {"coarsen": True}])
def test_other_inputs_give_another_mesh(folder, change):
    make = Mesher()
    cached_cells(INPUTS, make)
    cached_cells(INPUTS | change, make)
    assert make.calls == 2


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04 damaged", b"nonsense"])
def test_a_damaged_file_is_made_anew(folder, content):
    make = Mesher()
    cached_cells(INPUTS, make)
    next(folder.iterdir()).write_bytes(content)
    with pytest.warns(UserWarning, match="cache of meshes"):
        assert cached_cells(INPUTS, make)[0][0, 0] == 2
    assert cached_cells(INPUTS, make)[0][0, 0] == 2


def test_a_folder_that_cannot_be_written_costs_no_mesh(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("not a folder")
    monkeypatch.setenv("TURGOR_CACHE", str(tmp_path / "file"))
    assert cached_cells(INPUTS, Mesher())[0].shape == (4, 3)


def test_the_oldest_meshes_go_first(folder, monkeypatch):
    make = Mesher()
    cached_cells({"edge_length_abs": 0.5}, make)
    (file,) = folder.iterdir()
    monkeypatch.setattr(mesh_cache, "MESHES", Cache("meshes", 2.5 * file.stat().st_size))
    file.unlink()
    for size in (1.0, 2.0, 3.0):
        cached_cells({"edge_length_abs": size}, make)
    assert len(list(folder.iterdir())) == 2
    cached_cells({"edge_length_abs": 3.0}, make)
    assert make.calls == 4
