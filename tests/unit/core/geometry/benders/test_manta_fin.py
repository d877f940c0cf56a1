"""The CAD shape of a manta fin has the volumes, faces and names that its dimensions say."""

from math import atan2, cos, pi

import pytest
from tube_cases import areas, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.manta_fin import MantaFin
from turgor.core.geometry.actuators.slow_pneunet import SlowPneuNet
from turgor.units import mm

FACES = {"cavity", "fixed", "outside", "strain_limiting_layer", "tip"}


@pytest.mark.parametrize(("chambers", "root", "tip", "length"), [(6, 50, 20, 80), (2, 30, 30, 40), (3, 15, 40, 60)])
@pytest.mark.parametrize(("sweep", "symmetric"), [(15, False), (-40, False), (0, False), (0, True)])
def test_volumes_computed_by_hand(chambers, root, tip, length, sweep, symmetric):
    fin = MantaFin(
        chambers=chambers, length=length * mm, root_width=root * mm, tip_width=tip * mm, sweep=sweep * mm,
        symmetric=symmetric,
    )  # fmt: skip

    def width(x):
        return root + (tip - root) * x / length - 5

    inside = (length - 6 - (chambers - 1) * 3) / chambers
    middles = [3 + inside / 2 + i * (inside + 3) for i in range(chambers)]  # a trapezoid is as wide as at its middle
    cavity = sum(width(x) for x in middles) * inside * 5 + (chambers - 1) * 3 * 3 * 2
    share = 2 if symmetric else 1
    assert_shape(
        fin, solid=((root + tip) / 2 * length * 10 - cavity) / share, cavities={"cavity": cavity / share},
        regions={"body", "base"}, faces=FACES | ({"symmetry_y"} if symmetric else set()),
    )  # fmt: skip


def test_areas_of_a_swept_fin_with_an_end_block_and_an_inlet():
    result = areas(MantaFin(clamp_length=10 * mm, inlet_diameter=4 * mm).build())
    assert result["fixed"] == pytest.approx(50 * 10 - pi * 4 + 10 * (2 * 50 + 2 * 10), rel=1e-6)
    assert result["tip"] == pytest.approx(20 * 10)
    assert result["strain_limiting_layer"] == pytest.approx(50 * 10 + 35 * 80)
    # the edge at y = -25 mm moves to 15 - 10 = 5 mm, the other one stays at 25 mm
    assert result["outside"] == pytest.approx(2 * 35 * 80 + 10 * ((80**2 + 30**2) ** 0.5 + 80), rel=1e-6)


def test_its_thinnest_wall_is_measured_across_the_slanted_edge():
    fin = MantaFin(side_wall=1 * mm)
    assert fin.smallest_wall == pytest.approx(1 * mm * cos(atan2(30, 80)))


def test_without_taper_and_sweep_it_is_a_slow_pneunet():
    same = {"chambers": 3, "length": 40 * mm, "height": 12 * mm, "side_wall": 2 * mm, "wall": 2 * mm}
    fin = MantaFin(root_width=20 * mm, tip_width=20 * mm, sweep=0.0, symmetric=True, end_wall=2 * mm, **same)
    slow = SlowPneuNet(width=20 * mm, **same)
    assert fin.cavity_volumes == pytest.approx(slow.cavity_volumes)
    assert areas(fin.build()) == pytest.approx(areas(slow.build()))


def test_it_meshes_coarsely():
    assert_meshes(
        MantaFin(chambers=2, length=30 * mm, root_width=25 * mm, sweep=8 * mm, inlet_diameter=3 * mm), size=6 * mm
    )


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"symmetric": True}, ("symmetric", "True", "15 mm", "allowed is False")),
        ({"sweep": 200 * mm}, ("sweep", "200 mm", "-160 mm to 160 mm")),
        ({"tip_width": 0.5 * mm}, ("tip_width", "0.5 mm", "1 mm to 2000 mm")),
        ({"tip_width": 4 * mm}, ("side_wall", "2.5 mm", "0.01 mm to 1.995 mm", "4 mm")),
        ({"tip_width": 6 * mm}, ("channel_width", "3 mm", "0.01 mm to 2.64 mm", "2.65 mm")),
        ({"wall": 20 * mm}, ("wall", "20 mm", "0.01 mm to 15.984 mm", 6, "80 mm")),
        ({"inlet_diameter": 6 * mm}, ("inlet_diameter", "6 mm", "0 mm to 4.99 mm", "43.875 mm x 5 mm")),
    ],
)
def test_an_impossible_dimension_is_refused(wrong, facts):
    with refused(*facts):
        MantaFin(**wrong)
