"""Derived code is kept on disk, by what it was derived from, and derived anew where it cannot be read."""

import numpy as np
import pytest
import sympy

from turgor.materials.laws import kept_code as module
from turgor.materials.laws.kept_code import kept_code
from turgor.materials.laws.laws import Gent, Yeoh


@pytest.fixture
def derived(tmp_path, monkeypatch):
    """A function of a symbol that is derived, with a note of each time, and a cache folder of its own."""
    monkeypatch.setattr(module, "user_cache_path", lambda name: tmp_path / name)
    times: list[int] = []

    def derive():
        times.append(1)
        x, c = sympy.symbols("x c")
        return sympy.lambdify([x, c], [c * sympy.log(x), sympy.diff(c * sympy.log(x), x)], modules="numpy")

    return times, derive


def test_the_second_process_reads_what_the_first_derived(derived):
    times, derive = derived
    first, second = (kept_code(Yeoh, "a", derive) for _ in range(2))
    assert len(times) == 1
    at = np.linspace(0.5, 2, 5)
    np.testing.assert_array_equal(first(at, 3.0), second(at, 3.0))
    np.testing.assert_allclose(second(at, 3.0), [3 * np.log(at), 3 / at])


def test_another_question_law_or_text_of_a_law_is_derived(derived, monkeypatch):
    times, derive = derived
    for law, asked in ((Yeoh, "a"), (Yeoh, "b"), (Gent, "a")):
        kept_code(law, asked, derive)
    monkeypatch.setattr(module, "_laws", lambda: "other files")
    kept_code(Yeoh, "a", derive)
    assert len(times) == 4


@pytest.mark.parametrize("text", [b"", b"def other(): pass", b"def (", b"\xff\xfe\x00"])
def test_a_damaged_file_is_derived_anew_and_mended(derived, tmp_path, text):
    times, derive = derived
    kept_code(Yeoh, "a", derive)
    (file,) = (tmp_path / "turgor" / "laws").iterdir()
    file.write_bytes(text)
    assert kept_code(Yeoh, "a", derive)(1.0, 2.0) == [0.0, 2.0]
    kept_code(Yeoh, "a", derive)
    assert len(times) == 2


def test_a_folder_that_cannot_be_written_costs_only_time(derived, tmp_path):
    times, derive = derived
    (tmp_path / "turgor").touch()
    assert kept_code(Yeoh, "a", derive)(1.0, 2.0) == [0.0, 2.0]
    kept_code(Yeoh, "a", derive)
    assert len(times) == 2


def test_laws_of_others_are_derived_every_time(derived):
    times, derive = derived
    own = type("Own", (), {"__module__": "somewhere.laws"})
    kept_code(own, "a", derive)
    kept_code(own, "a", derive)
    assert len(times) == 2
