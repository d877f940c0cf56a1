"""Damaged mesh files, STL and STEP files."""

import pickle
import random
from functools import cache
from pathlib import Path

import cad_cases
import exchange_cases as cases
import numpy as np
from mutants import changed_bytes, changed_lines
from netgen.occ import Box, Pnt
from trials import Case, apart

from turgor.core.geometry.cad.facets import find_facets
from turgor.core.geometry.cad.files import reading
from turgor.core.geometry.cad.read import read_here
from turgor.core.meshing.default_settings import chosen_settings
from turgor.core.meshing.exchange.formats.stl import read_stl, stl_bytes
from turgor.core.meshing.exchange.read import read_mesh
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.sizing.sizes import check_face_sizes
from turgor.foundation.errors import TurgorError

EXAMPLES = Path(__file__).parents[2] / "examples"
POINTS, CELLS, LOW = cases.hollow_cube()
GROUPS = {(3, 1): "base", (3, 2): "body"}

#: STEP files that are damaged: the two of the examples, and two small ones.
STEP_FILES = (
    EXAMPLES / "cad_file.step", EXAMPLES / "skew_fins.step", cad_cases.DATA / "cup_and_plate.step",
    cad_cases.DATA / "tube_radial_inlet.step",
)  # fmt: skip


def whole_mesh(chance: random.Random) -> tuple[str, bytes]:
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
            "*NSET, NSET=some, GENERATE",
            "1, 20, 2",
            "*SURFACE, NAME=cavity",
            "body, S1",
        ]
        return ".inp", "\n".join(lines).encode()
    if kind in (3, 4):
        return ".vtk", cases.vtk_legacy(POINTS, blocks, binary=kind == 3, version=chance.choice((2, 5)))
    form = chance.choice(("ascii", "base64", "raw"))
    return ".vtu", cases.vtu(POINTS, blocks, form=form, compressed=chance.random() < 0.5 and form != "ascii")


def damaged_mesh(chance: random.Random, folder: Path) -> Path:
    ending, content = whole_mesh(chance)
    if chance.random() < 0.5:
        content = changed_bytes(content, chance)
    else:
        content = changed_lines(content.decode("latin-1"), chance).encode("latin-1")
    (folder / f"cube{ending}").write_bytes(content)
    return folder / f"cube{ending}"


def use_mesh(file: Path) -> None:
    mesh = read_mesh(file)
    assert np.isfinite(mesh.points).all()
    assert (cell_volumes(mesh) > 0).all()


def damaged_surface(chance: random.Random, folder: Path) -> Path:
    (folder / "part.stl").write_bytes(changed_bytes(stl_bytes(POINTS, CELLS[:, :3]), chance))
    return folder / "part.stl"


def use_surface(file: Path) -> None:
    assert np.isfinite(read_stl(file).points).all()


@cache
def box() -> np.ndarray:
    """Triangles of a box with a cavity."""
    return np.asarray(apart(_box))


def _box() -> np.ndarray:
    shape = Box(Pnt(0, 0, 0), Pnt(20, 10, 10)) - Box(Pnt(2, 2, 2), Pnt(18, 8, 8))
    return np.asarray(find_facets(shape, list(dict.fromkeys(shape.faces))).corners())


def damaged_stl(chance: random.Random, folder: Path) -> Path:
    """An STL file of a closed surface whose corners are elsewhere, of a part and its damage, or of a soup."""
    file, kind = folder / "part.stl", chance.random()
    if kind < 0.5:
        corners, places = np.unique(box().reshape(-1, 3), axis=0, return_inverse=True)
        for _ in range(chance.choice((1, 1, 2, 5))):
            i, j = chance.randrange(len(corners)), chance.randrange(len(corners))
            moved = [chance.choice((0.0, 1e-7, 1e-3, 3.0, -30.0, 1e9)) for _ in range(3)]
            corners[i] = corners[j] + moved if chance.random() < 0.5 else corners[i] + moved
        cad_cases.write_stl(file, corners[places].reshape(-1, 3, 3), text=chance.random() < 0.3)
    elif kind < 0.9:
        cad_cases.write_stl(file, box(), text=chance.random() < 0.5)
        if chance.random() < 0.3:
            file.write_bytes((EXAMPLES / "print.stl").read_bytes())
        text = file.read_bytes().decode("latin-1")
        if text.startswith("solid") and chance.random() < 0.5:
            file.write_bytes(changed_lines(text, chance).encode("latin-1"))
        else:
            file.write_bytes(changed_bytes(file.read_bytes(), chance))
    else:
        soup = np.random.default_rng(chance.randrange(10**6)).random((chance.choice((3, 30, 300, 3000)), 3, 3))
        cad_cases.write_stl(file, 30 * soup, text=chance.random() < 0.3)
    return file


def damaged_step(chance: random.Random, folder: Path) -> Path:
    text = chance.choice(STEP_FILES).read_text("latin-1")
    (folder / "part.step").write_bytes(changed_lines(text, chance).encode("latin-1", "replace"))
    return folder / "part.step"


def use_shape(file: Path) -> None:
    """Read a shape as the child process of `read_cad` does; what was read can be used by this process."""
    again = pickle.loads(pickle.dumps(read_here(file)))
    if not (again.solid_volume > 0 and again.smallest_wall > 0 and again.extent > 0):
        raise AssertionError("a part without volume, walls or length was read")
    chosen = chosen_settings(again, MeshSettings())
    check_face_sizes(again, dict.fromkeys(again.faces, chosen.size), chosen.size or 0.0)


def longest(file: Path) -> float:
    """Seconds after which `read_cad` stops its child process."""
    try:
        return reading(file).limit
    except TurgorError:  # it does not begin like a file of its kind, and is not read
        return 0.0


CASES = (
    Case(name="meshes", share=1300, damage=damaged_mesh, read=use_mesh),
    Case(name="surfaces of obstacles", share=300, damage=damaged_surface, read=use_surface),
    Case(name="STL", share=500, damage=damaged_stl, read=use_shape, longest=longest),
    Case(name="STEP", share=500, damage=damaged_step, read=use_shape, longest=longest),
)
