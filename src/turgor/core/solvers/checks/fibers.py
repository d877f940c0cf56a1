"""Checks of windings: whether they fit their faces, and findings about them."""

from math import acos, pi

import numpy as np

from turgor.core.engine.faces.surfaces import area
from turgor.core.engine.fibers.fiber_trusses import lay
from turgor.core.engine.fibers.lines import laid_spacing
from turgor.core.engine.fibers.smeared import Course, course_of, wound_sides
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.core.model.fibers import DISCRETE, SMEARED, Fibers
from turgor.core.model.model import Model
from turgor.core.solvers.checks.settings import FIBERS, REPORTS
from turgor.foundation.finding import Finding, Severity
from turgor.units import deg, mm


def check_fibers(model: Model) -> tuple[Finding, ...]:
    """Refuse windings that do not fit their faces, and return findings about the others.

    Raises
    ------
    TurgorError
        If a winding cannot lie on its face.
    """
    findings = []
    for fibers in model.reinforcements:
        if fibers.embedded:
            lay(model.mesh, fibers)
            findings += _resisting(fibers)
            continue
        course = course_of(model.mesh, fibers)
        lay(model.mesh, fibers)  # an error for threads that lie nowhere on their face
        findings += [
            *_resisting(fibers),
            *_far_apart(model, fibers, course),
            *_other_spacing(fibers, course),
            *_both_hands(fibers, course),
            *_too_stiff(model, fibers, course),
        ]
    return tuple(findings)


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
    place = f"{'Embedded fibers' if fibers.embedded else 'Fibers on'} {fibers.place}"
    return [
        Finding(
            code="B04",
            severity=Severity.NOTE,
            message=f"{place} {' and '.join(what)}; threads do neither.",
            advice="Leave compression and bending out unless they are rods, or wires.",
        )
    ]


def _far_apart(model: Model, fibers: Fibers, course: Course) -> list[Finding]:
    """Smeared threads so far apart that what happens between them matters (B05)."""
    sides = wound_sides(model.mesh, fibers)
    corners = 3 if sides.shape[1] == 6 else 4
    one = area(model.mesh.points, sides) / len(sides)
    cell = float(np.sqrt(one * (4 / np.sqrt(3) if corners == 3 else 1.0)))
    far = course.spacing > FIBERS.cells_between * cell or course.spacing > FIBERS.share_of_perimeter * course.perimeter
    if fibers.form != SMEARED or not far:
        return []
    return [
        Finding(
            code="B05",
            severity=Severity.WARNING,
            message=f"Smeared fibers on {fibers.place} are {course.spacing / mm:.3g} mm apart, with cells of "
            f"{cell / mm:.3g} mm on a perimeter of {course.perimeter / mm:.3g} mm; what the wall does between them is "
            "not seen.",
            advice='Take form = "discrete", which follows every thread.',
        )
    ]


def _other_spacing(fibers: Fibers, course: Course) -> list[Finding]:
    """Discrete threads that are not as far apart as requested, because their number is whole (B21)."""
    if fibers.form != DISCRETE or fibers.wound.spacing is None:
        return []
    laid = laid_spacing(course)
    if abs(laid - course.spacing) <= REPORTS.notable_share * course.spacing:
        return []
    wrong = abs(laid - course.spacing) > REPORTS.large_share * course.spacing
    return [
        Finding(
            code="B21",
            severity=Severity.WARNING if wrong else Severity.NOTE,
            message=f"Threads on {fibers.place} are {laid / mm:.4g} mm apart instead of {course.spacing / mm:.4g} mm: "
            "their number is whole.",
            advice=_exact(course, laid),
        )
    ]


def _exact(course: Course, laid: float) -> str:
    """Advice that keeps the requested spacing."""
    if not 1e-9 < course.angle < pi / 2 - 1e-9:
        whole = "length of the face" if course.angle > 1 else "perimeter"
        return f"Nothing needs to be done, or choose a spacing that divides the {whole}."
    share = round(course.perimeter * np.cos(course.angle) / laid) * course.spacing / course.perimeter
    if share >= 1:
        return "Nothing needs to be done, or choose a spacing that divides the perimeter times the cosine of the angle."
    return f"With angle_from_axis = {acos(share) / deg:.4g} deg they are as far apart as requested."


def _both_hands(fibers: Fibers, course: Course) -> list[Finding]:
    """Threads of both hands that are nearly hoops (B22)."""
    if len(course.turning) < 2 or course.angle < FIBERS.nearly_hoops:
        return []
    return [
        Finding(
            code="B22",
            severity=Severity.WARNING,
            message=f"Fibers on {fibers.place} run at {course.angle / deg:.4g} deg from the axis in both hands: two "
            f"threads every {course.spacing / mm:.4g} mm, nearly hoops, are twice as stiff as one.",
            advice="For one thread, give angle_from_circumference = 0 deg and the spacing: hoops have no hand, and a "
            "mirror plane does not turn them.",
        )
    ]


def stiffness_over_wall(model: Model, fibers: Fibers, course: Course) -> float:
    """Return the stiffness of threads over that of the wall that they are wound on, both per width."""
    mesh = model.mesh
    softest = min(material.law.shear_modulus for material in model.region_materials.values())
    wall = float(cell_volumes(mesh).sum()) / area(mesh.points, wound_sides(mesh, fibers))
    return fibers.stretching_stiffness / course.spacing / (softest * wall)


def stiff_threads_text(model: Model) -> str:
    """Return the advice for threads that are too stiff to become slack, or nothing if there are none."""
    for fibers in model.reinforcements:
        if fibers.embedded:
            continue
        course = course_of(model.mesh, fibers)
        ratio = stiffness_over_wall(model, fibers, course)
        if fibers.compression == 0 and ratio > FIBERS.too_stiff:
            rigid = FIBERS.too_stiff / 10
            enough = fibers.stretching_stiffness * rigid / ratio
            return (
                "Give them compression = 1 if they stay tight everywhere, as hoops around a cavity under pressure do. "
                f"Otherwise give a smaller modulus: a thread of E A = {enough:.2g} N is {rigid:,.0f} times "
                "as stiff as the wall, which is as good as rigid."
            )
    return ""


def _too_stiff(model: Model, fibers: Fibers, course: Course) -> list[Finding]:
    """Threads so stiff that Newton's method does not find which of them are slack (B23)."""
    ratio = stiffness_over_wall(model, fibers, course)
    if fibers.compression > 0 or ratio <= FIBERS.too_stiff:
        return []
    return [
        Finding(
            code="B23",
            severity=Severity.WARNING,
            message=f"Fibers on {fibers.place} (E A = {fibers.stretching_stiffness:.3g} N) are about "
            f"{round(ratio, -3):,.0f} times as stiff as the wall below them and go slack in compression; the solve "
            "will probably not converge.",
            advice=stiff_threads_text(model),
        )
    ]
