"""Derived formulas are cached as data, by what they were derived from; nothing from disk is executed."""

import json
import warnings

import numpy as np
import pytest
import sympy

from refused import refused
from turgor.core.materials.laws import derived_formulas as module
from turgor.core.materials.laws.derived_formulas import Formulas, cached_formulas, formulas_of
from turgor.core.materials.laws.laws import Gent, Yeoh


@pytest.fixture
def derived(tmp_path, monkeypatch):
    """A function of a symbol that is derived, with a note of each time, and a cache folder of its own."""
    monkeypatch.setenv("TURGOR_CACHE", str(tmp_path))
    times: list[int] = []

    def derive():
        times.append(1)
        x, c = sympy.symbols("x c")
        return sympy.lambdify([x, c], [c * sympy.log(x), sympy.diff(c * sympy.log(x), x)], modules="numpy")

    return times, derive


def test_the_second_process_reads_what_the_first_derived(derived):
    times, derive = derived
    first, second = (cached_formulas(Yeoh, "a", derive) for _ in range(2))
    assert len(times) == 1
    at = np.linspace(0.5, 2, 5)
    np.testing.assert_array_equal(first(at, 3.0), second(at, 3.0))
    np.testing.assert_allclose(second(at, 3.0), [3 * np.log(at), 3 / at])


def test_formulas_are_those_of_sympy_to_the_last_bit():
    x, y, c = sympy.symbols("x y c")
    wanted = [(x - 3) ** 2 * c - y / (x + 2), sympy.log(x) * sympy.sqrt(y) * sympy.exp(-x), -c, sympy.Integer(0), x]
    function = sympy.lambdify([x, y, c], wanted, modules="numpy", cse=True)
    at = np.random.default_rng(0).uniform(1, 2, (2, 50))
    for got, expected in zip(formulas_of(function)(*at, 0.3), function(*at, 0.3), strict=True):
        np.testing.assert_array_equal(got, expected)


def test_another_question_law_or_text_of_a_law_is_derived(derived, monkeypatch):
    times, derive = derived
    for law, requested in ((Yeoh, "a"), (Yeoh, "b"), (Gent, "a")):
        cached_formulas(law, requested, derive)
    monkeypatch.setattr(module, "sources", lambda package: "other files")
    cached_formulas(Yeoh, "a", derive)
    assert len(times) == 4


@pytest.mark.parametrize(
    "text",
    [
        b"", b"import os", b"[", b"\xff\xfe\x00", b"[" * 5000, b"3", b"[2, [], [], [5]]", b'[1, ["a"], [], [0]]',
        b'[1, [], [["os.system", 0]], [1]]', b'[1, [], [["Add", 0, 9]], [1]]', b"[1e30, [], [], [0]]",
    ],
)  # fmt: skip
def test_a_damaged_file_is_derived_again_and_mended(derived, tmp_path, text):
    times, derive = derived
    cached_formulas(Yeoh, "a", derive)
    (file,) = (tmp_path / "laws").iterdir()
    file.write_bytes(text)
    with pytest.warns(UserWarning, match="cache of laws"):
        assert cached_formulas(Yeoh, "a", derive)(1.0, 2.0) == [0.0, 2.0]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        cached_formulas(Yeoh, "a", derive)
    assert len(times) == 2


def test_nothing_from_disk_is_executed(derived, tmp_path):
    """An entry of the cache into which others have written code."""
    times, derive = derived
    key = module.sources(module.__package__), f"{Yeoh.__module__}.{Yeoh.__qualname__}", "'a'"
    mark = tmp_path / "executed"
    for code in (f"open({str(mark)!r}, 'w')", json.dumps([1, [], [[f"open({str(mark)!r}, 'w')", 0]], [1]])):
        module.FORMULAS.put(code, *key)
        assert module.FORMULAS.get(*key) == code
        cached_formulas(Yeoh, "a", derive)
        assert not mark.exists()
    assert len(times) == 2
    cached_formulas(Yeoh, "a", derive)
    assert len(times) == 2


def test_a_folder_that_cannot_be_written_costs_only_time(derived, tmp_path):
    times, derive = derived
    (tmp_path / "laws").touch()
    assert cached_formulas(Yeoh, "a", derive)(1.0, 2.0) == [0.0, 2.0]
    cached_formulas(Yeoh, "a", derive)
    assert len(times) == 2


def test_laws_of_others_are_derived_every_time(derived):
    times, derive = derived
    own = type("Own", (), {"__module__": "somewhere.laws"})
    cached_formulas(own, "a", derive)
    cached_formulas(own, "a", derive)
    assert len(times) == 2


def test_formulas_check_themselves():
    with refused("operation 'open'", "1 operands"):
        Formulas(1, (), (("open", 0),), (1,))
