"""The PneuNet and the bellows of a SOFA tutorial load and move under pressure as their shape says.

No measurement belongs to them. The tests assert the direction of the motion; the angle of the PneuNet is a recorded
value that fails on drift.
"""

from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.geometry.cad.selectors import InBox, WithNormal
from turgor.core.meshing.exchange import mesh_surfaces, read_mesh
from turgor.core.results.measures.measures import find_measure
from turgor.units import deg, kPa, mm

DATA = Path(__file__).parent / "data" / "sofa-actuator-meshes"
PNEUNET, BELLOWS = DATA / "pneunet", DATA / "bellows"

#: From the tutorial's axes to ours: x to the tip, the strain-limiting side at the bottom.
AXES = ("-x", "-z", "-y")
CLAMP = InBox((0, -20 * mm, -40 * mm), (10 * mm, 20 * mm, 0))

#: The tutorial's box of stiffer cells.
STIFF = InBox((19 * mm, -8 * mm, -28 * mm), (100 * mm, 8 * mm, -22.5 * mm))


def rubber(young):
    return tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=young / 6))


def solved(mesh, materials, pressure):
    model = tg.Model(mesh, materials, [tg.Fixed("fixed")], [tg.Pressure("cavity", pressure)])
    return tg.solve(model, tg.Static())


def test_pneunet_bends_towards_its_stiff_side():
    mesh = read_mesh(
        PNEUNET / "pneunetCutCoarse.vtk",
        axes=AXES,
        faces={"fixed": CLAMP, "tip": WithNormal("+x")},
        regions={"base": STIFF},
        cavities={"cavity": PNEUNET / "pneunetCavityCut.stl"},
    )
    assert {finding.code for finding in mesh.findings} == {"G20", "G23"}
    solution = solved(mesh, {"body": rubber(500 * kPa), "base": rubber(1500 * kPa)}, 10 * kPa)
    response = tg.measure(solution, tg.bending_angle, tg.cavity_volume, mesh_error=False)
    assert response.column("cavity_volume")[0] == pytest.approx(8887.5 * mm**3, rel=1e-6)
    assert response.column("bending_angle")[-1] / deg == pytest.approx(16.2, abs=0.2)


def test_pneunet_is_filled_from_its_surfaces():
    """The cavity is in the file already, as an inner shell; its own file only names it."""
    mesh = mesh_surfaces(PNEUNET / "pneunetCut.stl", axes=AXES, cavities={"air": PNEUNET / "pneunetCavityCut.stl"})
    assert set(mesh.faces) == {"air", "cavity", "outside"}
    assert mesh.cavities == ("cavity",)
    assert (len(mesh.faces["air"]), len(mesh.faces["cavity"]), len(mesh.faces["outside"])) == (912, 912, 2056)


@pytest.mark.parametrize(
    ("file", "axes", "volume"), [("Springy.vtu", ("y", "z", "x"), 3691.5), ("Springy.vtk", ("z", "x", "y"), 5426.5)]
)
def test_bellows_extends(file, axes, volume):
    faces = {"fixed": WithNormal("-x"), "tip": WithNormal("+x")}
    mesh = read_mesh(BELLOWS / file, unit="cm", axes=axes, faces=faces)
    assert ("G24" in {finding.code for finding in mesh.findings}) == (file == "Springy.vtk")
    response = tg.measure(
        solved(mesh, {"body": rubber(500 * kPa)}, 5 * kPa), find_measure("tip_displacement_x"), tg.cavity_volume
    )
    assert response.column("cavity_volume")[0] == pytest.approx(volume * mm**3, rel=1e-3)
    assert response.column("tip_displacement_x")[-1] > 0.3 * mm
    assert response.column("cavity_volume")[-1] > 1.02 * response.column("cavity_volume")[0]


def test_bellows_with_a_surface_in_other_axes_or_crossing_itself():
    with refused("'cavity'", BELLOWS / "Springy_Cavity.stl", "37.8 mm", "(x, z, y)"):
        read_mesh(BELLOWS / "Springy.vtu", unit="cm", cavities={"cavity": BELLOWS / "Springy_Cavity.stl"})
    with refused(BELLOWS / "Springy.stl", "2 places", "(-9.398, -8.437, 26.13) mm"):
        mesh_surfaces(BELLOWS / "Springy.stl", unit="cm", cavities={"cavity": BELLOWS / "Springy_Cavity.stl"})
    mesh = read_mesh(BELLOWS / "Springy.vtk", unit="cm", cavities={"cavity": BELLOWS / "Springy_Cavity.stl"})
    (finding,) = [finding for finding in mesh.findings if finding.code == "G23"]
    assert finding.severity == "warning"
    assert np.ptp(mesh.points[mesh.face_nodes("cavity"), 2]) == pytest.approx(40 * mm, rel=0.02)
