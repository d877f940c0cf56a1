"""Models with bonds: a cube of two blocks, and a double cantilever beam."""

import numpy as np

import meshes
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON

#: Side of the cube [m], and the numbers of its bond.
SIDE = 10e-3
BOND = {
    "peel_strength": 20e3, "energy_peel": 40.0, "shear_strength": 30e3, "energy_shear": 90.0, "stiffness": 5e7,
}  # fmt: skip


def in_two(mesh, height, corners=4, **faces):
    """The mesh with the regions ``low`` and ``high``."""
    low = mesh.points[mesh.cells][:, :corners, 2].mean(axis=1) < height
    regions = {"low": np.flatnonzero(low), "high": np.flatnonzero(~low)}
    return tg.Mesh(points=mesh.points, cells=mesh.cells, regions=regions, faces={**mesh.faces, **faces})


def cube(counts=(1, 1, 2)):
    return in_two(meshes.box((SIDE, SIDE, SIDE), counts), SIDE / 2)


def pulled(move, history=((0, 0), (1, 1)), **bond):
    """Two hard blocks whose bond opens alike everywhere."""
    hard = tg.Material(name="hard", law=tg.laws.NeoHooke(C10=50e6))
    shift = tg.supports.Shift(move, history=history)
    glue = tg.bodies.Bond(name="glue", between=("low", "high"), **(BOND | bond))
    return tg.Model(cube(), hard, [tg.Fixed("z0"), tg.Displacement("z1", shift)], [], bonds=glue)


def tractions(solution):
    """Traction of the upper side at each state (n, 3) [Pa]."""
    top = solution.model.mesh.face_nodes("z1")
    return np.array([state.nodal_force[top].sum(axis=0) for state in solution.states]) / SIDE**2


#: Double cantilever beam: length, height of an arm, width, flaw [m]; modulus [Pa], Poisson's ratio; strength, energy.
LENGTH, ARM, WIDTH, FLAW = 30e-3, 1e-3, 1e-3, 15e-3
MODULUS, POISSON, STRENGTH, ENERGY = 30e6, 0.3, 6e3, 0.05
OPENING = 1.4e-3


def double_cantilever(cells):
    """Two arms in plane strain, pulled apart at their free ends."""
    mesh = meshes.box((LENGTH, WIDTH, 2 * ARM), (cells, 1, 2), kind=HEXAHEDRON)
    ends = mesh.faces["x0"]
    high = mesh.points[ends].mean(axis=1)[:, 2] > ARM
    mesh = in_two(mesh, ARM, 8, up=ends[high], down=ends[~high])
    shear = MODULUS / 2 / (1 + POISSON)
    material = tg.Material(
        name="arm", law=tg.laws.NeoHooke(C10=shear / 2), bulk_modulus=MODULUS / 3 / (1 - 2 * POISSON)
    )
    glue = tg.bodies.Bond(
        name="glue", between=("low", "high"), peel_strength=STRENGTH, energy_peel=ENERGY,
        unbonded=((-1.0, -1.0, -1.0), (FLAW, 1.0, 1.0)),
    )  # fmt: skip
    moved = [tg.Displacement(face, (0.0, 0.0, sign * OPENING / 2), "z") for face, sign in (("up", 1), ("down", -1))]
    fixed = [tg.Fixed("x1", "x"), tg.Fixed("y0", "y"), tg.Fixed("y1", "y")]
    return tg.Model(mesh, material, [*fixed, *moved], [], bonds=glue)


def beam_loads(opening):
    """Load [N] of beam theory at an opening [m]: while the flaw stays, with its end turned, and while the bond peels.

    The end of the flaw turns and shears as if the arms were longer by χ h (Williams 1989, J. Composite Materials 23).
    """
    plane = MODULUS / (1 - POISSON**2)
    bending, ratio = plane * WIDTH * ARM**3 / 12, plane / (MODULUS / 2 / (1 + POISSON))
    turned = 1.18 * ratio
    longer = np.sqrt(ratio / 11 * (3 - 2 * (turned / (1 + turned)) ** 2)) * ARM
    root = np.sqrt(ENERGY * WIDTH * bending)
    return 1.5 * opening * bending / (FLAW + longer) ** 3, root / np.sqrt(1.5 * opening * bending / root)
