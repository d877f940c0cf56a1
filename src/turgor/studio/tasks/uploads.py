"""Uploads: a look at a file that a page has sent, in a child process, which may crash or take too long."""

from pathlib import Path
from typing import Any

import numpy as np

from turgor.core.geometry.cad.files import SUFFIXES, reading
from turgor.core.geometry.child_process import Work, in_child
from turgor.core.materials.experiments.table_text import read_table
from turgor.foundation.errors import TurgorError

#: Time after which a mesh file is no longer read [s]: 100 MB of text take a minute.
LONGEST = 120.0

#: Memory that a reader may take [bytes]: ten times what the largest upload needs, and less than a machine has.
MEMORY = 8 * 2**30

#: Endings of files that state the unit of their numbers.
_STATED = (".step", ".stp")


def look(part: Path, unit: str | None) -> dict[str, Any]:
    """Read a part or a table, and return what it is.

    Parameters
    ----------
    part : Path
    unit : str or None
        Unit of its numbers.

    Returns
    -------
    dict
        ``kind``, ``size`` [m], whether its ``unit`` is stated, and the numbers of ``faces`` and ``cavities``; of a
        table the numbers of ``columns`` and ``rows``.

    Raises
    ------
    TurgorError
        If it cannot be read.
    """
    if part.suffix.lower() == ".csv":
        table = read_table(part)
        return {"kind": "table", "columns": len(table.names), "rows": len(table.rows)}
    is_cad = part.suffix.lower() in SUFFIXES
    work = reading(part) if is_cad else Work(
        who="the reader", doing=f"reading '{part}'", advice="Export it again, or as another format.", limit=LONGEST
    )  # fmt: skip
    return in_child(work, _cad if is_cad else _mesh, part, unit)


def _cad(part: Path, unit: str | None) -> dict[str, Any]:
    from turgor.core.geometry.cad.read import read_here

    _bound_memory()
    shape = read_here(part, unit)
    low, high = shape.bounds
    size = [b - a for a, b in zip(low, high, strict=True)]
    stated = unit is not None or part.suffix.lower() in _STATED
    return {"kind": "cad", "size": size, "unit": stated, "faces": len(shape.faces), "cavities": len(shape.cavities)}


def _mesh(part: Path, unit: str | None) -> dict[str, Any]:
    from turgor.core.meshing.exchange.mesh_file import MeshFile

    _bound_memory()
    mesh = MeshFile(file=part, unit=unit).read()
    size = [float(side) for side in np.ptp(mesh.points, axis=0)]
    if not len(mesh.cells):
        raise TurgorError(f"'{part}' has no cells; a mesh of the volume is needed.")
    counts = {"faces": len(mesh.faces), "cavities": len(mesh.cavities)}
    return {"kind": "mesh", "size": size, "unit": unit is not None, **counts}


def _bound_memory() -> None:
    """End this process, not the machine, where a file declares more than there is."""
    try:
        import resource
    except ImportError:  # Windows has no such limit
        return
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
