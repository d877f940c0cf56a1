"""What documents say is so: findings, functions, examples, jobs and links that they name exist and work."""

import ast
import pkgutil
import re
import signal
from dataclasses import is_dataclass
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import pytest
from PIL import Image

import turgor as tg
from turgor.cli import answers
from turgor.cli.exits import BAD_INPUT, DONE, ENDED, FOUND_ERROR, NOT_CONVERGED
from turgor.cli.start.commands import COMMANDS
from turgor.job.tables.contact import ContactTable
from turgor.job.tables.fibers import FibersTable
from turgor.job.tables.obstacles import SHAPES, STL, ObstacleTable, obstacle_table

ROOT = Path(__file__).parents[3]
SOURCES = sorted((ROOT / "src").rglob("*.py"))
FINDING = re.compile(r"\b([BDFGLMNPTU]\d\d)\b")


def read(name):
    return (ROOT / name).read_text(encoding="utf-8")


def blocks(name, language):
    """The code blocks of a page in a language."""
    return re.findall(rf"```{language}\n(.*?)```", read(name), re.DOTALL)


def test_every_finding_has_its_section():
    used = {code for path in SOURCES for code in FINDING.findall(path.read_text(encoding="utf-8"))}
    assert set(re.findall(r"^## (\w+)$", read("docs/findings.md"), re.MULTILINE)) == used
    assert used >= {"G01", "B01", "B02"}


@pytest.mark.parametrize("page", ["theory", "rods"])
def test_functions_named_on_the_pages_on_theory_exist(page):
    names = set(re.findall(r"`(turgor\.[\w.]+)`", read(f"docs/{page}.md")))
    assert len(names) > 15
    for name in names:
        module, attribute = name.rsplit(".", 1)
        assert find_spec(module) is not None, name
        assert hasattr(import_module(module), attribute) or find_spec(name) is not None, name


def test_example_of_the_readme_is_the_example():
    (block,) = blocks("README.md", "python")
    statements = [ast.dump(node) for node in ast.parse(block).body]
    example = [ast.dump(node) for node in ast.parse(read("examples/fast_pneunet.py")).body]
    assert [statement for statement in statements if statement not in example] == []


def test_links_between_documents_lead_somewhere():
    pages = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]
    broken = []
    for page in pages:
        for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
            if not (page.parent / target).exists():
                broken.append(f"{page.name}: {target}")
    assert broken == []


def test_job_of_the_guide_on_materials_is_read(tmp_path):
    file = tmp_path / "job.toml"
    file.write_text("\n".join(blocks("docs/howto/own-material.md", "toml")), encoding="utf-8")
    materials = tg.jobs.read_job(file).materials
    assert materials["body"].law == tg.Yeoh(C10=48e3, C20=1.5e3)
    assert materials["strain_limiting_layer"].thickness == 0.2e-3
    names = {}
    exec("\n".join(blocks("docs/howto/own-material.md", "python")), names)
    assert names["rubber"] == materials["body"]


def test_jobs_of_the_guides_on_reinforcement_are_read(tmp_path):
    file = tmp_path / "job.toml"
    for page, name in (("fibers", "braid"), ("strain-limiting-layer", None)):
        file.write_text(blocks(f"docs/howto/{page}.md", "toml")[0], encoding="utf-8")
        job = tg.jobs.read_job(file)
        assert list(job.fibers) == ([name] if name else [])
    assert isinstance(job.materials["strain_limiting_layer"], tg.Shell)
    keys = set(re.findall(r"`(\w+)`", "".join(re.findall(r"(?m)^\| (.*?) \|", read("docs/howto/fibers.md")))))
    assert keys - {"E"} == set(FibersTable.model_fields) - {"name", "law", "E", "nu", "density", "source"}


def test_job_of_the_guide_on_contact_is_read(tmp_path):
    page = "docs/howto/contact.md"
    file = tmp_path / "job.toml"
    file.write_text(blocks(page, "toml")[0], encoding="utf-8")
    names = {}
    exec(blocks(page, "python")[0], names)
    assert tg.jobs.read_job(file).contact == names["contact"]
    first = [re.findall(r"`([\w\"]+)`", cell) for cell in re.findall(r"(?m)^\| (.*?) \|", read(page))]
    keys = {name for cell in first for name in cell}
    shapes = (*SHAPES, STL)
    assert keys == {*ContactTable.model_fields, *ObstacleTable.model_fields, *(f'"{shape}"' for shape in shapes)}
    for shape in shapes:
        (row,) = re.findall(rf'(?m)^\| `"{shape}"` \| (.*) \|$', read(page))
        own = set(obstacle_table(shape).model_fields) - set(ObstacleTable.model_fields) - {"sha256"}
        assert set(re.findall(r"`(\w+)`", row)) == own


def test_page_on_the_command_line_names_every_command_result_and_exit_code():
    page = read("docs/reference/command-line.md")
    assert set(re.findall(r"`turgor (\w+) ", page)) >= set(COMMANDS) - {"materials"}
    for module in (each.name for each in pkgutil.iter_modules(answers.__path__) if each.name != "document"):
        result = import_module(f"{answers.__name__}.{module}")
        kinds = {name for name, kind in vars(result).items() if is_dataclass(kind)}
        members = page.partition(f"answers.{module}\n   :members:")[2].partition(":no-index:")[0]
        assert set(re.findall(r"\w+", members)) == kinds, module
    codes = (DONE, BAD_INPUT, FOUND_ERROR, NOT_CONVERGED, ENDED + signal.SIGINT, ENDED + signal.SIGTERM)
    assert re.findall(r"(?m)^\| (\d+) \|", page) == [str(int(code)) for code in codes]


def test_gallery_shows_its_pictures_and_they_move(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "docs"))
    names = import_module("gallery").MOVING
    files = [ROOT / "docs" / target for target in re.findall(r"!\[.*\]\((.*\.webp)\)", read("docs/gallery.md"))]
    assert [file.stem for file in files] == list(names)
    assert sum(file.stat().st_size for file in files) < 1_000_000
    assert all(Image.open(file).n_frames > 10 for file in files)


def test_pictures_of_the_architecture_show_what_exists(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "docs"))
    pictures = import_module("architecture_pictures")
    order = next(line for line in read("docs/architecture.md").splitlines() if line.startswith("    foundation → "))
    assert ["foundation", *pictures.ROOMS] == order.strip().split(" → ")
    for name in pictures.PARTS:
        module, attribute = name.rsplit(".", 1)
        assert hasattr(import_module(module), attribute), name


def test_paths_named_on_the_page_on_the_architecture_exist():
    source = ROOT / "src" / "turgor"
    wings = "|".join(path.name for path in source.iterdir() if (path / "__init__.py").exists())
    named = set(re.findall(rf"`((?:{wings})/[\w/]+)(?:\.py|\.\w+)?`", read("docs/architecture.md")))
    assert len(named) > 15
    assert [name for name in named if not (source / name).is_dir() and not (source / f"{name}.py").exists()] == []


def test_each_wing_is_in_the_table_of_the_architecture_and_says_what_it_is():
    wings = {path.parent.name: path for path in (ROOT / "src" / "turgor").glob("*/__init__.py")}
    table = read("docs/architecture.md").partition("| wing |")[2].partition("\n\n")[0]
    assert set(re.findall(r"(?m)^\| `(\w+)` \|", table)) == set(wings)
    for name, path in wings.items():
        assert re.match(rf'"""{name.replace("_", " ")}|"""command line', path.read_text("utf-8"), re.IGNORECASE), name
