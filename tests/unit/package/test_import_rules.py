"""Imports run one way through the rooms, heavy parts stay in their folder, the library does not print."""

import re
from pathlib import Path

import pytest
from import_rules import (
    HOME,
    LARGE_FOLDERS,
    LARGEST_FOLDER,
    LONGEST_FILE,
    ROOMS,
    WINGS,
    cycles,
    file_imports,
    large_folders,
    problems,
    room_of,
)

ROOT = Path(__file__).parents[3]
SOURCE = ROOT / "src" / "turgor"
FILES = sorted(SOURCE.rglob("*.py"))

#: Files that gather the public names.
OUTSIDE = [
    SOURCE / "__init__.py",
    *(SOURCE / "namespaces").glob("*.py"),
    *(SOURCE / wing / "__init__.py" for wing in WINGS),
]


def module_of(path):
    parts = path.relative_to(SOURCE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


@pytest.mark.parametrize("path", FILES, ids=lambda path: module_of(path))
def test_file_follows_the_rules(path):
    assert problems(module_of(path), path.read_text(encoding="utf-8")) == []


def test_every_file_is_in_a_known_room():
    rooms = {module_of(path): room_of(module_of(path)) for path in FILES if path not in OUTSIDE}
    assert {module: room for module, room in rooms.items() if room not in ROOMS} == {}
    assert len(FILES) > 40


def test_the_page_on_the_architecture_shows_the_same_order():
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    shown = re.search(r"^    (foundation(?: → [\w.]+)+)$", page, re.MULTILINE)
    assert shown is not None
    assert tuple(shown[1].split(" → ")) == ROOMS


@pytest.mark.parametrize(
    ("module", "text", "expected"),
    [
        (
            "turgor.core.engine.cells.kernels",
            "from turgor.core.solvers.solve import solve",
            "core.engine must not import",
        ),
        (
            "turgor.core.engine.cells.kernels",
            "def late():\n    import turgor.core.results.files.vtu",
            "engine must not import",
        ),
        ("turgor.core.engine.cells.kernels", "from ....cli import main", "engine must not import turgor.cli.main"),
        (
            "turgor.units",
            "from turgor.core.materials import material",
            "foundation must not import turgor.core.materials",
        ),
        ("turgor.views.plots.response_plots", "import turgor as tg", "is a public name"),
        ("turgor.views.plots.response_plots", "from turgor import Model", "is a public name"),
        ("turgor.views.plots.response_plots", "from turgor.namespaces.laws import Yeoh", "is a public name"),
        ("turgor.core.results.files.vtu", "import numba", "numba may be imported in core.engine"),
        ("turgor.core.results.files.vtu", "from numba import njit", "numba may be imported in core.engine"),
        (
            "turgor.core.solvers.newton.newton",
            "import ctypes",
            "ctypes may be imported in core.engine and core.geometry",
        ),
        (
            "turgor.core.meshing.generate",
            "from netgen.occ import Box",
            "netgen.occ may be imported in core.geometry",
        ),
        ("turgor.core.meshing.generate", "from netgen import occ", "netgen.occ may be imported in core.geometry"),
        (
            "turgor.core.meshing.generate",
            "from turgor.core.geometry import occ",
            "geometry.occ may be imported in core.geometry",
        ),
        ("turgor.core.engine.cells", "import netgen", "netgen may be imported in core.geometry and core.meshing"),
        ("turgor", "import numba", "numba may be imported in core.engine"),
        ("turgor.core.solvers.newton.newton", "def step():\n    print('hello')", "line 2: print"),
        ("turgor.studio.pages", "", "studio is no known room"),
        ("turgor.core.model.model", "def build(**options): ...", "**options in the public function build"),
        (
            "turgor.core.model.model",
            "class Model:\n    def __init__(self, **kw): ...",
            "**kw in the public function __init__",
        ),
        ("turgor.core.model.model", "\n" * (LONGEST_FILE + 1), f"{LONGEST_FILE + 1} lines"),
    ],
)
def test_a_broken_rule_is_noticed(module, text, expected):
    found = problems(module, text)
    assert len(found) >= 1
    assert expected in "; ".join(found)


@pytest.mark.parametrize(
    ("module", "text"),
    [
        (
            "turgor.core.solvers.solve",
            "from turgor.core.engine.system import System\nfrom turgor.core.solvers.newton.newton import newton",
        ),
        ("turgor.core.engine.cells.kernels", "import numba\nfrom basix import create_element"),
        ("turgor.core.geometry.shapes.solids", "from netgen.occ import Box"),
        ("turgor.cli.app", "import turgor as tg\nfrom turgor import solve\nprint(tg)"),
        ("turgor", "from turgor.cli import main"),
        ("turgor.core.model.model", "def _build(**options): ...\nclass _Model:\n    def make(self, **kw): ..."),
        ("turgor.core.model.model", "\n" * LONGEST_FILE),
    ],
)
def test_a_kept_rule_is_not_blamed(module, text):
    assert problems(module, text) == []


def test_every_home_is_a_room():
    assert {room for rooms in HOME.values() for room in rooms} <= set(ROOMS)


def test_no_folder_holds_too_many_files():
    modules = [module_of(path) for path in FILES if path.name != "__init__.py" and path not in OUTSIDE]
    assert large_folders(modules) == {}
    assert all(sum(each.startswith(f"{folder}.") for each in modules) > LARGEST_FOLDER for folder in LARGE_FOLDERS)


def test_no_folder_of_tests_holds_too_many_files():
    paths = [path.relative_to(ROOT).with_suffix("") for path in (ROOT / "tests").rglob("*.py")]
    assert len(paths) > 200
    assert large_folders(".".join(path.parts) for path in paths) == {}


def test_a_large_folder_is_noticed():
    modules = [f"turgor.core.model.load_{n}" for n in range(LARGEST_FOLDER)]
    assert large_folders(modules) == {}
    assert large_folders([*modules, "turgor.core.model.one_more"]) == {"turgor.core.model": LARGEST_FOLDER + 1}


def test_no_two_files_need_each_other():
    graph = file_imports({module_of(path): path.read_text(encoding="utf-8") for path in FILES})
    assert cycles(graph) == []


def test_a_cycle_is_noticed_wherever_the_import_stands():
    texts = {
        "turgor.core.model.a": "from turgor.core.model.b import one",
        "turgor.core.model.b": "def one():\n    from turgor.core.model import c",
        "turgor.core.model.c": "if TYPE_CHECKING:\n    from turgor.core.model.a import two",
        "turgor.core.model.d": "from turgor.core.model.a import two",
    }
    assert cycles(file_imports(texts)) == [("turgor.core.model.a", "turgor.core.model.b", "turgor.core.model.c")]
