"""What the first seconds of a run load: measured by what is imported, because a loaded machine tells no times."""

import subprocess
import sys

import pytest

HEAVY = {"numpy", "numba", "scipy", "pydantic", "netgen"}


def loaded(script: str) -> set[str]:
    """Modules that a process has loaded after a script."""
    command = [sys.executable, "-c", f"import sys; {script}; print(*sys.modules)"]
    return set(subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[-1].split())


@pytest.mark.parametrize(
    ("script", "refused"),
    [
        ("from turgor.cli.run import run; from turgor.loops import begin_early", HEAVY),
        ("import turgor.engine.warmup.compiling", {"netgen", "netgen.occ", "typer"}),
        ("import turgor.job.run; from turgor.job.job import ACTUATORS; list(ACTUATORS.values())", {"netgen"}),
        ("from turgor.results.measures.measures import find_measure as f; f('reaction')", {"scipy.optimize"}),
    ],
    ids=["before a command compiles", "the process that compiles", "a run and all families", "the list of measures"],
)
def test_is_light(script, refused):
    modules = loaded(script)
    assert "turgor" in modules
    assert modules & refused == set()
