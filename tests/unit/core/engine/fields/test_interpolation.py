"""Fields carried from one mesh to another one of the same body."""

import numpy as np
import pytest

import turgor as tg
from turgor.core.engine.cells.element import element_of
from turgor.core.engine.interpolation import Interpolation
from turgor.units import MPa, mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.1 * MPa))


def quadratic(points: np.ndarray) -> np.ndarray:
    """A field that ten-node tetrahedra with straight edges hold exactly."""
    x, y, z = (points / mm).T
    return np.stack([x * y + z, z**2 - x, 1 + x * z - y**2], axis=1)


@pytest.fixture(scope="module")
def meshes() -> tuple[tg.Mesh, tg.Mesh]:
    bar = tg.bodies.Block(width=10 * mm, height=6 * mm, length=20 * mm).build()
    return tg.mesh(bar, size=5 * mm), tg.mesh(bar, size=2.7 * mm)


def test_a_quadratic_field_is_carried_exactly(meshes: tuple[tg.Mesh, tg.Mesh]) -> None:
    coarse, fine = meshes
    for one, other in (meshes, meshes[::-1]):
        carried = Interpolation(one, other).nodal(quadratic(one.points))
        assert carried == pytest.approx(quadratic(other.points), abs=1e-9)
    assert len(fine.points) > 2 * len(coarse.points)


def test_a_linear_mean_stress_is_carried_exactly(meshes: tuple[tg.Mesh, tg.Mesh]) -> None:
    models = [tg.Model(mesh, materials={"body": RUBBER}, supports=[tg.Fixed("ends")], loads=[]) for mesh in meshes]
    fields = []
    for model in models:
        element, mesh = element_of(model), model.mesh
        out = np.zeros(element.mean_count)
        out[element.mean] = (mesh.points[mesh.cells[:, :4]] / mm) @ [1.0, -2.0, 0.5]
        fields.append(out)
    carried = Interpolation(*meshes).mean_stress(*models, fields[0])
    assert carried == pytest.approx(fields[1], abs=1e-9)
