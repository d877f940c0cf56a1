"""PneuNets without a base: one region, and the strain-limiting layer is their bottom."""

import numpy as np
import pytest
from turgor.actuators import (
    FastPneuNet,
    FreeBottomPneuNet,
    HelicalPneuNet,
    MantaFin,
    SlowPneuNet,
    TrapezoidalPneuNet,
    TriangularPneuNet,
)

import turgor as tg
from refused import refused
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.units import GPa, MPa, deg, kPa, mm

FAMILIES = (FastPneuNet, HelicalPneuNet, SlowPneuNet, MantaFin, TrapezoidalPneuNet, TriangularPneuNet)


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("clamp_length", [0.0, 5 * mm])
def test_the_layer_is_the_bottom(family, clamp_length):
    part = family(base=0.0, clamp_length=clamp_length).build()
    assert part.regions == ("body",)
    made = tg.mesh(part, size=3 * part.smallest_wall, cells="hexahedra")
    assert cell_volumes(made).sum() == pytest.approx(part.solid_volume)
    layer = made.points[made.face_nodes("strain_limiting_layer")]
    assert np.abs(layer[:, 2]).max() < 1e-12
    assert np.ptp(layer[:, 0]) == pytest.approx(np.ptp(made.points[:, 0]))


def bend(base):
    """Bending angle of two chambers on paper at 5 kPa [deg]."""
    made = tg.mesh(FastPneuNet(chambers=2, length=20 * mm, base=base).build(), size=3 * mm, cells="hexahedra")
    rubber = tg.Material(law=tg.laws.NeoHooke(C10=0.1 * MPa), name="rubber")
    paper = tg.Material(law=tg.laws.Hooke(E=1 * GPa, nu=0.2), name="paper")
    model = tg.Model(
        made,
        materials=dict.fromkeys(made.regions, rubber) | {"strain_limiting_layer": tg.Shell(paper, thickness=0.1 * mm)},
        supports=[tg.supports.Fixed("fixed")],
        loads=[tg.loads.Pressure("cavity", 5 * kPa)],
    )
    response = tg.measure(tg.solve(model), tg.measures.bending_angle, mesh_error=False)
    return response.find("bending_angle").values[-1] / deg


def test_no_base_bends_further_than_a_thin_one():
    # 9.15 deg with 1.5 mm and 12.67 deg with 0.75 mm: the second half of the base costs less than the first
    assert bend(0.0) == pytest.approx(14.15, rel=0.02)
    assert bend(0.75 * mm) == pytest.approx(12.67, rel=0.02)


def test_chambers_that_are_open_below_need_a_base():
    with refused("base", "0 mm", "0.01 mm to 14.97 mm"):
        FreeBottomPneuNet(base=0.0)


def test_a_base_is_no_negative_length():
    with refused("base", "-1 mm", "0.01 mm to 14.97 mm", "15 mm"):
        FastPneuNet(base=-1 * mm)
