"""Middles that follow: 20-node hexahedra whose sides and cells still have a node in their middle."""

from dataclasses import replace

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.cells.element import element_of
from turgor.core.engine.system import System
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.meshing.middles import middles_of
from turgor.core.meshing.sizing.settings import SIZING
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import swept_mesh
from turgor.core.model.contact import Contact
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Obstacle, Sphere
from turgor.units import MPa, kPa, mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.1 * MPa))
PAPER = tg.from_library("paper", record="hooke-polygerinos-2020")


def following(geometry: tg.Geometry, size: float) -> tg.Mesh:
    """A swept mesh whose middles follow, which by themselves they do in large ones."""
    return replace(swept_mesh(geometry, Fineness(size=size)), serendipity=True)


@pytest.fixture(scope="module")
def tube() -> tg.Mesh:
    """A closed tube: curved cells, and a radius that supports can fix."""
    return following(tg.actuators.ExtendingCylinder(length=20 * mm).build(), 8 * mm)


@pytest.fixture(scope="module")
def finger() -> tg.Mesh:
    """A finger with a strain-limiting layer."""
    return following(tg.FastPneuNet(chambers=1, length=12 * mm).build(), 6 * mm)


def pressed(mesh: tg.Mesh) -> Model:
    """A finger on paper, whose sheet and walls have forces at middles."""
    materials = {"body": RUBBER, "base": RUBBER, "strain_limiting_layer": tg.Membrane(PAPER, thickness=0.1 * mm)}
    return tg.Model(mesh, materials, [tg.Fixed("fixed")], [tg.Pressure("cavity", 5 * kPa)])


def closed(mesh: tg.Mesh) -> Model:
    """A tube under pressure."""
    return tg.Model(mesh, {"body": RUBBER}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 5 * kPa)])


def random_unknowns(system: System, size: float) -> np.ndarray:
    """Free unknowns at random."""
    values = size * np.random.default_rng(5).standard_normal(system.size)
    values[system.prescribed] = 0.0
    return values


def test_swept_cells_have_the_unknowns_of_20_nodes(tube: tg.Mesh) -> None:
    middles = np.unique(tube.cells[:, 20:])
    free = replace(tube, serendipity=False)
    assert tube.cell_type is HEXAHEDRON
    assert free.unknown_count - tube.unknown_count == 3 * len(middles)
    system = System(closed(tube))
    follows = np.flatnonzero(system.prescribed.reshape(-1)[: 3 * len(tube.points)].reshape(-1, 3).all(axis=1))
    assert np.isin(middles, follows).all()
    assert element_of(closed(tube)).cells.shape[1] == 20


def test_middles_follow_in_large_meshes_by_themselves() -> None:
    """Up to a number of unknowns, middles have their own."""
    fingers = (tg.FastPneuNet(chambers=count, length=count * 10 * mm).build() for count in (2, 11))
    small, large = (swept_mesh(finger, Fineness(size=3 * mm)) for finger in fingers)
    assert not small.serendipity
    assert large.serendipity
    assert replace(large, serendipity=False).unknown_count > SIZING.row > small.unknown_count


def test_places_and_displacements_of_middles_follow(finger: tg.Mesh) -> None:
    moved = replace(finger, points=finger.points + 1e-4 * np.random.default_rng(1).standard_normal(finger.points.shape))
    for mesh in (finger, moved):
        assert middles_of(mesh.cells).values(mesh.points) == pytest.approx(mesh.points, abs=1e-12)
    system = System(pressed(finger))
    u = system.displacement(random_unknowns(system, 1e-2))
    assert middles_of(finger.cells).values(u) == pytest.approx(u, abs=1e-12)


@pytest.mark.parametrize("name", ["tube", "finger"])
def test_tangent_is_the_derivative_of_the_residual(name: str, request: pytest.FixtureRequest) -> None:
    """Pressure, sheet and cells together; a pattern without room for the middles of the sheet would lose stiffness."""
    mesh = request.getfixturevalue(name)
    system = System(pressed(mesh) if name == "finger" else closed(mesh))
    at, along, free = random_unknowns(system, 5e-4), random_unknowns(system, 1.0), ~system.prescribed
    step = 1e-5
    exact = system.tangent(at, 0.7) @ along
    numeric = (system.residual(at + step * along, 0.7) - system.residual(at - step * along, 0.7)) / (2 * step)
    assert exact[free] == pytest.approx(numeric[free], abs=1e-6 * np.abs(numeric).max())


def test_tangent_has_the_middles_that_a_rigid_shape_presses(finger: tg.Mesh) -> None:
    """No cell couples middles; without room for them Newton's method converged linearly, or not at all."""
    top = finger.points[finger.face_nodes("tip")].mean(axis=0)
    ball = Obstacle(name="ball", shape=Sphere(center=tuple(top + [2.5 * mm, 0, 0]), radius=3 * mm))
    system = System(replace(pressed(finger), contact=Contact(False, [ball])))
    at, along, free = 0.0 * random_unknowns(system, 1.0), random_unknowns(system, 1.0), ~system.prescribed
    exact = system.tangent(at, 0.0) @ along
    step = 1e-6
    numeric = (system.residual(at + step * along, 0.0) - system.residual(at - step * along, 0.0)) / (2 * step)
    assert len(system.evaluate(at, 0.0).contacts.gaps[0].touching) > 3
    assert exact[free] == pytest.approx(numeric[free], abs=1e-5 * np.abs(numeric).max())


def test_exact_tangent_has_no_compressibility_of_its_own(tube: tg.Mesh) -> None:
    """Factors need some, which an adjoint must not see."""
    system = System(closed(tube))
    at = system.evaluate(random_unknowns(system, 1e-4), 0.5)
    means = slice(3 * system.node_count, 3 * system.node_count + system.element.mean_count)
    regular, exact = (
        np.abs(system.pattern.full(system.tangent_data(at, exact=which))[means, means]).max() for which in (False, True)
    )
    assert 0 == exact < regular < 1e-6


def test_rigid_rotation_has_no_stress(tube: tg.Mesh) -> None:
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    model = tg.Model(tube, {"body": RUBBER}, [], [])
    system = System(model)
    turned = system.unknowns(tube.points @ turn.T - tube.points, np.zeros(system.element.mean_count))
    shear = replace(system.evaluate(turned, 0.0), load_factor=0.0)
    assert np.abs(shear.residual[~system.prescribed]).max() < 1e-10


def test_middles_follow_in_hexahedra_alone() -> None:
    tetrahedra = tg.mesh(tg.FastPneuNet(chambers=1, length=12 * mm).build(), size=6 * mm, cells="tetrahedra")
    with refused(tetrahedra.name, "27"):
        replace(tetrahedra, serendipity=True)
