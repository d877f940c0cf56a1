"""Guideline 7.1-5: the force is best where the void is about ten times as long as wide."""

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa, mm
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.parts import elastosil, fabric, threads
from turgor_guidelines.pictures import outline_of
from turgor_guidelines.sections import COARSER, compared
from turgor_guidelines.single_chamber.half_round import BARE, HOOPED

#: Widths of the void [mm]; its height, walls all around [mm]; last pressure [kPa].
WIDTHS, HEIGHT, WALL, PRESSURE = (5.0, 7.0, 8.5, 10.0, 12.0, 16.0, 25.0), 8.0, 2.0, 24.0

#: Fixed length [mm] and fixed plan area [mm²]: both have ten times the width at 10 mm.
LENGTH, AREA = 100.0, 1000.0

#: Pressure at which forces are compared [kPa], stretch of the rubber at which they are, ratios that the rule names.
EQUAL, STRETCH, NAMED = 12.0, 1.4, (8.0, 12.5)


def push(width: float, hooped: bool, size: float) -> Computed:
    """Inflate a rectangular section whose void has a width [mm], at zero curvature."""
    shape = tg.actuators.RectangularBender(
        width=(width + 2 * WALL) * mm,
        height=(HEIGHT + 2 * WALL) * mm,
        side_wall=WALL * mm,
        top_wall=WALL * mm,
        floor=WALL * mm,
        base=0.0,
    )
    hoops = [threads(("outside", "strain_limiting_layer"))] if hooped else []

    def solve(cell: float) -> tuple[tg.Response, tg.sections.SectionSolution]:
        section = tg.Section(shape, {"body": elastosil()}, reinforcements=[*fabric(), *hoops], size=cell)
        still = section.solve(
            np.linspace(0, PRESSURE * kPa, 13), prescribed={"curvature_y": 0.0}, throw=False, mesh_error=False
        )
        response = still.response
        columns = [*response.columns, tg.experiments.Column("blocked_moment", "Nm", -response["moment_y"])]
        return tg.Response(columns=tuple(columns), source=response.source, message=response.message), still

    (fine, still), (coarse, _) = solve(size * mm), solve(COARSER * size * mm)
    return Computed(response=compared(fine, coarse), picture=outline_of(still))


def runs(setting: Setting) -> tuple[Run, ...]:
    """Voids of several widths, bare and in hoops."""
    size = 1.5 if setting == "quick" else 0.75
    return tuple(
        Run(
            name=f"{around}, {width:g} mm wide",
            function=push,
            values={"width": width, "hooped": around == HOOPED, "size": size},
        )
        for around in (BARE, HOOPED)
        for width in WIDTHS
    )


def forces(runs: Runs, around: str, drive: str, where: float) -> dict[str, tuple[list[float], list[float]]]:
    """Ratios of length to width, and forces of the tip [N], at a fixed length and at a fixed area.

    A beam that is fixed at one end and whose other end is fixed across, free to turn, pushes with 1.5 times the moment
    over its length.
    """
    chosen = {float(name.split()[-3]): each.response for name, each in runs.items() if name.startswith(around)}
    moments = {
        width: float(np.interp(where, each[drive], each["blocked_moment"], right=np.nan))
        for width, each in chosen.items()
    }
    out = {}
    for fixed, length in (("length", lambda width: LENGTH), ("plan area", lambda width: AREA / width)):
        known = {width: moment for width, moment in moments.items() if np.isfinite(moment)}
        ratios = [length(width) / width for width in known]
        out[fixed] = ratios, [1.5 * moment / (length(width) * mm) for width, moment in known.items()]
    return out


def ways(runs: Runs) -> dict[str, tuple[list[float], list[float]]]:
    """Return ratios and forces for each of eight readings of the rule."""
    return {
        f"{around}, {fixed} kept, equal {drive}": values
        for around in (BARE, HOOPED)
        for drive, column, where in (
            ("pressure", "pressure", EQUAL * kPa),
            ("stretch of the rubber", "largest_stretch", STRETCH),
        )
        for fixed, values in forces(runs, around, column, where).items()
    }


def judge(runs: Runs) -> Judgement:
    """The ratio of the largest force, in each way."""
    parts, inside = [], []
    for way, (ratios, pushes) in ways(runs).items():
        top = int(np.argmax(pushes))
        end = " (the last that was tried)" if top in (0, len(pushes) - 1) else ""
        inside.append(not end and NAMED[0] <= ratios[top] <= NAMED[1])
        parts.append(f"{way}: {max(pushes):.3g} N at {ratios[top]:.3g}{end}")
    verdict = Verdict.CONFIRMED if all(inside) else Verdict.CONDITIONAL if any(inside) else Verdict.NOT_REPRODUCED
    errors = [
        float((each.response.mesh_error("blocked_moment") / np.abs(each.response["blocked_moment"]).max()).max())
        for each in runs.values()
    ]
    return Judgement(
        verdict=verdict,
        finding=f"Largest force, and the ratio of length to width: {'; '.join(parts)}. Mesh errors are at most "
        f"{max(errors):.1%} of the force at {PRESSURE:g} kPa.",
        conditions=f"{sum(inside)} of {len(inside)} ways to compare have their best ratio between {NAMED[0]:g} and "
        f"{NAMED[1]:g}. What stays the same decides: the rule does not say whether length, area or volume is, nor "
        "whether the pressure or what the rubber bears. The force follows from the section by beam theory, without "
        "end walls.",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Force against the ratio, at equal pressure and at equal stretch."""
    drawn = []
    for drive in ("pressure", "stretch of the rubber"):
        lines = [
            tg.pictures.Line(x=ratios, y=pushes, label=way.rpartition(", ")[0])
            for way, (ratios, pushes) in ways(runs).items()
            if way.endswith(drive)
        ]
        drawn.append(
            tg.pictures.Panel(x="length over width of the void", y=f"force of the tip, equal {drive} [N]", lines=lines)
        )
    return tuple(drawn)


GUIDELINE = Guideline(
    key="7.1-5",
    rule="The force is optimal where the void is about ten times as long as wide.",
    sources=("Gorissen et al. 2017",),
    families=("rectangular_bender",),
    studies=(
        GuidelineTest(
            title="Width of a rectangular void",
            setup="Section of a long rectangular bender, void 8 mm high and 5 to 25 mm wide, walls of 2 mm, "
            "Elastosil M4601 (neo-Hookean, C10 = 0.12 MPa), fabric of 650 N/mm along and across below; bare or in "
            "hoops of Kevlar thread every 2 mm; at zero curvature. Force of a tip that is fixed across, 1.5 times the "
            "moment over the length, for a length of 100 mm or a plan area of 1000 mm², at 12 kPa or where the "
            "rubber is stretched by 1.4.",
            expected="The force is largest at a ratio between 8 and 12.5.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
