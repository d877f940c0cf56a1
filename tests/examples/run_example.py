"""Solve an example job of `examples/actuators` in memory."""

from pathlib import Path

from turgor.core.results.measures.measures import find_measure, measure
from turgor.core.solvers.solve import solve
from turgor.foundation.response import Response
from turgor.job.job import Job
from turgor.job.prepare import prepare
from turgor.job.read import read_job

JOBS = Path(__file__).parents[2] / "examples" / "actuators"


def run_example(name: str) -> Response:
    """Return the measures of `examples/actuators/<name>.toml` along its path; raise SolveError unless it is done."""
    return solve_job(example(name))


def example(name: str) -> Job:
    """Read `examples/actuators/<name>.toml`, so that a test can change it before it is solved."""
    return read_job(JOBS / f"{name}.toml")


def solve_job(job: Job) -> Response:
    """Return the measures of a job along its path; raise SolveError unless it is done."""
    model, _ = prepare(job)
    solution = solve(model, job.procedure)
    return measure(solution, *(find_measure(each) for each in job.output.measures))


def at_the_end(job: Job) -> dict[str, float]:
    """Solve a job and return its measures at the last state."""
    response = solve_job(job)
    return {name: float(response.column(name)[-1]) for name in response.names}
