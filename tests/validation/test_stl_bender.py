"""A half-round bender bends alike from its CAD shape and from an STL file of 176 facets.

The corners of the facets lie on the circle: a polygon of 48 sides, whose area is 0.3 % smaller. Both meshes are
tetrahedra of 2.5 mm. At 50 kPa, CAD gave 13.16 deg and the meshes of the STL shape, which differ from call to call,
12.6 to 13.1 deg; at 1.8 mm, CAD gave 13.50 deg and STL 13.1 to 13.2 deg; at 1.3 mm, STL 13.4 deg.
"""

import pytest
from netgen.occ import Box, Cylinder, Pnt, X
from turgor.cad import WithNormal, read_cad

import turgor as tg
from prints import half_round
from turgor.units import MPa, deg, kPa, mm

ENDS = {"fixed": WithNormal("-x"), "tip": WithNormal("+x")}


def angle(part):
    """Bending angle at 50 kPa [deg]."""
    rubber = tg.Material(law=tg.laws.NeoHooke(C10=0.1 * MPa), name="rubber")
    model = tg.Model(
        mesh=tg.mesh(part, size=2.5 * mm, cells="tetrahedra"),
        materials={"body": rubber},
        supports=[tg.supports.Fixed("fixed")],
        loads=[tg.loads.Pressure("cavity", 50 * kPa)],
        contact=tg.Contact(self_contact=False),
    )
    response = tg.measure(tg.solve(model), tg.measures.bending_angle)
    return response.find("bending_angle").values[-1] / deg


@pytest.mark.slow
def test_a_bender_bends_alike_from_step_and_stl(tmp_path):
    body = Cylinder(Pnt(0, 0, 0), X, r=8, h=50) * Box(Pnt(0, -8, 0), Pnt(50, 8, 8))
    hollow = Cylinder(Pnt(3, 0, 0), X, r=6.5, h=44) * Box(Pnt(3, -7, 4), Pnt(47, 7, 7))
    (body - hollow).WriteStep(str(tmp_path / "bender.step"))
    exact = angle(read_cad(tmp_path / "bender.step", faces=ENDS))
    printed = angle(read_cad(half_round().write(tmp_path / "bender.stl"), faces=ENDS))
    assert printed == pytest.approx(exact, rel=0.06)
