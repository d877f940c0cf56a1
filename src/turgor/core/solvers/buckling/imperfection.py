"""imperfect: the rest shape of a model, changed a little along its buckling modes."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from turgor.core.meshing.quality.cell_quality import quality
from turgor.core.model.model import Model
from turgor.core.solvers.buckling.buckling_modes import BucklingModes, buckling_modes
from turgor.core.solvers.buckling.settings import BUCKLING
from turgor.foundation.errors import TurgorError


def imperfect(model: Model, sizes: float | Sequence[float], modes: BucklingModes | None = None) -> Model:
    """Return a model whose stress-free shape deviates along its buckling modes.

    A perfect column stays straight beyond its buckling load; one that deviates by a hundredth of its thickness bends,
    as a real one does.

    Parameters
    ----------
    model : Model
        The perfect one.
    sizes : float or sequence of float [m]
        Largest deviation along the first mode, or along the first modes in turn; a negative one deviates to the other
        side.
    modes : BucklingModes, optional
        Those of `buckling_modes`, on the same mesh; computed from rest by default.

    Returns
    -------
    Model
        On a mesh with the same cells and moved nodes.

    Raises
    ------
    TurgorError
        If a size is zero or larger than a tenth of the body, there are fewer modes than sizes, or a cell would be
        turned inside out.
    """
    along = (float(sizes),) if isinstance(sizes, (int, float)) else tuple(map(float, sizes))
    limit = BUCKLING.largest_imperfection * float(np.ptp(model.mesh.points, axis=0).max())
    if not along or not all(0 < abs(size) <= limit for size in along):
        given = ", ".join(f"{size * 1e3:g} mm" for size in along) or "none"
        raise TurgorError(
            f"the sizes of an imperfection are {given}; allowed is "
            f"up to {limit * 1e3:.4g} mm to either side, a tenth of the largest extent, and not zero."
        )
    modes = modes or buckling_modes(model, count=len(along))
    if len(modes.shapes) < len(along):
        raise TurgorError(
            f"the imperfection has {len(along)} sizes, and there {'is' if len(modes.shapes) == 1 else 'are'} "
            f"{len(modes.shapes)} buckling mode{'s' if len(modes.shapes) != 1 else ''} of these loads. {modes.message}"
        )
    moved = np.einsum("k,kni->ni", np.array(along), modes.shapes[: len(along)])
    mesh = replace(model.mesh, points=model.mesh.points + moved)
    if len(mesh.cells) and quality(mesh).inverted:
        raise TurgorError(
            f"an imperfection of {max(map(abs, along)) * 1e3:.4g} mm turns a cell inside out; take a smaller one."
        )
    return replace(model, mesh=mesh)
