"""Processes that compile at the same time share the groups of kernels, and wait for each other's."""

import gc
import io
import threading
from dataclasses import replace

import pytest
from filelock import FileLock

from turgor.core.engine.warmup import compiling
from turgor.core.engine.warmup.compiling import Group, announce_needs, compile_in_background, compile_kernels
from turgor.core.engine.warmup.needs import Needs
from turgor.foundation.startup import background_compiler as background
from turgor.foundation.startup import kernel_folder

TOLD = '{"nodes": 10, "sides": 6}'


@pytest.fixture
def done(tmp_path, monkeypatch):
    """Groups a, b, c and the later one d, which note that they were compiled; no garbage is searched for."""
    noted: list[str] = []

    def group(name):
        def touch():
            assert not gc.isenabled()
            noted.append(name)

        return Group(name, touch, needed_first=name != "d")

    monkeypatch.setattr(compiling, "_groups", lambda needs: [group(name) for name in "abcd"])
    monkeypatch.setattr(compiling, "_pressure", lambda: group("b"))
    monkeypatch.setattr(compiling, "marker", lambda name: tmp_path / f"{name}.compiled")
    monkeypatch.setattr(background, "background_process", lambda: None)
    monkeypatch.setattr("sys.stdin", io.StringIO(TOLD))
    monkeypatch.setattr(compiling.os, "nice", lambda more: noted.append(f"nice {more > 0}"), raising=False)
    return noted


def test_a_group_that_another_process_compiles_comes_last(done, tmp_path):
    lock = FileLock(tmp_path / "a.lock")
    lock.acquire()
    main = threading.Thread(target=compile_kernels, args=(None, Needs()))
    main.start()
    main.join(0.5)
    assert done == ["b", "c"]
    assert main.is_alive()
    lock.release()
    main.join(10)
    assert done[:3] == ["b", "c", "a"]


def test_the_background_compiler_begins_at_the_other_end_and_leaves_what_others_compile(done, tmp_path):
    with FileLock(tmp_path / "a.lock"):
        compile_in_background()
    # b before it is told what is needed, which it only loads again; what no first step needs with a low priority
    assert done == ["b", "c", "b", "nice True", "d"]


def test_the_background_compiler_ends_if_it_reads_no_needs(done, monkeypatch):
    monkeypatch.setattr("sys.stdin", io.StringIO())
    compile_in_background()
    assert done == ["b"]


@pytest.mark.parametrize("at_work", [True, False])
def test_later_groups_are_left_to_the_background_compiler(done, monkeypatch, at_work):
    monkeypatch.setattr(compiling, "still_compiling", lambda: at_work)
    compile_kernels(None, Needs())
    assert ("d" in done) is not at_work
    assert done[:3] == ["a", "b", "c"]


def test_later_groups_that_are_compiled_are_loaded_once_they_are_called(done, tmp_path):
    (tmp_path / "d.compiled").touch()
    compile_kernels(None, Needs())
    assert done == ["a", "b", "c"]


def test_who_has_waited_too_long_compiles_himself(done, tmp_path, monkeypatch):
    monkeypatch.setattr(compiling, "COMPILATION", replace(compiling.COMPILATION, longest=0.05))
    with FileLock(tmp_path / "c.lock"):
        compile_kernels(None, Needs())
    assert done[:3] == ["a", "b", "c"]


def test_without_a_place_for_locks_everything_is_compiled(done, tmp_path, monkeypatch):
    file = tmp_path / "file"
    file.touch()
    monkeypatch.setattr(compiling, "marker", lambda name: file / name)
    compile_kernels(None, Needs())
    assert set(done) == set("abcd")


def test_garbage_is_searched_for_again_afterwards(done):
    compile_kernels(None, Needs())
    assert gc.isenabled()


class Started:
    """A process that was begun, with what it is told."""

    def __init__(self, command, **_):
        self.command, self.stdin, self.told = command, self, []
        self.closed = False

    def write(self, text):
        self.told.append(text)

    def close(self):
        self.closed = True


@pytest.fixture
def started(tmp_path, monkeypatch):
    """Processes that are begun, with two processors and an empty folder for what is compiled."""
    results: list[Started] = []
    monkeypatch.setattr(
        background.subprocess, "Popen", lambda command, **_: results.append(Started(command)) or results[-1]
    )
    monkeypatch.setattr(background, "processors", lambda: 2)
    monkeypatch.setenv(kernel_folder.VARIABLE, str(tmp_path))
    background.background_process.cache_clear()
    yield results
    background.background_process.cache_clear()


def test_another_process_begins_early_and_is_told_once_what_is_needed(started, monkeypatch):
    background.start_early()
    announce_needs(Needs(sides=6))
    announce_needs(Needs(sides=9))
    assert len(started) == 1
    assert ['"sides": 6' in text for text in started[0].told] == [True]
    heard: list[bool] = []
    monkeypatch.setattr(compiling, "compile_in_background", lambda: heard.append(True))
    exec(started[0].command[-1])
    assert heard == [True]


def test_no_other_process_begins_on_a_single_processor(started, monkeypatch):
    monkeypatch.setattr(background, "processors", lambda: 1)
    background.start_early()
    announce_needs(Needs())
    assert started == []


def test_no_other_process_begins_where_everything_is_compiled(started):
    kernel_folder.marker(kernel_folder.FIRST).touch()
    background.start_early()
    assert started == []
    announce_needs(Needs())  # other loops are not
    assert len(started) == 1
    background.background_process.cache_clear()
    for group in compiling._groups(Needs()):
        kernel_folder.marker(group.name).touch()
    announce_needs(Needs())
    assert len(started) == 1


def test_groups_are_those_that_a_model_needs():
    def names(needs):
        return [group.name for group in compiling._groups(needs)]

    ends = ["pattern", "pressure"]
    cells = ["tangent-10-True", "updates-10-True", "residual-10-True", "geometry-10-True"]
    assert names(Needs()) == [*cells, *ends, "gradients-10-True"]
    every = Needs(nodes=27, sides=9, stretches=True, sheets=True)
    first, last = ["tangent-27-True", "updates-27-True"], ["residual-27-True", "geometry-27-True"]
    cells = [*first, "stretches-27-True", "gradients-27-True", *last]
    assert names(every) == [*cells, "pattern", "sheets", "pressure", "search", "press"]


@pytest.mark.parametrize("stretches", [True, False])
def test_deformation_gradients_are_compiled_soon_where_a_law_takes_them(stretches):
    groups = {group.name: group.needed_first for group in compiling._groups(Needs(stretches=stretches))}
    assert groups["gradients-10-True"] is stretches
