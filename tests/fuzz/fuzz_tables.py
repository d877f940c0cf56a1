"""Tables of material tests in any form, and damaged ones; tables of responses, experiments and marker tracks."""

import random
from pathlib import Path

import numpy as np
from mutants import changed_bytes, changed_text
from trials import Case

from turgor.accuracy.laboratory.markers import read_tracks
from turgor.accuracy.laboratory.read_experiment import read_experiment
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.experiments.read_tests import read_tests
from turgor.core.materials.experiments.specimen import Specimen
from turgor.core.materials.experiments.test_edits import remove_tail, thin
from turgor.core.materials.fitting.fit_laws import fit
from turgor.core.results.files.response_csv import read_response

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


def check_use(test, number):
    """A test that was read is finite, and what `turgor fit` does with it ends in a fit or a sentence."""
    assert isinstance(test, MaterialTest)
    assert np.isfinite(test.stretch).all() and np.isfinite(test.nominal_stress).all()
    assert len(test.stretch) >= 2 and (test.mode == "simple_shear" or (test.stretch > 0).all())
    if number % 4 == 0:
        fit("neo-hooke", test if test.mode == "biaxial" else thin(remove_tail(test)))


RESPONSE = "pressure_kPa,tip_displacement_x_mm,load_factor\n0,0,0\n5,1.25,0.5\n10,2.5e0,1\n"
EXPERIMENT = "Pressure (psi);Bending Angle (°);note\n0;0;a\n1,5;12,5;b\n3;31;c\n"
TRACKS = "time (s),tip_x (mm),tip_y (mm),base_x (mm),base_y (mm)\n0,100,0,0,0\n0.1,99,4,0,0\n0.2,98,8,0,0\n"


def damaged_test(chance: random.Random, folder: Path) -> Path:
    (folder / "fuzz_uniaxial.csv").write_bytes(damage(chance, Written(chance)))
    return folder / "fuzz_uniaxial.csv"


def use_test(file: Path) -> None:
    size = len(file.read_bytes())  # stands for a number, so that the file alone decides
    chance = random.Random(size)
    options = {
        "mode": chance.choice(("uniaxial", "planar", "equibiaxial", "simple_shear", "biaxial", None)),
        "stress_measure": chance.choice((None, "nominal", "cauchy")),
        "specimen": chance.choice((None, STRIP)),
        "columns": chance.choice((None, None, None, ("stretch", "nominal stress (Pa)"), {"stretch": "stretch"})),
        "cyclic": chance.random() < 0.5,
    }
    for test in read_tests(file, **options):
        check_use(test, size)


def damaged_response(chance: random.Random, folder: Path) -> Path:
    """A table of a response, an experiment or marker tracks."""
    name, text = chance.choice((("response", RESPONSE), ("experiment", EXPERIMENT), ("tracks", TRACKS)))
    if chance.random() < 0.5:
        for _ in range(chance.choice((1, 2, 4))):
            at = chance.randrange(len(text) + 1)
            text = text[:at] + chance.choice(PIECES) + text[at + chance.choice((0, 1, 4)) :]
    elif chance.random() < 0.5:
        text = changed_text(text, chance)
    content = text.encode(chance.choice(ENCODINGS), "replace")
    (folder / f"{name}.csv").write_bytes(content if chance.random() < 0.7 else changed_bytes(content, chance))
    return folder / f"{name}.csv"


def use_response(file: Path) -> None:
    read = {"response": read_response, "experiment": read_experiment, "tracks": read_tracks}[file.stem]
    repr(read(file))


CASES = (
    Case(name="material tests (CSV)", share=500, damage=damaged_test, read=use_test),
    Case(name="responses, experiments, tracks (CSV)", share=500, damage=damaged_response, read=use_response),
)
