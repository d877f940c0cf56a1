"""The estimated mesh error against the true one, on actuators whose converged answers are known.

Problem: a fast PneuNet on a stiff base, its default mesh and tetrahedra of 2 and 3 mm, and a cylinder whose hoops are
held inside its skin, at its default mesh.
Reference: for the PneuNet hexahedra that grow away from sharp edges (docs/truth.md). For the cylinder the default
hexahedra, refined three times where the error comes from: 20,735, 43,363 and 89,220 degrees of freedom give 0.70260,
0.70348 and 0.70390 mm, which leads to 0.7043 mm. The values of docs/truth.md, 0.70176 and 0.70221 mm, come from meshes
that are not refined at the rim of the fixed face; they are about as far off as the default mesh.
Tolerance: the estimate over the true error lies between 0.5 and 3, which is asked of nine cases of ten; the page on the
truth set shows all of them. A constant estimate, or one without the displacements of the second mesh, would not lie
there on all four.
"""

import pytest

import turgor as tg
from turgor.units import deg, kPa, mm

SOFT = tg.Material(name="soft", law=tg.Yeoh(C10=0.11e6, C20=0.02e6))
STIFF = tg.Material(name="stiff", law=tg.laws.NeoHooke(C10=2.2e6))
RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12e6))
ALONE = tg.Contact(self_contact=False)


def _pneunet(size):  # hexahedra where there is none
    mesh = tg.mesh(tg.FastPneuNet(chambers=3, length=30 * mm).build(), size=size)
    loads = [tg.Pressure("cavity", 4 * kPa)]
    return tg.Model(mesh, {"body": SOFT, "base": STIFF}, [tg.Fixed("fixed")], loads, contact=ALONE)


def _cylinder(size):
    mesh = tg.mesh(tg.actuators.FiberReinforcedCylinder(length=40 * mm, skin=1 * mm).build(), size=size)
    supports = [tg.Fixed("fixed", "x"), tg.supports.Radial("winding")]
    loads = [tg.Pressure("cavity", 13.7201 * kPa)]
    return tg.Model(mesh, dict.fromkeys(mesh.regions, RUBBER), supports, loads, contact=ALONE)


@pytest.mark.parametrize(
    ("model", "size", "measure", "truth", "unit"),
    [
        (_pneunet, None, tg.bending_angle, 6.607, deg),
        (_pneunet, 2 * mm, tg.bending_angle, 6.607, deg),
        (_pneunet, 3 * mm, tg.bending_angle, 6.607, deg),
        (_cylinder, None, tg.measures.tip_displacement_x, 0.7043, mm),
    ],
    ids=["stiff base, default", "stiff base, 2 mm", "stiff base, 3 mm", "held hoops, default"],
)
def test_estimate_over_true_error(model, size, measure, truth, unit, record_verification, request):
    response = tg.measure(tg.solve(model(size)), measure)
    value, estimate = response.column(measure.name)[-1] / unit, response.mesh_error(measure.name)[-1] / unit
    ratio = estimate / abs(value - truth)
    record_verification(
        claim=f"mesh error, {request.node.callspec.id}: estimate over true error, {measure.name.replace('_', ' ')}",
        source="converged meshes, docs/truth.md",
        expected=1.0,
        got=ratio,
        tolerance="0.5 to 3",
    )
    assert 0.5 < ratio < 3
