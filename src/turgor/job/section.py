"""Section of a job: the cross-section of its actuator at rising shares of its pressures."""

import numpy as np

from turgor.core.model.loads import pressures_among
from turgor.fast_models.section.section import Section
from turgor.fast_models.section.solution import SectionSolution
from turgor.foundation.errors import TurgorError
from turgor.job.job import Job

#: Rows of a section that may be requested.
MOST_ROWS = 1000


def section_of(job: Job, size: float | None = None, ends: str = "closed") -> Section:
    """Return the section of a job's actuator with its materials, fibers and faces that keep their radius.

    Parameters
    ----------
    job : Job
    size : float or None [m]
        Longest edge of a cell of the section.
    ends : str
        ``"closed"`` or ``"open"``.

    Raises
    ------
    TurgorError
        If the actuator has no uniform section.
    """
    if job.bonds:
        name = next(iter(job.bonds))
        raise TurgorError(f"bonds.{name}: a section has no bonds that open; leave it out, or solve the whole actuator.")
    return Section(
        job.geometry(),
        job.materials,
        reinforcements=tuple(job.fibers.values()),
        supports=[support for support in job.supports if support.in_sections],
        ends=ends,
        size=size,
    )


def solve_section(job: Job, section: Section, rows: int) -> SectionSolution:
    """Solve a section at equal steps of the pressures of a job; the path so far where it ends early.

    Parameters
    ----------
    job : Job
    section : Section
        That of `section_of`.
    rows : int
        Number of states, 1 to 1000.

    Raises
    ------
    TurgorError
        If the job has no pressure in a cavity of the section, or the number is out of range.
    """
    if not 1 <= rows <= MOST_ROWS:
        raise TurgorError(f"rows is {rows}; allowed is 1 to {MOST_ROWS}.")
    for load in job.loads:
        if load.of_bodies:
            raise TurgorError(
                f"loads: a section has no states of bodies, and {load.label} is one; solve the whole part."
            )
    full = {load.face: load.pressure for load in pressures_among(job.loads)}
    acting = {name: value for name, value in full.items() if name in section.cavities}
    if not acting:
        raise TurgorError(
            f"the job gives no pressure in a cavity of the section ({', '.join(section.cavities) or 'it has none'}); "
            "state one in [loads]."
        )
    shares = np.arange(1, rows + 1) / rows
    return section.solve({name: value * shares for name, value in acting.items()}, throw=False)
