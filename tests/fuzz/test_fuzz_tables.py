"""Tables of material tests, written in every way and damaged: never another exception than `TurgorError`, no hang.

Three kinds of cases, each from its number alone, so that a failure can be repeated:

- the same numbers written differently (separator, decimal sign, encoding, quotes, units, order of columns, comments,
  empty lines, rows without a number) must read to the same test;
- rows with a cell too many, too few or of another kind may be left out or refused, but no number may change its place;
- anything else may happen to the text; what is read then is a test with finite numbers.

``TURGOR_FUZZ=5000 pytest tests/fuzz/test_fuzz_tables.py`` runs as many cases of each kind.
"""

import os
import random
from time import perf_counter

import numpy as np
import pytest

from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.experiments.read_tests import read_tests
from turgor.core.materials.experiments.specimen import Specimen
from turgor.core.materials.experiments.test_edits import remove_tail, thin
from turgor.core.materials.fitting.fit_laws import fit
from turgor.foundation.errors import TurgorError

CASES = int(os.environ.get("TURGOR_FUZZ", "40"))

#: Seconds that one table may take on a slow machine.
LONGEST = 5.0

STRIP = Specimen(length=0.05, width=0.005, thickness=0.003)

#: Ways to state the same columns: name, unit, factor to SI, and what is stored for a stretch or a nominal stress.
STRETCHES = (
    ("stretch", "", lambda x, p: x),
    ("stretch", "-", lambda x, p: x),
    ("Engineering strain", "%", lambda x, p: 100 * (x - 1)),
    ("true strain", "mm/mm", lambda x, p: np.log(x)),
    ("Extension", "mm", lambda x, p: 50 * (x - 1)),
    ("grip length", "cm", lambda x, p: 5 * x),
)
STRESSES = (
    ("nominal stress", "MPa", lambda x, p: p / 1e6),
    ("nominal stress 2", "MPa", lambda x, p: p / 1e6),
    ("Engineering stress", "kPa", lambda x, p: p / 1e3),
    ("cauchy stress", "N/mm²", lambda x, p: p * x / 1e6),
    ("Force", "N", lambda x, p: p * 15e-6),
)
ENCODINGS = ("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "latin-1")
COMMENTS = (
    "",
    "# a strip of rubber\n",
    "# Length = 50mm\n# area: 15 mm²\n",
    "Machine;7;;\nSpeed (mm/min);450\n\n",
    "\n",
)
NO_NUMBER = ("", "nan", "NaN", "n/a", "-", "inf")

#: What a hand, a machine or a transfer may put into a cell.
CELLS = (
    "",
    "nan",
    "1e999",
    "-1",
    "0",
    "abc",
    "1,5",
    "1.5",
    "1e300",
    "--",
    '"',
    "'1'",
    "1_0",
    "٣",
    "0x10",
    "1 5",
    "=A1",
    "∞",
)
#: The same for any place of the file.
PIECES = (
    *CELLS,
    "\n",
    ";",
    ",",
    "\t",
    "\0",
    "\ufeff",
    "#",
    "(",
    "[MPa]",
    "\r",
    "stretch",
    "λ",
    "\x1f" * 3,
    "9" * 400,
    "e" * 3000,
)


def curve(chance):
    points = chance.randint(5, 30)
    stretch = np.linspace(1.0, chance.uniform(1.2, 5.0), points).round(5)
    return stretch, (chance.uniform(2e4, 2e6) * (stretch - stretch**-2)).round(1)


class Written:
    """A table in one of many forms, as cells and as bytes."""

    def __init__(self, chance):
        self.stretch, self.stress = curve(chance)
        self.separator = chance.choice((";", "\t", ",", " "))
        self.comma = chance.random() < 0.4 and (self.separator != "," or chance.random() < 0.5)
        self.quoted = (self.comma and self.separator == ",") or chance.random() < 0.2
        self.encoding, self.end = chance.choice(ENCODINGS), chance.choice(("\n", "\r\n"))
        self.units = chance.choice(("brackets", "square", "line", "bracket line"))
        self.comment = chance.choice(COMMENTS) if self.separator != " " else chance.choice(COMMENTS[:3])
        along, pull = chance.choice(STRETCHES), chance.choice(STRESSES)
        columns = [(*along[:2], along[2](self.stretch, self.stress)), (*pull[:2], pull[2](self.stretch, self.stress))]
        if chance.random() < 0.5:
            columns.append(("temperature", "K", np.full(len(self.stretch), 296.5)))
        chance.shuffle(columns)
        digits = chance.choice(("{:.9g}", "{:.8e}", "{:+.9g}"))
        self.columns = [(name, unit) for name, unit, _ in columns]
        self.rows = [[digits.format(value) for value in row] for row in zip(*(c[2] for c in columns), strict=True)]
        self.decimal_commas()

    def decimal_commas(self):
        if self.comma:
            self.rows = [[cell.replace(".", ",") for cell in row] for row in self.rows]

    def header(self):
        names = [name.replace(" ", "_") if self.separator == " " else name for name, _ in self.columns]
        units = [unit for _, unit in self.columns]
        if self.separator == " ":  # a name and its unit are one word
            return [[f"{name}_{unit}" if unit else name for name, unit in zip(names, units, strict=True)]]
        marks = {"brackets": "({})", "square": "[{}]", "line": "{}", "bracket line": "({})"}[self.units]
        stated = [marks.format(unit) if unit else "" for unit in units]
        if self.units in ("line", "bracket line"):
            return [names, stated]
        return [[f"{name} {unit}".strip() for name, unit in zip(names, stated, strict=True)]]

    def lines(self):
        body = [*self.header(), *self.rows]
        cells = [[f'"{cell}"' if self.quoted else cell for cell in row] for row in body]
        return [self.separator.join(row) for row in cells]

    def bytes(self, lines=None):
        text = self.comment + "\n".join([*(lines or self.lines()), ""])
        return text.replace("\n", self.end).encode(self.encoding)


def keep_the_meaning(chance, table):
    """Lines of a table with additions that mean nothing: empty lines, comments, empty cells, rows without a number."""
    count = len(table.header())
    lines, gone = table.lines(), 0
    separator = table.separator
    for _ in range(chance.randint(0, 4)):
        at = chance.randint(count + 1, len(lines))  # below the first row
        kind = chance.choice(("empty", "comment", "cells", "missing"))
        if kind == "empty":
            lines.insert(at, "")
        elif kind == "comment":
            lines.insert(at, "# a pause")
        elif kind == "cells" and separator != " ":
            lines = [line + 2 * separator for line in lines]
        elif kind == "missing" and separator != " ":
            empty = [chance.choice(NO_NUMBER) for _ in table.columns]
            lines.insert(at, separator.join(empty))
            gone += any(cell for cell in empty)
    return lines, gone


def read(folder, data, number, **options):
    """Read a table in bounded time: its tests, or the sentence that refuses it."""
    path = folder / f"fuzz_{number}_uniaxial.csv"
    path.write_bytes(data)
    begin = perf_counter()
    try:
        found = read_tests(path, **({"specimen": STRIP} | options))
    except TurgorError as error:
        found = str(error)
    except Exception as error:
        pytest.fail(f"case {number}: {type(error).__name__}: {error}\n{data!r}")
    path.unlink()
    assert perf_counter() - begin < LONGEST, f"case {number} took {perf_counter() - begin:.1f} s:\n{data!r}"
    if isinstance(found, str):
        assert 20 < len(found) < 8000 and found.endswith((".", '"')), f"case {number}: no sentence: {found}"
    return found


def check_use(test, number):
    """A test that was read is finite, and what `turgor fit` does with it ends in a fit or a sentence."""
    assert isinstance(test, MaterialTest)
    assert np.isfinite(test.stretch).all() and np.isfinite(test.nominal_stress).all()
    assert len(test.stretch) >= 2 and (test.mode == "simple_shear" or (test.stretch > 0).all())
    if number % 4 == 0:
        try:
            fit("neo-hooke", test if test.mode == "biaxial" else thin(remove_tail(test)))
        except TurgorError:
            pass
        except Exception as error:
            pytest.fail(f"case {number}: {type(error).__name__} after reading: {error}")


def test_the_same_numbers_in_any_form(tmp_path):
    for number in range(CASES):
        chance = random.Random(f"form {number}")
        table = Written(chance)
        lines, gone = keep_the_meaning(chance, table)
        data = table.bytes(lines)
        found = read(tmp_path, data, number)
        assert not isinstance(found, str), f"case {number}: {found}\n{data!r}"
        (test,) = found
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
        found = read(tmp_path, data, number)
        if isinstance(found, str):
            continue
        (test,) = found
        for x, p in zip(test.stretch, test.nominal_stress, strict=True):
            near = np.isclose(x, table.stretch, rtol=1e-6) & np.isclose(p, table.stress, rtol=1e-6, atol=1e-3)
            assert near.any(), f"case {number}: stretch {x}, stress {p} were not in the table\n{data!r}"
        check_use(test, number)


def damage(chance, table):
    """Bytes of a table to which anything may have happened."""
    text = table.bytes().decode(table.encoding)
    for _ in range(chance.randint(1, 4)):
        lines = text.split("\n")
        at, line = chance.randrange(len(text) + 1), chance.randrange(len(lines))
        kind = chance.choice(("piece", "cut", "swap", "double", "separator", "cell", "header", "drop"))
        if kind == "piece":
            text = text[:at] + chance.choice(PIECES) + text[at:]
        elif kind == "cut":
            text = text[:at] + text[at + chance.choice((1, 3, 50, 10_000)) :]
        elif kind == "swap":
            other = chance.randrange(len(lines))
            lines[line], lines[other] = lines[other], lines[line]
            text = "\n".join(lines)
        elif kind == "double":
            text = "\n".join([*lines[:line], *lines[line:][: chance.randint(1, 9)], *lines[line:]])
        elif kind == "separator":
            text = text.replace(
                chance.choice((";", ",", "\t", " ", ".")), chance.choice((";", ",", "\t", " ", ".", ""))
            )
        elif kind == "cell":
            cells = lines[line].split(table.separator)
            cells[chance.randrange(len(cells))] = chance.choice(CELLS)
            lines[line] = table.separator.join(cells)
            text = "\n".join(lines)
        elif kind == "header":
            text = chance.choice(("", "a;b;c\n", "stretch,stretch,stretch\n", "\n" * 50, '"\n', "1,2,3\n")) + text
        else:
            del lines[line]
            text = "\n".join(lines)
    data = bytearray(text.encode(table.encoding, errors="replace"))
    for _ in range(chance.choice((0, 0, 1, 20))):
        if data:
            data[chance.randrange(len(data))] = chance.randrange(256)
    return bytes(data)


def test_damaged_tables_are_read_or_refused_with_a_sentence(tmp_path):
    for number in range(CASES):
        chance = random.Random(f"damage {number}")
        data = damage(chance, Written(chance))
        options = {
            "mode": chance.choice(("uniaxial", "planar", "equibiaxial", "simple_shear", "biaxial", None)),
            "stress_measure": chance.choice((None, "nominal", "cauchy")),
            "specimen": chance.choice((None, STRIP)),
            "columns": chance.choice((None, None, None, ("stretch", "nominal stress (Pa)"), {"stretch": "stretch"})),
            "cyclic": chance.random() < 0.5,
        }
        found = read(tmp_path, data, number, **options)
        if not isinstance(found, str):
            for test in found:
                check_use(test, number)
