"""The mold of a PneuNet: its parts and the casting fill the block, and come apart along z."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.geometry.actuators.slow_pneunet import SlowPneuNet
from turgor.core.geometry.molds.casting_mold import casting_mold
from turgor.core.geometry.molds.mold import MoldSettings
from turgor.core.geometry.shapes.solids import box
from turgor.core.meshing.exchange.formats.write_stl import write_stl
from turgor.units import mm

FAMILIES = {
    "fast": tg.FastPneuNet(chambers=3, length=30 * mm),
    "fast with clamp": tg.FastPneuNet(chambers=2, length=20 * mm, clamp_length=8 * mm, inlet_diameter=2 * mm),
    "one chamber": tg.FastPneuNet(chambers=1, length=15 * mm),
    "slow": SlowPneuNet(chambers=3, length=30 * mm),
}


@pytest.fixture(scope="module", params=list(FAMILIES))
def actuator(request):
    return FAMILIES[request.param]


def overlap(a, b):
    return sum(solid.mass for solid in (a * b).solids)


def test_parts_and_casting_do_not_overlap(actuator):
    parts = casting_mold(actuator).parts
    assert set(parts) == {"cup", "core", "tray"}
    assert overlap(parts["cup"].shape, parts["core"].shape) == pytest.approx(0, abs=1e-6)
    assert all(len(list(part.shape.solids)) == 1 for part in parts.values())


def test_space_between_cup_and_core_is_the_body_above_its_floor(actuator):
    parts = casting_mold(actuator).parts
    z = actuator.base + actuator.floor
    length = actuator.clamp_length + actuator.length
    block = box((-8 * mm, length + 8 * mm), (-18 * mm, 18 * mm), (z, actuator.height + 8 * mm))
    casting = block - parts["cup"].shape - parts["core"].shape
    whole = 2 * actuator.solid_volume - length * actuator.width * z
    duct = np.pi * actuator.inlet_diameter**2 / 4 * (actuator.clamp_length + actuator.end_wall)
    assert sum(solid.mass for solid in casting.solids) == pytest.approx((whole + duct) * 1e9, rel=1e-9)


@pytest.mark.parametrize(("part", "step"), [("cup", 1), ("core", -1)])
def test_parts_come_off_along_z(actuator, part, step):
    """Pulled by a millimeter, no part of the mold has entered the casting."""
    parts = casting_mold(actuator).parts
    z = actuator.base + actuator.floor
    length = actuator.clamp_length + actuator.length
    block = box((0, length), (-actuator.width / 2, actuator.width / 2), (z, actuator.height))
    casting = block - parts["cup"].shape - parts["core"].shape
    pulled = parts[part].shape.Move((0, 0, step))
    assert overlap(pulled, casting) == pytest.approx(0, abs=1e-6)


def test_parts_are_closed_stl(tmp_path, actuator):
    for name, part in casting_mold(actuator).parts.items():
        made = write_stl(part, tmp_path / f"{name}.stl")
        assert made.volume == pytest.approx(part.solid_volume, rel=1e-3)


def test_refusals():
    with refused("pin_diameter", "9 mm", "0.5 mm to 6.6 mm"):
        MoldSettings(pin_diameter=9 * mm)
    with refused("pour_diameter", "0 mm"):
        MoldSettings(pour_diameter=0.0)
    with refused("undercut", "-1 mm²"):
        MoldSettings(undercut=-1e-6)
