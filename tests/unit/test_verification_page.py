"""The verification page shows what was recorded, and nothing that changes from run to run."""

import numpy as np
import pytest

from verification_page import Row, page, reading, scalars, table_line


def row(**change):
    values = {
        "file": "test_v01.py",
        "line": 3,
        "claim": "claim",
        "source": "exact",
        "expected": 1.0,
        "got": 1.0000001,
        "tolerance": "1 %",
    }
    return Row(**(values | change))


def test_line_shows_every_cell():
    line = table_line(row(expected=[0.0, 2.5], got=np.array([[3e-13, 2.500001]]), claim="|a| = b"))
    assert line == "| \\|a\\| = b | exact | 0, 2.5 | below 1e-12, 2.5 | 1 % |"


@pytest.mark.parametrize(
    ("expected", "got", "text"),
    [
        (0.0, 2e-13, "below 1e-12"),
        (0.0, -2e-3, "below 1e-02"),
        (0.0, 0.0, "0"),
        (0.0, float("nan"), "nan"),
        (1.0, 1.00004, "1"),
        (1.0, 1.0004, "1.0004"),
        ("closed", "open", "open"),
        (True, False, "no"),
    ],
)
def test_reading(expected, got, text):
    assert reading(expected, got) == text


def test_round_off_does_not_change_the_page():
    assert page([row(got=1.23456789)]) == page([row(got=1.23456789 * (1 + 1e-12))])
    assert page([row(got=1.2345)]) != page([row(got=1.2346)])


def test_order_is_by_file_and_line_and_not_by_run():
    rows = [row(file="test_v02.py"), row(line=9, claim="second"), row(line=3, claim="first")]
    text = page(rows)
    assert text == page(rows[::-1])
    assert text.index("first") < text.index("second") < text.index("test_v02.py")


def test_scalars_of_anything():
    assert scalars([1, (2.0, np.arange(2))]) == [1, 2.0, 0, 1]
    assert scalars("text") == ["text"]
