"""Rules for source files that `lint-imports` and ruff do not know: sizes, open keywords, files that need each other.

Each rule is one test, which lists all places that break it.
"""

import ast
import re
from collections import Counter
from configparser import ConfigParser
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import grimp
import pytest

ROOT = Path(__file__).parents[3]
SOURCES = (ROOT / "src" / "turgor", ROOT / "guidelines" / "src" / "turgor_guidelines")
FILES = sorted(path for folder in SOURCES for path in folder.rglob("*.py"))

#: Public functions whose keywords are names that only the user knows: the factors of a sweep are fields of a design.
OPEN_KEYWORDS = ("src/turgor/studies/runs/sweep.py: sweep",)

#: Lines of a file, and files of a folder.
LONGEST_FILE, LARGEST_FOLDER = 500, 15

#: Folders that may have more files: lists of like things.
LARGE_FOLDERS = (
    "src/turgor/core/geometry/actuators",
    "src/turgor/core/materials/laws/energies",
    "src/turgor/core/model/loads",
)


def name_of(path):
    return path.relative_to(ROOT).as_posix()


def open_keywords(node):
    """List the functions and methods that take ``**``: those without a leading underscore, and ``__init__``."""
    results = []
    for item in node.body:
        if isinstance(item, ast.ClassDef) and not item.name.startswith("_"):
            results += [f"{item.name}.{name}" for name in open_keywords(item)]
        if isinstance(item, ast.FunctionDef | ast.AsyncFunctionDef) and item.args.kwarg is not None:
            results += [item.name] * (item.name == "__init__" or not item.name.startswith("_"))
    return results


def large_folders(paths):
    """Count the files of each folder that has too many; those of its own folders do not count."""
    counts = Counter(name_of(path.parent) for path in paths if path.name != "__init__.py")
    return {folder: count for folder, count in counts.items() if count > LARGEST_FOLDER and folder not in LARGE_FOLDERS}


def circle(graph):
    """Return files that need each other in a circle, the first one twice; empty if there are none."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return error.args[1]
    return []


def test_no_file_is_too_long():
    lengths = {name_of(path): len(path.read_text(encoding="utf-8").splitlines()) for path in FILES}
    assert len(lengths) > 1000
    assert {name: length for name, length in lengths.items() if length > LONGEST_FILE} == {}


def test_public_functions_name_their_keywords():
    results = [
        f"{name_of(path)}: {name}" for path in FILES for name in open_keywords(ast.parse(path.read_text("utf-8")))
    ]
    assert sorted(results) == sorted(OPEN_KEYWORDS)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("def build(**options): ...", ["build"]),
        ("class Model:\n    def __init__(self, **kw): ...", ["Model.__init__"]),
        ("def _build(**options): ...\nclass _Model:\n    def make(self, **kw): ...", []),
    ],
)
def test_an_open_keyword_is_noticed(text, expected):
    assert open_keywords(ast.parse(text)) == expected


def test_no_folder_holds_too_many_files():
    namespaces = ROOT / "src" / "turgor" / "namespaces"
    assert large_folders(path for path in FILES if path.parent != namespaces) == {}
    for folder in LARGE_FOLDERS:
        assert len(list((ROOT / folder).glob("*.py"))) > LARGEST_FOLDER


@pytest.mark.parametrize("folder", ["tests", "benchmarks", "guidelines"])
def test_no_folder_besides_the_package_holds_too_many_files(folder):
    assert large_folders((ROOT / folder).rglob("*.py")) == {}


def test_a_large_folder_is_noticed():
    paths = [ROOT / "src" / "turgor" / f"load_{n}.py" for n in range(LARGEST_FOLDER)]
    assert large_folders(paths) == {}
    assert large_folders([*paths, ROOT / "src" / "turgor" / "one_more.py"]) == {"src/turgor": LARGEST_FOLDER + 1}


def test_no_two_files_need_each_other():
    """Imports within functions and for type checkers count too; the root lists the public names, and is left out."""
    graph = grimp.build_graph("turgor", "turgor_guidelines", cache_dir=None)
    files = {each: graph.find_modules_directly_imported_by(each) - {"turgor"} for each in graph.modules - {"turgor"}}
    assert len(files) > 1000
    assert circle(files) == []


def test_a_circle_is_noticed():
    assert set(circle({"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}})) == {"a", "b", "c"}
    assert circle({"a": {"b"}, "b": set()}) == []


def test_the_page_on_the_architecture_shows_the_order_of_the_rooms():
    rules = ConfigParser()
    rules.read(ROOT / ".importlinter", encoding="utf-8")

    def layers(contract):
        return [line for line in rules[f"importlinter:contract:{contract}"]["layers"].split("\n") if line][::-1]

    rooms = []
    for wing in layers("wings"):
        if f"importlinter:contract:{wing}" in rules:
            rooms += [f"{wing}.{room}" for room in layers(wing)]
        elif wing != "__main__":
            rooms.append(wing.partition(" : ")[0])
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    shown = re.search(r"^    (foundation(?: → [\w.]+)+)$", page, re.MULTILINE)
    assert shown is not None
    assert shown[1].split(" → ") == rooms
