"""PneuNets whose chambers are open at the bottom and closed by the base."""

import pytest
from turgor.actuators import FastPneuNet, FreeBottomPneuNet, HelicalPneuNet, MantaFin, SlowPneuNet

import turgor as tg
from refused import refused
from turgor.core.engine.faces.surfaces import enclosed_volume
from turgor.core.meshing.surface import check_surface, outer_triangles
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import swept_mesh
from turgor.units import deg, kPa, mm

OPEN = (
    FastPneuNet(chambers=2, length=20 * mm, floor=0.0),
    SlowPneuNet(chambers=2, length=20 * mm, floor=0.0, symmetric=False),
    HelicalPneuNet(chambers=2, length=40 * mm, floor=0.0),
    MantaFin(chambers=2, floor=0.0),
)


@pytest.mark.parametrize("actuator", OPEN, ids=lambda each: type(each).__name__)
def test_the_base_closes_the_chambers(actuator) -> None:
    geometry = actuator.build()
    (finding,) = geometry.findings
    assert finding.code == "G12"
    made = tg.mesh(geometry, size=4 * mm)
    assert check_surface(made) == ()
    assert enclosed_volume(made.points, outer_triangles(made)) == pytest.approx(geometry.solid_volume, rel=1e-9)
    assert -enclosed_volume(made.points, made.face("cavity")) == pytest.approx(
        geometry.cavity_volumes["cavity"], rel=1e-9
    )


def test_the_layer_is_left_out_under_the_chambers() -> None:
    made = tg.mesh(FastPneuNet(chambers=2, length=20 * mm, floor=0.0).build(), size=4 * mm)
    closed = tg.mesh(FastPneuNet(chambers=2, length=20 * mm).build(), size=4 * mm)
    x, y, _ = made.points[made.face("strain_limiting_layer")[:, :3]].mean(axis=1).T / mm
    inside = (x > 2) & (x < 8.5) & (y < 8)
    assert not inside.any()
    x, y, _ = closed.points[closed.face("strain_limiting_layer")[:, :3]].mean(axis=1).T / mm
    assert ((x > 2) & (x < 8.5) & (y < 8)).any()


def test_open_chambers_bend_as_closed_ones_of_the_same_shape_and_rubber() -> None:
    rubber = tg.from_library("ecoflex-00-30", record="ogden-moseley-2016")

    def angle(**sizes: float) -> float:
        bender = SlowPneuNet(chambers=1, length=16 * mm, **sizes)
        model = tg.Model(
            swept_mesh(bender.build(), Fineness(size=4 * mm, edge=4 / 3 * mm)),  # the same lines in both
            materials={"body": rubber, "base": rubber},
            supports=[tg.Fixed("fixed")],
            loads=[tg.Pressure("cavity", 2 * kPa)],
        )
        return float(tg.measure(tg.solve(model), tg.bending_angle, mesh_error=False).column("bending_angle")[-1])

    whole = angle(floor=1.5 * mm, base=1.5 * mm)
    assert whole > 0.2 * deg
    assert angle(floor=0.0, base=3 * mm) == pytest.approx(whole, rel=0.01)


def test_something_must_close_the_chambers() -> None:
    for family in (FastPneuNet, SlowPneuNet, MantaFin):
        with refused("floor", "base", "0 mm"):
            family(floor=0.0, base=0.0)
    with refused("floor", "0 mm", "0.01 mm to 15 mm"):
        FreeBottomPneuNet(floor=0.0)
