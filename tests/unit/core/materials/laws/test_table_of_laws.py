"""The table of all laws in docs/theory.md: what it says of fits, of `.inp` files and of verification is so."""

import re
from contextlib import suppress
from pathlib import Path

import pytest

import turgor as tg
from turgor.core.inp.materials import material_lines
from turgor.core.materials.fitting.law_specs import law_spec
from turgor.core.materials.laws.laws import LAWS, Woven
from turgor.core.materials.orientation import Orientation
from turgor.foundation.errors import TurgorError

ROOT = Path(__file__).parents[5]
PAGE = (ROOT / "docs" / "theory.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| `(\w+)` \| .* \| (.*?) \| (.*?) \| `(.*?\.py)` \|$", PAGE, re.MULTILINE)
FORMS = {
    "NeoHooke": {"C10": 1e5}, "MooneyRivlin": {"C10": 1e5, "C01": 1e4}, "Yeoh": {"C10": 1e5, "C20": 1e3, "C30": 10.0},
    "CompressibleNeoHooke": {"mu": 1e5, "nu": 0.3},
    "YeohN": {"coefficients": (1e5, 1e3)}, "GeneralizedRivlin": {"coefficients": ((1, 0, 1e5),)},
    "Ogden": {"mu": (1e5,), "alpha": (2.0,)}, "Gent": {"mu": 1e5, "Jm": 50.0},
    "ArrudaBoyce": {"mu": 1e5, "locking_stretch": 3.0}, "BlatzKo": {"mu": 1e5},
    "ExtendedTube": {"Gc": 1e5, "Ge": 1e5, "delta": 0.1, "beta": 0.5},
    "Hyperfoam": {"mu": (1e5,), "alpha": (2.0,), "nu": (0.1,)}, "Orthotropic": {"C10": 1e6, "a1": 1e5},
    "HolzapfelGasserOgden": {"C10": 1e5, "k1": 1e4, "k2": 1.0}, "Hooke": {"E": 1e9, "nu": 0.3},
    "Woven": {"E": 4e8, "nu": 0.2, "E_weft": 2e8, "G": 1e6},
}  # fmt: skip


def test_the_table_has_every_law():
    assert sorted(name for name, *_ in ROWS) == sorted(kind.__name__ for kind in LAWS.values())


@pytest.mark.parametrize(("name", "fitted", "programs", "file"), ROWS, ids=[row[0] for row in ROWS])
def test_a_row_says_what_the_code_does(name, fitted, programs, file):
    kind = next(each for each in LAWS.values() if each.__name__ == name)
    if fitted.strip("`") in ("--directions", "stated"):
        with pytest.raises(TurgorError):
            law_spec(kind.__name__)
    else:
        assert law_spec(fitted.strip("`")).name == fitted.strip("`")
    assert _programs(kind) == programs
    test = (ROOT / "tests" / "verification" / file).read_text(encoding="utf-8")
    assert re.search(rf"\b{name}\b", test), file


def _programs(kind) -> str:
    """Programs that have a form of a law; a woven sheet is refused with its model."""
    if kind is Woven:
        return "none"
    law, known = kind(**FORMS[kind.__name__]), []
    lies = Orientation(along=(1, 0, 0), across=(0, 1, 0)) if hasattr(law, "families") else None
    no_bulk = ("BlatzKo", "CompressibleNeoHooke", "Hyperfoam", "Hooke")
    bulk = {} if kind.__name__ in no_bulk else {"bulk_modulus": 2e6}
    material = tg.Material(name="any", law=law, orientation=lies, **bulk)
    for program in ("Abaqus", "CalculiX"):
        with suppress(TurgorError):
            material_lines("any", material, program.lower())
            known.append(program)
    return ", ".join(known) or "none"
