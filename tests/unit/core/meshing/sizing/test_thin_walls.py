"""Thin walls among thick ones get smaller cells where they are, and nowhere else."""

from dataclasses import replace

import numpy as np
import pytest
from meshing_cases import thin_roof, thin_tube

from refused import refused
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.mesh import TRIANGLE_EDGES, Mesh
from turgor.core.meshing.quality.checks import check_mesh
from turgor.core.meshing.sizing import thin_walls
from turgor.core.meshing.sizing import wall_sizes as fitted
from turgor.core.meshing.sizing.settings import THIN_WALLS
from turgor.core.meshing.sizing.thin_walls import ThinWalls, find_thin_walls, refuse_thin_walls
from turgor.core.meshing.surface import outer_triangles
from turgor.foundation.finding import Severity
from turgor.units import mm

SIZE = 5 * mm


@pytest.fixture(scope="module")
def suited() -> Mesh:
    return mesh(thin_roof(), size=SIZE, wall_cells=2)


def edges_near(made: Mesh, x: tuple[float, float], z: float) -> np.ndarray:
    """Lengths of the edges on a horizontal piece of surface."""
    surface = outer_triangles(made)
    middle = made.points[surface[:, :3]].mean(axis=1) / mm
    chosen = (abs(middle[:, 2] - z) < 1e-6) & (middle[:, 0] > x[0]) & (middle[:, 0] < x[1])
    chosen &= abs(middle[:, 1] - 10) < 4  # over the cavity
    corners = made.points[surface[chosen, :3]]
    return np.concatenate([np.linalg.norm(corners[:, a] - corners[:, b], axis=1) for a, b in TRIANGLE_EDGES])


def test_cells_suit_the_thin_roof_and_stay_large_elsewhere(suited: Mesh) -> None:
    assert check_mesh(suited) == ()
    assert len(find_thin_walls(suited, SIZE).points) == 0
    assert edges_near(suited, (22, 28), 20).max() < 3.01 * mm  # six times 0.5 mm
    assert edges_near(suited, (22, 58), 0).max() > 4 * mm


def test_the_thickness_is_measured_through_the_solid(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fitted, "THIN_WALLS", replace(THIN_WALLS, rounds=0))
    plain = mesh(thin_roof(), size=SIZE, wall_cells=2)
    walls = find_thin_walls(plain, SIZE)
    assert walls.thickness == pytest.approx(np.full(len(walls.points), 0.5 * mm))
    x, y, z = (walls.points / mm).T
    assert ((x > 18) & (x < 32) & (y > 3) & (y < 17)).all()
    assert set(np.round(z, 6)) == {19.5, 20.0}  # seen from both sides
    assert (walls.sizes(1) < walls.sizes(0)).all()
    (finding,) = check_mesh(plain)
    assert finding.code == "G09"
    assert f"In {len(walls.points)} places cells are more than six times as long" in finding.message
    assert "0.5 mm thick" in finding.message


def test_the_thickness_of_a_curved_wall_is_along_its_normal(monkeypatch: pytest.MonkeyPatch) -> None:
    every_wall = replace(THIN_WALLS, longest_per_wall=0.0)  # each counts as too thin for its cells
    monkeypatch.setattr(thin_walls, "THIN_WALLS", every_wall)
    result = find_thin_walls(mesh(thin_tube(), size=2 * mm), 4 * mm)
    assert len(result.points) > 0
    assert result.thickness == pytest.approx(np.full(len(result.points), 0.5 * mm), rel=0.2)


def test_without_wall_cells_a_note_says_that_thin_walls_have_shorter_cells() -> None:
    made = mesh(thin_roof(), size=SIZE)
    (finding,) = [each for each in made.findings if each.code == "G09"]
    assert finding.severity is Severity.NOTE
    assert (
        "size of 5 mm is more than four times the thinnest wall, 0.5 mm: walls thinner than 1.25 mm" in finding.message
    )
    assert edges_near(made, (22, 28), 20).max() < 3.01 * mm
    assert edges_near(made, (22, 58), 0).max() > 4 * mm


def test_a_face_with_a_size_keeps_it_where_its_wall_is_thin() -> None:
    made = mesh(thin_roof(), size=SIZE, face_sizes={"cavity": SIZE})
    (finding,) = [each for each in made.findings if each.code == "G09"]
    assert finding.severity is Severity.WARNING
    assert edges_near(made, (22, 28), 20).max() > 3.01 * mm
    firm = mesh(thin_roof(), size=SIZE, face_sizes={"cavity": SIZE}, wall_cells=2)  # asks for every wall
    assert edges_near(firm, (22, 28), 20).max() < 3.01 * mm


def test_walls_too_thin_for_their_area_are_refused_before_they_fill_the_memory() -> None:
    walls = ThinWalls(points=np.array([[1.0, 2, 3]]) * mm, thickness=np.array([1e-6]), areas=np.array([1e-6]))
    refuse_thin_walls(walls, "roof")  # one million unknowns
    with refused("roof", "111 million", "0.0001 mm", "(1, 2, 3) mm", "face_sizes"):
        refuse_thin_walls(replace(walls, thickness=np.array([1e-7])), "roof")


def test_no_size_is_larger_than_the_part() -> None:
    with refused("mesh size", "100 mm", "0.639 mm to 60 mm"):
        mesh(thin_roof(), size=100 * mm, wall_cells=2)
