"""Compiled loops in several files: a change in a file that a loop calls reaches the loop."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

SOURCE = Path(__file__).parents[5] / "src" / "turgor"

CALLER = """
from numba import njit
import callee
from turgor.core.engine.compiled import calls

@njit(cache=True)
@calls(callee)
def loop(x):
    return callee.value(x)

print(loop(2.0), sum(loop.stats.cache_hits.values()))
"""
CALLEE = """
from numba import njit

@njit(cache=True)
def value(x):
    return {factor} * x
"""


def run(folder):
    ended = subprocess.run([sys.executable, "caller.py"], cwd=folder, capture_output=True, text=True, check=True)
    value, hits = ended.stdout.split()
    return float(value), int(hits)


def test_a_change_in_a_called_file_is_compiled(tmp_path):
    (tmp_path / "caller.py").write_text(CALLER)
    (tmp_path / "callee.py").write_text(CALLEE.format(factor="3.0"))
    assert run(tmp_path) == (6.0, 0)
    assert run(tmp_path) == (6.0, 1)  # from the cache
    (tmp_path / "callee.py").write_text(CALLEE.format(factor="5.0"))
    assert run(tmp_path) == (10.0, 0)


def compiled_functions(path):
    """Names of the compiled functions of a file, and for each what it calls by name and which modules it states."""
    tree, modules = ast.parse(path.read_text(encoding="utf-8")), {}
    for node in tree.body:
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("turgor."):
            modules |= {alias.name: node.module for alias in node.names}
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and any("njit" in ast.unparse(each) for each in node.decorator_list):
            stated = {
                ast.unparse(name)
                for each in node.decorator_list
                if isinstance(each, ast.Call) and ast.unparse(each.func) == "calls"
                for name in each.args
            }
            calls = [each for line in node.body for each in ast.walk(line) if isinstance(each, ast.Call)]
            called = {each.func.id for each in calls if isinstance(each.func, ast.Name)}
            yield node.name, {modules[name].split(".")[-1] for name in called if name in modules}, stated


@pytest.mark.parametrize("path", sorted((SOURCE / "core" / "engine").rglob("*.py")), ids=lambda path: path.stem)
def test_compiled_functions_state_the_files_that_they_call(path):
    for name, called, stated in compiled_functions(path):
        assert called <= stated, f"{name} calls functions of {called - stated}; name them in calls()"
