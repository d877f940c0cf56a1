"""Checks of states of sheets: shrinkage, pre-stretch and the like of a shell or a membrane."""

from collections.abc import Mapping, Sequence

import numpy as np

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.loads import Load
from turgor.core.model.sheets import Sheet
from turgor.foundation.errors import TurgorError

#: Largest logarithm of the stretch of a sheet without stress: the law of sheets is one of small strains.
LARGEST = 0.1


def check_sheet_states(mesh: Mesh, sheets: Mapping[str, Sheet], loads: Sequence[Load]) -> None:
    """Refuse states of faces without a sheet, of sheets that wrinkle, of their stiffness, and large ones.

    Parameters
    ----------
    mesh : Mesh
    sheets : mapping of str to Shell or Membrane
    loads : sequence of Load

    Raises
    ------
    TurgorError
        If a sheet cannot have a state.
    """
    for load in loads:
        name = load.place
        if not load.of_bodies or not name or name in mesh.regions:
            continue
        if name not in sheets:
            there = ", ".join([*mesh.regions, *sheets])
            raise TurgorError(f"{load.kind} of '{name}': '{name}' is a face without a sheet; give one of: {there}.")
        if load.hardens or load.stiffness(1.0) != 1:
            raise TurgorError(f"{load.kind} of '{name}': '{name}' is a sheet, whose stiffness stays; give a body.")
        if sheets[name].wrinkles:
            raise TurgorError(
                f"{load.kind} of '{name}': '{name}' is a sheet that wrinkles (compression = "
                f"{sheets[name].compression:g}), which has no such state; leave compression out, or take a shell."
            )
        middles = mesh.points[mesh.face(name)[:, :4]].mean(axis=1)
        log = load.log_stretch(middles[:, None], 1.0)
        size = 0.0 if log is None else float(np.abs(np.linalg.eigvalsh(log)).max())
        if size > LARGEST:
            raise TurgorError(
                f"{load.kind} of '{name}': a stretch of {np.exp(size):.3g}, but the law of sheets is one of small "
                f"strains; allowed is up to {np.exp(LARGEST):.3g}, or its inverse."
            )
