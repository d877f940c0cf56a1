"""Quantities with units: what is read, what is refused and how, and that written values read back exactly."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from refused import refused
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
    ("text", "dimension", "facts"),
    [
        ("60 kP", "pressure", ["'kP'", "'60 kP'", "'kPa'", "Pa, kPa, MPa, GPa, bar, mbar, hPa"]),
        ("60 kpa", "pressure", ["'kpa'", "'60 kpa'", "'kPa'"]),
        ("60 MM", "length", ["'MM'", "'60 MM'", "'mm'"]),
        ("2 m m", "length", ["'m m'", "'2 m m'", "'mm'", "m, cm, mm"]),
        ("5 xyz", "length", ["'xyz'", "'5 xyz'", "m, cm, mm"]),
        ("1.5", "length", ["'1.5'", "'1.5 mm'", "m, cm, mm"]),
        (1.5, "length", ["1.5", "'1.5 mm'", "m, cm, mm"]),
        (3, "pressure", ["3", "'60 kPa'"]),
        ("30 mm", "pressure", ["'30 mm'", "a length", "a pressure", "Pa, kPa"]),
        ("30 mL/min", "volume", ["'30 mL/min'", "a flow rate", "a volume"]),
        ("30 kPa", "angle", ["'30 kPa'", "a pressure", "an angle"]),
        ("30 deg", "length", ["'30 deg'", "an angle", "a length"]),
        ("fast", "angle", ["'fast'", "an angle", "'90 deg'"]),
        ("nan kPa", "pressure", ["'nan kPa'", "a pressure"]),
        ("inf mm", "length", ["'inf mm'", "a length"]),
        ("1e999 mm", "length", ["'1e999 mm'", "large", "finite length"]),
        ("1,5 mm", "length", ["'1,5 mm'", "comma", "'1.5 mm'"]),
        ("", "length", ["''", "a length", "'1.5 mm'"]),
        ("mm", "length", ["'mm'", "a length"]),
        (True, "length", ["true", "a length"]),
        (["1 mm"], "length", ["['1 mm']", "a length"]),
        (None, "length", ["None", "a length"]),
    ],
)
def test_refuses(text: object, dimension: str, facts: list[str]) -> None:
    with refused(*facts):
        parse_quantity(text, dimension)


def test_a_float_that_is_not_finite_is_refused() -> None:
    with refused("nan", "'1.5 mm'", "m, cm, mm"):
        parse_quantity(float("nan"), "length")


@pytest.mark.parametrize("dimension", UNITS)
def test_the_first_unit_is_that_of_the_si(dimension: str) -> None:
    """`format_quantity` writes it where no number in another unit reads back exactly."""
    unit = next(iter(UNITS[dimension]))
    assert parse_quantity(f"3 {unit}", dimension) == 3.0


def test_a_compliance_that_micrometers_cannot_write_is_in_meters_per_newton() -> None:
    value = 111625608015.10864
    assert parse_quantity(format_quantity(value, "µm/N"), "compliance") == value


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
