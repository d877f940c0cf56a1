"""Results of checks of a mesh: computed once in a process, saved with the mesh, and found by the next one."""

import ast
from pathlib import Path

import pytest

import turgor
from refused import refused
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.meshing.generate import mesh_with
from turgor.core.meshing.quality import checks, overlaps
from turgor.core.meshing.quality import self_contact as meeting
from turgor.core.meshing.quality.checks import check_mesh
from turgor.core.meshing.quality.overlaps import overlap_at_rest
from turgor.core.meshing.quality.quality_cache import check_results
from turgor.core.meshing.quality.self_contact import may_meet
from turgor.core.meshing.settings import MeshSettings
from turgor.job import family_cache
from turgor.job.family_cache import mesh_on_disk, save_family

FINGER = FastPneuNet(chambers=2, length=20e-3)
SETTINGS = MeshSettings(size=5e-3, cells="tetrahedra")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder of caches."""
    monkeypatch.setenv("TURGOR_CACHE", str(tmp_path))
    monkeypatch.setenv("TURGOR_CACHE_MB", "100")
    return tmp_path / "families"


@pytest.fixture
def made():
    """Geometry and mesh, of which nobody has asked anything."""
    geometry = FINGER.build()
    return geometry, mesh_with(geometry, SETTINGS)


def forbid(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let every question fail that is really asked."""

    def asked(*_):
        raise AssertionError("asked again")

    monkeypatch.setattr(checks, "check_surface", asked)
    monkeypatch.setattr(meeting, "find_bodies", asked)
    monkeypatch.setattr(overlaps, "find_overlaps", asked)


def test_a_question_is_once_per_mesh_in_a_process(made, monkeypatch):
    mesh = made[1]
    first = check_mesh(mesh), may_meet(mesh), overlap_at_rest(mesh)
    forbid(monkeypatch)
    assert (check_mesh(mesh), may_meet(mesh), overlap_at_rest(mesh)) == first
    with refused("asked again", error=AssertionError):
        check_mesh(mesh_with(made[0], SETTINGS))


def test_answers_are_found_with_the_mesh(made, monkeypatch):
    geometry, mesh = made
    first = check_mesh(mesh), may_meet(mesh), overlap_at_rest(mesh)
    assert "G01" in [each.code for each in first[0]]
    assert first[1:] == (True, None)
    save_family(FINGER, geometry, SETTINGS, mesh)
    forbid(monkeypatch)
    result = mesh_on_disk(FINGER, SETTINGS)
    assert check_results(result).by_check == check_results(mesh).by_check
    assert (check_mesh(result), may_meet(result), overlap_at_rest(result)) == first


def test_a_job_that_asks_for_more_adds_it(made, monkeypatch):
    geometry, mesh = made
    may_meet(mesh)
    save_family(FINGER, geometry, SETTINGS, mesh)
    second = mesh_on_disk(FINGER, SETTINGS)
    first = check_mesh(second)
    save_family(FINGER, geometry, SETTINGS, second)
    forbid(monkeypatch)
    third = mesh_on_disk(FINGER, SETTINGS)
    assert (may_meet(third), check_mesh(third)) == (True, first)
    with refused("asked again", error=AssertionError):
        overlap_at_rest(third)


def test_an_entry_that_holds_as_much_is_not_written_again(made, folder):
    geometry, mesh = made
    may_meet(mesh)
    save_family(FINGER, geometry, SETTINGS, mesh)
    result = mesh_on_disk(FINGER, SETTINGS)
    before = {file.name: file.stat().st_mtime_ns for file in folder.iterdir()}
    assert len(before) == 3
    save_family(FINGER, geometry, SETTINGS, result)
    assert {file.name: file.stat().st_mtime_ns for file in folder.iterdir()} == before


def test_a_damaged_entry_is_asked_anew(made, folder):
    geometry, mesh = made
    first = check_mesh(mesh)
    save_family(FINGER, geometry, SETTINGS, mesh)
    entries, key = family_cache._entries(FINGER), family_cache._key(FINGER, SETTINGS)
    entries.file(*key, family_cache.CHECKS).write_bytes(b"no archive")
    with pytest.warns(UserWarning, match="cache of families"):
        result = mesh_on_disk(FINGER, SETTINGS)
    assert check_results(result).by_check == {}
    assert check_mesh(result) == first
    save_family(FINGER, geometry, SETTINGS, result)
    assert len(check_results(mesh_on_disk(FINGER, SETTINGS)).by_check) == 1


def test_questions_lie_where_their_sources_are_in_the_names_of_entries():
    """An entry is true as long as `core.geometry` and `core.meshing` stay the same, so nothing else may answer."""
    root = Path(turgor.__file__).parent
    asking = {
        file.relative_to(root).parts[:2]
        for file in root.rglob("*.py")
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(node, ast.FunctionDef) and "once_per_mesh" in [ast.unparse(each) for each in node.decorator_list]
    }
    assert asking == {("core", "meshing")}
