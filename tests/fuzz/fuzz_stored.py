"""Damaged .turgor files and caches: a damaged cache gives what it gave before, and nothing else."""

import importlib.util
import io
import json
import os
import random
import warnings
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZIP_DEFLATED, ZipFile

import numba
import numpy as np
import results_cases
from mutants import changed_bytes, changed_table
from trials import Case, apart
from turgor.laws import NeoHooke

import turgor as tg
from turgor.core.geometry.actuators.extending_cylinder import ExtendingCylinder
from turgor.core.geometry.geometry import Geometry
from turgor.core.materials.laws.derived_formulas import cached_formulas, formulas_of
from turgor.core.meshing.generate import mesh_with
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.tetwild.mesh_cache import cached_cells
from turgor.job.family_cache import MOST, geometry_on_disk, mesh_on_disk, save_family

#: A loop that is compiled in a tenth of a second.
LOOP = "import numba\n@numba.njit(cache=True)\ndef double(x):\n    return 2 * x + 1\n"

CYLINDER = ExtendingCylinder(length=20e-3, symmetric=False)
SETTINGS = MeshSettings(size=5e-3)
POINTS, CELLS = np.random.default_rng(0).random((40, 3)), np.arange(160).reshape(40, 4)


def formula(a, b):  # as SymPy writes the derivatives of a law
    x0 = a - 3
    return [x0, b * x0**2.5 / (a + 7.25), 1.5 * b]


@cache
def saved() -> tuple[bytes, ...]:
    """Whole files: a model, a solution and a response."""
    question = results_cases.model(results_cases.body())
    solution = results_cases.solution(
        [results_cases.state(question, load_factor=0), results_cases.state(question, results_cases.stretched(1.1))]
    )
    with TemporaryDirectory() as folder:
        response = tg.measure(solution, tg.measures.tip_displacement_x)
        return tuple(Path(each.save(Path(folder) / "a.turgor")).read_bytes() for each in (question, solution, response))


def damaged_archive(content: bytes, chance: random.Random) -> bytes:
    """Change bytes of an archive, or pack it again with other content, other arrays or a member less."""
    if chance.random() < 0.4:
        return changed_bytes(content, chance)
    with ZipFile(io.BytesIO(content)) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    name = "content.json" if chance.random() < 0.6 else chance.choice(sorted(members))
    kind = chance.randrange(5)
    if kind == 0:
        del members[name]
    elif kind < 4 and name == "content.json":
        tree = json.loads(members[name])
        for _ in range(chance.choice((1, 1, 3))):
            changed_table(tree, chance)
        members[name] = json.dumps(tree).encode("utf-8", "replace")
    elif kind == 1 and name.startswith("arrays"):
        made = io.BytesIO()
        shape = chance.choice(((), (0,), (1,), (3, 3), (2, 2, 2), (5, 10), (10**5, 3)))
        np.save(made, np.full(shape, chance.choice((0, -1, 10**9, np.nan, 1j, True, "x"))))
        members[name] = made.getvalue()
    else:
        members[name] = changed_bytes(members[name], chance)
    packed = io.BytesIO()
    with ZipFile(packed, "w", chance.choice((0, ZIP_DEFLATED))) as archive:
        for each, data in members.items():
            archive.writestr(each, data)
    return packed.getvalue()


def damaged_saved(chance: random.Random, folder: Path) -> Path:
    (folder / "a.turgor").write_bytes(damaged_archive(chance.choice(saved()), chance))
    return folder / "a.turgor"


def use_saved(file: Path) -> None:
    result = tg.load(file)
    repr(result)
    result.save(file.with_name("b.turgor"))


@cache
def source() -> tuple[Path, TemporaryDirectory[str]]:
    """The source of a compiled loop, in a folder that lasts as long as this process."""
    folder = TemporaryDirectory(prefix="turgor-fuzz-")
    file = Path(folder.name) / "lone.py"
    file.write_text(LOOP, encoding="utf-8")
    return file, folder


def use_loop() -> None:
    """Load a compiled loop, or compile it."""
    spec = importlib.util.spec_from_file_location("lone", source()[0])
    assert spec is not None and spec.loader is not None
    lone = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(lone)
    assert lone.double(3) == 7


def use_formula() -> None:
    """Read a formula, or derive it."""
    assert cached_formulas(NeoHooke, "fuzz", lambda: formula).text == formulas_of(formula).text


def use_mesh() -> None:
    """Read the mesh of an STL file, or make it."""
    points, cells = cached_cells({"a": 1}, lambda: (POINTS, CELLS))
    assert np.array_equal(points, POINTS) and np.array_equal(cells, CELLS)


def use_family() -> None:
    """Read the shape and the mesh of a family, where they can be read."""
    geometry, mesh = geometry_on_disk(CYLINDER), mesh_on_disk(CYLINDER, SETTINGS)
    if geometry is not None:
        assert geometry.solid_volume == family()[0].solid_volume and geometry.faces == family()[0].faces
    if mesh is not None:
        assert mesh.points.tobytes() == family()[1].points.tobytes(), "another mesh was read"


USES = {"compiled": use_loop, "laws": use_formula, "meshes": use_mesh, "families": use_family}


@cache
def family() -> tuple[Geometry, Mesh]:
    geometry = CYLINDER.build()
    return geometry, mesh_with(geometry, SETTINGS)


@cache
def caches() -> dict[str, bytes]:
    """Files of all caches by their names, as turgor writes them."""
    source()
    return dict(apart(_caches))


def _caches() -> dict[str, bytes]:
    with TemporaryDirectory() as folder:
        move_caches(Path(folder))
        save_family(CYLINDER, family()[0], SETTINGS, family()[1])
        for use in USES.values():
            use()
        return {
            str(each.relative_to(folder)): each.read_bytes() for each in Path(folder).rglob("*.*") if each.is_file()
        }


def move_caches(place: Path) -> None:
    """Let all caches be in a folder."""
    os.environ |= {"TURGOR_CACHE": str(place), MOST: "256"}
    numba.config.CACHE_DIR = str(place / "compiled")


def damaged_cache(chance: random.Random, folder: Path) -> Path:
    """A folder with all files of one cache, of which one is damaged or missing."""
    part = chance.choice(sorted(USES))
    names = sorted(name for name in caches() if name.startswith(part))
    damaged = chance.choice(names)
    for name in names:
        file, content = folder / name, caches()[name]
        file.parent.mkdir(parents=True, exist_ok=True)
        if name == damaged:
            kind = chance.randrange(8)
            if kind == 0:
                content = content[: chance.randrange(len(content))]
            elif kind == 1:
                content = chance.choice((b"", bytes(100), b"\x80\x05nonsense"))
            elif kind < 5:
                content = changed_bytes(content, chance)
            elif file.suffix == ".turgor":
                content = damaged_archive(content, chance)
            else:
                at = chance.randrange(len(content))  # one bit
                content = content[:at] + bytes([content[at] ^ 1 << chance.randrange(8)]) + content[at + 1 :]
        file.write_bytes(content)
    return folder / part


def use_cache(part: Path) -> None:
    """Use a cache twice: after the first time it is whole again."""
    move_caches(part.parent)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        USES[part.name]()
    USES[part.name]()


CASES = (
    Case(name=".turgor files", share=1200, damage=damaged_saved, read=use_saved),
    Case(name="caches", share=700, damage=damaged_cache, read=use_cache),
)
