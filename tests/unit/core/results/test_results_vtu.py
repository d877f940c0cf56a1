"""VTU and PVD: what VTK reads back is what was written, quadratic cells included."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
import results_cases as cases

from turgor.core.meshing.refining.region_nodes import region_nodes
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.files.mesh_vtu import write_mesh_vtu
from turgor.core.results.files.vtu import write_series, write_state
from turgor.core.results.measures.field_measures import von_mises_p99
from turgor.foundation.symmetric import PAIRS

vtk_io = pytest.importorskip("vtkmodules.vtkIOXML")
numpy_support = pytest.importorskip("vtkmodules.util.numpy_support")


#: Where arrays stand in a VTU file.
SECTIONS = ("FieldData", "PointData", "CellData", "Points", "Cells")


@pytest.fixture(scope="module")
def state():
    made = cases.state(cases.model(cases.body(half=True)), cases.bent(1.0), load_factor=0.7)
    return replace(made, mean_stress=np.linspace(-1e5, 2e5, len(made.mean_stress)))


@pytest.fixture(scope="module")
def grid(state, tmp_path_factory):
    path = tmp_path_factory.mktemp("vtu") / "state.vtu"
    write_state(path, state)
    return read(path)


def read(path):
    reader = vtk_io.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0
    return reader.GetOutput()


def array(data, name):
    return numpy_support.vtk_to_numpy(data.GetArray(name))


def test_quadratic_cells_of_a_region_share_their_nodes(state, grid):
    mesh = state.model.mesh
    nodes = region_nodes(mesh)
    points = numpy_support.vtk_to_numpy(grid.GetPoints().GetData())
    cells = numpy_support.vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 10)
    np.testing.assert_array_equal(points, mesh.points[nodes.node])
    np.testing.assert_array_equal(cells, nodes.cells)
    node = array(grid.GetPointData(), "node")
    np.testing.assert_array_equal(node[cells], mesh.cells)
    doubled = set(cells[mesh.region("base")].ravel()) & set(cells[mesh.region("body")].ravel())
    assert not doubled
    assert {grid.GetCellType(i) for i in range(grid.GetNumberOfCells())} == {24}


def test_vtk_sees_the_cells_as_we_do(state, grid):
    """A wrong order of the mid-side nodes would fold the cells: VTK's own interpolation gives their centers."""
    mesh = state.model.mesh
    weights = np.array([-0.125] * 4 + [0.25] * 6)
    for i in (0, 7, len(mesh.cells) - 1):
        cell, center, result = grid.GetCell(i), [0.25] * 3, [0.0] * 3
        cell.EvaluateLocation(
            __import__("vtkmodules.vtkCommonCore", fromlist=["reference"]).reference(0), center, result, [0.0] * 10
        )
        assert result == pytest.approx(weights @ mesh.points[mesh.cells[i]], abs=1e-12)
        assert cell.IsA("vtkQuadraticTetra")


def test_fields_come_back(state, grid):
    at, data = StateFields(state), grid.GetPointData()
    np.testing.assert_array_equal(array(data, "displacement"), state.displacement[array(data, "node")])
    np.testing.assert_allclose(array(data, "von_mises"), at.von_mises, rtol=1e-6)
    np.testing.assert_allclose(array(data, "stretch"), at.stretch, rtol=1e-6)
    np.testing.assert_allclose(array(data, "mean_stress"), at.mean_stress, rtol=1e-6)
    cauchy = array(data, "cauchy_stress")
    for k, (i, j) in enumerate(PAIRS):
        np.testing.assert_allclose(cauchy[:, k], at.cauchy_stress[:, i, j], rtol=1e-6)
        assert data.GetArray("cauchy_stress").GetComponentName(k) == "XYZ"[i] + "XYZ"[j]


def test_units_and_regions_are_stated(state, grid):
    key = __import__("vtkmodules.vtkCommonCore", fromlist=["vtkDataArray"]).vtkDataArray.UNITS_LABEL()
    units = {n: grid.GetPointData().GetArray(n).GetInformation().Get(key) for n in ("displacement", "von_mises")}
    assert units == {"displacement": "m", "von_mises": "Pa"}
    assert list(state.model.mesh.regions) == ["base", "body"]
    assert [array(grid.GetFieldData(), f"region:{name}")[0] for name in ("base", "body")] == [0, 1]
    region = array(grid.GetCellData(), "region")
    np.testing.assert_array_equal(np.flatnonzero(region == 1), state.model.mesh.region("body"))
    assert array(grid.GetFieldData(), "load_factor")[0] == 0.7


def test_every_program_reads_the_arrays(state, tmp_path):
    """VTK reads arrays of text, too; meshio, which has no arrays but of numbers, then reads nothing."""
    staged = replace(state, stage='fill "slowly" & stop')
    write_state(tmp_path / "state.vtu", staged)
    write_mesh_vtu(tmp_path / "mesh.vtu", state.model.mesh)
    for file in (tmp_path / "state.vtu", tmp_path / "mesh.vtu"):
        whole = ElementTree.parse(file).getroot().find("UnstructuredGrid")
        assert {part.tag for part in whole} == {"FieldData", "Piece"}
        arrays = [each for part in whole.iter() if part.tag in SECTIONS for each in part]
        assert len(arrays) > 8
        assert {each.tag for each in arrays} == {"DataArray"}
        assert {each.get("type") for each in arrays} <= {"Float64", "Float32", "Int32", "UInt8"}
    assert array(read(tmp_path / "state.vtu").GetFieldData(), f"stage:{staged.stage}")[0] == 0


def test_mean_stress_is_linear_between_vertices(state):
    at = StateFields(state)
    cell = state.model.mesh.cells[3]
    assert at.mean_stress[cell[4]] == pytest.approx(state.mean_stress[cell[[0, 1]]].mean())
    assert at.mean_stress[cell[9]] == pytest.approx(state.mean_stress[cell[[2, 3]]].mean())
    np.testing.assert_allclose(at.mean_stress[: len(state.mean_stress)], state.mean_stress, rtol=1e-12)


@pytest.mark.parametrize(("hollow", "times", "meaning"), [(True, [0, 20, 50], "pressure [kPa]"),
                                                          (False, [0, 0.4, 1], "load factor")])  # fmt: skip
def test_series_is_listed_by_what_drives_it(tmp_path, hollow, times, meaning):
    model = cases.model(cases.body(hollow=hollow), pressure=50e3)
    path = [cases.state(model, cases.stretched(1 + f), f) for f in (0.0, 0.4, 1.0)]
    pvd = write_series(tmp_path, cases.solution(path))
    sets = ElementTree.parse(pvd).getroot().findall("./Collection/DataSet")
    assert [float(s.get("timestep")) for s in sets] == times
    assert f"timestep is the {meaning}" in pvd.read_text()
    last = read(tmp_path / sets[-1].get("file"))
    node = array(last.GetPointData(), "node")
    np.testing.assert_array_equal(array(last.GetPointData(), "displacement"), path[-1].displacement[node])
    assert array(last.GetFieldData(), "von_mises_p99")[0] == von_mises_p99(path[-1])
    assert array(last.GetFieldData(), "principal_stretch_p99")[0] == pytest.approx(2.0)


def test_pyvista_opens_the_series(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    model = cases.model(cases.body(half=True))
    pvd = write_series(tmp_path, cases.solution([cases.state(model, None, 0.0), cases.state(model)]))
    reader = pyvista.get_reader(str(pvd))
    assert reader.time_values == [0.0, 50.0]
    assert reader.read()[0].n_cells == len(model.mesh.cells)
