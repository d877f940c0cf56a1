"""Checks of films without a solid: each side has a sheet, and nothing is requested that only solids have."""

from collections.abc import Mapping, Sequence

import numpy as np

from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import corner_keys
from turgor.core.model.fibers import Fibers
from turgor.core.model.loads import Load
from turgor.core.model.sheets import Sheet
from turgor.foundation.errors import TurgorError


def check_films(
    mesh: Mesh, sheets: Mapping[str, Sheet], loads: Sequence[Load], reinforcements: Sequence[Fibers]
) -> None:
    """Refuse films that no sheet is given for, and what films without a solid cannot have.

    Parameters
    ----------
    mesh : Mesh
        Without cells.
    sheets : mapping of str to Shell or Membrane
    loads : sequence of Load
    reinforcements : sequence of Fibers

    Raises
    ------
    TurgorError
        If a side has no sheet, a load is a weight and a sheet has no density, or threads are wound.
    """
    keys = corner_keys(mesh.film_sides, len(mesh.points))
    given = [corner_keys(mesh.face(name), len(mesh.points)) for name in sheets if name in mesh.faces]
    bare = int((~np.isin(keys, np.concatenate([np.zeros(0, dtype=np.int64), *given]))).sum())
    if bare:
        raise TurgorError(
            f"'{mesh.name}' consists of films, and {bare} of its {len(keys)} sides have no sheet; give a Shell or a "
            f"Membrane for faces that cover it, among {', '.join(mesh.faces)}."
        )
    if any(load.needs_density for load in loads):
        for name, sheet in sheets.items():
            if sheet.material.density is None:
                raise TurgorError(f"materials.{name}: '{sheet.material.name}' has no density, and gravity needs it.")
    if reinforcements:
        raise TurgorError(f"'{mesh.name}' consists of films; threads are wound on solids only. Make the film woven.")
