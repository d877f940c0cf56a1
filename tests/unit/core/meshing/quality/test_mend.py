"""Curved cells that are inside out, or nearly, are straightened where it is needed and nowhere else."""

from dataclasses import replace

import numpy as np
import pytest
from meshing_cases import filleted_pneunet, slotted_block, thin_tube

from refused import refused
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing import generate
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.mesh import TETRAHEDRON_EDGES, Mesh
from turgor.core.meshing.quality.cell_quality import cell_volumes, jacobian_ratios, refuse_inverted
from turgor.core.meshing.quality.checks import check_mesh
from turgor.core.meshing.quality.settings import STRAIGHTENING
from turgor.core.meshing.quality.straightening import mended
from turgor.core.meshing.sizing.settings import SIZING
from turgor.foundation.finding import Severity
from turgor.units import mm


@pytest.fixture
def as_generated(monkeypatch: pytest.MonkeyPatch):
    """Mesh without mending and refusing, with as many cells along arcs as wanted."""

    def make(geometry: Geometry, size: float, curvature: float) -> Mesh:
        monkeypatch.setattr(generate, "SIZING", replace(SIZING, cells_per_radius=curvature))
        with monkeypatch.context() as patch:
            patch.setattr(generate, "mended", lambda made: made)
            patch.setattr(generate, "refuse_inverted", lambda made: None)
            return mesh(geometry, size=size)

    return make


@pytest.mark.parametrize("curvature", [0.5, 1.0])
def test_fillets_and_an_inlet_meshed_too_coarsely_are_mended(as_generated, curvature: float) -> None:
    geometry = filleted_pneunet()
    bent = as_generated(geometry, size=4 * mm, curvature=curvature)
    bad = jacobian_ratios(bent) < STRAIGHTENING.jacobian_ratio
    assert 0 < bad.sum() < 0.1 * len(bad)
    made = mesh(geometry, size=4 * mm)
    assert jacobian_ratios(made).min() >= STRAIGHTENING.jacobian_ratio
    assert np.array_equal(made.cells, bent.cells)
    moved = np.flatnonzero((made.points != bent.points).any(axis=1))
    assert set(moved) <= set(np.unique(bent.cells[bad][:, 4:]))  # mid-side nodes of bad cells only
    (finding,) = check_mesh(made)[:1]
    assert finding.code == "G08"
    assert finding.message.startswith(f"{bad.sum()} of {len(bad)} curved cells were inverted or nearly so")
    missed = np.linalg.norm(made.points - bent.points, axis=1).max() / mm
    assert f"deviates from the surface by up to {missed:.2g} mm" in finding.message
    assert finding.severity is (Severity.WARNING if curvature < 1 else Severity.NOTE)
    assert cell_volumes(made).sum() == pytest.approx(geometry.solid_volume, rel=1e-3)


@pytest.mark.parametrize("shape", [filleted_pneunet, slotted_block, thin_tube])
def test_the_default_mesh_of_hard_shapes_can_be_solved(shape) -> None:
    made = mesh(shape())
    assert jacobian_ratios(made).min() >= STRAIGHTENING.jacobian_ratio
    assert all(finding.severity is not Severity.ERROR for finding in check_mesh(made))
    assert all(finding.severity is Severity.NOTE for finding in made.findings)  # the surface is followed


def test_a_mesh_with_nothing_to_mend_stays_itself() -> None:
    made = mesh(FastPneuNet(chambers=1, length=20 * mm).build(), size=4 * mm)
    assert mended(made) is made
    assert made.findings == ()


def one_cell() -> tuple[np.ndarray, np.ndarray]:
    points = np.vstack([np.zeros(3), np.eye(3)])
    mids = np.array([(points[a] + points[b]) / 2 for a, b in TETRAHEDRON_EDGES])
    return np.vstack([points, mids]), np.arange(10)[None]


@pytest.mark.parametrize("bend", [0.3, 0.6, 3.0])
def test_an_edge_is_straightened_as_little_as_it_takes(bend: float) -> None:
    points, cells = one_cell()
    points[4, 2] += bend
    made = mended(Mesh(points=points, cells=cells, regions={"body": np.array([0])}, faces={}))
    left = made.points[4, 2]
    assert jacobian_ratios(made)[0] >= STRAIGHTENING.jacobian_ratio
    assert left > 0
    halvings = np.log2(bend / left)
    assert halvings == pytest.approx(round(halvings))
    worse = made.points.copy()
    worse[4, 2] *= 2
    before = Mesh(points=worse, cells=cells, regions={"body": np.array([0])}, faces={})
    assert jacobian_ratios(before)[0] < STRAIGHTENING.jacobian_ratio  # half as much would not have done
    assert np.array_equal(np.delete(made.points, 4, axis=0), np.delete(points, 4, axis=0))


def test_a_cell_that_is_inside_out_with_straight_edges_cannot_be_mended() -> None:
    points, cells = one_cell()
    made = mended(Mesh(points=points * [1, 1, -1], cells=cells, regions={"body": np.array([0])}, faces={}))
    with refused("1 of 1", "(250, 250, -250) mm"):
        refuse_inverted(made)
