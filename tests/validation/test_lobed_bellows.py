"""A bellows with small fillets extends as its axisymmetric model, which follows every fillet.

A quarter of a bellows of six lobes from a STEP file of another CAD program: wall 1 mm, every edge rounded with 0.8
mm. At 0.2 kPa with neo-Hookean rubber of C10 = 0.1 MPa its end moves by 4.680 mm and its cavity holds 12.508 mL: it is
a body of revolution, and axisymmetric meshes of 6,331, 6,575 and 8,531 unknowns give 4.6798, 4.6794 and 4.6818 mm.
Tetrahedra that follow every fillet (size 2 mm, 314,538 unknowns) give 4.620 mm. Coarse along the fillets at 2.5 mm they
give 4.466 mm with one cell through the wall (22,113 unknowns) and 4.604 mm with two (73,622). The aim was 2 % at 25,000
unknowns for a quarter: axisymmetric meshes meet it, tetrahedra are kept within 5 % there.
"""

from pathlib import Path

import pytest
from turgor.cad import WithNormal, read_cad

import turgor as tg
from turgor.units import MPa, kPa, mL, mm

BELLOWS = Path(__file__).parents[1] / "unit" / "data" / "cad" / "bellows.step"
FACES = {
    "fixed": WithNormal("-x"),
    "tip": WithNormal("+x"),
    "symmetry_y": WithNormal("-y"),
    "symmetry_z": WithNormal("-z"),
}
EXTENSION, VOLUME = 4.682 * mm, 12.508 * mL


def inflated(mesh, pressure):
    """What is measured at a pressure."""
    model = tg.Model(
        mesh,
        materials={"bellows": tg.Material(law=tg.laws.NeoHooke(C10=0.1 * MPa), name="rubber")},
        supports=[tg.supports.Fixed("fixed")],
        loads=[tg.loads.Pressure("cavity", pressure)],
    )
    solution = tg.solve(model)
    measures = (tg.measures.tip_displacement_x, tg.measures.cavity_volume)
    response = tg.measure(solution, *measures, mesh_error=False)
    values = [response.find(name).values[-1] for name in ("tip_displacement_x", "cavity_volume")]
    return solution, *values


@pytest.mark.slow
@pytest.mark.parametrize(("wall_cells", "unknowns", "error"), [(1, 25_000, 0.05), (2, 80_000, 0.02)])
def test_the_extension_of_a_bellows_with_coarse_fillets(wall_cells, unknowns, error):
    mesh = tg.mesh(read_cad(BELLOWS, faces=FACES), size=2.5 * mm, wall_cells=wall_cells)
    assert mesh.unknown_count < unknowns
    _, extension, volume = inflated(mesh, 0.2 * kPa)
    assert extension == pytest.approx(EXTENSION, rel=error)
    assert volume == pytest.approx(VOLUME, rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("size", [2 * mm, 0.6 * mm])
def test_the_axisymmetric_bellows_meets_the_aim(size):
    mesh = tg.mesh(read_cad(BELLOWS, faces=FACES), size=size, cells="axisymmetric")
    assert mesh.unknown_count < 25_000
    solution, extension, volume = inflated(mesh, 0.2 * kPa)
    assert extension == pytest.approx(EXTENSION, rel=1e-3)
    assert volume == pytest.approx(VOLUME, rel=1e-3)
    assert not solution.findings, "nothing touches"
