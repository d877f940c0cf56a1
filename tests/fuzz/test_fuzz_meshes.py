"""Damaged mesh files and STL surfaces are read, or refused with a sentence: no traceback, no cell without volume."""

import random
from pathlib import Path

import exchange_cases as cases
import numpy as np
import pytest
from mutants import changed_bytes, changed_lines, check_sentence, limit, seeds

from turgor.core.meshing.exchange.formats.stl import read_stl, stl_bytes
from turgor.core.meshing.exchange.read import read_mesh
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.foundation.errors import TurgorError

POINTS, CELLS, LOW = cases.hollow_cube()
GROUPS = {(3, 1): "base", (3, 2): "body"}


def whole(chance: random.Random) -> tuple[str, bytes]:
    """A whole file of the hollow cube, and its ending."""
    blocks = [(12, CELLS)]
    kind = chance.randrange(7)
    if kind == 0:
        return ".msh", cases.gmsh_2(POINTS, [(5, CELLS, np.where(LOW, 1, 2))], GROUPS).encode()
    if kind == 1:
        return ".msh", cases.gmsh_4(POINTS, [(3, 1, 5, CELLS[LOW]), (3, 2, 5, CELLS[~LOW])], GROUPS).encode()
    if kind == 2:
        lines = [
            *cases.inp_nodes(POINTS),
            *cases.inp_cells("C3D8", CELLS, elset="body"),
            "*NSET, NSET=fixed",
            "1, 2, 3",
        ]
        return ".inp", "\n".join(lines).encode()
    if kind in (3, 4):
        return ".vtk", cases.vtk_legacy(POINTS, blocks, binary=kind == 3, version=chance.choice((2, 5)))
    form = chance.choice(("ascii", "base64", "raw"))
    return ".vtu", cases.vtu(POINTS, blocks, form=form, compressed=chance.random() < 0.5 and form != "ascii")


def damaged(content: bytes, chance: random.Random) -> bytes:
    if chance.random() < 0.5:
        return changed_bytes(content, chance)
    return changed_lines(content.decode("latin-1"), chance).encode("latin-1")


@pytest.mark.parametrize("seed", seeds(40))
def test_a_damaged_mesh_is_read_or_refused(seed: int, tmp_path: Path) -> None:
    chance = random.Random(seed)
    ending, content = whole(chance)
    file = tmp_path / f"cube{ending}"
    file.write_bytes(damaged(content, chance))
    with limit(30):
        try:
            mesh = read_mesh(file)
        except TurgorError as error:
            return check_sentence(error)
    assert np.isfinite(mesh.points).all()
    assert (cell_volumes(mesh) > 0).all()


@pytest.mark.parametrize("seed", seeds(15))
def test_a_damaged_surface_is_read_or_refused(seed: int, tmp_path: Path) -> None:
    chance = random.Random(seed)
    file = tmp_path / "part.stl"
    file.write_bytes(changed_bytes(stl_bytes(POINTS, CELLS[:, :3]), chance))
    with limit(30):
        try:
            surface = read_stl(file)
        except TurgorError as error:
            return check_sentence(error)
    assert np.isfinite(surface.points).all()
