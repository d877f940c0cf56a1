"""Facts that stand in two places agree: versions, public names, dependencies, what the wheel holds."""

import ast
import re
import subprocess
import sys
import tomllib
import zipfile
from email import message_from_bytes
from importlib import import_module
from pathlib import Path
from types import FunctionType, ModuleType

import pytest

import turgor
from refused import refused
from turgor.core.materials.laws.laws import LAWS
from turgor.core.results.measures.measures import MEASURES
from turgor.foundation.lazy_names import names_in
from turgor.job.job import ACTUATORS

ROOT = Path(__file__).parents[3]
SOURCES = sorted((ROOT / "src").rglob("*.py"))
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]

#: Distributions whose import name is another one.
IMPORT_NAMES = {"pillow": "PIL", "fenics-basix": "basix", "netgen-mesher": "netgen"}

#: Packages that come inside a distribution of another name.
INSIDE = {"mpl_toolkits"}  # matplotlib


#: Modules that hold the public names that are not at the root.
NAMESPACES = [
    value
    for value in (getattr(turgor, name) for name in turgor.__all__)
    if isinstance(value, ModuleType) and value is not turgor.units
]


def read(name):
    return (ROOT / name).read_text(encoding="utf-8")


def test_version_is_the_same_everywhere():
    assert turgor.__version__ == PROJECT["version"]
    assert f"\nversion: {PROJECT['version']}\n" in read("CITATION.cff")


def test_every_public_name_exists():
    assert [name for name in turgor.__all__ if not hasattr(turgor, name)] == []
    for module in NAMESPACES:
        assert [name for name in module.__all__ if not hasattr(module, name)] == []
        assert set(module.__all__) <= set(dir(module))


def test_a_name_stands_in_one_namespace_only():
    every = [name for module in NAMESPACES for name in module.__all__]
    twice = {name for name in every if every.count(name) > 1}
    assert twice == {"blocked_force"}, "the setup, and what is measured in it"


def test_every_law_and_actuator_and_measure_has_a_public_name():
    for namespace, registry in ((turgor.actuators, ACTUATORS), (turgor.laws, LAWS)):
        assert {kind.__name__ for kind in registry.values()} <= set(namespace.__all__)
    assert set(MEASURES) <= set(turgor.measures.__all__)


def test_every_public_name_is_in_the_reference():
    pages = "".join(page.read_text("utf-8") for page in (ROOT / "docs" / "reference").glob("*.md"))
    shown = set(re.findall(r"auto(?:module|class|function):: ([\w.]+)", pages))
    missing = set()
    for namespace in (turgor, *NAMESPACES):
        for name, module in names_in(namespace.__file__).items():
            value = getattr(namespace, name)
            if isinstance(value, ModuleType):
                continue
            home = value.__module__ if isinstance(value, type | FunctionType) else module
            if not {home, f"{home}.{name}"} & shown:
                missing.add(f"{home}.{name}")
    assert missing == set()


def test_an_unknown_name_is_refused():
    with refused("'turgor'", "'nonsense'", error=AttributeError):
        turgor.nonsense  # noqa: B018
    with refused("'Model'", error=AttributeError):
        turgor.laws.Model  # noqa: B018


def test_documents_and_examples_import_public_names_only():
    allowed = {"turgor", "turgor.units", *(f"turgor.{module.__name__.rpartition('.')[2]}" for module in NAMESPACES)}
    folders = (ROOT / "docs", ROOT / "examples")
    pages = [ROOT / "README.md", *(page for each in folders for page in (*each.rglob("*.md"), *each.rglob("*.py")))]
    line = re.compile(r"^\s*(?:>>> )?(?:from|import) (turgor(?!_)[\w.]*)", re.MULTILINE)
    imported = {(page.name, module) for page in pages for module in line.findall(page.read_text("utf-8"))}
    assert {each for each in imported if each[1] not in allowed} == set()


def test_what_type_checkers_read_is_what_the_modules_hold():
    for module in (turgor, *NAMESPACES):
        tree = ast.parse(Path(module.__file__).read_text("utf-8"))
        shown = next(node for node in tree.body if isinstance(node, ast.If)).body
        assert sorted(alias.asname for line in shown for alias in line.names) == module.__all__
    assert len(turgor.__all__) - len(NAMESPACES) <= 56, "those that most scripts need; others stand in namespaces"


def test_dependencies_are_those_that_are_imported():
    imported = _imported(path for path in SOURCES if "studio" not in path.parts)
    names = (re.match(r"[\w-]+", entry)[0] for entry in PROJECT["dependencies"])
    declared = {IMPORT_NAMES.get(name, name) for name in names}
    assert imported == declared


def test_the_studio_imports_what_its_extra_names():
    imported = _imported(path for path in SOURCES if "studio" in path.parts)
    extra = {re.match(r"[\w-]+", entry)[0] for entry in PROJECT["optional-dependencies"]["studio"]}
    others = {re.match(r"[\w-]+", entry)[0] for entry in PROJECT["dependencies"]}
    assert imported - {IMPORT_NAMES.get(name, name) for name in others} == extra - {"websockets"}  # uvicorn names it


def _imported(paths):
    """Packages that files import by statements."""
    imported = set()
    for path in paths:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                imported |= {alias.name.split(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and not node.level:
                imported.add(node.module.split(".")[0])
    return imported - {"turgor", *INSIDE, *sys.stdlib_module_names}


def test_the_conda_recipe_asks_for_the_same_packages():
    recipe = read("release/conda/recipe.yaml").split("  run:\n")[1].split("tests:")[0]
    asked = {line.strip("- ").replace(" ", "") for line in recipe.splitlines()}
    other = {"netgen-mesher": "netgen", "matplotlib": "matplotlib-base"}
    names = {
        other.get(name, name) + rest
        for name, rest in (re.match(r"([\w-]+)(.*)", each).groups() for each in PROJECT["dependencies"])
    }
    assert asked == {*names, f"python{PROJECT['requires-python']}"}
    assert f'version: "{PROJECT["version"]}"' in read("release/conda/recipe.yaml")


@pytest.mark.parametrize("lock", ["run", "dev", "docs", "fast"])
def test_lock_pins_what_the_project_asks_for(lock):
    lines = read(f"requirements/{lock}.lock").splitlines()
    pinned = dict(line.split(" ;")[0].split("==") for line in lines)
    extra = PROJECT["optional-dependencies"].get(lock, [])
    asked = {re.match(r"[\w-]+", entry)[0].lower() for entry in (*PROJECT["dependencies"], *extra)}
    assert asked <= set(pinned)


def test_locks_agree_with_each_other():
    run, *others = (set(read(f"requirements/{lock}.lock").splitlines()) for lock in ("run", "dev", "docs", "fast"))
    for other in others:
        assert run <= other


def test_wheel_holds_data_and_command(tmp_path):
    build = "import sys, hatchling.build as b; print(b.build_wheel(sys.argv[1]))"
    run = subprocess.run(
        [sys.executable, "-c", build, str(tmp_path)], cwd=ROOT, check=True, capture_output=True, text=True
    )
    with zipfile.ZipFile(tmp_path / run.stdout.splitlines()[-1]) as wheel:
        held = {name for name in wheel.namelist() if "__pycache__" not in name}
        entry = next(name for name in held if name.endswith("entry_points.txt"))
        assert "turgor = turgor.cli:command" in wheel.read(entry).decode()
        metadata = message_from_bytes(wheel.read(entry.replace("entry_points.txt", "METADATA")))
    assert metadata["Description-Content-Type"] == "text/markdown"
    assert metadata.get_payload().startswith("# turgor\n")
    assert re.findall(r"\]\((?!https?://|#)([^)]*)\)", metadata.get_payload()) == []
    folder = ROOT / "src"
    wanted = {
        path.relative_to(folder).as_posix()
        for path in folder.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts and "egg-info" not in str(path)
    }
    assert wanted <= held
    assert {"turgor/py.typed", "turgor/core/materials/library/data/paper.toml"} <= held
    examples = "turgor/job/reference/examples/"
    jobs = {name.rpartition("/")[2].removesuffix(".toml") for name in held if name.startswith(examples)}
    assert jobs == set(ACTUATORS)


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        (None, "the Guide and [a paper](https://doi.org/1)\n\nand [below](#more)"),
        (
            "https://example.org/turgor/",
            "the [Guide](https://example.org/turgor/blob/main/docs/guide.md#top) and [a paper](https://doi.org/1)\n\n"
            "![Finger](https://example.org/turgor/raw/main/docs/finger.png)\n\nand [below](#more)",
        ),
    ],
)
def test_readme_for_the_package_index_has_no_links_to_files(monkeypatch, source, expected):
    monkeypatch.syspath_prepend(str(ROOT / "release"))
    text = (
        "the [Guide](docs/guide.md#top) and [a paper](https://doi.org/1)\n\n"
        "![Finger](docs/finger.png)\n\nand [below](#more)"
    )
    assert import_module("readme").for_index(text, source) == expected
