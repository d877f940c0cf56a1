"""The CAD shape of a slow PneuNet has the volumes, faces and names that its dimensions say."""

from math import pi

import pytest
from tube_cases import areas, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.actuators.slow_pneunet import SlowPneuNet
from turgor.units import mm

FACES = {"cavity", "fixed", "outside", "strain_limiting_layer", "tip"}


@pytest.mark.parametrize(
    ("chambers", "length", "width", "height", "wall"), [(11, 110, 20, 15, 3), (3, 40, 12, 9, 1), (1, 25, 30, 12, 99)]
)
@pytest.mark.parametrize("symmetric", [True, False])
def test_volumes_computed_by_hand(chambers, length, width, height, wall, symmetric):
    actuator = SlowPneuNet(
        chambers=chambers, length=length * mm, width=width * mm, height=height * mm, wall=wall * mm,
        symmetric=symmetric,
    )  # fmt: skip
    inside = length - 4 - (chambers - 1) * wall
    cavity = inside * (width - 4) * (height - 5) + (chambers - 1) * wall * 3 * 2
    share = 2 if symmetric else 1
    assert_shape(
        actuator, solid=(length * width * height - cavity) / share, cavities={"cavity": cavity / share},
        regions={"body", "base"}, faces=FACES | ({"symmetry_y"} if symmetric else set()),
    )  # fmt: skip


def test_it_is_the_fast_one_with_its_gaps_filled():
    slow, fast = SlowPneuNet(), FastPneuNet()
    assert slow.cavity_volumes["cavity"] == pytest.approx(fast.cavity_volume)
    assert slow.solid_volume - fast.solid_volume == pytest.approx(10 * 1 * (20 * 12 - 5 * 3) / 2 * mm**3)


def test_an_end_block_is_held_all_around_and_an_inlet_opens_the_cavity_at_its_end():
    actuator = SlowPneuNet(chambers=2, length=30 * mm, clamp_length=10 * mm, inlet_diameter=3 * mm, symmetric=False)
    duct = pi / 4 * 9
    result = areas(actuator.build())
    assert result["fixed"] == pytest.approx(20 * 15 - duct + 2 * 10 * (20 + 15), rel=1e-6)
    assert result["tip"] == pytest.approx(20 * 15)
    assert result["strain_limiting_layer"] == pytest.approx(20 * 40)
    closed = SlowPneuNet(chambers=2, length=30 * mm, symmetric=False)
    assert actuator.cavity_volumes["cavity"] - closed.cavity_volumes["cavity"] == pytest.approx(duct * 12 * mm**3)
    walls = areas(closed.build())["cavity"] - duct + pi * 3 * 12
    assert result["cavity"] == pytest.approx(walls, rel=1e-6)
    assert actuator.solid_volume == pytest.approx(closed.solid_volume + (20 * 15 * 10 - duct * 12) * mm**3)


@pytest.mark.parametrize("options", [{}, {"clamp_length": 8 * mm, "inlet_diameter": 3 * mm}])
def test_it_meshes_coarsely(options):
    assert_meshes(SlowPneuNet(chambers=2, length=25 * mm, **options), size=4 * mm)


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"wall": 11 * mm}, ("wall", "11 mm", "0.01 mm to 10.987 mm", 11, "110 mm")),
        ({"end_wall": 41 * mm}, ("end_wall", "41 mm", "0.01 mm to 39.945 mm", 11, "110 mm")),
        ({"side_wall": 10 * mm}, ("side_wall", "10 mm", "0.01 mm to 9.995 mm", "20 mm")),
        ({"top_wall": 12 * mm}, ("top_wall", "12 mm", "0.01 mm to 11.99 mm", "15 mm")),
        ({"base": 15 * mm}, ("base", "15 mm", "0.01 mm to 14.97 mm")),
        ({"floor": 14 * mm}, ("floor", "14 mm", "0.01 mm to 13.48 mm", "15 mm")),
        ({"channel_width": 16 * mm}, ("channel_width", "16 mm", "0.01 mm to 15.99 mm")),
        ({"channel_height": 10 * mm}, ("channel_height", "10 mm", "0.01 mm to 9.99 mm")),
        ({"inlet_diameter": 10 * mm}, ("inlet_diameter", "10 mm", "0 mm to 9.99 mm", "16 mm x 10 mm")),
        ({"clamp_length": -1 * mm}, ("clamp_length", "-1 mm", "0 mm to 2000 mm")),
        ({"chambers": 0}, ("chambers", 0, "1 to 100")),
        ({"length": 110}, ("length", "110000 mm", "1 mm to 2000 mm", "unit")),
        ({"symmetric": 1}, ("symmetric", 1, "True or False")),
        ({"chambers": 1, "channel_width": 0}, ("channel_width", "0 mm", "0.01 mm to 2000 mm")),
    ],
)
def test_an_impossible_dimension_is_refused(wrong, facts):
    with refused(*facts):
        SlowPneuNet(**wrong)


@pytest.mark.parametrize(
    ("dimensions", "cavity"),
    [
        ({"wall": 10.987 * mm, "end_wall": 0.01 * mm}, 0.11 * 16 * 10 + 109.87 * 3 * 2),
        ({"side_wall": 9.995 * mm, "chambers": 1}, 106 * 0.01 * 10),
        ({"end_wall": 39.945 * mm}, 0.11 * 16 * 10 + 30 * 3 * 2),
    ],
)
def test_limits_that_errors_name_are_themselves_allowed(dimensions, cavity):
    geometry = SlowPneuNet(**dimensions).build()
    assert geometry.cavity_volumes["cavity"] == pytest.approx(cavity / 2 * mm**3)
