"""Processes that compile at the same time share the groups of loops, and wait for each other's."""

import gc
import threading

import pytest
from filelock import FileLock

from turgor.engine.warmup import compiling
from turgor.engine.warmup.compiling import compile_ahead, compile_beside, compile_kernels
from turgor.engine.warmup.needs import Needs

TOLD = '{"nodes": 10, "sides": 6}'


@pytest.fixture
def done(tmp_path, monkeypatch):
    """Groups a, b and c, which note that they were compiled, and whether garbage was collected then."""
    noted: list[str] = []
    names = ("a", "b", "c")

    def group(name):
        def touch():
            assert not gc.isenabled()
            noted.append(name)

        return name, touch

    monkeypatch.setattr(compiling, "_groups", lambda needs: [group(name) for name in names])
    monkeypatch.setattr(compiling, "_lock_file", lambda name: tmp_path / name)
    monkeypatch.setattr(compiling, "touch_first_loop", lambda: False)
    return noted


def test_a_group_that_another_process_compiles_comes_last(done, tmp_path):
    lock = FileLock(tmp_path / "a")
    lock.acquire()
    main = threading.Thread(target=compile_kernels, args=(None, Needs()))
    main.start()
    main.join(0.5)
    assert done == ["b", "c"]
    assert main.is_alive()
    lock.release()
    main.join(10)
    assert done == ["b", "c", "a"]


def test_the_process_beside_begins_at_the_other_end_and_leaves_what_others_compile(done, tmp_path):
    with FileLock(tmp_path / "b"):
        compile_beside(TOLD)
    assert done == ["c", "a"]


def test_who_has_waited_too_long_compiles_himself(done, tmp_path, monkeypatch):
    monkeypatch.setattr(compiling, "LONGEST", 0.05)
    with FileLock(tmp_path / "c"):
        compile_kernels(None, Needs())
    assert done == ["a", "b", "c"]


def test_without_a_place_for_locks_everything_is_compiled(done, tmp_path, monkeypatch):
    file = tmp_path / "file"
    file.touch()
    monkeypatch.setattr(compiling, "_lock_file", lambda name: file / name)
    compile_kernels(None, Needs())
    assert done == ["a", "b", "c"]


def test_garbage_is_collected_again_afterwards(done):
    compile_kernels(None, Needs())
    assert gc.isenabled()


@pytest.mark.parametrize(("first", "processors", "begun"), [(True, 2, 1), (True, 1, 0), (False, 2, 0)])
def test_another_process_begins_where_nothing_is_compiled_and_a_processor_is_free(
    first, processors, begun, monkeypatch
):
    started: list[list[str]] = []
    monkeypatch.setattr(compiling, "touch_first_loop", lambda: first)
    monkeypatch.setattr(compiling, "processors", lambda: processors)
    monkeypatch.setattr(compiling.subprocess, "Popen", lambda command, **_: started.append(command))
    compile_ahead(Needs(sides=6))
    assert len(started) == begun
    if begun:
        heard: list[str] = []
        monkeypatch.setattr(compiling, "compile_beside", heard.append)
        exec(started[0][-1])
        assert '"sides": 6' in heard[0]


def test_groups_are_those_that_a_model_needs():
    def names(needs):
        return [name for name, _ in compiling._groups(needs)]

    assert names(Needs()) == ["cells-10-True", "pressure"]
    every = Needs(nodes=27, sides=9, stretches=True, sheets=True)
    assert names(every) == ["cells-27-True", "stretches-27-True", "pressure", "sheets", "contact"]
