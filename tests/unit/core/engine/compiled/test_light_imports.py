"""What the first seconds of a run load: measured by what is imported, because a loaded machine tells no times."""

import subprocess
import sys
from pathlib import Path

import pytest

DEMO = Path(__file__).parents[5] / "examples" / "fast_pneunet.toml"

HEAVY = {"numpy", "numba", "scipy", "pydantic", "netgen"}

#: What a plain run may not load before its solve: it may be needed afterwards, or by other jobs.
LATER = {
    "matplotlib",
    "rich",
    "scipy.interpolate",
    "scipy.linalg",
    "scipy.optimize",
    "scipy.sparse.csgraph",
    "scipy.sparse.linalg",
    "scipy.spatial",
    "scipy.special",
    "sympy",
    "turgor.accuracy.adaptivity.mesh_error",
    "turgor.accuracy.adaptivity.mesh_to",
    "turgor.cli.analyses.sweep",
    "turgor.cli.answers.results",
    "turgor.cli.live",
    "turgor.core.engine.algebra.iterative.solver",
    "turgor.core.geometry.actuators.manta_fin",
    "turgor.core.geometry.cad.read",
    "turgor.job.output.write",
    "turgor.accuracy.laboratory",
    "turgor.core.materials.experiments.material_test",
    "turgor.core.materials.fitting.fit_laws",
    "turgor.core.meshing.exchange.surface_filling",
    "turgor.core.meshing.exchange.read",
    "turgor.core.meshing.generate",
    "turgor.views.pictures",
    "turgor.fast_models.rod",
    "turgor.fast_models.section",
    "turgor.core.solvers.continuation.scalar_control.cavity_control",
    "turgor.core.solvers.dynamics",
}

READING = (
    "from turgor.cli.run import run_command; from turgor.cli.console import PlainDisplay; "
    "from turgor.job.run import run_job; from turgor.job.read import read_job; "
    f"job = read_job({str(DEMO)!r})"
)

#: What the job does before its solve; the mesh is kept for the next process.
PREPARING = (
    f"{READING}; from turgor.job.prepare import prepare; prepare(job); "
    "from turgor.job.meshes import save_mesh_of; save_mesh_of(job)"
)


def loaded(script: str) -> set[str]:
    """Modules that a process has loaded after a script."""
    command = [sys.executable, "-c", f"import sys; {script}; print(*sys.modules)"]
    return set(subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[-1].split())


def test_a_run_that_finds_its_mesh_on_disk_is_light_up_to_the_solve(tmp_path, monkeypatch):
    monkeypatch.setenv("TURGOR_CACHE", str(tmp_path))
    monkeypatch.setenv("TURGOR_CACHE_MB", "100")
    making = loaded(PREPARING)
    assert making & {"netgen", "scipy.spatial", "turgor.core.meshing.generate"}
    assert loaded(PREPARING) & (LATER | {"netgen"}) == set()


@pytest.mark.parametrize(
    ("script", "refused"),
    [
        (
            "from turgor.cli.run import run; from turgor.foundation.startup.background_compiler import start_early",
            HEAVY,
        ),
        ("import turgor.core.engine.warmup.compiling", {"netgen", "netgen.occ", "typer"}),
        ("import turgor.job.run; from turgor.job.job import ACTUATORS; list(ACTUATORS.values())", {"netgen"}),
        ("from turgor.core.results.measures.measures import find_measure as f; f('reaction')", {"scipy.optimize"}),
        (READING, LATER),
        (
            "import turgor.job.output.write",
            {"scipy.optimize", "scipy.sparse.csgraph", "scipy.sparse.linalg", "scipy.spatial", "scipy.special"},
        ),
    ],
    ids=[
        "before a command compiles",
        "the process that compiles",
        "a run and all families",
        "the list of measures",
        "before a plain solve",
        "what writes and draws the results",
    ],
)
def test_is_light(script, refused):
    modules = loaded(script)
    assert "turgor" in modules
    assert modules & refused == set()
