"""Guideline 7.0-4: omnidirectional actuators bend further with a larger void area."""

from math import pi

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa, mm
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.parts import elastosil
from turgor_guidelines.sections import solved_twice
from turgor_guidelines.values import last, listed, rises

#: Diameters of the chambers [mm], and the last pressure in one of them [kPa].
DIAMETERS, PRESSURE = (5.0, 6.0, 7.0, 8.0, 9.0), 15.0

#: Radius of the cylinder, radius of the circle of the chambers' axes, wall [mm].
OUTER, PLACE, WALL = 12.5, 6.5, 1.5

#: What stays while the chambers grow.
CENTERS, THINNEST = "axes kept", "wall kept"


def bend(diameter: float, fixed: str, size: float) -> Computed:
    """Bend a cylinder with three round chambers of a diameter [mm], one of them under pressure."""
    wall = OUTER - PLACE - diameter / 2 if fixed == CENTERS else WALL
    shape = tg.actuators.OmnidirectionalActuator(
        outer_radius=OUTER * mm, chamber_size=diameter * mm, wall=wall * mm, symmetric=True
    )

    def solve(cell: float) -> tg.sections.SectionSolution:
        section = tg.Section(shape, {"body": elastosil()}, size=cell)
        return section.solve({"cavity_1": np.linspace(0, PRESSURE * kPa, 7)}, throw=False, mesh_error=False)

    return solved_twice(solve, size * mm)


def runs(setting: Setting) -> tuple[Run, ...]:
    """Five diameters, at fixed axes of the chambers or at a fixed wall outside them."""
    size = 2.0 if setting == "quick" else 1.0
    return tuple(
        Run(
            name=f"{fixed}, {3 * pi * diameter**2 / 4:.0f} mm2",
            function=bend,
            values={"diameter": diameter, "fixed": fixed, "size": size},
        )
        for fixed in (CENTERS, THINNEST)
        for diameter in DIAMETERS
    )


def _groups(runs: Runs) -> dict[str, list[str]]:
    out: dict[str, list[str]] = {}
    for name in runs:
        out.setdefault(name.split(", ")[0], []).append(name)
    return out


def judge(runs: Runs) -> Judgement:
    """Whether the curvature rises with the area."""
    parts, good = [], []
    for fixed, names in _groups(runs).items():
        bends = [last(runs[name].response, "curvature") for name in names]
        good.append(rises(bends))
        parts.append(f"{fixed}, void of {', '.join(name.split()[-2] for name in names)} mm²: {listed(bends)}")
    verdict = Verdict.CONFIRMED if all(good) else Verdict.CONDITIONAL if any(good) else Verdict.NOT_REPRODUCED
    first, second = (
        last(runs[names[-1]].response, "curvature").number / last(runs[names[0]].response, "curvature").number
        for names in _groups(runs).values()
    )
    return Judgement(
        verdict=verdict,
        finding=f"Curvature at {PRESSURE:g} kPa in one of three chambers: {'; '.join(parts)}.",
        conditions=f"A void {(DIAMETERS[-1] / DIAMETERS[0]) ** 2:.1f} times as large bends {second:.3g} times as "
        f"far where the wall of {WALL:g} mm outside it stays, and {first:.3g} times where the chambers' axes stay "
        "and this wall becomes thinner: a larger void mostly means a thinner wall, and both add up.",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curvature against pressure, and against the area."""
    lines = []
    for fixed, names in _groups(runs).items():
        bends = [last(runs[name].response, "curvature") for name in names]
        error = [each.error for each in bends]
        area = [float(name.split()[-2]) for name in names]
        lines.append(tg.pictures.Line(x=area, y=[each.number for each in bends], error=error, label=fixed))
    curves = [
        tg.pictures.Line(
            x=np.linspace(0, PRESSURE, len(runs[name].response)), y=runs[name].response["curvature"], label=name
        )
        for name in runs
        if name.startswith(CENTERS)
    ]
    return (
        tg.pictures.Panel(x="pressure in one chamber [kPa]", y="curvature [1/m]", lines=curves),
        tg.pictures.Panel(x="area of three chambers [mm²]", y=f"curvature at {PRESSURE:g} kPa [1/m]", lines=lines),
    )


GUIDELINE = Guideline(
    key="7.0-4",
    rule="For omnidirectional actuators, a larger void area gives more bending.",
    sources=("Elsayed et al. 2014", "Yan et al. 2016", "Xie et al. 2018"),
    families=("omnidirectional_actuator",),
    studies=(
        GuidelineTest(
            title="Diameter of three round chambers",
            setup="Section of a long cylinder of 12.5 mm radius with three round chambers of 5 to 9 mm diameter, "
            "Elastosil M4601 (neo-Hookean, C10 = 0.12 MPa), one chamber under pressure; axes of the chambers at 6.5 "
            "mm, or 1.5 mm of wall outside them; curvature at 15 kPa.",
            expected="The curvature rises with every step to a larger area.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
