"""Layout of a model: nodes, elements, where they stand at rest, and their mass."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.fast_models.rod.frames import adjoint_inverse, cross_matrix, exponential, logarithm
from turgor.fast_models.rod.model import FREE_MOTIONS, Place, Rod, RodModel

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True, slots=True, eq=False)
class Layout:
    """Nodes and elements of a model; the plates are the first nodes.

    Parameters
    ----------
    nodes : tuple of (m + 1,) arrays
        Nodes of each rod in order.
    ends : (e, 2) array
        Nodes of each element.
    rod : (e,) array
        Which rod each element belongs to.
    length : (e,) array [m]
    end_turn, end_position : (e, 2, 3, 3) and (e, 2, 3) arrays
        Where elements begin and end, in the axes of their nodes.
    to_end : (e, 2, 6, 6) array
        From twists of the nodes to those of the ends.
    free : (n, 6) array of bool
        Motions of the nodes that nothing holds.
    turn, position : (n, 3, 3) and (n, 3) arrays
        The nodes at rest.
    """

    nodes: tuple[Indices, ...]
    ends: Indices
    rod: Indices
    length: Array
    end_turn: Array
    end_position: Array
    to_end: Array
    free: NDArray[np.bool_]
    turn: Array
    position: Array


def layout_of(model: RodModel) -> Layout:
    """Number the nodes of a model and place them at rest."""
    names = list(model.plate_names)
    nodes, count = [], len(names)
    for rod in model.rods:
        inner = np.arange(count, count + rod.elements - 1)
        nodes.append(np.array([names.index(rod.start), *inner, names.index(rod.end)], dtype=np.intp))
        count += rod.elements - 1
    ends = np.concatenate([np.stack([each[:-1], each[1:]], axis=1) for each in nodes])
    turn, position = _tiled(count)
    _place(model, nodes, turn, position)
    end_turn, end_position = (each.reshape(len(ends), 2, *each.shape[1:]) for each in _tiled(2 * len(ends)))
    firsts = np.cumsum([0, *(rod.elements for rod in model.rods)])
    for rod, first, after in zip(model.rods, firsts[:-1], firsts[1:], strict=True):
        end_turn[first, 0], end_position[first, 0] = _frame(rod.start_at)
        end_turn[after - 1, 1], end_position[after - 1, 1] = _frame(rod.end_at)
    free = np.ones((count, 6), dtype=bool)
    free[: len(names)] = [FREE_MOTIONS[model.plate(name).support] for name in names]
    return Layout(
        nodes=tuple(nodes),
        ends=ends,
        rod=np.repeat(np.arange(len(model.rods)), [rod.elements for rod in model.rods]),
        length=np.concatenate([np.full(rod.elements, rod.length / rod.elements) for rod in model.rods]),
        end_turn=end_turn,
        end_position=end_position,
        to_end=adjoint_inverse(end_turn, end_position),
        free=free,
        turn=turn,
        position=position,
    )


def shares_of_ends(layout: Layout) -> Array:
    """Return where the half of each element that an end carries acts, (e, 2, 3), in the axes of the end's node.

    It acts a sixth of the length inside the element. Then a load along the rod does the work that the trapezoidal rule
    with its correction at the ends gives, whose error is one of fourth order.
    """
    inward = np.stack([layout.length / 6, -layout.length / 6], axis=1)
    return inward[:, :, None] * layout.end_turn[:, :, :, 0]


def nodal_mass(model: RodModel, layout: Layout) -> tuple[Array, Array, Array]:
    """Return the mass of the nodes (n,), its moment (n, 3) and their inertia about themselves (n, 3, 3)."""
    count = len(layout.turn)
    mass, moment, inertia = np.zeros(count), np.zeros((count, 3)), np.zeros((count, 3, 3))
    inward, shift = shares_of_ends(layout), np.zeros((count, 3))
    each = np.array([rod.section.mass_per_length for rod in model.rods])[layout.rod] * layout.length / 2
    rotary = np.array([rod.section.rotary_inertia or (0, 0, 0) for rod in model.rods])[layout.rod]
    rotary = rotary * layout.length[:, None] / 2
    for end in (0, 1):
        at, turn, place = layout.ends[:, end], layout.end_turn[:, end], layout.end_position[:, end]
        np.add.at(mass, at, each)
        np.add.at(moment, at, each[:, None] * (place + inward[:, end]))
        np.add.at(shift, at, each[:, None] * inward[:, end])
        own = np.einsum("eij,ej,ekj->eik", turn, rotary, turn)
        both = _about(place, place + 2 * inward[:, end])
        np.add.at(inertia, at, own + each[:, None, None] * 0.5 * (both + np.swapaxes(both, 1, 2)))
    # Shifts cancel but at the ends: there is half an element of uniform mass, whose inertia is three times m shift².
    inertia += 3 * _about(shift, shift) / mass[:, None, None]
    for k, name in enumerate(model.plate_names):
        plate = model.plate(name)
        mass[k] += plate.mass
        inertia[k] += np.diag(plate.inertia)
    return mass, moment, inertia


def mass_matrices(mass: Array, moment: Array, inertia: Array) -> Array:
    """Return the mass matrices of nodes, (n, 6, 6), in their own axes."""
    matrices = np.zeros((len(mass), 6, 6))
    hat = cross_matrix(moment)
    matrices[:, :3, :3] = mass[:, None, None] * np.eye(3)
    matrices[:, :3, 3:], matrices[:, 3:, :3], matrices[:, 3:, 3:] = -hat, hat, inertia
    return matrices


def _about(a: Array, b: Array) -> Array:
    """Return (a · b) 1 − b aᵀ for arrays of vectors, (n, 3, 3)."""
    return np.einsum("ni,ni->n", a, b)[:, None, None] * np.eye(3) - b[:, :, None] * a[:, None, :]


def _tiled(count: int) -> tuple[Array, Array]:
    return np.tile(np.eye(3), (count, 1, 1)), np.zeros((count, 3))


def _frame(place: Place) -> tuple[Array, Array]:
    turn, _ = exponential(np.array([0.0, 0.0, 0.0, *place.turn]))
    return turn, np.array(place.position)


def _then(first: tuple[Array, Array], second: tuple[Array, Array]) -> tuple[Array, Array]:
    """Return the frame that the second one, stated in the axes of the first, stands at."""
    return first[0] @ second[0], first[1] + (first[0] @ second[1][..., None])[..., 0]


def _back(frame: tuple[Array, Array]) -> tuple[Array, Array]:
    turn = np.swapaxes(frame[0], -1, -2)
    return turn, -(turn @ frame[1][..., None])[..., 0]


def _place(model: RodModel, nodes: list[Indices], turn: Array, position: Array) -> None:
    """Place all nodes at rest, rod by rod from plates that stand already; rods that do not fit are bent."""
    known: set[str] = set()
    for k, name in enumerate(model.plate_names):
        place = model.plate(name).place
        if place is not None:
            turn[k], position[k] = _frame(place)
            known.add(name)
    if not known:
        known.add(model.plate_names[0])
    waiting = list(zip(model.rods, nodes, strict=True))
    while waiting:
        ready = next((pair for pair in waiting if {pair[0].start, pair[0].end} & known), None)
        if ready is None:  # a group of rods apart from the others stands in the origin, too
            known.add(waiting[0][0].start)
            continue
        waiting.remove(ready)
        rod, own = ready
        _place_rod(rod, own, (turn, position), known)
        known |= {rod.start, rod.end}


def _place_rod(rod: Rod, own: Indices, frames: tuple[Array, Array], known: set[str]) -> None:
    turn, position = frames
    rest = np.array(rod.rest_strain) + [1, 0, 0, 0, 0, 0]
    along = np.linspace(0.0, rod.length, rod.elements + 1)
    shape = exponential(along[:, None] * rest)
    last = shape[0][-1], shape[1][-1]
    start, end = _frame(rod.start_at), _frame(rod.end_at)
    first, final = (turn[own[0]], position[own[0]]), (turn[own[-1]], position[own[-1]])
    if rod.start not in known:
        begin = _then(_then(final, end), _back(last))
        turn[own[0]], position[own[0]] = _then(begin, _back(start))
    else:
        begin = _then(first, start)
    if rod.end not in known:
        turn[own[-1]], position[own[-1]] = _then(_then(begin, last), _back(end))
        missed = np.zeros(6)
    elif rod.start not in known:
        missed = np.zeros(6)
    else:
        missed = logarithm(*_then(_back(_then(begin, last)), _then(final, end)))
    bent = _then(shape, exponential((along / rod.length)[:, None] * missed))
    placed = _then((begin[0], begin[1]), bent)
    turn[own[1:-1]], position[own[1:-1]] = placed[0][1:-1], placed[1][1:-1]
