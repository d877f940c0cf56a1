"""Checks of windings: whether they fit their faces, and findings about them."""

import numpy as np

from turgor.engine.faces.surfaces import area
from turgor.engine.fibers.fiber_trusses import discrete_threads
from turgor.engine.fibers.smeared import Course, course_of, wound_sides
from turgor.finding import Finding, Severity
from turgor.model.fibers import DISCRETE, SMEARED, Fibers
from turgor.model.model import Model
from turgor.solvers.checks.thresholds import CELLS_BETWEEN, SHARE_OF_PERIMETER
from turgor.units import mm


def check_fibers(model: Model) -> tuple[Finding, ...]:
    """Refuse windings that do not fit their faces, and return findings about the others (B04, B05).

    Raises
    ------
    TurgorError
        If a winding cannot lie on its face.
    """
    found = []
    for fibers in model.reinforcements:
        course = course_of(model.mesh, fibers)
        if fibers.form == DISCRETE:
            discrete_threads(model.mesh, fibers)
        found += [*_resisting(fibers), *_far_apart(model, fibers, course)]
    return tuple(found)


def _resisting(fibers: Fibers) -> list[Finding]:
    """Threads that resist compression or bending (B04)."""
    what = []
    if fibers.compression > 0:
        share = "all" if fibers.compression == 1 else f"{100 * fibers.compression:.3g} %"
        what.append(f"keep {share} of their stiffness in compression")
    if fibers.bending:
        what.append("resist bending")
    if not what:
        return []
    return [
        Finding(
            code="B04",
            severity=Severity.NOTE,
            message=f"Fibers on {fibers.name} {' and '.join(what)}; threads do neither.",
            advice="Leave compression and bending out unless they are rods, or wires.",
        )
    ]


def _far_apart(model: Model, fibers: Fibers, course: Course) -> list[Finding]:
    """Smeared threads so far apart that what happens between them matters (B05)."""
    sides = wound_sides(model.mesh, fibers)
    corners = 3 if sides.shape[1] == 6 else 4
    one = area(model.mesh.points, sides) / len(sides)
    cell = float(np.sqrt(one * (4 / np.sqrt(3) if corners == 3 else 1.0)))
    far = course.spacing > CELLS_BETWEEN * cell or course.spacing > SHARE_OF_PERIMETER * course.perimeter
    if fibers.form != SMEARED or not far:
        return []
    return [
        Finding(
            code="B05",
            severity=Severity.WARNING,
            message=f"Smeared fibers on {fibers.name} are {course.spacing / mm:.3g} mm apart, with cells of "
            f"{cell / mm:.3g} mm on a perimeter of {course.perimeter / mm:.3g} mm; what the wall does between them is "
            "not seen.",
            advice='Take form = "discrete", which follows every thread.',
        )
    ]
