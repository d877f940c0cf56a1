"""Small bodies and states made by formula for the tests of the room results: no solve."""

from collections.abc import Callable
from itertools import pairwise, permutations, product

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.element import element_of
from turgor.core.materials.laws.laws import NeoHooke
from turgor.core.materials.material import Material
from turgor.core.meshing.mesh import TETRAHEDRON_EDGES, Mesh
from turgor.core.meshing.surface import outer_triangles
from turgor.core.model.loads import Pressure
from turgor.core.model.model import Model
from turgor.core.model.supports import Fixed
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.solution import Solution, State, Status, Step

Array = NDArray[np.float64]

RUBBER = Material(name="rubber", law=NeoHooke(C10=0.12e6))

#: Outer dimensions of the body [m], and the same lattice for all tests: 4 x 4 x 3 bricks.
LENGTH, WIDTH, HEIGHT = 40e-3, 20e-3, 12e-3
COUNTS = (4, 4, 3)


def body(*, half: bool = False, hollow: bool = True, shift: float = 0.0) -> Mesh:
    """Box along x, centered about y = ``shift``; two bricks wide and long it is hollow. ``half`` keeps y >= shift."""
    bricks = [b for b in product(*map(range, COUNTS)) if not half or b[1] >= COUNTS[1] // 2]
    if hollow:
        bricks = [b for b in bricks if not (b[0] in (1, 2) and b[1] in (1, 2) and b[2] == 1)]
    lattice = np.array([brick_cell for brick in bricks for brick_cell in _brick(np.array(brick))])
    mids = np.stack([(lattice[:, a] + lattice[:, b]) // 2 for a, b in TETRAHEDRON_EDGES], axis=1)
    nodes = np.concatenate([lattice, mids], axis=1)
    places, inverse = np.unique(nodes.reshape(-1, 3), axis=0, return_inverse=True)
    cells = inverse.reshape(-1, 10)
    is_middle = np.ones(len(places), dtype=bool)
    is_middle[cells[:, :4]] = False
    order = np.argsort(is_middle, kind="stable")
    points = places[order] / (2.0 * np.array(COUNTS)) * [LENGTH, WIDTH, HEIGHT] + [0, shift - WIDTH / 2, 0]
    low = points[np.argsort(order)[cells]][:, :4, 2].mean(axis=1) < HEIGHT / 3
    regions = {"base": np.flatnonzero(low), "body": np.flatnonzero(~low)}
    bare = Mesh(points=points, cells=np.argsort(order)[cells], regions=regions, faces={}, name="box")
    return Mesh(points=points, cells=bare.cells, regions=regions, faces=_faces(bare, half, shift), name="box")


def _brick(corner: NDArray[np.int64]) -> list[NDArray[np.int64]]:
    """Six tetrahedra of one brick (Kuhn), in half-brick steps of the lattice, positively oriented."""
    cells = []
    for order in permutations(range(3)):
        steps = np.zeros((4, 3), dtype=np.int64)
        for k, axis in enumerate(order):
            steps[k + 1 :, axis] += 2
        if np.linalg.det(steps[1:] - steps[0]) < 0:
            steps[[1, 2]] = steps[[2, 1]]
        cells.append(2 * corner + steps)
    return cells


def _faces(mesh: Mesh, half: bool, shift: float) -> dict[str, NDArray[np.int64]]:
    triangles = outer_triangles(mesh)
    low, high = mesh.points[triangles].min(axis=1), mesh.points[triangles].max(axis=1)
    at = {
        "fixed": high[:, 0] < 1e-9,
        "tip": low[:, 0] > LENGTH - 1e-9,
        "symmetry_y": half & (high[:, 1] < shift + 1e-9),
        "outside": (abs(low[:, 1] - shift) > WIDTH / 2 - 1e-9) & (abs(high[:, 1] - shift) > WIDTH / 2 - 1e-9)
        | (high[:, 2] < 1e-9)
        | (low[:, 2] > HEIGHT - 1e-9),
    }
    at["cavity"] = ~np.any(list(at.values()), axis=0)
    return {name: triangles[on] for name, on in at.items() if on.any()}


def model(mesh: Mesh, pressure: float = 50e3) -> Model:
    """The body clamped at one end, with pressure in its cavity if it has one."""
    loads = [Pressure("cavity", pressure)] if "cavity" in mesh.faces else []
    return Model(mesh, {"body": RUBBER, "base": RUBBER}, [Fixed("fixed")], loads)


def state(question: Model, place: Callable[[Array], Array] | None = None, load_factor: float = 1) -> State:
    """The state in which every node X has moved to ``place(X)``, without mean stress and nodal forces."""
    points = question.mesh.points
    moved = points if place is None else np.asarray(place(points))
    return State(
        model=question, load_factor=load_factor, displacement=moved - points,
        mean_stress=np.zeros(element_of(question).mean_count), nodal_force=np.zeros_like(points),
    )  # fmt: skip


def solution(states: list[State], status: Status = Status.CONVERGED) -> Solution:
    """A path of given states."""
    steps = [
        Step(load_factor=b.load_factor, increment=b.load_factor - a.load_factor, iterations=4, residual=1e-9,
             accepted=True, seconds=0.5)
        for a, b in pairwise(states)
    ]  # fmt: skip
    return Solution(
        model=states[0].model, procedure=Static(), states=tuple(states), status=status, message="Reached 50 kPa.",
        steps=tuple(steps),
    )  # fmt: skip


def bent(angle: float) -> Callable[[Array], Array]:
    """Bend into a circle by an angle [rad] towards −z, cross-sections plane, the middle line keeping its length."""

    def place(points: Array) -> Array:
        x, y, z = points.T
        if angle == 0:
            return points
        turn, radius = angle * x / LENGTH, LENGTH / angle
        up = radius + z - HEIGHT / 2
        return np.stack([up * np.sin(turn), y, up * np.cos(turn) - radius + HEIGHT / 2], axis=1)

    return place


def stretched(stretch: float, center: float = 0.0) -> Callable[[Array], Array]:
    """Stretch along x at constant volume, about y = ``center``."""
    factors = np.array([stretch, stretch**-0.5, stretch**-0.5])
    return lambda points: (points - [0, center, 0]) * factors + [0, center, 0]
