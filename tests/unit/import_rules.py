"""The rules that keep the rooms apart, checked on the text of a file: what it imports, how long it is, what it prints.

The order of the rooms stands here once; ``docs/architecture.md`` shows the same list, and a test compares them.
"""

import ast
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping

#: Rooms in the order of import: a room may import from itself and from those before it.
ROOMS = (
    "foundation", "core.materials", "core.geometry", "core.meshing", "core.model", "core.engine", "core.solvers",
    "core.setups", "core.results", "fast_models.formulas", "fast_models.rod", "fast_models.section", "views",
    "accuracy.gradients", "accuracy.adaptivity", "accuracy.laboratory", "job", "studies.runs", "studies.calibration",
    "studies.uncertainty", "studies.sensitivity", "studies.surrogates", "studies.optimization",
    "studies.study_file", "guidelines", "cli",
)  # fmt: skip

#: Wings with several rooms.
WINGS = ("core", "fast_models", "accuracy", "studies")

#: The modules of the command line, which is a client of the public names.
COMMAND_LINE = ("cli", "__main__")

#: Rooms that use the public names, as users do.
CLIENTS = ("guidelines", "cli")

#: Where a heavy part, or a part with one purpose, may be imported.
HOME = {
    "basix": ("core.engine",),
    "ctypes": ("core.engine", "core.geometry"),  # MKL; emptying the buffers of the CAD kernel and the mesh generator
    "mkl": ("core.engine",),
    "numba": ("core.engine",),
    "rslab": ("core.engine",),
    "threadpoolctl": ("core.engine", "studies.surrogates"),
    "netgen": ("core.geometry", "core.meshing"),
    "netgen.occ": ("core.geometry",),
    "netgen.meshing": ("core.meshing",),
    "turgor.core.geometry.occ": ("core.geometry",),
    "turgor.core.meshing.netgen": ("core.meshing",),
    "embreex": ("views",),
    "jinja2": ("views",),
    "matplotlib": ("views",),
    "distributed": ("studies.runs",),
    "pyarrow": ("studies.runs",),
    "SALib": ("studies.sensitivity",),
    "sklearn": ("studies.surrogates",),
    "pydantic": ("job", "studies.study_file"),
    "pymoo": ("studies.optimization",),
    "rich": ("cli", "core.solvers"),
    "typer": ("cli",),
}

#: Public functions whose keywords are names that only the user knows: the factors of a sweep are fields of a design.
FREE_KEYWORDS = ("turgor.studies.runs.sweep.sweep",)

LONGEST_FILE = 500

#: Modules that a folder of the package or of the tests may hold.
LARGEST_FOLDER = 15

#: Folders that may hold more: lists of like things.
LARGE_FOLDERS = ("turgor.core.geometry.actuators",)


def room_of(module: str) -> str | None:
    """Room of a dotted module such as ``turgor.core.engine.system``; None for public modules and other packages.

    The ``__init__`` of the package and of a wing, and the namespaces, give public names: they are no rooms.
    """
    parts = module.split(".")
    if parts[0] != "turgor" or len(parts) == 1 or parts[1] == "namespaces":
        return None
    if parts[1] == "units":
        return "foundation"
    if parts[1] in COMMAND_LINE:
        return "cli"
    if parts[1] in WINGS:
        return ".".join(parts[1:3]) if len(parts) > 2 else None
    return parts[1]


def problems(module: str, text: str) -> list[str]:
    """List what breaks a rule in a module of ``src/turgor``, one line each."""
    tree = ast.parse(text)
    found = [*_import_problems(module, tree), *_call_problems(module, tree), *_signature_problems(tree, module)]
    lines = len(text.splitlines())
    if lines > LONGEST_FILE:
        found.append(f"{lines} lines; {LONGEST_FILE} are allowed")
    return found


def imported(module: str, tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Line and dotted name of everything imported, inside functions too; relative names are made absolute."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = ".".join(module.split(".")[: -node.level]) if node.level else ""
            source = ".".join(part for part in (base, node.module) if part)
            yield from ((node.lineno, f"{source}.{alias.name}") for alias in node.names)


def _import_problems(module: str, tree: ast.Module) -> Iterator[str]:
    here = room_of(module)
    if here is not None and here not in ROOMS:
        yield f"{here} is no known room"
        return
    for line, name in imported(module, tree):
        yield from (f"line {line}: {text}" for text in _home_problems(here, name))
        if here is None or name.split(".")[0] != "turgor":
            continue
        there = room_of(name)
        if there not in ROOMS:
            if here not in CLIENTS:
                yield f"line {line}: {name} is a public name; a room imports from the room that defines it"
        elif ROOMS.index(there) > ROOMS.index(here):
            yield f"line {line}: {here} must not import {name}, which comes after it"


def _home_problems(here: str | None, name: str) -> Iterator[str]:
    for part, homes in HOME.items():
        if (name == part or name.startswith(f"{part}.")) and here not in homes:
            yield f"{part} may be imported in {' and '.join(homes)} only"


def _call_problems(module: str, tree: ast.Module) -> Iterator[str]:
    if room_of(module) == "cli":
        return
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "print":
            yield f"line {node.lineno}: print; the library returns, the command line prints"


def _signature_problems(tree: ast.Module | ast.ClassDef, module: str) -> Iterator[str]:
    """Functions and methods without a leading underscore, and ``__init__``, name their arguments."""
    for node in tree.body:
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            yield from _signature_problems(node, f"{module}.{node.name}")
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) or node.args.kwarg is None:
            continue
        if f"{module}.{node.name}" in FREE_KEYWORDS:
            continue
        if node.name == "__init__" or not node.name.startswith("_"):
            yield f"line {node.lineno}: **{node.args.kwarg.arg} in the public function {node.name}"


def large_folders(modules: Iterable[str]) -> dict[str, int]:
    """Count the modules of every folder that holds more than it may; folders in it do not count."""
    held = Counter(module.rpartition(".")[0] for module in modules)
    return {folder: n for folder, n in held.items() if n > LARGEST_FOLDER and folder not in LARGE_FOLDERS}


def file_imports(texts: Mapping[str, str]) -> dict[str, set[str]]:
    """Find the files of the package that each file imports, anywhere in it.

    Imports inside functions and under ``TYPE_CHECKING`` count too: a cycle that only they close still means that
    neither file can be read without the other. The ``__init__`` of a folder counts where it is imported by name.

    Parameters
    ----------
    texts : mapping of str to str
        Text of every file, by dotted module.

    Returns
    -------
    dict of str to set of str
    """
    found: dict[str, set[str]] = {module: set() for module in texts}
    for module, text in texts.items():
        for _, name in imported(module, ast.parse(text)):
            there = name if name in texts else name.rpartition(".")[0]
            if there in texts and there not in (module, "turgor"):
                found[module].add(there)
    return found


def cycles(graph: Mapping[str, set[str]]) -> list[tuple[str, ...]]:
    """Find the groups of files that import each other, directly or by others, each group sorted."""
    needs = _reachable(graph)
    groups = {tuple(sorted(b for b in needs[a] if a in needs[b])) for a in graph if a in needs[a]}
    return sorted(groups)


def _reachable(graph: Mapping[str, set[str]]) -> dict[str, set[str]]:
    """Find what each file needs, directly or by others."""
    found = {}
    for start in graph:
        seen: set[str] = set()
        stack = list(graph[start])
        while stack:
            here = stack.pop()
            if here not in seen:
                seen.add(here)
                stack.extend(graph[here])
        found[start] = seen
    return found
