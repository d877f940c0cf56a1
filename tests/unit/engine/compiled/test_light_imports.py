"""What the first seconds of a run load: measured by what is imported, because a loaded machine tells no times."""

import subprocess
import sys
from pathlib import Path

import pytest

DEMO = Path(__file__).parents[4] / "examples" / "fast_pneunet.toml"

HEAVY = {"numpy", "numba", "scipy", "pydantic", "netgen"}

#: What a plain run may not load before its solve: it may be needed afterwards, or by other jobs.
LATER = {
    "matplotlib",
    "scipy.interpolate",
    "scipy.optimize",
    "sympy",
    "turgor.adaptivity.mesh_error",
    "turgor.adaptivity.mesh_to",
    "turgor.geometry.actuators.manta_fin",
    "turgor.geometry.cad.read",
    "turgor.job.output.write",
    "turgor.laboratory",
    "turgor.materials.experiments.material_test",
    "turgor.materials.fitting.fit_laws",
    "turgor.meshing.exchange.fill",
    "turgor.meshing.exchange.read",
    "turgor.meshing.generate",
    "turgor.results.pictures",
    "turgor.rod",
    "turgor.section",
    "turgor.solvers.dynamics",
}

READING = (
    "from turgor.cli.console import PlainDisplay; from turgor.job.run import run_job; "
    f"from turgor.job.read import read_job; read_job({str(DEMO)!r})"
)


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
        (READING, LATER),
    ],
    ids=[
        "before a command compiles",
        "the process that compiles",
        "a run and all families",
        "the list of measures",
        "before a plain solve",
    ],
)
def test_is_light(script, refused):
    modules = loaded(script)
    assert "turgor" in modules
    assert modules & refused == set()
