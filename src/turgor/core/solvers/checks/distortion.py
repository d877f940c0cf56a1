"""Distortion: find cells so deformed that the path depends on the mesh rather than on the body."""

import numpy as np

from turgor.core.engine.fields import cell_fields
from turgor.core.materials.material import Material
from turgor.core.solvers.checks.plausibility.of_materials import NO_RUBBER
from turgor.core.solvers.checks.settings import DISTORTION
from turgor.core.solvers.solution import State


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
