"""What the verification tests share: units, materials, supports, and how they read a solution."""

from collections.abc import Sequence
from math import inf

import numpy as np

import meshes
import turgor as tg
from turgor.core.engine.cells.reference import CELL_QUADRATURE_DEGREE, reference_cell
from turgor.core.engine.fields import CellFields, cell_fields, strain_energy
from turgor.core.materials.laws.laws import Ogden
from turgor.core.meshing.cells import HEXAHEDRON

MM, MPA = 1e-3, 1e6

NEO_HOOKE = tg.laws.NeoHooke(C10=0.12 * MPA)
YEOH = tg.Yeoh(C10=0.11 * MPA, C20=0.02 * MPA)
#: Ecoflex 00-30, three terms, constants as Abaqus writes them.
OGDEN = Ogden.from_abaqus(mu=(24361.0, 66.703, 453.81), alpha=(1.7138, 7.0679, -3.3659))

#: A slab between two frictionless walls; see `meshes` on the nodes half way between.
PLANE_STRAIN = (tg.Fixed("z0", "z"), tg.Fixed("z1", "z"))


#: One thread: these problems are so small that waiting for a second thread costs more than it saves.
OPTIONS = tg.EngineOptions(linear_solver="rslab", threads=1)


def solve(model: tg.Model, procedure: tg.Static | None = None, **more) -> tg.Solution:
    """`turgor.solve` with the linear solver that every installation has."""
    return tg.solve(model, procedure, options=OPTIONS, **more)


def rubber(law, bulk_modulus: float = inf, density: float | None = None) -> tg.Material:
    """A material of a law, incompressible unless told otherwise."""
    return tg.Material(name="rubber", law=law, bulk_modulus=bulk_modulus, density=density)


def one_material(
    mesh: tg.Mesh, law, bulk_modulus: float = inf, supports: Sequence = (), loads: Sequence = ()
) -> tg.Model:
    """A model whose only region, ``body``, is of one law."""
    return tg.Model(mesh, materials={"body": rubber(law, bulk_modulus)}, supports=supports, loads=loads)


def arch(material: tg.Material, push: float) -> tg.Model:
    """Half of a flat arch of 100 × 2 mm that rises by 3.4 mm, clamped at its ends and pushed down [Pa]: it snaps."""

    def place(points):
        return points + np.outer(3.4e-3 * (1 - (points[:, 0] / 50e-3) ** 2), [0, 0, 1])

    mesh = meshes.box((50e-3, 2e-3, 2e-3), (2, 1, 1), place, kind=HEXAHEDRON)
    held = [tg.Fixed("x1"), tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.Fixed("y1", "y")]
    return tg.Model(mesh, {"body": material}, held, [tg.Traction("z1", (0.0, 0.0, -push))])


def pinned(mesh: tg.Mesh) -> tuple[tg.Mesh, list[tg.Fixed]]:
    """Hold three corners of a cube of side 1 against the six rigid motions and nothing else; the origin stays."""
    corners = ((0, 0, 0), (1, 0, 0), (0, 1, 0))
    pins = {f"pin{k}": meshes.single_node(meshes.node_at(mesh, corner)) for k, corner in enumerate(corners)}
    supports = [tg.Fixed("pin0", "xyz"), tg.Fixed("pin1", "yz"), tg.Fixed("pin2", "z")]
    return meshes.with_faces(mesh, **pins), supports


def state_at(solution: tg.Solution, load_factor: float) -> tg.solutions.State:
    """The state of the path at a load factor that was asked for."""
    state = min(solution.states, key=lambda s: abs(s.load_factor - load_factor))
    assert abs(state.load_factor - load_factor) < 1e-12, f"the path has no state at load factor {load_factor}"
    return state


def reaction(state: tg.solutions.State, face: str) -> np.ndarray:
    """Sum of the support forces on a face, (3,) [N]."""
    return state.nodal_force[state.model.mesh.face_nodes(face)].sum(axis=0)


def current(state: tg.solutions.State) -> np.ndarray:
    """Current positions of all nodes [m]."""
    return state.model.mesh.points + state.displacement


def mean_radius(state: tg.solutions.State, face: str, axes: Sequence[int]) -> float:
    """Mean distance of the nodes of a face from the axis or the center [m]."""
    positions = current(state)[state.model.mesh.face_nodes(face)]
    return float(np.linalg.norm(positions[:, list(axes)], axis=1).mean())


def fields(state: tg.solutions.State) -> CellFields:
    """Stresses and stretches of a state at the quadrature points."""
    return cell_fields(state.model, state.displacement, state.mean_stress, state.memory, state.load_factor)


def energy(state: tg.solutions.State) -> float:
    """Stored energy of the modeled part [J]."""
    fields = (state.displacement, state.mean_stress, state.memory, state.points)
    return strain_energy(state.model, *fields, state.load_factor)


def at_quadrature_points(state: tg.solutions.State, nodal: np.ndarray) -> np.ndarray:
    """A quadratic nodal field (n, 3) at the quadrature points of the cells, (c, q, 3)."""
    table = reference_cell(10, CELL_QUADRATURE_DEGREE).N
    return np.einsum("qa,cai->cqi", table, nodal[state.model.mesh.cells])


def polar_stress(state: tg.solutions.State, axes: Sequence[int], shift: Sequence[float] = 0.0):
    """Current radius, radial and hoop Cauchy stress at the quadrature points, about the axis or center at the origin.

    ``axes`` are the coordinates in which the radius lies: (0, 1) around z, (0, 1, 2) around the center, where the
    hoop stress is the mean of two.
    """
    x = at_quadrature_points(state, current(state))[..., list(axes)] + shift
    stress = fields(state).cauchy[..., : len(axes), : len(axes)]
    r = np.linalg.norm(x, axis=-1)
    n = x / r[..., None]
    radial = np.einsum("cqi,cqij,cqj->cq", n, stress, n)
    return r, radial, (np.trace(stress, axis1=-2, axis2=-1) - radial) / (len(axes) - 1)


def rotation(axis, angle):
    """Rotation matrix about an axis (Rodrigues)."""
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K
