"""A Cosserat rod against finite elements of slender fingers of rubber, solid and hollow, with and without pressure.

Problem: (a) a square bar 60 × 4 × 4 mm, (b) a square tube 80 × 6 × 6 mm with walls of 1.5 mm and closed ends; both
neo-Hookean with C10 = 0.12 MPa, clamped at one end, with a dead force across at the other, F L²/EI = 4 and 2. The tube
holds 0 or 40 kPa before the force comes. The rod has the initial moduli; by the theory of small strains a bare
closed tube of incompressible rubber does not get longer under pressure, so that the rod has no chamber.
Reference: turgor's 27-node hexahedra, 20 × 2 × 2 cells and one cell through the walls.
Tolerance: 2 % of the displacement of the tip for the bar and the empty tube: the clamp, which holds the thickness too,
costs most of it. 9 % at 40 kPa, where the walls bulge and stiffen the section, which the rod leaves out: 7.5 % were
seen. A section analysis gives the stiffness under pressure.
"""

import numpy as np
from turgor.rods import PlateForce, Rectangle, Rod, RodModel, RodSection, static

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON

YOUNG = 6 * problems.NEO_HOOKE.C10
BAR, SIDE = 60e-3, 4e-3
TUBE, OUTSIDE, WALL = 80e-3, 6e-3, 1.5e-3


def _solved(mesh, force, area, loads=(), history=((0, 0), (1, 1)), at=(1.0,)):
    """Displacement of the middle of the end at load factors, (n, 3)."""
    push = tg.Traction("x1", (0.0, 0.0, -force / area), history=history)
    model = tg.Model(mesh, {"body": problems.rubber(problems.NEO_HOOKE)}, [tg.Fixed("x0")], [push, *loads])
    solution = problems.solve(model, tg.Static(first_step=0.125, max_step=0.25, at=at))
    node = meshes.node_at(mesh, (mesh.points[:, 0].max(), 0, 0))
    return np.array([problems.state_at(solution, factor).displacement[node] for factor in at])


def _distance(found, expected):
    return np.linalg.norm(found - expected, axis=-1) / np.linalg.norm(expected, axis=-1)


def test_solid_finger(record_verification):
    at = (0.125, 0.25, 0.5, 1.0)
    section = RodSection.from_geometry(Rectangle(width=SIDE, height=SIDE), problems.rubber(problems.NEO_HOOKE))
    force = 4 * section.stiffness[4, 4] / BAR**2
    rod = static(RodModel(rods=[Rod(section=section, length=BAR)], loads=[PlateForce(force=(0, 0, -force))]), at=at)
    mesh = meshes.box((BAR, SIDE, SIDE), (20, 2, 2), lambda X: X - [0, SIDE / 2, SIDE / 2], kind=HEXAHEDRON)
    solid = _solved(mesh, force, SIDE**2, at=at)
    result = rod.tip[1:] - [BAR, 0, 0]
    record_verification(
        "solid bar, F L²/EI = 0.5, 1, 2, 4: tip (x, z) over the length", "finite elements",
        solid[:, [0, 2]] / BAR, result[:, [0, 2]] / BAR, "2 % of its displacement",
    )  # fmt: skip
    assert _distance(result, solid).max() < 0.02
    assert np.linalg.norm(solid[-1]) > 0.7 * BAR


def _tube():
    """A closed square tube: caps as thick as the walls, 12 cells between them."""
    along = np.array([0, WALL, *np.linspace(WALL, TUBE - WALL, 13)[1:], TUBE])
    across = np.array([0, WALL, OUTSIDE - WALL, OUTSIDE]) - OUTSIDE / 2
    lines, counts = (along, across, across), (len(along) - 1, 3, 3)

    def hollow(cell):
        return 0 < cell[0] < counts[0] - 1 and tuple(cell[1:]) == (1, 1)

    blocks = []
    for corner in filter(lambda cell: not hollow(cell), np.ndindex(counts)):
        names = {}
        for side in meshes.SIDES:
            axis, end = "xyz".index(side[0]), int(side[1])
            beside = tuple(c + (2 * end - 1) * (a == axis) for a, c in enumerate(corner))
            if beside[axis] in (-1, counts[axis]):
                names[side] = side
            elif hollow(beside):
                names[side] = "cavity"
        low = np.array([line[c] for line, c in zip(lines, corner, strict=True)])
        size = np.array([line[c + 1] - line[c] for line, c in zip(lines, corner, strict=True)])
        blocks.append(meshes.Block((1, 1, 1), lambda p, low=low, size=size: low + p * size, names))
    return meshes.glued(blocks, straight=True, kind=HEXAHEDRON)


def test_hollow_finger_under_pressure(record_verification):
    inside, mesh = OUTSIDE - 2 * WALL, _tube()
    area, bending = OUTSIDE**2 - inside**2, YOUNG * (OUTSIDE**4 - inside**4) / 12
    section = RodSection.from_moduli(EA=YOUNG * area, GA=0.5 * YOUNG / 3 * area, EI=bending, GJ=bending)
    force = 2 * bending / TUBE**2
    rod = static(RodModel(rods=[Rod(section=section, length=TUBE)], loads=[PlateForce(force=(0, 0, -force))]))
    result = rod.tip[-1] - [TUBE, 0, 0]
    solid = []
    for pressure in (0.0, 40e3):
        loads = [tg.Pressure("cavity", pressure, history=((0, 0), (0.5, 1), (1, 1)))] if pressure else []
        solid.append(_solved(mesh, force, OUTSIDE**2, loads, ((0, 0), (0.5, 0), (1, 1)), at=(0.5, 1.0))[-1])
    distances = _distance(result, np.array(solid))
    record_verification(
        "hollow finger at 0 and 40 kPa, F L²/EI = 2: distance of the tip over its displacement", "finite elements",
        0.0, distances, "2 %, 9 %",
    )  # fmt: skip
    assert (distances < [0.02, 0.09]).all()
    assert distances[0] < distances[1]
