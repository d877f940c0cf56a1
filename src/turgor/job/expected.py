"""Expected time and memory of a run, from its counts, the last run of the same job, and the speed of this machine."""

import tomllib
from dataclasses import dataclass
from math import log2
from time import process_time

import numpy as np

from turgor.core.engine.runtime import FEW_UNKNOWNS
from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.meshing.sizing.default_size import default_size
from turgor.core.meshing.sizing.settings import QUALITIES
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import is_grid_row
from turgor.core.model.model import Model
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.row_guide import shorter_row
from turgor.core.solvers.solution import Solution
from turgor.foundation.store.cached_values import Cache
from turgor.job.job import MESHED, Job
from turgor.job.output.identity import IGNORED, digest
from turgor.job.output.lock import lock_text


@dataclass(frozen=True, slots=True)
class ExpectedSettings:
    """Costs that were measured on the example jobs of all families as drafts, and on the truth set.

    Parameters
    ----------
    iteration, growth, exponent : float
        CPU seconds of an iteration for each unknown, one thread of the machine that measured: ``iteration`` for few,
        twice as much at ``growth`` unknowns, rising by ``exponent``. With 3,000 to 36,000 unknowns of tetrahedra,
        an iteration took 1.0e-5 to 1.7e-5; hexahedra of a solid bender with 44,000, 3e-5.
    product, side : float, int
        CPU seconds on that machine of a product of two square matrices with this side.
    by_threads : float
        A solve gets faster by the number of threads to this power: by 1.6 on two.
    iterations : float
        Iterations of a step. Without contact, 20 families took 9 to 20 iterations in 6 or 7 steps.
    obstacle, fibers, meeting : float
        Factor of the iterations with obstacles, with fibers, and where walls meet: 28 for a blocked force; 13 and 59
        for a cylinder and a bender with fibers; 71 to 87 for the demo.
    led : float
        Factor of the time where walls meet in a row of equal parts that the path of a shorter one leads: 0.47 for the
        demo.
    mesh_error : float
        Estimating the mesh error takes this share of the solve.
    drawing : float
        CPU seconds of pictures and report.
    process, picture, unknown, estimated : float
        Bytes of the process, of pictures and report, for each unknown of a solve, and for each unknown of the estimate
        of the mesh error.
    dense : float
        Bytes of an unknown of hexahedra over those of tetrahedra.
    draft : float
        Unknowns of tetrahedra over those of hexahedra of the same size: 0.14 to 0.46 in nine families.
    row : float
        Those of hexahedra of chambers in a row fall with the size to this power: to 0.5 and 0.65 for twice the size.
    thinning : float
        Unknowns fall with the size to this power, where walls are one cell thick.
    """

    iteration: float = 1.3e-5
    growth: float = 1e5
    exponent: float = 0.7
    product: float = 5.2e-3
    side: int = 512
    by_threads: float = 0.7
    iterations: float = 2.4
    obstacle: float = 2.0
    fibers: float = 2.0
    meeting: float = 4.5
    led: float = 0.5
    mesh_error: float = 0.6
    drawing: float = 5.0
    process: float = 2.8e8
    picture: float = 0.8e8
    unknown: float = 9e3
    estimated: float = 8e3
    dense: float = 1.5
    draft: float = 0.33
    row: float = 0.8
    thinning: float = 1.5


EXPECTED = ExpectedSettings()

#: Iterations of the last runs, some ten thousand of them.
_RUNS = Cache("runs", 1e7)


@dataclass(frozen=True, slots=True, kw_only=True)
class Expected:
    """Expected time and memory of a run.

    Parameters
    ----------
    seconds : float or None [s]
        Wall time after meshing; None where the number of steps is open, as in a motion.
    meeting : float or None [s]
        The same where walls meet, if they may and no run has shown whether they do.
    draft : float or None [s]
        The same of a draft, if it is much faster.
    memory : float [bytes]
        Most memory of the process.
    threads : int
    """

    seconds: float | None
    meeting: float | None = None
    draft: float | None = None
    memory: float
    threads: int

    def __str__(self) -> str:
        memory = f"{self.memory / 1e9:.1f} GB on {self.threads} thread{'s' if self.threads > 1 else ''}"
        if self.seconds is None:
            return f"about {memory}; the first run of a motion shows how long it takes"
        met = "" if self.meeting is None else f" ({_duration(self.meeting)} if walls meet)"
        draft = "" if self.draft is None else f'; quality = "draft" takes about {_duration(self.draft)}'
        return f"about {_duration(self.seconds)}{met} and {memory}{draft}"


def expected_of(job: Job, model: Model, threads: int) -> Expected:
    """Return the expected time and memory of a run, before anything is solved.

    The number of iterations is that of the last run of the same job on this computer, whatever its mesh. Without one,
    it follows from the steps of the procedure.

    Parameters
    ----------
    job : Job
    model : Model
        Its model.
    threads : int

    Returns
    -------
    Expected
    """
    mesh, last = model.mesh, _RUNS.get(_key(job))
    iterations = float(last) if isinstance(last, int) else _iterations(model, job.procedure)
    slowness = _slowness()

    def seconds(unknowns: float, factor: float = 1.0) -> float | None:
        return None if iterations is None else slowness * _seconds(job, unknowns, factor * iterations, threads)

    unknowns = float(mesh.unknown_count)
    unmet = not isinstance(last, int) and model.contact.for_mesh(mesh) is not None
    draft = unknowns * _draft_share(job, model)
    led = shorter_row(model, job.procedure) is not None
    meeting = EXPECTED.meeting * (EXPECTED.led if led else 1.0)
    dense = 1.0 if mesh.cell_type is TETRAHEDRON else EXPECTED.dense
    each = EXPECTED.unknown + (EXPECTED.estimated if job.output.mesh_error else 0.0)
    return Expected(
        seconds=seconds(unknowns),
        meeting=seconds(unknowns, meeting) if unmet else None,
        draft=seconds(draft) if draft < 0.7 * unknowns else None,
        memory=EXPECTED.process + EXPECTED.picture * _draws(job) + each * unknowns * dense,
        threads=threads,
    )


def remember(job: Job, solution: Solution) -> None:
    """Save the iterations of a run that reached its end, for the next run of the same job on any mesh.

    Parameters
    ----------
    job : Job
    solution : Solution
    """
    if solution.complete:
        timing = solution.timing
        whole = timing.total / (timing.total - timing.guide) if timing.guide < timing.total else 1.0
        _RUNS.put(round(whole * solution.iterations), _key(job))


def _key(job: Job) -> str:
    """A hash of what a job computes, without its mesh."""
    return digest(tomllib.loads(lock_text(job, {})), {*IGNORED, "mesh"})


def _iterations(model: Model, procedure: Procedure) -> float | None:
    """Iterations of a path whose steps grow from the first to the largest; None for a motion, whose steps are open."""
    total = 0.0
    for each in [stage.procedure for stage in procedure.stages] or [procedure]:
        if each.depends_on_path:
            return None
        growing = max(0.0, log2(each.max_step / each.first_step))
        total += EXPECTED.iterations * (1 / each.max_step + growing)
    total *= EXPECTED.fibers if model.reinforcements else 1.0
    return total * (EXPECTED.obstacle if model.contact.obstacles else 1.0)


def _seconds(job: Job, unknowns: float, iterations: float, threads: int) -> float:
    """Wall seconds of a run on the machine that measured."""
    each = EXPECTED.iteration * unknowns * (1 + (unknowns / EXPECTED.growth) ** EXPECTED.exponent)
    solve = each * iterations * (1 + EXPECTED.mesh_error * bool(job.output.mesh_error))
    faster = threads**EXPECTED.by_threads if unknowns >= FEW_UNKNOWNS else 1.0
    return solve / faster + EXPECTED.drawing * _draws(job)


def _draws(job: Job) -> bool:
    return job.output.pictures or job.output.report


def _draft_share(job: Job, model: Model) -> float:
    """Unknowns of a draft over those of a mesh; 1 where the mesh is a draft, or has no other size."""
    if job.mesh.quality == "draft" or job.mesh.cells == "axisymmetric" or isinstance(job.actuator, MESHED):
        return 1.0
    hexahedra = model.mesh.cell_type is not TETRAHEDRON
    if hexahedra and is_grid_row(geometry := job.geometry(), Fineness(size=job.mesh_size)):
        return (job.mesh_size / default_size(geometry, "hexahedra", "draft")) ** EXPECTED.row
    if hexahedra and model.mesh.unknown_count <= QUALITIES["draft"].hexahedra:
        return 1.0  # a draft has hexahedra, too, and hardly fewer
    size = default_size(job.geometry(), "tetrahedra", "draft")
    return (EXPECTED.draft if hexahedra else 1.0) * (job.mesh_size / size) ** EXPECTED.thinning


def _slowness() -> float:
    """CPU time of this machine over that of the one that measured, the shortest of some products of matrices."""
    matrix = np.ones((EXPECTED.side, EXPECTED.side))
    times = []
    for _ in range(6):
        start = process_time()
        np.matmul(matrix, matrix)
        times.append(process_time() - start)
    return min(times) / EXPECTED.product


def _duration(seconds: float) -> str:
    """Write a duration with as many digits as are known.

    Examples
    --------
    >>> _duration(7.6), _duration(43.0), _duration(200.0), _duration(9000.0)
    ('8 s', '45 s', '3 min', '2.5 h')
    """
    if seconds < 95:
        return f"{seconds:.0f} s" if seconds < 12.5 else f"{5 * round(seconds / 5)} s"
    return f"{seconds / 60:.0f} min" if seconds < 95 * 60 else f"{seconds / 3600:.2g} h"
