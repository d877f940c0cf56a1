"""The parameters that a docstring describes are those that the function or dataclass has, in the same order.

numpydoc's own check does not know that the fields of a dataclass are its parameters, hence this one.
"""

import ast
import re
from pathlib import Path

import pytest

SOURCE = Path(__file__).parents[2] / "src"
FILES = sorted(SOURCE.rglob("*.py"))
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
    arguments = [*every.posonlyargs, *every.args, every.vararg, *every.kwonlyargs]
    return [a.arg for a in arguments if a is not None and a.arg not in ("self", "cls")]


def is_parameter(field):
    made = field.value is not None and "init=False" in ast.unparse(field.value)
    return not made and not field.target.id.startswith("_")


def mistakes(text):
    """List the docstrings of a module that describe other parameters than there are."""
    found = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            names = described(node)
            if names is not None and names != accepted(node):
                found.append(f"{node.name} describes {', '.join(names)}; it takes {', '.join(accepted(node))}")
    return found


@pytest.mark.parametrize("path", FILES, ids=lambda path: ".".join(path.relative_to(SOURCE).with_suffix("").parts))
def test_described_parameters_are_the_parameters(path):
    assert mistakes(path.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize("names", ["a", "a, c", "b, a", "a, b, c"])
def test_a_mistake_is_noticed(names):
    docstring = f'"""Do it.\n\n    Parameters\n    ----------\n    {names} : float\n        Text, more text.\n    """'
    assert len(mistakes(f"def do(a, b):\n    {docstring}\n")) == 1
    fields = "    a: float\n    b: float\n    _c: float\n    c: int = field(init=False)"
    assert len(mistakes(f"class Do:\n    {docstring}\n{fields}\n")) == 1


def test_a_right_docstring_is_not_blamed():
    docstring = '"""Do it.\n\n    Parameters\n    ----------\n    a, b : float [Pa]\n        Text.\n    c\n    """'
    assert mistakes(f"def do(a, *b, c):\n    {docstring}\n") == []
