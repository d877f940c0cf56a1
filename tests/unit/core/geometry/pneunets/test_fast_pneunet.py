"""The CAD shape of a fast PneuNet has the volumes, faces and names that its dimensions say."""

from dataclasses import replace
from math import pi

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tube_cases import areas

from refused import refused
from turgor.core.engine.faces.surfaces import enclosed_volume
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.meshing.generate import mesh
from turgor.units import mm

FACES = ("cavity", "fixed", "outside", "strain_limiting_layer", "tip")


def test_the_default_half_has_the_volumes_and_areas_computed_by_hand() -> None:
    # 11 chambers of 100/11 mm with 10 gaps of 1 mm; cavities 76 mm long together, 16 mm wide, 10 mm high
    geometry = FastPneuNet().build()
    assert geometry.cavity_volume * 1e9 == pytest.approx((76 * 16 * 10 + 10 * 3 * 3 * 2) / 2)
    assert geometry.solid_volume * 1e9 == pytest.approx((110 * 20 * 3 + 100 * 20 * 12 + 10 * 5 * 3 - 12340) / 2)
    assert geometry.smallest_wall == pytest.approx(1 * mm)
    assert geometry.extent == pytest.approx(110 * mm, rel=1e-6)
    assert geometry.regions == ("body", "base")
    assert geometry.faces == ("cavity", "fixed", "outside", "strain_limiting_layer", "symmetry_y", "tip")
    expected = {
        "fixed": 10 * 15,
        "tip": 10 * 15,
        "strain_limiting_layer": 110 * 10,
        "symmetry_y": 110 * 3 + 100 * 12 + 10 * 3 - (76 * 10 + 30 * 2),
        "cavity": 2 * 76 * 8 + 76 * 10 + 22 * 8 * 10 - 20 * 1.5 * 2 + 30 * (1.5 + 1.5 + 2),
        "outside": 110 * 10 + 110 * 3 + 100 * 12 + 100 * 10 + 20 * (120 - 2.5 * 3) + 10 * (7.5 + 2.5 + 3),
    }
    assert areas(geometry) == pytest.approx(expected, rel=1e-9)


def test_the_whole_is_twice_the_half() -> None:
    half, whole = (FastPneuNet(chambers=3, length=30 * mm, symmetric=s).build() for s in (True, False))
    assert whole.solid_volume == pytest.approx(2 * half.solid_volume)
    assert whole.cavity_volume == pytest.approx(2 * half.cavity_volume)
    assert whole.faces == FACES
    low, high = whole.bounds
    assert low[1] == pytest.approx(-high[1])
    of_half, of_whole = areas(half), areas(whole)
    del of_half["symmetry_y"]
    assert of_whole == pytest.approx({name: 2 * area for name, area in of_half.items()}, rel=1e-9)


def test_a_single_chamber_has_neither_gap_nor_channel() -> None:
    one = FastPneuNet(chambers=1, length=20 * mm, wall=50 * mm, channel_wall=0.5 * mm, gap=30 * mm)
    assert one.smallest_wall == pytest.approx(1.5 * mm)
    assert one.build().cavity_volume * 1e9 == pytest.approx(16 * 8 * 10)


@st.composite
def fingers(draw: st.DrawFn) -> FastPneuNet:
    """Admissible dimensions, each share of what the ones before leave."""

    def share(of: float, low: float = 0.05, high: float = 0.9) -> float:
        return of * draw(st.floats(low, high))

    chambers = draw(st.integers(1, 4))
    length, width, height = (draw(st.floats(5, 300)) * mm for _ in range(3))
    gap = share(length / chambers, 0.05, 0.6)
    block = (length - (chambers - 1) * gap) / chambers
    wall = share(block / 2)
    side_wall = share(width / 2)
    base = share(height, 0.05, 0.4)
    floor = share(height - base, 0.05, 0.5)
    top_wall = share(height - base - floor, 0.05, 0.6)
    channel_width = share(width - 2 * side_wall)
    channel_height = share(height - base - floor - top_wall)
    channel_wall = share(min((width - channel_width) / 2, height - base - floor - channel_height))
    return FastPneuNet(
        chambers=chambers,
        length=length,
        width=width,
        height=height,
        wall=wall,
        gap=gap,
        side_wall=side_wall,
        top_wall=top_wall,
        end_wall=share(block / 2 if chambers == 1 else block - wall),
        floor=floor,
        base=base,
        channel_width=channel_width,
        channel_height=channel_height,
        channel_wall=channel_wall,
        symmetric=draw(st.booleans()),
    )


@settings(max_examples=25, deadline=None)
@given(finger=fingers())
def test_any_admissible_dimensions_give_the_shape_that_they_say(finger: FastPneuNet) -> None:
    geometry = finger.build()  # raises if a CAD volume is off by 1e-9
    assert set(geometry.faces) == {*FACES, *(["symmetry_y"] if finger.symmetric else [])}
    across = finger.width / mm / (2 if finger.symmetric else 1)
    result = areas(geometry)
    assert result["fixed"] == pytest.approx(across * finger.height / mm, rel=1e-9)
    assert result["tip"] == pytest.approx(result["fixed"], rel=1e-9)
    assert result["strain_limiting_layer"] == pytest.approx(across * finger.length / mm, rel=1e-9)
    assert len(geometry.shape.solids) == 2


@pytest.mark.parametrize("symmetric", [True, False])
def test_an_end_block_is_held_all_around_and_an_inlet_opens_the_cavity_at_its_end(symmetric: bool) -> None:
    plain, share = FastPneuNet(chambers=2, length=20 * mm, symmetric=symmetric), 2 if symmetric else 1
    finger = replace(plain, clamp_length=8 * mm, inlet_diameter=3 * mm)
    duct = pi / 4 * 9 / share  # mm²
    assert (finger.cavity_volume - plain.cavity_volume) * 1e9 == pytest.approx(duct * 10)
    assert (finger.solid_volume - plain.solid_volume) * 1e9 == pytest.approx(20 * 15 * 8 / share - duct * 10)
    result, before = areas(finger.build()), areas(plain.build())
    around = 2 * 20 + 2 * 15
    assert result["fixed"] == pytest.approx(20 * 15 / share - duct + 8 * around / share, rel=1e-6)
    assert result["cavity"] == pytest.approx(before["cavity"] - duct + pi * 3 * 10 / share, rel=1e-6)
    assert result["outside"] == pytest.approx(before["outside"], rel=1e-9)
    assert result["tip"] == pytest.approx(before["tip"], rel=1e-9)
    made = mesh(finger.build(), size=4 * mm)
    open_at_x_0 = -enclosed_volume(made.points, made.face("cavity"))  # the plane x = 0 adds nothing
    assert open_at_x_0 == pytest.approx(finger.cavity_volume, rel=1e-3)


def test_an_inlet_must_fit_into_the_chamber() -> None:
    with refused("inlet_diameter", "10 mm", "0 mm to 9.99 mm", "16 mm x 10 mm"):
        FastPneuNet(inlet_diameter=10 * mm)
    with refused("clamp_length", "3000 mm", "0 mm to 2000 mm", "unit"):
        FastPneuNet(clamp_length=3.0)
