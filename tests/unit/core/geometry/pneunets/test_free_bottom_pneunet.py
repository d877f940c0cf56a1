"""The CAD shape of a free-bottom PneuNet has the volumes, faces and names that its dimensions say."""

import pytest
from tube_cases import areas, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.actuators.free_bottom_pneunet import FreeBottomPneuNet
from turgor.units import mm

FACES = {"cavity", "fixed", "outside", "strain_limiting_layer", "tip"}


@pytest.mark.parametrize(("chambers", "length", "free", "bonded"), [(11, 110, 1.5, 2), (3, 30, 0.5, 0), (2, 25, 4, 6)])
@pytest.mark.parametrize("symmetric", [True, False])
def test_volumes_computed_by_hand(chambers, length, free, bonded, symmetric):
    actuator = FreeBottomPneuNet(
        chambers=chambers, length=length * mm, free_height=free * mm, bonded_side=bonded * mm, symmetric=symmetric
    )
    gaps, share = chambers - 1, 2 if symmetric else 1
    cavity = (length - gaps - 4 - 2 * gaps) * 16 * 10 + gaps * 3 * 3 * 2
    joint = 2 * bonded * 1.5 + 5 * 4  # strips of floor, and a tube of 5 x 4 mm around the channel
    solid = length * 20 * 1.5 + (length - gaps) * 20 * 13.5 + gaps * joint - cavity
    assert_shape(
        actuator, solid=solid / share, cavities={"cavity": cavity / share}, regions={"body", "base"},
        faces=FACES | ({"symmetry_y"} if symmetric else set()),
    )  # fmt: skip


def test_the_layer_covers_the_base_but_is_bonded_to_the_body_only_below_chambers_and_strips():
    shape = FreeBottomPneuNet(chambers=3, length=30 * mm, symmetric=False).build().shape
    body, base = shape.solids
    bonded = sum(face.mass for face in set(body.faces) & set(base.faces))
    layer = sum(face.mass for face in set(base.faces) if face.name == "strain_limiting_layer")
    assert bonded == pytest.approx(28 * 20 + 2 * 2 * 4)
    assert layer == pytest.approx(30 * 20)


def test_the_tubes_hang_free_above_the_base():
    faces = set(FreeBottomPneuNet(chambers=2, length=20 * mm, symmetric=False).build().shape.faces)
    below = [f for f in faces if f.name == "outside" and f.mass == pytest.approx(5) and abs(f.center[0] - 10) < 1e-9]
    assert sorted(face.center[2] for face in below) == pytest.approx([3.0, 7.0])  # 1.5 mm above the base of 1.5 mm


def test_a_single_chamber_is_that_of_the_fast_pneunet():
    one, fast = FreeBottomPneuNet(chambers=1, length=20 * mm), FastPneuNet(chambers=1, length=20 * mm)
    assert areas(one.build()) == pytest.approx(areas(fast.build()))
    assert one.smallest_wall == fast.smallest_wall


@pytest.mark.parametrize("options", [{}, {"bonded_side": 0.0}, {"clamp_length": 8 * mm, "inlet_diameter": 3 * mm}])
def test_it_meshes_coarsely(options):
    assert_meshes(FreeBottomPneuNet(chambers=2, length=20 * mm, **options), size=4 * mm)


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"free_height": 0.4 * mm}, ("free_height", "0.4 mm", "0.5 mm to 8.49 mm")),
        ({"free_height": 9 * mm}, ("free_height", "9 mm", "0.5 mm to 8.49 mm")),
        ({"bonded_side": 8 * mm}, ("bonded_side", "8 mm", "0 mm to 7.49 mm")),
        ({"bonded_side": -1 * mm}, ("bonded_side", "-1 mm", "0 mm to 7.49 mm")),
        ({"channel_wall": 5.8 * mm}, ("channel_wall", "5.8 mm", "0.01 mm to 5.74 mm")),
        ({"gap": -1 * mm}, ("gap", "-1 mm", "0.01 mm to 10.967 mm", 11, "110 mm")),
        ({"base": 0}, ("base", "0 mm", "0.01 mm to 14.97 mm")),
    ],
)
def test_an_impossible_dimension_is_refused(wrong, facts):
    with refused(*facts):
        FreeBottomPneuNet(**wrong)


@pytest.mark.parametrize("free_height", [0.5 * mm, 8.49 * mm])
def test_limits_that_errors_name_are_themselves_allowed(free_height):
    geometry = FreeBottomPneuNet(chambers=2, length=20 * mm, free_height=free_height).build()
    cavity = (20 - 1 - 4 - 2) * 16 * 10 + 3 * 3 * 2  # chambers and channel, wherever the channel lies
    assert geometry.cavity_volumes["cavity"] == pytest.approx(cavity / 2 * mm**3)
