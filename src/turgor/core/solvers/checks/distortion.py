"""Distortion: find cells so deformed that the path depends on the mesh rather than on the body."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import reference_nodes, tables_at
from turgor.core.engine.fields import cell_fields
from turgor.core.materials.material import Material
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.model.drive import kinks
from turgor.core.model.model import Model
from turgor.core.solvers.checks.plausibility.of_materials import NO_RUBBER
from turgor.core.solvers.checks.settings import DISTORTION
from turgor.core.solvers.solution import State
from turgor.foundation.finding import Finding, Severity

Array = NDArray[np.float64]

#: Cells that are looked at together: 27 points of each with a matrix take 60 MB.
CHUNK = 10_000


def worst_volume(state: State) -> tuple[float, tuple[float, float, float]] | None:
    """Find the point of the rubber whose volume has changed the most.

    Parameters
    ----------
    state : State

    Returns
    -------
    (float, (float, float, float)) or None
        Its volume over that at rest, and the middle of its cell at rest [m]; None where no rubber keeps its volume.
    """
    model = state.model
    hard = [
        np.asarray(model.mesh.regions[name])
        for name, material in model.materials.items()
        if isinstance(material, Material) and material.bulk_modulus >= NO_RUBBER * material.law.shear_modulus
    ]
    if not hard:
        return None
    cells = np.concatenate(hard)
    ratio = cell_fields(model, state.displacement, state.mean_stress).volume_ratio[cells]
    change = np.abs(np.log(np.maximum(ratio, 1e-12)))
    cell, point = np.unravel_index(int(change.argmax()), change.shape)
    x, y, z = model.mesh.points[model.mesh.cells[cells[cell]]].mean(axis=0)
    return float(ratio[cell, point]), (float(x), float(y), float(z))


def distortion_text(state: State) -> str:
    """Say which cell is so distorted that the mesh is too coarse for it; empty where none is.

    Parameters
    ----------
    state : State

    Returns
    -------
    str
        A sentence with a space before it.
    """
    worst = worst_volume(state)
    if worst is None or DISTORTION.volume_share <= worst[0] <= 1 / DISTORTION.volume_share:
        return ""
    place = ", ".join(f"{1e3 * x:.3g}" for x in worst[1])
    return (
        f" The cell at ({place}) mm has {worst[0]:.2g} times its volume at one of its points, though rubber keeps its "
        "volume: the mesh is too coarse there to tell whether the body or the cell gives way."
    )


def telling_states(model: Model, states: Sequence[State]) -> tuple[State, ...]:
    """Return the states at the turns of the loads, the one with the largest displacement, and the last one, each once.

    Parameters
    ----------
    model : Model
    states : sequence of State
    """
    if not states:
        return ()
    farthest = max(states, key=lambda state: float(np.abs(state.displacement).max()))
    turns = kinks(model)
    chosen = (*(state for state in states if state.load_factor in turns), farthest, states[-1])
    return tuple({id(state): state for state in chosen}.values())


def turned_cells(model: Model, states: Sequence[State]) -> tuple[Finding, ...]:
    """Say which cells are turned inside out at a node (N06), in the states that tell most.

    No state has an integration point that is turned inside out; but a cell that folds about one of its corners has
    none there.

    Parameters
    ----------
    model : Model
    states : sequence of State
    """
    worst, counted = None, np.empty(0)
    for state in telling_states(model, states):
        ratios = node_volume_ratios(state).min(axis=1, initial=1.0)
        if (ratios <= 0).sum() > (counted <= 0).sum():
            worst, counted = state, ratios
    if worst is None:
        return ()
    mesh, count = worst.model.mesh, int((counted <= 0).sum())
    place = mesh.points[mesh.carrying_cells[int(counted.argmin())]].mean(axis=0)
    many = f"{count} cells are" if count > 1 else "1 cell is"
    return (
        Finding(
            code="N06",
            severity=Severity.WARNING,
            message=f"{many} turned inside out at some of their nodes at load factor {worst.load_factor:.3g}, the "
            f"worst around ({', '.join(f'{1e3 * x:.3g}' for x in place)}) mm at rest: the body overlaps itself there.",
            advice="Do not rely on stresses and forces there. Mesh the place more finely, cut its cells on the way "
            "(procedure.remesh), round its edge, or request less; where a free side rolls onto a support, an obstacle "
            "there stops it.",
        ),
    )


def node_volume_ratios(state: State) -> Array:
    """Return the volume ratio det F at the nodes of each cell, (c, n)."""
    mesh = state.model.mesh
    cells = mesh.carrying_cells
    if not len(cells):
        return np.empty((0, 1))
    nodes = cells.shape[1]
    places = reference_nodes(TETRAHEDRON.nodes if nodes == TETRAHEDRON.nodes else HEXAHEDRON.nodes)
    slopes = tables_at(nodes, places, np.ones(len(places))).dN
    moved = mesh.points + state.displacement
    return np.concatenate(
        [_ratios(cells[i : i + CHUNK], mesh.points, moved, slopes) for i in range(0, len(cells), CHUNK)]
    )


def _ratios(cells: NDArray[np.int64], rest: Array, moved: Array, slopes: Array) -> Array:
    before, now = (
        np.linalg.det(np.einsum("cai,qak->cqik", points[cells], slopes, optimize=True)) for points in (rest, moved)
    )
    flat = before <= DISTORTION.flat * before.mean(axis=1, keepdims=True)  # such as on the axis of a sector
    return np.asarray(np.where(flat, 1.0, now / np.where(flat, 1.0, before)))
