"""Convergence study: solve the same model on three meshes or more and compare a measure."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import isfinite

import numpy as np

from turgor.core.engine.runtime import EngineOptions
from turgor.core.meshing.exchange.mesh_file import MeshFile
from turgor.core.meshing.sizing.sizes import size_range, wall_size
from turgor.core.results.convergence.study import Convergence
from turgor.core.results.measures.measures import Measure, find_measure
from turgor.core.results.measures.measures import measure as measured
from turgor.core.setups.with_setup import with_direction
from turgor.core.solvers.solution import Solution, SolveError
from turgor.core.solvers.solve import Progress, solve
from turgor.foundation.errors import TurgorError
from turgor.job.job import MESHED, Job
from turgor.job.meshes import settings_at
from turgor.job.prepare import prepare
from turgor.units import mm

#: Factor between the sizes of a study; the number of cells grows about threefold from one mesh to the next.
RATIO = 1.4

MOST_SIZES = 6

Question = Job | Callable[[float], Solution]


def convergence(
    question: Question,
    sizes: int | Sequence[float] = 3,
    *,
    measure: str | Measure = "bending_angle",
    notify: Callable[[str], None] | None = None,
    progress: Progress = None,
) -> Convergence:
    """Solve a model on successively finer meshes, and extrapolate one measure at the full load.

    Parameters
    ----------
    question : Job or callable
        A job, or ``function(size) -> Solution`` that meshes with this size [m] and solves.
    sizes : int or sequence of float [m]
        Mesh sizes, three or more. For a job also their number: they are then a factor of 1.4 apart, around the size of
        the job. Sizes of faces change with them.
    measure : str or Measure
        Measure to compare.
    notify : callable, optional
        ``notify(text)``, called with each activity.
    progress : callable, optional
        Called by `solve` after every iteration and every accepted step of a job.

    Returns
    -------
    Convergence

    Raises
    ------
    TurgorError
        If the sizes are too few, not positive, or not accepted by `mesh`, or if the meshes do not get finer.
    SolveError
        If a solve does not reach the full load: only complete paths can be compared.
    """
    say = notify or _silent
    compared = find_measure(measure) if isinstance(measure, str) else measure
    chosen = study_sizes(question, sizes)
    counts, values = [], []
    for number, size in enumerate(chosen, start=1):
        say(f"mesh {number} of {len(chosen)}, size {size / mm:.4g} mm")
        try:
            solution = _solve_job(question, size, say, progress) if isinstance(question, Job) else question(size)
            if not solution.converged:
                raise SolveError(solution)
        except SolveError as error:
            error.add_note(f"This was the mesh of size {size / mm:.4g} mm; a study compares complete paths.")
            raise
        if isinstance(question, Job):  # finer meshes do not choose again
            question = replace(question, setup=with_direction(question.setup, solution.model))
        mesh = solution.model.mesh
        counts.append((len(mesh.cells), mesh.unknown_count))
        values.append(measured(solution, compared).column(compared.name)[-1])
        say(f"{len(mesh.cells)} cells, {compared.name.replace('_', ' ')} {compared.text(values[-1])}")
    cells, unknowns = np.array(counts).T
    return Convergence(
        measure=compared, sizes=np.array(chosen), cells=cells, unknowns=unknowns, values=np.array(values)
    )


def study_sizes(question: Question, sizes: int | Sequence[float]) -> tuple[float, ...]:
    """Return the mesh sizes of a study, from coarse to fine, after checks.

    Parameters
    ----------
    question : Job or callable
        See `convergence`.
    sizes : int or sequence of float [m]
        Sizes, or their number.

    Returns
    -------
    tuple of float [m]

    Raises
    ------
    TurgorError
        If there are fewer than 3 or more than 6, one is not positive, two are equal, one does not fit the geometry of
        the job, or the geometry is a mesh already.
    """
    count = sizes if isinstance(sizes, int) else len(sizes)
    if isinstance(sizes, bool) or not 3 <= count <= MOST_SIZES:
        raise TurgorError(f"{count} mesh sizes are requested; allowed is 3 to {MOST_SIZES}.")
    limits = _limits(question) if isinstance(question, Job) else None
    if isinstance(sizes, int):
        if limits is None:
            raise TurgorError("a function needs its mesh sizes, such as (4*mm, 2.8*mm, 2*mm); only a job has one.")
        coarsest = min(question.mesh_size * RATIO, limits[1])  # type: ignore[union-attr]
        sizes = [float(f"{coarsest / RATIO**i:.4g}") for i in range(count)]
    for size in sizes:
        if not isfinite(size) or size <= 0:
            raise TurgorError(f"mesh size is {size / mm:g} mm; allowed is more than 0.")
        if limits is not None and not limits[0] <= size <= limits[1] * (1 + 1e-9):
            low, high = limits[0] / mm, limits[1] / mm
            raise TurgorError(
                f"mesh size is {size / mm:.4g} mm; allowed for this job is {low:.3g} mm to {high:.4g} mm."
            )
    if len(set(sizes)) < len(sizes):
        listed = ", ".join(f"{size / mm:.4g}" for size in sizes)
        raise TurgorError(
            f"two of the mesh sizes {listed} mm are equal; sizes that differ by a factor of 1.3 or more compare well."
        )
    return tuple(sorted(sizes, reverse=True))


def _limits(job: Job) -> tuple[float, float]:
    """Smallest and largest size that the geometry of a job allows."""
    if isinstance(job.actuator, MESHED):
        what = f"is the mesh file '{job.actuator.file}'" if isinstance(job.actuator, MeshFile) else "has several bodies"
        raise TurgorError(
            f"the actuator {what}, whose mesh has one size here; mesh the parts at three sizes and give a function of "
            "the size."
        )
    geometry = job.geometry()
    return size_range(geometry)[0], max(wall_size(geometry), job.mesh_size)  # above it only if the job is


def _solve_job(job: Job, size: float, say: Callable[[str], None], progress: Progress) -> Solution:
    model, _ = prepare(replace(job, mesh=settings_at(job, size)), say)
    options = EngineOptions(notify=say)
    if job.threads is not None:
        options = replace(options, threads=job.threads)
    return solve(model, job.procedure, progress=progress, options=options)


def _silent(_: str) -> None:
    """Ignore a notice, where the caller gave no ``notify``."""
