"""Late modules: not executed by an import, whole with the first use, and commands that are loaded one by one."""

import subprocess
import sys

import pytest
import typer.main

from turgor.cli.start.commands import COMMANDS, app_of
from turgor.cli.start.lazy_imports import LATE


def said(script: str) -> list[str]:
    """Lines that a process of its own prints, in which modules are late."""
    text = f"import sys\nfrom turgor.cli.app import settle\nsettle()\n{script}"
    return subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True).stdout.splitlines()


def test_what_scipy_and_numba_import_in_passing_is_not_executed():
    script = (
        "import scipy.sparse, numba\nprint(*sys.modules)\nprint(*(type(sys.modules[n]).__name__ for n in sys.argv))"
    )
    script = script.replace("sys.argv", repr(["numpy.f2py", "numpy.testing", "yaml"]))
    modules, kinds = said(script)
    assert set(modules.split()) & {"numpy.f2py.crackfortran", "numpy.testing._private.utils", "yaml.reader"} == set()
    assert set(kinds.split()) == {"LateModule"}


@pytest.mark.parametrize(
    ("use", "result"),
    [
        ("import scipy.linalg; print(scipy.linalg.det([[2.0, 0.0], [0.0, 3.0]]))", "6.0"),
        ("from scipy.linalg import lstsq; print(lstsq.__module__)", "scipy.linalg._basic"),
        ("import scipy.linalg.cython_blas as b; print('dgemm' in b.__pyx_capi__)", "True"),
        ("import yaml; print(yaml.safe_load('a: 1'))", "{'a': 1}"),
        ("import numpy; print(numpy.testing.assert_allclose(1, 1))", "None"),
        ("import inspect, yaml; print('def safe_load(' in inspect.getsource(yaml))", "True"),
        ("import yaml; print(hasattr(yaml, 'nothing'), type(yaml).__name__)", "False module"),
        (
            "import yaml; yaml.load; print(yaml.__spec__.loader is yaml.__loader__, '_waiting' in vars(yaml))",
            "True False",
        ),
    ],
)
def test_a_late_module_is_whole_once_it_is_used(use, result):
    assert said(use) == [result]


def test_threads_that_use_a_late_module_together_find_it_whole():
    script = (
        "import yaml\nfrom concurrent.futures import ThreadPoolExecutor\nsys.setswitchinterval(1e-6)\n"
        "def read(k):\n    return yaml.safe_load(f'a: {k}')['a']\n"
        "with ThreadPoolExecutor(8) as pool:\n    print(*pool.map(read, range(8)))"
    )
    assert said(script) == ["0 1 2 3 4 5 6 7"]


def test_only_the_process_of_a_command_has_late_modules():
    assert not [each for each in sys.meta_path if type(each).__name__ == "LateFinder"]
    modules, later = said("import turgor\nprint(len(sys.meta_path))\nsettle()\nprint(len(sys.meta_path))")
    assert modules == later
    assert set(LATE) >= {"scipy.linalg", "yaml"}


@pytest.mark.parametrize("name", ["run", "materials"])
def test_one_command_is_made_where_the_arguments_begin_with_it(name):
    assert list(typer.main.get_group(app_of(name, "--help")).commands) == [name]


@pytest.mark.parametrize("given", [(), ("--help",), ("rum",), ("--version", "run")])
def test_all_commands_are_made_for_anything_else(given):
    assert set(typer.main.get_group(app_of(*given)).commands) >= set(COMMANDS)
