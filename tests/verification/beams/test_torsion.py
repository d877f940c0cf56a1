"""V09: a round bar that is twisted at constant length needs the exact torque, and pushes its ends apart.

Problem: radius 10 mm, length 10 mm, incompressible neo-Hookean (C10 = 0.12 MPa) and Mooney–Rivlin (0.10, 0.02 MPa) of
one shear modulus; the ends are turned against each other by τ times the length, up to τA = 1.
Exact: T = π τ A⁴ (C10 + C01), N = −½ π A⁴ τ² (C10 + 2 C01); both rubbers have the same torque, and only the axial force
(Poynting's effect) tells them apart. Source: Rivlin 1948.
Tolerance: torque 0.2 %, axial force 1 %, with cells of 3 mm.
"""

import numpy as np
import pytest

import problems
import turgor as tg
from problems import MM, MPA
from turgor.core.geometry.solids import RoundBar

RADIUS, LENGTH = 10 * MM, 10 * MM
TWISTS = (0.2, 0.5, 1.0)  # τA
TABLE = {  # law, torque [N mm], axial force [N]
    "neo-Hookean": (problems.NEO_HOOKE, (75.398224, 188.49556, 376.99112), (-0.75398224, -4.7123890, -18.849556)),
    "Mooney-Rivlin": (
        tg.laws.MooneyRivlin(C10=0.10 * MPA, C01=0.02 * MPA),
        (75.398224, 188.49556, 376.99112),
        (-0.87964594, -5.4977871, -21.991149),
    ),
}


@pytest.fixture(scope="module")
def bar():
    return tg.mesh(RoundBar(radius=RADIUS, length=LENGTH).build(), size=3 * MM)


def _turned(points, load_factor):
    """Displacement of the ends: turned about x by τ times their x, with τA = 1 at last."""
    angle = load_factor * points[:, 0] / RADIUS
    x, y, z = points.T
    turned = np.column_stack([x, y * np.cos(angle) - z * np.sin(angle), y * np.sin(angle) + z * np.cos(angle)])
    return turned - points


def _torque_and_force(state):
    """On the end at positive x: torque about x [N mm], axial force [N]."""
    nodes = state.model.mesh.face_nodes("ends")
    nodes = nodes[state.model.mesh.points[nodes, 0] > 0]
    arm, force = problems.current(state)[nodes], state.nodal_force[nodes]
    return float((arm[:, 1] * force[:, 2] - arm[:, 2] * force[:, 1]).sum()) / MM, float(force[:, 0].sum())


@pytest.mark.parametrize("name", TABLE)
def test_torque_and_axial_force(name, bar, record_verification):
    law, torques, forces = TABLE[name]
    model = problems.one_material(bar, law, supports=[tg.Displacement("ends", _turned)])
    solution = problems.solve(model, tg.Static(at=TWISTS[:-1], tolerance=1e-8))
    results = [_torque_and_force(problems.state_at(solution, twist)) for twist in TWISTS]
    torque, force = zip(*results, strict=True)
    what = f"round bar twisted to τA = 0.2, 0.5, 1, {name}"
    record_verification(f"{what}: torque [N mm]", "V09, exact", torques, torque, "0.2 %")
    record_verification(f"{what}: axial force [N]", "V09, exact", forces, force, "1 %")
    assert torque == pytest.approx(torques, rel=2e-3)
    assert force == pytest.approx(forces, rel=1e-2)
