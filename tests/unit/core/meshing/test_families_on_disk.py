"""Geometry and mesh of a family on disk: the same bits again, under a name that all of its causes decide."""

import copy
import os
import pickle
import subprocess
import sys
from dataclasses import dataclass, fields, replace
from pathlib import Path

import numpy as np
import pytest

from refused import refused
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.shapes.film_shape import FilmShape
from turgor.core.geometry.shapes.lazy_shape import LateShape
from turgor.core.geometry.write_step import write_step
from turgor.core.meshing.generate import mesh_with
from turgor.core.meshing.generator_override import meshing_instead
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.sizing.sizes import size_range
from turgor.foundation.store import cached_values
from turgor.foundation.store.codec import Encoder
from turgor.job import family_cache, meshes
from turgor.job.family_cache import geometry_on_disk, mesh_on_disk, save_family
from turgor.job.job import ACTUATORS
from turgor.job.meshes import save_mesh_of
from turgor.job.prepare import prepare
from turgor.job.read import read_job

FINGER = FastPneuNet(chambers=2, length=20e-3)
SETTINGS = MeshSettings(size=5e-3, cells="tetrahedra")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder of caches, and room for one entry or many."""
    monkeypatch.setenv("TURGOR_CACHE", str(tmp_path))
    monkeypatch.setenv("TURGOR_CACHE_MB", "100")
    return tmp_path / "families"


@pytest.fixture(scope="module")
def made():
    """Geometry and mesh, built and generated."""
    geometry = FINGER.build()
    return geometry, mesh_with(geometry, SETTINGS)


def entry(*key: object) -> Path:
    """File of an entry."""
    return family_cache._entries(FINGER).file(*family_cache._key(*key))


def as_text(value: object) -> tuple[str, list[bytes]]:
    """All that a value holds, but for its CAD shape: text, and the bytes of its arrays."""
    shape = getattr(value, "shape", None)
    encoder = Encoder(known=lambda each: "shape" if each is shape and shape is not None else None)
    return str(encoder.encode(value)), [
        f"{array.dtype} {array.shape} {array.flags.c_contiguous} {array.flags.writeable}".encode() + array.tobytes()
        for array in encoder.arrays.values()
    ]


def test_what_was_kept_is_found_with_the_same_bits(made, folder):
    geometry, mesh = made
    assert geometry_on_disk(FINGER) is None
    assert mesh_on_disk(FINGER, SETTINGS) is None
    save_family(FINGER, geometry, SETTINGS, mesh)
    assert len(list(folder.iterdir())) == 2
    result = geometry_on_disk(FINGER)
    assert isinstance(result.shape, LateShape)
    assert as_text(result) == as_text(geometry)
    assert result.bounds == geometry.bounds
    assert repr(result) == repr(geometry)
    again = mesh_on_disk(FINGER, SETTINGS)
    assert as_text(again) == as_text(mesh)


@pytest.mark.parametrize("name", sorted(ACTUATORS))
def test_every_family_is_found_as_it_was_built(name, made):
    actuator = ACTUATORS[name]()
    geometry = actuator.build()
    save_family(actuator, geometry, SETTINGS, made[1])
    result = geometry_on_disk(actuator)
    assert as_text(result) == as_text(geometry)
    assert size_range(result) == size_range(geometry)
    assert repr(result) == repr(geometry)
    assert isinstance(result.shape, FilmShape) or result.shape._shape is None


def test_the_shape_is_made_when_it_is_asked_for_and_gives_the_same_mesh(made, tmp_path):
    geometry, mesh = made
    save_family(FINGER, geometry, SETTINGS, mesh)
    result = pickle.loads(pickle.dumps(geometry_on_disk(FINGER)))
    assert result.shape._shape is None
    assert as_text(mesh_with(result, SETTINGS)) == as_text(mesh)
    assert result.shape._shape is not None
    write_step(geometry_on_disk(FINGER), tmp_path / "finger.step")
    assert (tmp_path / "finger.step").stat().st_size > 1000


def test_every_field_changes_the_name():
    names = {entry(FINGER), entry(FINGER, SETTINGS)}
    for item in fields(FINGER):
        changed = copy.copy(FINGER)
        object.__setattr__(changed, item.name, "another")  # without the rules, which few values of all fields meet
        names.add(entry(changed))
    other = {"size": 4e-3, "grading": 0.4, "face_sizes": {"cavity": 2e-3}, "wall_cells": 2, "cells": "hexahedra"}
    other |= {"ignore_features_below": 1e-4, "quality": "fine"}
    assert set(other) == {item.name for item in fields(SETTINGS)}
    names |= {entry(FINGER, replace(SETTINGS, **{name: value})) for name, value in other.items()}
    assert len(names) == 2 + len(fields(FINGER)) + len(other)
    assert None not in names


def test_other_sources_and_versions_change_the_name(monkeypatch, tmp_path):
    before = entry(FINGER)
    monkeypatch.setattr(family_cache, "version", lambda library: "another version")
    assert entry(FINGER) != before
    (tmp_path / "room").mkdir()
    (tmp_path / "room" / "one.py").write_text("a = 1")
    monkeypatch.syspath_prepend(tmp_path)
    written = cached_values.sources("room")
    (tmp_path / "room" / "one.py").write_text("a = 12")
    cached_values.sources.cache_clear()
    assert cached_values.sources("room") != written


def test_families_of_others_and_files_are_not_kept(made, folder):
    @dataclass(frozen=True)
    class Mine(FastPneuNet):
        pass

    geometry, mesh = made
    mine = Mine(chambers=2, length=20e-3)
    save_family(mine, geometry, SETTINGS, mesh)
    assert not folder.exists()
    save_family(FINGER, geometry, SETTINGS, mesh)
    assert mesh_on_disk(mine, SETTINGS) is None


def test_a_mesh_that_moves_is_neither_kept_nor_replaced(made, folder):
    geometry, mesh = made
    with meshing_instead(lambda geometry, settings: mesh):
        save_family(FINGER, geometry, SETTINGS, mesh)
        assert not folder.exists()
    save_family(FINGER, geometry, SETTINGS, mesh)
    with meshing_instead(lambda geometry, settings: mesh):
        assert mesh_on_disk(FINGER, SETTINGS) is None


@pytest.mark.parametrize("share", [0.0, 0.5, 0.999])
def test_damaged_entries_are_made_anew(made, folder, share):
    geometry, mesh = made
    save_family(FINGER, geometry, SETTINGS, mesh)
    for file in folder.iterdir():
        file.write_bytes(file.read_bytes()[: int(share * file.stat().st_size)])
    with pytest.warns(UserWarning, match="cache of families"):
        assert geometry_on_disk(FINGER) is None
    with pytest.warns(UserWarning, match="cache of families"):
        assert mesh_on_disk(FINGER, SETTINGS) is None
    save_family(FINGER, geometry, SETTINGS, mesh)
    assert geometry_on_disk(FINGER) is not None
    assert mesh_on_disk(FINGER, SETTINGS) is not None


def test_a_changed_byte_is_noticed(made, folder):
    geometry, mesh = made
    save_family(FINGER, geometry, SETTINGS, mesh)
    file = max(folder.iterdir(), key=lambda each: each.stat().st_size)
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 1
    file.write_bytes(content)
    with pytest.warns(UserWarning, match="cache of families"):
        assert mesh_on_disk(FINGER, SETTINGS) is None


def test_the_oldest_used_go_first(made, folder, monkeypatch):
    geometry, mesh = made
    sizes = [replace(SETTINGS, grading=0.1 * k) for k in range(1, 5)]
    for k, settings in enumerate(sizes[:3]):
        save_family(FINGER, geometry, settings, mesh)
        os.utime(entry(FINGER, settings), (k, k))
    os.utime(entry(FINGER), (9, 9))
    assert mesh_on_disk(FINGER, sizes[0]) is not None  # used now
    one, shape = (entry(*key).stat().st_size for key in ((FINGER, sizes[0]), (FINGER,)))
    monkeypatch.setenv("TURGOR_CACHE_MB", str((2.5 * one + shape) / 1e6))
    monkeypatch.setattr(cached_values, "LARGEST_SHARE", 1.0)
    save_family(FINGER, geometry, sizes[3], mesh)
    assert [mesh_on_disk(FINGER, settings) is not None for settings in sizes] == [True, False, False, True]
    monkeypatch.setattr(cached_values, "LARGEST_SHARE", 0.1)
    save_family(FINGER, geometry, sizes[1], mesh)
    assert mesh_on_disk(FINGER, sizes[1]) is None  # too large


def test_it_can_be_switched_off(made, folder, monkeypatch):
    geometry, mesh = made
    save_family(FINGER, geometry, SETTINGS, mesh)
    monkeypatch.setenv("TURGOR_CACHE_MB", "0")
    assert mesh_on_disk(FINGER, SETTINGS) is None
    assert geometry_on_disk(FINGER) is None
    monkeypatch.setenv("TURGOR_CACHE_MB", "some")
    with refused("TURGOR_CACHE_MB", "'some'", "megabytes"):
        mesh_on_disk(FINGER, SETTINGS)


def test_a_folder_that_cannot_be_written_is_no_error(made, tmp_path, monkeypatch):
    geometry, mesh = made
    (tmp_path / "file").write_text("no folder")
    monkeypatch.setenv("TURGOR_CACHE", str(tmp_path / "file"))
    save_family(FINGER, geometry, SETTINGS, mesh)
    assert mesh_on_disk(FINGER, SETTINGS) is None


JOB = """
[actuator]
type = "fast_pneunet"
chambers = 2
length = "20 mm"
[mesh]
size = "5 mm"
[materials]
body = { law = "neo_hooke", C10 = "0.1 MPa" }
base = { law = "neo_hooke", C10 = "0.1 MPa" }
[loads]
pressure = "1 kPa"
"""


def test_a_job_is_prepared_without_its_shape_and_without_meshing(tmp_path, folder, monkeypatch):
    def refused(*_: object) -> None:
        raise AssertionError("nothing may be built or meshed")

    (tmp_path / "job.toml").write_text(JOB)
    meshes._mesh_of_family.cache_clear()
    job = read_job(tmp_path / "job.toml")
    model, findings = prepare(job)
    assert not list(folder.glob("*"))  # studies prepare jobs, too, and keep nothing
    save_mesh_of(job)
    meshes._mesh_of_family.cache_clear()
    for owner, name in ((meshes, "_new_mesh"), (FastPneuNet, "build")):
        monkeypatch.setattr(owner, name, refused)
    again, result = prepare(read_job(tmp_path / "job.toml"))
    assert result == findings
    assert as_text(again.mesh) == as_text(model.mesh)
    meshes._mesh_of_family.cache_clear()


WRITER = """
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.job.family_cache import mesh_on_disk, save_family
from turgor.core.meshing.generate import mesh_with
from turgor.core.meshing.settings import MeshSettings

finger, settings = FastPneuNet(chambers=2, length=20e-3), MeshSettings(size=5e-3, cells="tetrahedra")
geometry = finger.build()
mesh = mesh_with(geometry, settings)
from turgor.foundation.store.caches import cache_folder
for _ in range(20):
    save_family(finger, geometry, settings, mesh)
    found = mesh_on_disk(finger, settings)
    assert found is None or (found.points == mesh.points).all()
    for file in cache_folder("families").iterdir():
        file.unlink(missing_ok=True)
save_family(finger, geometry, settings, mesh)
"""


def test_two_processes_write_and_remove_at_once(made, folder):
    both = [subprocess.Popen([sys.executable, "-c", WRITER]) for _ in range(2)]
    assert [each.wait() for each in both] == [0, 0]
    result = mesh_on_disk(FINGER, SETTINGS)
    assert result is not None
    assert np.array_equal(result.points, made[1].points)
