"""Pictures and files of hexahedral meshes: the same surface, mirrored and colored, and cells that VTK knows."""

import numpy as np
import pytest
import results_cases as cases

from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.meshing.generate import mesh
from turgor.core.model.loads import Pressure
from turgor.core.model.model import Model
from turgor.core.model.supports import Fixed
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.files.vtu import write_state
from turgor.core.solvers.solution import State
from turgor.units import kPa, mm
from turgor.views.pictures.skin import visible_skin

STRETCH = 1.2


@pytest.fixture(scope="module")
def stretched() -> State:
    made = mesh(FastPneuNet(chambers=2, length=24 * mm).build(), size=4 * mm, cells="hexahedra")
    materials = {"body": cases.RUBBER, "base": cases.RUBBER}
    model = Model(made, materials, [Fixed("fixed")], [Pressure("cavity", 10 * kPa)])
    return State(
        model=model, load_factor=1.0, displacement=cases.stretched(STRETCH)(made.points) - made.points,
        mean_stress=np.zeros(made.vertex_count), nodal_force=np.zeros_like(made.points),
    )  # fmt: skip


def test_the_skin_is_the_whole_surface(stretched: State) -> None:
    at = StateFields(stretched)
    skin = visible_skin(at, at.stretch)
    finger, thin = FastPneuNet(chambers=2, length=24 * mm), STRETCH**-0.5
    low, high = skin.points.min(axis=0), skin.points.max(axis=0)
    assert high - low == pytest.approx([finger.length * STRETCH, finger.width * thin, finger.height * thin])
    assert skin.values == pytest.approx(STRETCH, rel=1e-6)
    sides = np.abs(np.abs(skin.normals[:, 1]) - 1) < 1e-9
    assert sides.any()
    top = skin.areas[(skin.points[skin.triangles, 2] > high[2] - 1e-9).all(axis=1)].sum()
    assert top == pytest.approx(23 * mm * STRETCH * finger.width * thin)


def test_vtk_opens_the_cells(stretched: State, tmp_path) -> None:
    vtk_io = pytest.importorskip("vtkmodules.vtkIOXML")
    write_state(tmp_path / "state.vtu", stretched)
    reader = vtk_io.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(tmp_path / "state.vtu"))
    reader.Update()
    grid, made = reader.GetOutput(), stretched.model.mesh
    assert grid.GetNumberOfCells() == len(made.cells)
    assert grid.GetCellType(0) == 29  # triquadratic hexahedron
    cell = grid.GetCell(5)
    assert [cell.GetPointId(i) for i in range(27)] == made.cells[5].tolist()
