"""Rod strains: an actuator laid out as a helix has the curvature, twist and stretch that it was given.

The mesh is coarse: half a percent of the largest strain.
"""

import numpy as np
import pytest
import results_cases as cases

import turgor as tg
from refused import refused
from turgor.core.engine.cells.element import element_of
from turgor.core.results.measures.shape.rod_strains import rod_strains
from turgor.core.solvers.solution import State
from turgor.fast_models.section.kinematics import skew
from turgor.units import mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12e6))

STRETCH = 1.1
NAMES = ("curvature_y", "curvature_z", "twist", "stretch")


def helix(curvature):
    """Lay every section along a helix of the strains; the reference line passes through the middle of the body."""
    middle = np.array([0.0, 0.0, cases.HEIGHT / 2])
    kappa = np.array(curvature)
    angle = np.linalg.norm(kappa)
    K = skew(kappa)

    def place(points):
        turn = angle * points[:, 0]
        a, b, c = (f[:, None, None] for f in (np.sin(turn) / angle, (1 - np.cos(turn)) / angle**2, turn - np.sin(turn)))
        R = np.eye(3) + a * K + b * K @ K
        V = points[:, 0, None, None] * np.eye(3) + b * K + c / angle**3 * K @ K
        across = points * [0.0, 1.0, 1.0] - middle
        return (R @ across[..., None])[..., 0] + STRETCH * V[:, :, 0] + middle

    return place


@pytest.mark.parametrize("curvature", [(5.0, 10.0, -4.0), (-8.0, 0.0, 0.0), (0.0, 25.0, 0.0)])
def test_helix_is_found_again(curvature):
    state = cases.state(cases.model(cases.body()), helix(curvature))
    twist, about_y, about_z = curvature
    measures = rod_strains(0.2, 0.8, "part")
    assert [each.name for each in measures] == [f"part_{name}" for name in NAMES]
    got = [each(state) for each in measures]
    assert got == pytest.approx([about_y, about_z, twist, STRETCH], rel=5e-3, abs=0.06)


def test_ready_made_measures_are_known_by_name():
    result = tg.measures.middle_curvature_y
    assert result.name == "middle_curvature_y"
    assert "40%" in result.definition


def test_stations_out_of_order_and_too_few_cells_are_refused():
    with refused("0.6", "0.4", "0.4, 0.6"):
        rod_strains(0.6, 0.4, "part")
    state = cases.state(cases.model(cases.body()), lambda X: X)
    with refused("part_curvature_y", "0.04 mm", "10 mm"):
        rod_strains(0.5, 0.501, "part")[0](state)


@pytest.mark.parametrize(("cells", "scatter"), [("hexahedra", 1e-4), ("tetrahedra", 5e-3)])
def test_windows_of_a_uniform_actuator_agree(cells, scatter):
    """A bent tube whose sections widen across and warp: what windows give does not depend on where cells end."""
    mesh = tg.mesh(tg.actuators.EccentricBender(length=160 * mm).build(), size=6 * mm, cells=cells)
    model = tg.Model(mesh, {"body": RUBBER}, [tg.Fixed("fixed")], [])
    x, y, z = mesh.points.T
    place = helix((0.0, 5.0, 0.0))
    warped = np.column_stack([x, y + 30.0 * y * z + 200.0 * y * z**2, z + 15.0 * (z**2 - y**2) + 100.0 * y**2 * z])
    state = State(
        model=model,
        load_factor=1.0,
        displacement=place(warped) - mesh.points,
        mean_stress=np.zeros(element_of(model).mean_count),
        nodal_force=np.zeros_like(mesh.points),
    )
    for width in (0.2, 0.12):
        windows = [rod_strains(low, low + width, "window") for low in np.linspace(0.25, 0.75 - width, 7)]
        curvature = np.array([window[0](state) for window in windows])
        stretch = np.array([window[3](state) for window in windows])
        assert np.ptp(curvature) < scatter * curvature.mean()
        assert np.ptp(stretch) < scatter * stretch.mean()


def test_a_mesh_too_coarse_is_refused_before_the_solve():
    mesh = tg.mesh(tg.actuators.EccentricBender(length=40 * mm).build(), size=12 * mm, cells="hexahedra")
    model = tg.Model(mesh, {"body": RUBBER}, [tg.Fixed("fixed")], [])
    with refused("middle_twist", "40%", "60%", "8 mm", "8.222 mm"):
        tg.measures.check_measures(model, ["middle_twist"])
    tg.measures.check_measures(model, rod_strains(0.2, 0.8, "most"))
