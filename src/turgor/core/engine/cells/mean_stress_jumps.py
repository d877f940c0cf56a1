"""Number the mean stresses, with one for each side of a border where the mean stress may jump.

Equilibrium makes the traction continuous across a border between two rubbers, not the mean stress: where the stiffness
jumps, the mean stress jumps too. A field that is continuous there cannot follow. It pollutes a whole layer of cells on
both sides, and more cells of the same size do not show it. Every vertex on such a border therefore carries one mean
stress for each side.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.rings import rings_of, shared_numbers
from turgor.core.materials.material import Material
from turgor.core.meshing.bodies.groups import groups_of
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import cell_sides, corner_keys
from turgor.core.model.model import CONTINUOUS, Model

Ints = NDArray[np.int64]


def mean_stress_numbers(model: Model) -> tuple[Ints, int]:
    """Number the mean stresses of a model's cells.

    Cells on the two sides of a border between different rubbers, or of an inner face with a membrane, fibers, a support
    or a load, share no mean stress across it. They still share it around the rim of such a face. The formulation
    ``"continuous"`` has one mean stress for each vertex everywhere.

    Parameters
    ----------
    model : Model

    Returns
    -------
    numbers : (c, m) int array
        Number of the mean stress at each corner of each cell. The first numbers are those of the vertices.
    count : int
        How many mean stresses there are, with those that no cell has: on an axisymmetric mesh, all but one of a ring.
    """
    numbers, count = numbers_at_borders(model)
    if model.mesh.revolved:
        return shared_numbers(rings_of(model.mesh), model.mesh.cells, numbers), count
    return numbers, count


def numbers_at_borders(model: Model) -> tuple[Ints, int]:
    """Number the mean stresses as `mean_stress_numbers`, but each node of a ring on its own.

    The cut faces of a wedge are one face inside the body: the node of the higher one counts as its partner.
    """
    if model.formulation == CONTINUOUS:
        return _at_vertices(model.mesh, model.mesh.leaders), model.mesh.vertex_count
    return _numbers(model.mesh, _alike(model), _acting(model))


def _at_vertices(mesh: Mesh, leaders: Ints) -> Ints:
    return np.ascontiguousarray(leaders[mesh.cells[:, : mesh.cell_type.corners]])


def _alike(model: Model) -> tuple[tuple[str, ...], ...]:
    """Groups of regions whose rubber responds alike."""
    groups: list[tuple[tuple[object, ...], list[str]]] = []
    for name, material in model.region_materials.items():
        response = (*_response(material), model.states_of(name))
        for known, names in groups:
            if known == response:
                names.append(name)
                break
        else:
            groups.append((response, [name]))
    return tuple(tuple(names) for _, names in groups)


def _response(material: Material) -> tuple[object, ...]:
    return (
        material.law, material.bulk_modulus, material.viscoelasticity, material.stress_softening, material.orientation,
        material.permanent_set,
    )  # fmt: skip


def _acting(model: Model) -> tuple[str, ...]:
    """Faces across which the traction may jump, because something acts on them; mirror planes are outer faces."""
    faces = set(model.membranes)
    for fibers in model.reinforcements:
        faces.update(fibers.faces)
    faces.update(name for support in model.supports if support.jumps for name in support.named_faces)
    faces.update(name for load in model.loads if load.spread for name in load.named_faces)
    return tuple(sorted(faces & set(model.mesh.faces)))


@lru_cache(maxsize=4)
def _numbers(mesh: Mesh, alike: tuple[tuple[str, ...], ...], acting: tuple[str, ...]) -> tuple[Ints, int]:
    leaders, count = mesh.leaders, len(mesh.points)
    at_vertices, sides = _at_vertices(mesh, leaders), cell_sides(leaders[mesh.cells])
    keys = corner_keys(sides, count)
    first, second = _twins(keys)
    per_cell = len(mesh.cell_type.sides)
    rubber = _rubber_of(mesh, alike)
    jumps = rubber[first // per_cell] != rubber[second // per_cell]
    for name in acting:
        jumps |= np.isin(keys[first], corner_keys(leaders[mesh.face(name)], count))
    if not jumps.any():
        return at_vertices, mesh.vertex_count
    corners = mesh.cell_type.side.corners
    bordering = np.zeros(count, dtype=bool)
    bordering[sides[first[jumps], :corners]] = True
    smooth = ~jumps & bordering[sides[first, :corners]].any(axis=1)
    links = _links(mesh, sides, (first[smooth], second[smooth]))
    return _numbered(at_vertices, bordering, links, mesh.vertex_count)


def _twins(keys: Ints) -> tuple[Ints, Ints]:
    """Pairs of cell sides that are the same side of the mesh."""
    order = np.argsort(keys, kind="stable")
    same = keys[order[1:]] == keys[order[:-1]]
    return order[:-1][same], order[1:][same]


def _rubber_of(mesh: Mesh, alike: tuple[tuple[str, ...], ...]) -> Ints:
    rubber = np.zeros(len(mesh.cells), dtype=np.int64)
    for number, names in enumerate(alike):
        for name in names:
            rubber[mesh.regions[name]] = number
    return rubber


def _links(mesh: Mesh, sides: Ints, pairs: tuple[Ints, Ints]) -> tuple[Ints, Ints]:
    """Places (cell and corner, as one number) that share a mean stress through a side without a jump."""
    kind = mesh.cell_type
    corners, per_cell = kind.side.corners, len(kind.sides)
    place_in_cell = np.array([side[:corners] for side in kind.sides])
    ends = []
    for chosen in pairs:
        nodes = sides[chosen, :corners]
        places = (chosen // per_cell)[:, None] * kind.corners + place_in_cell[chosen % per_cell]
        ends.append(np.take_along_axis(places, np.argsort(nodes, axis=1), axis=1).ravel())
    return ends[0], ends[1]


def _numbered(
    at_vertices: Ints, bordering: NDArray[np.bool_], links: tuple[Ints, Ints], first: int
) -> tuple[Ints, int]:
    """One number for each connected group of places at a bordering vertex; the vertex's own number for one of them."""
    group = groups_of(at_vertices.size, *links)
    vertex = at_vertices.ravel()
    split = np.flatnonzero(bordering[vertex])
    pairs, inverse = np.unique(np.stack([vertex[split], group[split]], axis=1), axis=0, return_inverse=True)
    keeps = np.concatenate([[True], pairs[1:, 0] != pairs[:-1, 0]])
    numbers = np.where(keeps, pairs[:, 0], first + np.cumsum(~keeps) - 1)
    out = vertex.copy()
    out[split] = numbers[inverse.ravel()]
    return np.ascontiguousarray(out.reshape(at_vertices.shape)), first + int((~keeps).sum())
