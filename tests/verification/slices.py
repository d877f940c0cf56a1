"""A quarter of a slice of a fiber-reinforced tube: what a long tube without ends does, in a handful of cells.

The slice lies between the planes z0 and z1, which stay plane and are moved along the axis; the reaction there, less the
push of the pressure on a cap, is the force that pulls at the tube's ends. One path holds and stretches the slice as the
points (pressure, stretch) say, in straight lines from point to point, so tubes with free ends are found between two
points of one path. Windings must be symmetric (hoops, axial fibers, both hands), else the planes would not stay plane.
"""

from collections.abc import Sequence
from dataclasses import astuple, dataclass

import numpy as np

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.model.fibers import Fibers, Winding

#: Diameter of the threads and distance between them [m]; only stiffness per width counts where they are smeared.
THREAD, SPACING = 0.1e-3, 1e-3


@dataclass(frozen=True)
class Slice:
    """What a point of the path says.

    Current inner and outer radius [m], stretch along the axis, pull at the ends [N], and the pressure between the
    outside and what holds it radially [Pa], zero where it is free or wound with fibers.
    """

    inner: float
    outer: float
    stretch: float
    pull: float
    held: float


def family(stiffness: float, from_circumference: float, face: str = "outside", **more) -> Fibers:
    """Smeared fibers of a stiffness per width [N/m] at an angle [rad]; both hands unless they are hoops or axial."""
    modulus = stiffness * SPACING / (np.pi * THREAD**2 / 4)
    turned = {"hand": "both", "axis": (0.0, 0.0, 1.0)} | {k: more.pop(k) for k in ("hand", "axis") if k in more}
    winding = Winding(angle_from_circumference=from_circumference, spacing=SPACING, **turned)
    material = tg.Material(name="thread", law=tg.laws.Hooke(E=modulus, nu=0.3))
    return Fibers(face=face, material=material, diameter=THREAD, winding=winding, **more)


def quarter(inner: float, outer: float, counts: tuple[int, int, int] = (2, 3, 1)) -> tg.Mesh:
    """Mesh of a quarter of a slice of 27-node hexahedra, 1 mm along the axis."""
    return meshes.tube_sector(inner, outer, 1e-3, counts, kind=HEXAHEDRON)


def follow(model: tg.Model, path: Sequence[tuple[float, float]], **steps) -> list[Slice]:
    """Take a slice through points (pressure [Pa], stretch along the axis) and say what it does at each."""
    states = states_at(model, path, **steps)
    return [_slice(state, p, s) for state, (p, s) in zip(states, path, strict=True)]


def states_at(model: tg.Model, path: Sequence[tuple[float, float]], **steps) -> list[tg.solutions.State]:
    """Take a slice through points (pressure [Pa], stretch along the axis) and return its state at each."""
    factors = np.arange(len(path) + 1) / len(path)
    pressure, stretch = np.array([(0.0, 1.0), *path]).T
    largest = pressure.max()

    def moved(points, load_factor):
        return points * [0, 0, np.interp(load_factor, factors, stretch) - 1]

    load = tg.Pressure("cavity", largest, history=list(zip(factors, pressure / largest, strict=True)))
    supports = [tg.Fixed("z0", "z"), tg.Displacement("z1", moved, "z"), *model.supports]
    model = tg.Model(model.mesh, model.materials, supports, [load, *model.loads], reinforcements=model.reinforcements)
    solution = problems.solve(model, tg.Static(tolerance=1e-8, first_step=0.25 / len(path), **steps))
    return [problems.state_at(solution, factor) for factor in factors[1:]]


def free(model: tg.Model, near: Sequence[tuple[float, float]], within: float = 0.004, **steps) -> list[Slice]:
    """Closed ends without a force: between two stretches at each pressure, ``within`` about the one given."""
    path = [(p, s + side * within) for p, s in near for side in (-1, 1)]
    result = follow(model, path, **steps)
    return [unforced(low, high) for low, high in zip(result[::2], result[1::2], strict=True)]


def unforced(low: Slice, high: Slice) -> Slice:
    """The slice without a pull at its ends, on the straight line through two."""
    share = low.pull / (low.pull - high.pull)
    return Slice(*(a + share * (b - a) for a, b in zip(astuple(low), astuple(high), strict=True)))


def wound(mesh: tg.Mesh, law, fibers: Sequence[Fibers] = (), supports: Sequence = (), loads: Sequence = ()) -> tg.Model:
    """A slice with fibers, or held in another way; the loads act besides the pressure."""
    return tg.Model(mesh, {"body": problems.rubber(law)}, supports, loads, reinforcements=fibers)


def _slice(state: tg.solutions.State, pressure: float, stretch: float) -> Slice:
    mesh = state.model.mesh
    inner, outer = (problems.mean_radius(state, face, (0, 1)) for face in ("cavity", "outside"))
    force = mesh.symmetry_factor * float(problems.reaction(state, "z1")[2])
    nodes = mesh.face_nodes("outside")
    radial = mesh.points[nodes] * [1, 1, 0]
    radial /= np.linalg.norm(radial, axis=1)[:, None]
    length = stretch * float(np.ptp(mesh.points[:, 2]))
    held = -mesh.symmetry_factor * float((state.nodal_force[nodes] * radial).sum()) / (2 * np.pi * outer * length)
    return Slice(inner, outer, stretch, force - pressure * np.pi * inner**2, held)
