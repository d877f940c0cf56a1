"""A bar that is held at one end and tied to a reference point at the other, for the tests of reference points."""

import numpy as np
from turgor.supports import ReferencePoint

import meshes
import problems
import turgor as tg
from turgor.core.engine.system import System
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.model.points import Rotation

#: Length and side of the bar [m].
LENGTH, SIDE = 40e-3, 10e-3


def bar(kind=TETRAHEDRON, counts=(4, 2, 2), half=False) -> tg.Mesh:
    """A bar along x, centered in y; its half with y ≥ 0 if ``half``."""
    size = (LENGTH, SIDE / 2 if half else SIDE, SIDE)
    across = counts[1] // 2 if half else counts[1]
    low = 0.0 if half else SIDE / 2

    def place(points):
        return points - np.array([0.0, low, 0.0])

    made = meshes.box(size, (counts[0], across, counts[2]), place, kind=kind)
    faces = {"symmetry_y" if half and name == "y0" else name: sides for name, sides in made.faces.items()}
    return tg.Mesh(points=made.points, cells=made.cells, regions=made.regions, faces=faces)


def rig(point: ReferencePoint, supports=(), loads=(), mesh=None, **material) -> tg.Model:
    """The bar with a reference point, held at x0."""
    rubber = problems.rubber(problems.NEO_HOOKE, **material)
    return tg.Model(
        mesh or bar(), materials={"body": rubber}, supports=[tg.Fixed("x0"), point, *supports], loads=list(loads)
    )


def turned(system: System, seed: int, axis=(1, 2, 3), angle=1.3) -> np.ndarray:
    """Unknowns of the bar after a large rotation, disturbed at random; no follower has a value of its own."""
    rng = np.random.default_rng(seed)
    points = system.model.mesh.points
    arms = points - points.mean(axis=0)
    rotation = Rotation("any", angle, axis).matrix(1.0)
    unknowns = system.unknowns(arms @ (rotation - np.eye(3)).T, np.zeros(system.element.mean_count))
    disturbance = 0.03 * rng.standard_normal(system.size)
    disturbance[followers(system)] = 0.0
    return unknowns + disturbance


def followers(system: System) -> np.ndarray:
    """Unknowns that follow others: those of rigid faces."""
    rigid = [each.nodes for each in system.carriers if each.rigid]
    nodes = np.concatenate([np.zeros(0, dtype=np.int64), *rigid])
    return (3 * nodes[:, None] + np.arange(3)).ravel()


__all__ = ["HEXAHEDRON", "LENGTH", "SIDE", "TETRAHEDRON", "bar", "followers", "rig", "turned"]
