"""Bodies that start with a velocity: a cube that is thrown, a block that swings on springs, a bar that stays at rest.

Problem: a free cube of 10 mm starts with (1, 0, 2) m/s under its weight. A block of 10 mm on springs of 0.1 MPa/m
starts along their normal with 0.1 m/s. A bar hangs by its end under a weight that is there from the start.
Exact: x = v t, z = v t − g t² / 2; u = v sin(ωt) / ω with ω² = k / (ρ h); no motion.
Source: Newton's second law.
Tolerance: 1e-6 of the way for the throw; 1 % of the amplitude for the block, which is no rigid body (kh/3E = 0.05 %),
and whose steps have an error of 0.1 % each; 1e-6 of the displacement for the bar.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.model.loads import STANDARD_GRAVITY

SIDE, DENSITY, BED = 10e-3, 1000.0, 1e5
RUBBER = problems.rubber(problems.NEO_HOOKE, 100 * problems.NEO_HOOKE.shear_modulus, DENSITY)
WEIGHT = tg.Gravity((0, 0, -1), history="constant")


def block() -> tg.Mesh:
    return meshes.box((SIDE, SIDE, SIDE), (1, 1, 1), kind=HEXAHEDRON)


def test_a_cube_that_is_thrown(record_verification):
    duration, speed = 0.2, (1.0, 0.0, 2.0)
    motion = tg.Dynamic(duration=duration, velocity=("1 m/s", 0, "2 m/s"), tolerance=1e-9)
    state = problems.solve(tg.Model(block(), RUBBER, [], [WEIGHT]), motion).states[-1]
    exact = np.array(speed) * duration - [0, 0, 0.5 * STANDARD_GRAVITY * duration**2]
    off = np.abs(state.displacement - exact).max() / np.abs(exact).max()
    record_verification(
        "Cube that is thrown: largest error of the way",
        "Newton's second law",
        "0",
        f"{off:.1e}",
        "1e-6",
    )
    assert off < 1e-6


def test_a_block_on_springs_swings(record_verification):
    mesh, speed = block(), 0.1
    omega = np.sqrt(BED / (DENSITY * SIDE))
    supports = [tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.supports.Foundation("z0", BED)]
    motion = tg.Dynamic(duration=2 * np.pi / omega, velocity=(0, 0, speed), accuracy=1e-4)
    states = problems.solve(tg.Model(mesh, RUBBER, supports, []), motion).states
    moved = np.array([state.displacement[:, 2].mean() for state in states])
    exact = speed / omega * np.sin(omega * np.array([state.time for state in states]))
    off = np.abs(moved - exact).max() * omega / speed
    record_verification(
        "Block on springs with a velocity: largest error over one period, of the amplitude",
        "Newton's second law",
        "0",
        f"{100 * off:.2g} %",
        "1 %",
    )
    assert off < 0.01


def test_a_bar_under_its_weight_stays_at_rest():
    mesh = block()
    states = problems.solve(tg.Model(mesh, RUBBER, ["z1"], [WEIGHT]), tg.Dynamic(duration=0.05)).states
    hangs = np.abs(states[0].displacement).max()
    assert hangs > 1e-7
    assert np.abs(states[-1].displacement - states[0].displacement).max() == pytest.approx(0, abs=1e-6 * hangs)
