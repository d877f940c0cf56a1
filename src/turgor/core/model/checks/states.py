"""Checks of states before loading: shrinkage, pre-stretch and the like of bodies, of sheets and of windings."""

from collections.abc import Mapping, Sequence

import numpy as np

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.fibers import Fibers
from turgor.core.model.loads import Load
from turgor.core.model.sheets import Sheet
from turgor.foundation.errors import TurgorError, unknown

#: Largest logarithm of the stretch of a sheet without stress: the law of sheets is one of small strains.
LARGEST = 0.1


def check_states(mesh: Mesh, sheets: Mapping[str, Sheet], windings: Sequence[Fibers], loads: Sequence[Load]) -> None:
    """Refuse states of what is not there, and those that a sheet or a winding cannot have.

    Parameters
    ----------
    mesh : Mesh
    sheets : mapping of str to Shell or Membrane
    windings : sequence of Fibers
    loads : sequence of Load

    Raises
    ------
    TurgorError
        If a body, sheet or winding cannot have a state.
    """
    wound = {each.name for each in windings}
    for load in loads:
        name = load.place
        if not load.of_bodies or not name:
            continue
        _check_name(load, mesh, sheets, wound)
        if name in wound and load.hardens:
            what = "is a winding, and threads do not harden; give a body."
            raise TurgorError(f"{load.kind} of '{name}': '{name}' {what}")
        if name in sheets:
            _check_sheet(load, mesh, sheets[name])


def _check_name(load: Load, mesh: Mesh, sheets: Mapping[str, Sheet], wound: set[str]) -> None:
    """Refuse a name that nothing has, or both a winding and something else."""
    name, others = load.place, (*mesh.regions, *sheets)
    if name in wound and name in others:
        what = "a body" if name in mesh.regions else "a sheet"
        raise TurgorError(
            f"{load.kind} of '{name}': '{name}' is {what} and a winding; give the winding another name: "
            f"Fibers(..., name='hoops')."
        )
    if name in wound or name in others:
        return
    there = (*others, *sorted(wound))
    if name in mesh.faces:
        raise TurgorError(
            f"{load.kind} of '{name}': '{name}' is a face without a sheet; give one of: {', '.join(there)}."
        )
    raise unknown(f"body of a {load.kind}", name, there)


def _check_sheet(load: Load, mesh: Mesh, sheet: Sheet) -> None:
    """Refuse a state of a sheet that wrinkles, of its stiffness, and a large one."""
    name = load.place
    if load.hardens or load.stiffness(1.0) != 1:
        raise TurgorError(f"{load.kind} of '{name}': '{name}' is a sheet, whose stiffness stays; give a body.")
    if sheet.wrinkles:
        raise TurgorError(
            f"{load.kind} of '{name}': '{name}' is a sheet that wrinkles (compression = {sheet.compression:g}), which "
            "has no such state; leave compression out, or take a shell."
        )
    middles = mesh.points[mesh.face(name)[:, :4]].mean(axis=1)
    log = load.log_stretch(middles[:, None], 1.0)
    size = 0.0 if log is None else float(np.abs(np.linalg.eigvalsh(log)).max())
    if size > LARGEST:
        raise TurgorError(
            f"{load.kind} of '{name}': a stretch of {np.exp(size):.3g}, but the law of sheets is one of small "
            f"strains; allowed is up to {np.exp(LARGEST):.3g}, or its inverse."
        )
