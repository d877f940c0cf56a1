"""Tables of material tests, written in every way: the same numbers read to the same test.

Two kinds of cases, each from its number alone, so that a failure can be repeated:

- the same numbers written differently (separator, decimal sign, encoding, quotes, units, order of columns, comments,
  empty lines, rows without a number) must read to the same test;
- rows with a cell too many, too few or of another kind may be left out or refused, but no number may change its place.

``TURGOR_FUZZ=5000 pytest tests/fuzz/test_fuzz_tables.py`` runs as many cases of each kind.
"""

import os
import random
from time import perf_counter

import numpy as np
import pytest
from fuzz_tables import STRIP, Written, check_use, keep_the_meaning

from turgor.core.materials.experiments.read_tests import read_tests
from turgor.foundation.errors import TurgorError

CASES = int(os.environ.get("TURGOR_FUZZ", "40"))

#: Seconds that one table may take on a slow machine.
LONGEST = 5.0


def read(folder, data, number, **options):
    """Read a table in bounded time: its tests, or the sentence that refuses it."""
    path = folder / f"fuzz_{number}_uniaxial.csv"
    path.write_bytes(data)
    begin = perf_counter()
    try:
        result = read_tests(path, **({"specimen": STRIP} | options))
    except TurgorError as error:
        result = str(error)
    except Exception as error:
        pytest.fail(f"case {number}: {type(error).__name__}: {error}\n{data!r}")
    path.unlink()
    assert perf_counter() - begin < LONGEST, f"case {number} took {perf_counter() - begin:.1f} s:\n{data!r}"
    if isinstance(result, str):
        assert 20 < len(result) < 8000 and result.endswith((".", '"')), f"case {number}: no sentence: {result}"
    return result


def test_the_same_numbers_in_any_form(tmp_path):
    for number in range(CASES):
        chance = random.Random(f"form {number}")
        table = Written(chance)
        lines, gone = keep_the_meaning(chance, table)
        data = table.bytes(lines)
        result = read(tmp_path, data, number)
        assert not isinstance(result, str), f"case {number}: {result}\n{data!r}"
        (test,) = result
        assert test.stretch == pytest.approx(table.stretch, rel=1e-6, abs=1e-9), f"case {number}: {data!r}"
        scale = np.abs(table.stress).max()
        assert test.nominal_stress == pytest.approx(table.stress, rel=1e-6, abs=1e-6 * scale), f"case {number}"
        assert ("left out" in test.edits[0].text) == (gone > 0), f"case {number}: {test.edits[0].text}\n{data!r}"
        check_use(test, number)


def spoil(chance, row):
    """Give a row a cell too many or too few, or replace one by what is no number."""
    at = chance.randrange(len(row))
    kind = chance.choice(("surplus", "missing", "other"))
    if kind == "surplus":
        row.insert(at, chance.choice(("7", "0.5", "x", *row)))
    elif kind == "missing":
        del row[at]
    else:
        row[at] = chance.choice(("", "nan", "abc", "1e999", "--", "1_0", "12:30", "1 5"))


def test_no_number_changes_its_place(tmp_path):
    """A row that is spoiled is refused or left out, or stays as it was where only an unused column is spoiled."""
    for number in range(CASES):
        chance = random.Random(f"row {number}")
        table = Written(chance)
        for row in chance.sample(table.rows[1:], chance.choice((1, 1, 1, 3))):
            spoil(chance, row)
        data = table.bytes()
        result = read(tmp_path, data, number)
        if isinstance(result, str):
            continue
        (test,) = result
        for x, p in zip(test.stretch, test.nominal_stress, strict=True):
            near = np.isclose(x, table.stretch, rtol=1e-6) & np.isclose(p, table.stress, rtol=1e-6, atol=1e-3)
            assert near.any(), f"case {number}: stretch {x}, stress {p} were not in the table\n{data!r}"
        check_use(test, number)
