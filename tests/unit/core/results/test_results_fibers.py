"""Threads in results: their files for ParaView and their lines in pictures."""

from dataclasses import replace

import matplotlib.image
import numpy as np
import pytest
import results_cases as cases

import turgor as tg
from refused import refused
from turgor.core.geometry.actuators.fiber_reinforced_cylinder import FiberReinforcedCylinder
from turgor.core.materials.laws.laws import Hooke, NeoHooke
from turgor.core.meshing.generate import mesh
from turgor.core.model.fibers import Fibers, Winding
from turgor.core.results.fields.fibers import fiber_results
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.files.vtu import write_series
from turgor.core.results.files.vtu_overlays import threads_text
from turgor.core.results.measures.measures import find_measure
from turgor.core.solvers.solution import State
from turgor.units import deg, kPa, mm
from turgor.views.pictures.state_picture import shared_view, write_picture

KEVLAR = tg.Material(name="kevlar", law=Hooke(E=31067e6, nu=0.36))
RADIUS = 8.35 * mm
#: Distance between threads; six whole ones of each hand begin at the start of the tube.
SPACING = {"smeared": 4 * mm, "discrete": 2 * np.pi * RADIUS * np.cos(60 * deg) / 6}
RUBBER = tg.Material(name="rubber", law=NeoHooke(C10=0.12e6))


@pytest.fixture(scope="module")
def body():
    return mesh(FiberReinforcedCylinder(length=30 * mm).build(), size=8 * mm, cells="hexahedra")


def state_of(body, form="discrete", *, wound=True):
    winding = Winding(angle_from_circumference=30 * deg, spacing=4 * mm, hand="both")
    fibers = Fibers(face="outside", material=KEVLAR, diameter=0.2 * mm, winding=winding, form=form)
    model = tg.Model(
        body, {"body": RUBBER}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 10 * kPa)],
        reinforcements=[fibers] if wound else [],
    )  # fmt: skip
    return State(
        model=model, load_factor=1.0, displacement=body.points * np.array([0.01, 0.1, 0.1]),
        mean_stress=np.zeros(body.vertex_count), nodal_force=np.zeros_like(body.points),
    )  # fmt: skip


def test_vtk_reads_the_threads_and_their_tension(body, tmp_path):
    vtk_io = pytest.importorskip("vtkmodules.vtkIOXML")
    numpy_support = pytest.importorskip("vtkmodules.util.numpy_support")
    state = state_of(body)
    pvd = write_series(tmp_path, cases.solution([replace(state, load_factor=0.0), state]))
    assert "state_threads_0001.vtu" in (tmp_path / "state_threads.pvd").read_text()
    assert "threads" not in pvd.read_text()
    reader = vtk_io.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(tmp_path / "state_threads_0001.vtu"))
    reader.Update()
    grid = reader.GetOutput()
    result = fiber_results(state)[0]
    assert grid.GetNumberOfCells() == len(result.tension)
    assert {grid.GetCellType(k) for k in range(grid.GetNumberOfCells())} == {3}
    tension = numpy_support.vtk_to_numpy(grid.GetCellData().GetArray("tension"))
    assert tension == pytest.approx(result.tension, rel=1e-5)
    points = numpy_support.vtk_to_numpy(grid.GetPoints().GetData()).reshape(-1, 2, 3)
    line = result.threads.polylines(body.points + state.displacement)[0]
    assert points[: len(line) - 1, 0] == pytest.approx(line[:-1])
    assert np.linalg.norm(line[:, 1:], axis=1) == pytest.approx(1.1 * RADIUS, rel=1e-3)


def test_smeared_fibers_have_a_tension_but_no_file(body):
    state = state_of(body, "smeared")
    assert threads_text(StateFields(state)) == ""
    smeared, discrete = (find_measure("maximum_fiber_tension")(state_of(body, f)) for f in ("smeared", "discrete"))
    stretch = np.hypot(1.01 * np.cos(60 * deg), 1.1 * np.cos(30 * deg))
    exact = state.model.reinforcements[0].stretching_stiffness * (stretch - 1)
    assert [smeared, discrete] == pytest.approx([exact, exact], rel=0.01)
    with refused("'maximum_fiber_tension'", "no fibers"):
        find_measure("maximum_fiber_tension")(state_of(body, wound=False))


@pytest.mark.parametrize("form", ["smeared", "discrete"])
def test_pieces_have_a_place_and_a_weight(body, form):
    state = state_of(body, form)
    result = fiber_results(state)[0]
    assert np.linalg.norm(result.positions[:, 1:], axis=1) == pytest.approx(1.1 * RADIUS, rel=2e-3)
    assert result.positions[:, 0].min() > 0
    assert result.positions[:, 0].max() < 1.01 * 30 * mm
    quarter, hands = 2 * np.pi * RADIUS * 30 * mm / 4, 2
    expected = quarter if form == "smeared" else quarter / SPACING[form]
    assert result.weights.sum() == pytest.approx(hands * expected, rel=2e-3)


@pytest.mark.parametrize("form", ["smeared", "discrete"])
def test_winding_force_is_the_part_around_the_axis(body, form):
    """Both hands: 2 T / s for each width, seen on the current surface, of which the part around the axis counts."""
    state = state_of(body, form)
    fibers = state.model.reinforcements[0]
    stretch = np.hypot(1.01 * np.cos(60 * deg), 1.1 * np.cos(30 * deg))
    around = 1.1 * np.cos(30 * deg) / stretch
    tension = fibers.stretching_stiffness * (stretch - 1)
    exact = 2 * tension / SPACING[form] * stretch * around**2 / (1.1 * 1.01)
    assert find_measure("winding_force_per_length")(state) == pytest.approx(exact, rel=0.01)
    with refused("'winding_force_per_length'", "no fibers"):
        find_measure("winding_force_per_length")(state_of(body, wound=False))


def test_axial_threads_hold_nothing_around_and_windings_of_one_face_add_up(body):
    state = state_of(body)
    hoops, straight = (
        Fibers(face="outside", material=KEVLAR, diameter=0.2 * mm,
               winding=Winding(angle_from_axis=angle * deg, spacing=4 * mm))
        for angle in (90, 0)
    )  # fmt: skip

    def force(*fibers):
        model = replace(state.model, reinforcements=fibers)
        return find_measure("winding_force_per_length")(replace(state, model=model))

    exact = hoops.stretching_stiffness * 0.1 / (4 * mm * 1.01)
    assert force(hoops) == pytest.approx(exact, rel=0.01)
    assert force(straight) == pytest.approx(0, abs=1e-3 * exact)
    assert force(hoops, straight, hoops) == pytest.approx(2 * force(hoops), rel=1e-3)


@pytest.mark.parametrize("form", ["smeared", "discrete"])
def test_pictures_show_the_threads(body, form, tmp_path):
    images = []
    for wound in (True, False):
        path = tmp_path / f"{wound}.png"
        state = state_of(body, form, wound=wound)
        write_picture(path, state, shared_view([state], width=600))
        images.append(matplotlib.image.imread(path)[:, :, :3])
    darker = np.abs(images[1] - images[0]).sum(axis=2) > 0.05
    seen = images[1].min(axis=2) < 0.99
    assert 0.01 < darker.sum() / seen.sum() < 0.3
    assert (darker & ~seen).sum() < 0.05 * darker.sum()  # half their width beyond the outline


def force_of_a_tube(inner, outer, pressure):
    """q b of a tube of incompressible rubber in hoops that do not give way, closed ends free; small strain.

    With u = −e r/2 + C/r, u(b) = 0, σᵣ(a) = −p and the axial force π a² p:
    q = p − μ e (b²/a² − 1), and μ e (b²/a² + 3) = p b²/(b² − a²).
    """
    share = (outer / inner) ** 2
    axial = pressure * share / (share - 1) / (share + 3)
    return (pressure - axial * (share - 1)) * outer


def test_winding_force_leaves_the_ends_out():
    part = FiberReinforcedCylinder(length=60 * mm)
    body = mesh(part.build(), size=6 * mm, cells="hexahedra")
    rubber = tg.Material(name="rubber", law=NeoHooke(C10=120 * kPa))
    thread = tg.Material(name="thread", law=Hooke(E=200e9, nu=0.3))
    winding = Winding(angle_from_axis=90 * deg, spacing=2 * mm)
    hoops = Fibers(face="outside", material=thread, diameter=0.2 * mm, winding=winding)
    loads = [tg.Pressure("cavity", 1 * kPa)]
    model = tg.Model(body, {"body": rubber}, [tg.Fixed("fixed")], loads, reinforcements=[hoops])
    state = tg.solve(model, tg.Static(first_step=1.0)).states[-1]
    outer = part.inner_radius + part.wall
    force = find_measure("winding_force_per_length")(state)
    assert force == pytest.approx(force_of_a_tube(part.inner_radius, outer, 1 * kPa), rel=0.02)
