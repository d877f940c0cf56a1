"""Put probes in place of the chosen numbers in the source of modules, when they are imported."""

import ast
import sys
from collections.abc import Iterator
from importlib.machinery import SourceFileLoader
from importlib.util import find_spec
from pathlib import Path
from types import CodeType
from typing import Any

from benchmarks.robustness.probes import NUMBERS, plain, probe


class Plan:
    """Which numbers get probes, which do not, and the values of all."""

    def __init__(self) -> None:
        self.prefixes: tuple[str, ...] = ()
        self.compiled: set[str] = set()
        self.unprobed: set[str] = set()
        self.changed: dict[str, Any] = {}
        self.values: dict[str, Any] = {}


PLAN = Plan()


def made(name: str, value: Any) -> Any:
    """What stands for a number of the source: a probe, another value, or the number where kernels compile it."""
    if name in PLAN.changed:
        PLAN.values[name] = PLAN.changed[name]
        return PLAN.changed[name]
    value = plain(value)
    if not isinstance(value, NUMBERS) or not name.startswith(PLAN.prefixes):
        return value
    PLAN.values[name] = value
    if name in PLAN.compiled | PLAN.unprobed:
        return value
    half = (value // 2 or 1) if isinstance(value, int) else value / 2
    return probe((value, half, 2 * value), frozenset({name}))


def is_number(node: ast.expr | None) -> bool:
    """Whether an expression is a number, a calculation with one, or a tuple, list or dictionary of them."""
    match node:
        case ast.Constant(value=value):
            return isinstance(value, int | float) and not isinstance(value, bool)
        case ast.UnaryOp(operand=operand):
            return is_number(operand)
        case ast.BinOp(left=left, right=right):
            return is_number(left) or is_number(right)
        case ast.Tuple(elts=parts) | ast.List(elts=parts) | ast.Dict(values=parts):
            return bool(parts) and all(is_number(part) for part in parts)
    return False


def _wrapped(node: Any, name: str) -> ast.expr:
    """The call of `made` around a number, or around each of a tuple, list or dictionary."""
    if isinstance(node, ast.Tuple | ast.List):
        node.elts = [_wrapped(part, name) for part in node.elts]
        return node
    if isinstance(node, ast.Dict):
        node.values = [_wrapped(part, name) for part in node.values]
        return node
    return ast.copy_location(ast.Call(ast.Name("__made__", ast.Load()), [ast.Constant(name), node], []), node)


def _assignments(body: list[ast.stmt], all_names: bool) -> Iterator[tuple[Any, str]]:
    """Assignments of numbers to names in upper case, or in a class of settings to all."""
    for node in body:
        target = node.targets[0] if isinstance(node, ast.Assign) else getattr(node, "target", None)
        if not (isinstance(node, ast.Assign | ast.AnnAssign) and isinstance(target, ast.Name)):
            continue
        if is_number(node.value) and (all_names or target.id.strip("_").isupper()):
            yield node, target.id


def with_probes(text: str, module: str) -> ast.Module:
    """A module in which `made` stands around each chosen number."""
    tree = ast.parse(text)
    classes = [node for node in tree.body if isinstance(node, ast.ClassDef) and node.name.endswith("Settings")]
    results = list(_assignments(tree.body, False))
    results += [(node, f"{each.name}.{name}") for each in classes for node, name in _assignments(each.body, True)]
    for node, name in results:
        node.value = _wrapped(node.value, f"{module}.{name}")
    if results:
        first = next(k for k, node in enumerate(tree.body) if node in classes or node in [one for one, _ in results])
        tree.body.insert(first, ast.ImportFrom(__name__, [ast.alias("made", "__made__")], 0))
    return ast.fix_missing_locations(tree)


def compiled_numbers(root: Path) -> Iterator[str]:
    """Names of numbers that kernels of numba read as globals."""
    for file in root.rglob("*.py"):
        text = file.read_text("utf-8")
        if "njit" not in text:
            continue
        tree = ast.parse(text)
        module = ".".join(file.relative_to(root).with_suffix("").parts)
        origins = {
            each.name: str(node.module).removeprefix("turgor.")
            for node in tree.body
            if isinstance(node, ast.ImportFrom)
            for each in node.names
        }
        for node in tree.body:
            if isinstance(node, ast.FunctionDef) and any("njit" in ast.unparse(each) for each in node.decorator_list):
                for each in ast.walk(node):
                    if isinstance(each, ast.Name):
                        yield f"{origins.get(each.id, module)}.{each.id}"


def install(prefixes: list[str], unprobed: list[str], changed: list[str]) -> None:
    """Let modules that are imported from now on have probes; ``changed`` has texts as ``module.NAME=1.5``."""
    spec = find_spec("turgor")
    assert spec
    assert spec.origin
    if wrong := [name for name in sys.modules if name.startswith(tuple(f"turgor.{prefix}." for prefix in prefixes))]:
        raise RuntimeError(f"{', '.join(wrong[:3])} were imported before the probes.")
    PLAN.prefixes = tuple(prefixes)
    PLAN.compiled = set(compiled_numbers(Path(spec.origin).parent))
    PLAN.unprobed = set(unprobed)
    PLAN.changed = {name: ast.literal_eval(value) for name, _, value in (text.partition("=") for text in changed)}
    folders = tuple(f"turgor.{name}" for name in prefixes)
    ordinary = SourceFileLoader.get_code

    def get_code(loader: SourceFileLoader, name: str) -> CodeType | None:
        path, module = loader.get_filename(name), name.removeprefix("turgor.")
        changes = any(each.startswith(f"{module}.") for each in PLAN.changed)
        if not (changes or name.startswith(folders)) or path.endswith(".pyc"):
            return ordinary(loader, name)
        tree = with_probes(Path(path).read_text("utf-8"), module)
        return compile(tree, path, "exec", dont_inherit=True)

    SourceFileLoader.get_code = get_code  # type: ignore[method-assign]
