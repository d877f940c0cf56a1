"""Scripts that draw parts: their functions with parameters, read without running them, and a hash of all their text."""

import ast
from collections.abc import Iterator
from dataclasses import replace
from hashlib import sha256
from math import inf
from pathlib import Path
from typing import Any

from turgor.core.geometry.cad.parametric.parameter import KINDS, Parameter
from turgor.foundation.errors import TurgorError, near_match
from turgor.units import UNITS

#: Function of a script that is called where a job names none.
BUILD = "build"


def parameters_of(script: Path, function: str = BUILD) -> tuple[Parameter, ...]:
    """Return the parameters of a function of a script, which does not run.

    Parameters
    ----------
    script : Path
    function : str
        Name of a function at the top level of the script.

    Returns
    -------
    tuple of Parameter
        A parameter ``wall: Annotated[float, "mm", (0.5, 3)] = 1.5`` has a unit and a range.

    Raises
    ------
    TurgorError
        If the script is no Python, or has no such function, with the near match.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     script = Path(folder) / "part.py"
    ...     _ = script.write_text("def build(wall, folds=3): ...")
    ...     [(each.name, each.needed, each.default) for each in parameters_of(script)]
    [('wall', True, None), ('folds', False, 3)]
    """
    tree = _parsed(script)
    functions = {each.name: each for each in tree.body if isinstance(each, ast.FunctionDef)}
    if function not in functions:
        there = f"Functions there: {', '.join(functions)}." if functions else "It has none at its top level."
        raise TurgorError(
            f"function is '{function}', and '{script.name}' has no such function"
            f"{near_match(function, functions) or '.'} {there}"
        )
    given = functions[function].args
    if given.posonlyargs:
        raise TurgorError(
            f"function is '{function}', and in '{script.name}' its arguments before '/' have no names; remove the '/'."
        )
    defaults = [None] * (len(given.args) - len(given.defaults)) + list(given.defaults)
    pairs = [*zip(given.args, defaults, strict=True), *zip(given.kwonlyargs, given.kw_defaults, strict=True)]
    return tuple(_parameter(argument, default, script) for argument, default in pairs)


def digest_of(script: Path) -> str:
    """Return a hash of the text of a script and of the modules in its folder that it imports.

    Parameters
    ----------
    script : Path

    Returns
    -------
    str
    """
    digest = sha256()
    for file in sorted(sources_of(script)):
        digest.update(f"{file.relative_to(script.parent)}\n".encode() + file.read_bytes())
    return digest.hexdigest()


def sources_of(script: Path) -> set[Path]:
    """Return a script and the modules in its folder that it imports, and those that these import."""
    files, waiting = {script}, [script]
    while waiting:
        file = waiting.pop()
        for name in _imported(file):
            path = script.parent.joinpath(*name.split("."))
            for each in (path.with_suffix(".py"), path / "__init__.py"):
                if each.is_file() and each not in files:
                    files.add(each)
                    waiting.append(each)
    return files


def _imported(file: Path) -> Iterator[str]:
    """Names of what a file imports, with each name taken from a module: it may be a module of a package."""
    try:
        tree = _parsed(file)
    except TurgorError:
        return  # the script is refused when it is read or runs
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def _parsed(script: Path) -> ast.Module:
    try:
        return ast.parse(script.read_bytes(), filename=str(script))
    except SyntaxError as error:
        raise TurgorError(f"'{script.name}', line {error.lineno}, is no Python: {error.msg}.") from None
    except ValueError as error:  # a null byte
        raise TurgorError(f"'{script.name}' is no Python: {error}.") from None


def _parameter(argument: ast.arg, default: ast.expr | None, script: Path) -> Parameter:
    value = None if default is None else _literal(default)
    plain = value if isinstance(value, bool | int | float | str) else None
    parameter = Parameter(name=argument.arg, needed=default is None, default=plain)
    annotation, extras = argument.annotation, []
    if isinstance(annotation, ast.Subscript) and _name(annotation.value) == "Annotated":
        inner = annotation.slice
        annotation, *extras = inner.elts if isinstance(inner, ast.Tuple) else [inner]
    kind = KINDS.get(_name(annotation) if annotation is not None else _kind_of(plain), "number")
    parameter = replace(parameter, kind=kind)
    for extra in extras:
        parameter = _with_extra(parameter, _literal(extra), f"'{script.name}', line {argument.lineno}")
    return parameter


def _with_extra(parameter: Parameter, extra: Any, where: str) -> Parameter:
    """A parameter with a unit or a range of its annotation; others mean nothing here."""
    if isinstance(extra, str):
        known = (*UNITS["length"], *UNITS["angle"])
        if extra not in known:
            raise TurgorError(
                f"{where}: the unit of {parameter.name} is '{extra}'{near_match(extra, known) or '.'} "
                f"Allowed: {', '.join(known)}."
            )
        return replace(parameter, unit=extra)
    if isinstance(extra, tuple) and len(extra) == 2:
        low, high = (edge if edge is not None else side for edge, side in zip(extra, (-inf, inf), strict=True))
        if not low <= high:
            raise TurgorError(f"{where}: the range of {parameter.name} is {extra}; the lower end comes first.")
        return replace(parameter, low=float(low), high=float(high))
    return parameter


def _kind_of(default: object) -> str:
    """Type of a default; a whole number may stand for a length, such as ``wall=2``."""
    return "float" if type(default) is int else type(default).__name__


def _name(node: ast.expr) -> str:
    return node.id if isinstance(node, ast.Name) else node.attr if isinstance(node, ast.Attribute) else ""


def _literal(node: ast.expr) -> Any:
    try:
        return ast.literal_eval(node)
    except ValueError:
        return None
