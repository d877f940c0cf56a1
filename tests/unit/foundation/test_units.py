"""Quantities with units: what is read, what is refused and how, and that written values read back exactly."""

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from turgor.foundation.errors import TurgorError
from turgor.units import UNITS, format_quantity, kPa, mm, parse_quantity

FINITE = st.floats(min_value=-1e12, max_value=1e12, allow_nan=False)
WRITTEN = [(dimension, unit) for dimension, units in UNITS.items() for unit in units]


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("60 kPa", "pressure", 60e3),
        ("60kPa", "pressure", 60e3),
        ("  -1.5 mm ", "length", -1.5e-3),
        ("\N{MINUS SIGN}1.5 mm", "length", -1.5e-3),
        ("1e-3 m", "length", 1e-3),
        (".5 in", "length", 0.5 * 25.4e-3),
        ("2. bar", "pressure", 2e5),
        ("100 \N{MICRO SIGN}m", "length", 100e-6),
        ("100 \N{GREEK SMALL LETTER MU}m", "length", 100e-6),
        ("100\N{NO-BREAK SPACE}um", "length", 100e-6),
        ("180 deg", "angle", 3.141592653589793),
        ("1.13 g/cm3", "density", 1130.0),
        ("1130 kg/m³", "density", 1130.0),
        ("10 psi", "pressure", 68947.57293168361),
        ("120 mbar", "pressure", 12e3),
        ("120 hPa", "pressure", 12e3),
        ("10 cmH2O", "pressure", 980.665),
        ("10 mmH2O", "pressure", 98.0665),
        ("1 inHg", "pressure", 3386.388640341),
        ("2 N/mm2", "pressure", 2e6),
        ("5 cc", "volume", 5e-6),
        ("1 lbf", "force", 4.4482216152605),
        ("60 mL/min", "flow rate", 1e-6),
        ("50 N/m", "spring stiffness", 50),
        ("0.05 N/mm", "spring stiffness", 50),
        ("10 MPa/mm", "contact stiffness", 1e10),
    ],
)
def test_reads(text: str, dimension: str, value: float) -> None:
    assert parse_quantity(text, dimension) == pytest.approx(value, rel=1e-15)


def test_reads_what_the_constants_give() -> None:
    """A job file and a script that state the same number get the same float."""
    assert parse_quantity("1.5 mm", "length") == 1.5 * mm
    assert parse_quantity("62.1 kPa", "pressure") == 62.1 * kPa


@pytest.mark.parametrize(
    ("text", "dimension", "sentence"),
    [
        (
            "60 kP",
            "pressure",
            "unknown unit 'kP' in '60 kP'; did you mean 'kPa'? Known pressure units: Pa, kPa, MPa, GPa, bar, mbar, hPa",
        ),
        ("60 kpa", "pressure", "unknown unit 'kpa' in '60 kpa'; did you mean 'kPa'?"),
        ("60 MM", "length", "unknown unit 'MM' in '60 MM'; did you mean 'mm'?"),
        ("2 m m", "length", "unknown unit 'm m' in '2 m m'; did you mean 'mm'? Known length units: m, cm, mm"),
        ("5 xyz", "length", "unknown unit 'xyz' in '5 xyz'. Known length units"),
        ("1.5", "length", "'1.5' needs a unit, for example '1.5 mm'. Known length units"),
        (1.5, "length", "1.5 needs a unit, for example '1.5 mm'. Known length units"),
        (3, "pressure", "3 needs a unit, for example '60 kPa'"),
        ("30 mm", "pressure", "'30 mm' is a length, but a pressure is needed. Known pressure units"),
        ("30 mL/min", "volume", "'30 mL/min' is a flow rate, but a volume is needed."),
        ("30 kPa", "angle", "'30 kPa' is a pressure, but an angle is needed."),
        ("30 deg", "length", "'30 deg' is an angle, but a length is needed."),
        ("nan kPa", "pressure", "'nan kPa' is not a pressure"),
        ("inf mm", "length", "'inf mm' is not a length"),
        ("1e999 mm", "length", "'1e999 mm' is too large; a finite length is needed."),
        ("1,5 mm", "length", "'1,5 mm' has a decimal comma; write a point, for example '1.5 mm'."),
        ("", "length", "'' is not a length; write a number with its unit, for example '1.5 mm'."),
        ("mm", "length", "'mm' is not a length"),
        (True, "length", "true is not a length"),
        (["1 mm"], "length", "['1 mm'] is not a length"),
        (None, "length", "None is not a length"),
    ],
)
def test_refuses(text: object, dimension: str, sentence: str) -> None:
    with pytest.raises(TurgorError, match=f"^{re.escape(sentence)}"):
        parse_quantity(text, dimension)


def test_a_float_that_is_not_finite_is_refused() -> None:
    with pytest.raises(TurgorError, match="needs a unit"):
        parse_quantity(float("nan"), "length")


@given(value=FINITE, written=st.sampled_from(WRITTEN))
def test_written_values_read_back_exactly(value: float, written: tuple[str, str]) -> None:
    dimension, unit = written
    assert parse_quantity(format_quantity(value, unit), dimension) == value


@given(number=st.decimals(min_value=-1000, max_value=1000, places=3), written=st.sampled_from(WRITTEN))
def test_short_decimals_come_back_as_written(number: object, written: tuple[str, str]) -> None:
    """A lock file repeats ``"1.5 mm"`` as the user wrote it, not as a long row of digits."""
    dimension, unit = written
    text = format_quantity(parse_quantity(f"{number} {unit}", dimension), unit)
    assert text.endswith(f" {unit}")
    assert len(text.split()[0]) <= len(f"{float(str(number)):.3e}")


@given(text=st.text(max_size=20), dimension=st.sampled_from(list(UNITS)))
def test_any_text_is_read_or_refused_with_a_sentence(text: str, dimension: str) -> None:
    try:
        answer: float | str = parse_quantity(text, dimension)
    except TurgorError as error:
        answer = str(error)
    assert isinstance(answer, float) or answer.endswith((".", "?"))
