"""Loops on several threads: every pass is made once, and results do not depend on the number of threads."""

import sys
import threading
import time
from dataclasses import replace

import numpy as np
import pytest

from refused import refused
from turgor.core.engine.cells import spectral
from turgor.core.engine.compiled import LEAST, in_order, later, over
from turgor.core.engine.runtime import use_threads
from turgor.core.engine.warmup import compiling
from turgor.core.engine.warmup.needs import Needs
from turgor.core.materials.laws.laws import Hooke, NeoHooke, Ogden
from turgor.core.materials.material import Material
from turgor.core.model.model import Model
from turgor.core.model.sheets import Membrane
from turgor.core.model.supports import Fixed


@pytest.mark.parametrize("count", [0, 1, LEAST - 1, 2 * LEAST, 10 * LEAST + 7])
@pytest.mark.parametrize("threads", [1, 2, 5])
def test_every_pass_is_made_once(count, threads):
    made, ran = np.zeros(count, dtype=int), set()

    def loop(begin, end, out):
        out[begin:end] += 1
        ran.add(threading.get_ident())

    with use_threads(threads):
        over(count, loop, made)
    assert (made == 1).all()
    if threads == 1 or count < 2 * LEAST:
        assert ran <= {threading.get_ident()}
    else:
        assert threading.get_ident() not in ran


def test_an_error_in_a_thread_is_not_lost():
    def loop(begin, end):
        raise ValueError("bad range")

    with use_threads(2), refused("bad range", error=ValueError):
        over(10 * LEAST, loop)


def test_results_do_not_depend_on_threads():
    F = np.eye(3) + 0.3 * np.random.default_rng(1).standard_normal((5 * LEAST, 2, 3, 3))
    results = []
    for threads in (1, 2):
        with use_threads(threads):
            results.append(spectral.principal_stretches(F))
    for one, two in zip(*results, strict=True):
        np.testing.assert_array_equal(one, two)


def test_few_models_need_the_loops_of_stretches_and_sheets(results_body):
    paper = Membrane(material=Material(name="paper", law=Hooke(E=1e9, nu=0.2)), thickness=1e-4)

    def model(law, **faces):
        rubber = Material(name="rubber", law=law)
        return Model(results_body, dict.fromkeys(results_body.regions, rubber) | faces, [Fixed("fixed")], [])

    def few(needs):
        return needs.stretches, needs.sheets

    assert few(Needs.of(model(NeoHooke(C10=1e5)))) == (False, False)
    assert few(Needs.of(model(Ogden(mu=(1e5,), alpha=(3.0,))))) == (True, False)
    assert few(Needs.of(model(NeoHooke(C10=1e5), outside=paper))) == (False, True)


@pytest.mark.parametrize(("told", "terminal"), [(True, True), (False, True), (False, False)])
def test_a_compilation_that_takes_long_is_told(told, terminal, monkeypatch, capsys):
    heard: list[str] = []
    monkeypatch.setattr(compiling, "COMPILATION", replace(compiling.COMPILATION, announced_after=0.01))
    monkeypatch.setattr(compiling, "compile_tangent", lambda *_: time.sleep(0.3))
    monkeypatch.setattr(sys.stderr, "isatty", lambda: terminal)
    compiling.compile_kernels(heard.append if told else None, Needs())
    said = "compiling the element kernels (once per machine and kind of cell, up to half a minute)"
    assert heard == ([said] if told else [])
    assert capsys.readouterr().err == (f"turgor: {said}\n" if terminal and not told else "")


@pytest.fixture
def results_body():
    import results_cases

    return results_cases.body()


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_results_of_calls_come_in_their_order(threads):
    begun, alone = [], []

    def half(item):
        begun.append(item)
        if item % 3 == 0:
            time.sleep(0.01)
        over(10 * LEAST, lambda begin, end: alone.append((threading.get_ident(), end - begin)))
        return item, threading.get_ident(), len(begun)

    with use_threads(threads):
        results = list(in_order(half, range(12)))
        assert later(2 * LEAST, half, 12)()[1] != threading.get_ident() or threads == 1
        assert later(2 * LEAST - 1, half, 12)()[1] == threading.get_ident()
    assert [item for item, _, _ in results] == list(range(12))
    here = threading.get_ident()
    assert all((thread == here) == (threads == 1) for _, thread, _ in results)
    # a loop stays on the thread of its call
    assert threads == 1 or [passes for _, passes in alone[:13]] == 13 * [10 * LEAST]


def test_few_results_wait_for_the_first():
    begun = []

    with use_threads(2):
        results = in_order(begun.append, range(20))
        next(results)
        time.sleep(0.05)
        assert len(begun) <= 3
        with refused("bad item", error=ValueError):
            list(in_order(_bad, [1, 2]))


def _bad(item):
    raise ValueError(f"bad item {item}")
