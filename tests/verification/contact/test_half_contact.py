"""V16, V22: half of a body with a mirror plane meets an obstacle as the whole body does.

Problem: a block pressed by a ball that lies in its mirror plane, held rigidly or by a spring, or with friction.
Exact: the same displacement; twice the force. Tolerance: 1e-7, what the Newton tolerance leaves; 1e-4 with friction,
whose limits are renewed until they change by no more than that. Friction depends on the way, so both go in equal small
steps. The whole is built of two mirrored blocks, so its cells are those of the half and their images.
"""

import numpy as np
import pytest

import contact_cases
import meshes
import problems
import turgor as tg
from meshes import Block
from problems import MM
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.model.contact import Contact
from turgor.core.model.obstacles import Obstacle, Sphere

SIZE = np.array([10, 5, 5]) * MM
NAMES = {"x0": "x0", "x1": "x1", "y1": "y1", "z0": "z0", "z1": "z1"}
BALL = Sphere(center=(4 * MM, 0, 10 * MM), radius=5 * MM)


def _half(kind):
    return meshes.glued([Block((3, 2, 2), lambda p: p * SIZE, {**NAMES, "y0": "symmetry_y"})], kind=kind)


def _whole(kind):
    right = Block((3, 2, 2), lambda p: p * SIZE, NAMES)
    left = Block((3, 2, 2), lambda p: p * SIZE * [1, -1, 1], NAMES, mirrored=True)
    return meshes.glued([right, left], kind=kind)


def _solve(mesh, share=1.0, step=0.2, **more):
    path = [(0, (0, 0, 0)), (1, (0.4 * share * MM, 0, -1.2 * share * MM))]
    ball = Obstacle(**{"name": "ball", "shape": BALL, "path": path, "stiffness": 5e10} | more)
    model = tg.Model(
        mesh, {"body": problems.rubber(problems.NEO_HOOKE)}, [tg.Fixed("z0")], [], contact=Contact(False, [ball])
    )
    return problems.solve(model, tg.Static(first_step=step, max_step=step, tolerance=1e-10)).states[-1]


CASES = {"held": {}, "sprung": {"spring": 1500.0}, "with friction": {"friction": 0.4, "share": 0.4}}

# with friction both must take the same steps: a state depends on them, and step control on counts of iterations
STEPS = {HEXAHEDRON: 0.02, TETRAHEDRON: 0.025}


@pytest.mark.parametrize("kind", [HEXAHEDRON, TETRAHEDRON], ids=lambda kind: kind.name)
@pytest.mark.parametrize("case", CASES)
def test_half_is_the_whole(case, kind, record_verification):
    step = STEPS[kind] if case == "with friction" else 0.2
    half, whole = (_solve(mesh, step=step, **CASES[case]) for mesh in (_half(kind), _whole(kind)))
    nodes = [meshes.node_at(whole.model.mesh, point) for point in half.model.mesh.points]
    push = [contact_cases.push(state.touches["ball"]) for state in (half, whole)]
    places = [state.touches["ball"].place for state in (half, whole)]
    errors = [
        contact_cases.apart(half.displacement, whole.displacement[nodes]),
        contact_cases.apart(2 * push[0][[0, 2]], push[1][[0, 2]]),
        contact_cases.apart(places[0], places[1]),
    ]
    record_verification(
        claim=f"half against whole under a ball {case}, {kind.name}: displacement, force, place of the ball, relative",
        source="V22, exact",
        expected=[0.0, 0.0, 0.0],
        got=errors,
        tolerance="1e-4" if case == "with friction" else "1e-7",
    )
    assert max(errors) < (1e-4 if case == "with friction" else 1e-7)
    assert push[1][2] < -0.1
    assert 2 * half.touches["ball"].area == pytest.approx(whole.touches["ball"].area, rel=1e-6)
    assert half.touches["ball"].penetration == pytest.approx(whole.touches["ball"].penetration, rel=1e-6)
