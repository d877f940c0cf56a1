"""The parameters that a docstring describes are those that the function or dataclass has, in the same order.

numpydoc's own check does not know that the fields of a dataclass are its parameters, hence this one.
"""

import ast
import re
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
FILES = sorted(path for folder in ("src", "guidelines/src") for path in (ROOT / folder).rglob("*.py"))
SECTION = re.compile(r"^Parameters\n-+\n(.*?)(?=^\w[^\n]*\n-{3,}|\Z)", re.DOTALL | re.MULTILINE)
ENTRY = re.compile(r"^(\*{0,2}\w[\w, *]*?)(?: : .*)?$", re.MULTILINE)


def described(node):
    """Names in the section Parameters; None where there is none."""
    section = SECTION.search(ast.get_docstring(node) or "")
    if section is None:
        return None
    return [name.strip().lstrip("*") for entry in ENTRY.findall(section[1]) for name in entry.split(",")]


def accepted(node):
    """Names that a function or a class takes; ``self`` and private fields are left out."""
    if isinstance(node, ast.ClassDef):
        inits = [item for item in node.body if isinstance(item, ast.FunctionDef) and item.name == "__init__"]
        if inits:
            return accepted(inits[0])
        return [item.target.id for item in node.body if isinstance(item, ast.AnnAssign) and is_parameter(item)]
    every = node.args
    arguments = [*every.posonlyargs, *every.args, every.vararg, *every.kwonlyargs, every.kwarg]
    return [a.arg for a in arguments if a is not None and a.arg not in ("self", "cls")]


def is_parameter(field):
    made = field.value is not None and "init=False" in ast.unparse(field.value)
    shared = "ClassVar" in ast.unparse(field.annotation)
    return not (made or shared or field.target.id.startswith("_"))


def classes_in(text):
    """Classes of a module by name."""
    return {node.name: node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.ClassDef)}


@cache
def all_classes():
    """Classes of all modules by name."""
    return {name: node for path in FILES for name, node in classes_in(path.read_text(encoding="utf-8")).items()}


def inherited(node, classes):
    """Names that a dataclass takes from the dataclasses it extends; attributes of other classes are no parameters."""
    bases = [classes[base.id] for base in getattr(node, "bases", []) if getattr(base, "id", "") in classes]
    return [name for b in bases for name in [*inherited(b, classes), *(accepted(b) if is_made(b) else ())]]


def is_made(node):
    """Whether a class takes names when it is made: it has a decorator or an ``__init__``."""
    return bool(node.decorator_list) or any(getattr(item, "name", "") == "__init__" for item in node.body)


def mistakes(text, classes=None):
    """List the docstrings of a module that describe other parameters than there are.

    Where a class extends another one, it describes its own fields, or in any order those it inherits as well.
    """
    results = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            names, more = described(node), inherited(node, all_classes() if classes is None else classes)
            takes = list(dict.fromkeys([*more, *accepted(node)]))
            same = names in (takes, accepted(node)) or (bool(more) and sorted(names or []) == sorted(takes))
            if names is not None and not same:
                results.append(f"{node.name} describes {', '.join(names)}; it takes {', '.join(takes)}")
    return results


def test_described_parameters_are_the_parameters():
    results = {path.relative_to(ROOT).as_posix(): mistakes(path.read_text(encoding="utf-8")) for path in FILES}
    assert len(results) > 1000
    assert {name: lines for name, lines in results.items() if lines} == {}


@pytest.mark.parametrize("names", ["a", "a, c", "b, a", "a, b, c"])
def test_a_mistake_is_noticed(names):
    docstring = f'"""Do it.\n\n    Parameters\n    ----------\n    {names} : float\n        Text, more text.\n    """'
    assert len(mistakes(f"def do(a, b):\n    {docstring}\n", {})) == 1
    fields = "    a: float\n    b: float\n    _c: float\n    c: int = field(init=False)"
    assert len(mistakes(f"class Do:\n    {docstring}\n{fields}\n", {})) == 1


def test_a_right_docstring_is_not_blamed():
    docstring = '"""Do it.\n\n    Parameters\n    ----------\n    a, b : float [Pa]\n        Text.\n    c\n    """'
    assert mistakes(f"def do(a, *b, c):\n    {docstring}\n", {}) == []


def test_inherited_fields_are_parameters():
    base = "@dataclass\nclass Base:\n    size: int\n"
    section = "Parameters\n    ----------\n    shape : str\n    size : int\n"
    own = f'class Own(Base):\n    """Own.\n\n    {section}    """\n    shape: str\n'
    assert mistakes(base + own, classes_in(base + own)) == []
    assert mistakes(own.replace("    shape : str\n", ""), classes_in(base + own)) != []
