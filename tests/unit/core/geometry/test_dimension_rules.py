"""Dimensions that cannot be are refused with the field, the value in mm and what is allowed."""

from contextlib import nullcontext

import pytest

from refused import refused
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.geometry import Geometry, check_volume
from turgor.core.geometry.rules import as_length, check_count, check_length
from turgor.foundation.errors import TurgorError
from turgor.units import mm


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"gap": -1 * mm}, ("gap", "-1 mm", "0.01 mm to 10.967 mm", 11, "110 mm")),
        ({"gap": 0}, ("gap", "0 mm", "0.01 mm to 10.967 mm", 11, "110 mm")),
        ({"wall": 12 * mm}, ("wall", "12 mm", "0.01 mm to 4.54 mm", "9.091 mm")),
        ({"side_wall": 12 * mm}, ("side_wall", "12 mm", "0.01 mm to 9.995 mm", "20 mm")),
        ({"top_wall": 12 * mm}, ("top_wall", "12 mm", "0.01 mm to 11.99 mm", "15 mm")),
        ({"end_wall": 8.5 * mm}, ("end_wall", "8.5 mm", "0.01 mm to 8.08 mm", "9.091 mm")),
        ({"base": 16 * mm}, ("base", "16 mm", "0.01 mm to 14.97 mm", "15 mm")),
        ({"floor": 14 * mm}, ("floor", "14 mm", "0.01 mm to 13.48 mm", "15 mm")),
        ({"channel_width": 16 * mm}, ("channel_width", "16 mm", "0.01 mm to 15.99 mm")),
        ({"channel_height": 10 * mm}, ("channel_height", "10 mm", "0.01 mm to 9.99 mm")),
        ({"channel_wall": 9 * mm}, ("channel_wall", "9 mm", "0.01 mm to 8.495 mm", "20 mm")),
        ({"channel_wall": 6 * mm, "channel_height": 7 * mm}, ("channel_wall", "6 mm", "0.01 mm to 4.99 mm")),
        ({"chambers": 0}, ("chambers", 0, "1 to 100")),
        ({"chambers": 2.5}, ("chambers", 2.5, "1 to 100")),
        ({"chambers": True}, ("chambers", "True", "1 to 100")),
        ({"chambers": 60}, ("wall", "1 mm", "0.01 mm to 0.42 mm", "0.85 mm")),
        ({"length": 110}, ("length", "110000 mm", "1 mm to 2000 mm", "unit")),
        ({"width": 0.1 * mm}, ("width", "0.1 mm", "1 mm to 2000 mm")),
        ({"wall": 1}, ("wall", "1000 mm", "0.01 mm to 4.54 mm", "unit")),
        ({"wall": "1.5 mm"}, ("wall", "'1.5 mm'", "meters")),
        ({"height": float("nan")}, ("height", "nan", "meters")),
        ({"symmetric": "no"}, ("symmetric", "'no'", "True or False")),
        ({"chambers": 1, "channel_wall": -1 * mm}, ("channel_wall", "-1 mm", "0.01 mm to 2000 mm")),
    ],
)
def test_an_impossible_dimension_is_refused_before_anything_is_built(wrong: dict, facts: tuple) -> None:
    with refused(*facts):
        FastPneuNet(**wrong)


LIMITS = {"gap": 0.01, "wall": 4.54, "channel_wall": 8.495}  # mm


def test_the_limit_that_an_error_names_is_itself_allowed() -> None:
    volumes = [FastPneuNet(**{name: limit * mm}).cavity_volume / mm**3 for name, limit in LIMITS.items()]
    cavities = [  # chambers of 16 x 10 mm and channels of 3 x 2 mm, half of each
        (110 - 4 - 0.1 - 20) * 80 + 20.1 * 3,
        (110 - 4 - 10 - 90.8) * 80 + 100.8 * 3,
        (110 - 4 - 10 - 20) * 80 + 30 * 3,
    ]
    assert volumes == pytest.approx(cavities)
    with pytest.raises(TurgorError):
        FastPneuNet(wall=4.5405 * mm)


def test_a_whole_number_is_a_length_too_and_both_limits_of_a_count_are_allowed() -> None:
    check_length("length", 1, high=2.0)
    assert as_length("length", 1) == 1.0
    for count, allowed in ((0, False), (1, True), (3, True), (4, False)):
        with nullcontext() if allowed else refused("chambers", count, "1 to 3"):
            check_count("chambers", count, low=1, high=3)


def test_a_cad_volume_that_differs_from_the_dimensions_is_refused() -> None:
    check_volume("solid", 1.0e-6 * (1 + 1e-10), 1.0e-6)
    for wrong in (1.0e-6 * (1 + 1e-8), float("nan")):
        with refused("solid", "1000 mm³"):
            check_volume("solid", wrong, 1.0e-6)


def test_a_geometry_has_no_shape_in_its_text() -> None:
    assert "shape" not in repr(FastPneuNet(chambers=1, length=20 * mm).build())
    assert "shape" in Geometry.__slots__
