"""Guideline 7.4-5: more chambers on a fixed length bend further at lower pressure."""

import turgor as tg
from turgor.guidelines.drawn import picture_of
from turgor.guidelines.guideline import Found, Guideline, Judgement, Setting, Study, Verdict
from turgor.guidelines.multi_chamber.pneunets import WALLS, pneunet
from turgor.guidelines.values import at, linearity, listed, rises
from turgor.results.plots.study_figure import Line, Panel
from turgor.study.runs import Computed, Run
from turgor.units import kPa, mm

#: Length that the chambers share, and the pressures up to which they bend and at which they are compared.
LENGTH, PRESSURE = 59 * mm, 14 * kPa


def bend(chambers: int, size: float) -> Computed:
    """Bend a fast PneuNet of so many chambers with cells of a size [mm]."""
    solution = tg.solve(pneunet(tg.FastPneuNet(**WALLS, chambers=chambers, length=LENGTH), size, PRESSURE), throw=False)
    return Computed(response=tg.measure(solution, tg.bending_angle), picture=picture_of(solution, limit=200 * kPa))


def runs(setting: Setting) -> tuple[Run, ...]:
    """Three numbers of chambers, or five."""
    size, counts = (6.0, (2, 4, 6)) if setting == "quick" else (3.0, (2, 3, 4, 5, 6))
    return tuple(
        Run(name=f"{count} chambers", function=bend, values={"chambers": count, "size": size}) for count in counts
    )


def judge(found: Found) -> Judgement:
    """More chambers, larger angle; and how straight the curves are."""
    angles = [at(each.response, "bending_angle", "pressure", PRESSURE) for each in found.values()]
    straight = [linearity(each.response, "bending_angle", "pressure", PRESSURE) for each in found.values()]
    holds = rises(angles)
    return Judgement(
        verdict=Verdict.CONFIRMED if holds else Verdict.NOT_REPRODUCED,
        found=f"{', '.join(found)}: {listed(angles)} at {PRESSURE / kPa:g} kPa; R² of a straight line "
        + ", ".join(f"{each:.4f}" for each in straight),
        conditions=""
        if straight == sorted(straight)
        else "More chambers bend further, but not in a straighter line: those that bend further leave it sooner.",
    )


def panels(found: Found) -> tuple[Panel, ...]:
    """Angle against pressure, and against the number of chambers."""
    angles = [at(each.response, "bending_angle", "pressure", PRESSURE) for each in found.values()]
    line = Line(
        x=[int(name.split()[0]) for name in found],
        y=[each.number for each in angles],
        error=[each.error for each in angles],
    )
    curves = tuple((name, each.response) for name, each in found.items())
    return (
        Panel(x="pressure", y="bending_angle", responses=curves),
        Panel(x="number of chambers", y=f"bending angle at {PRESSURE / kPa:g} kPa [deg]", lines=[line]),
    )


GUIDELINE = Guideline(
    key="7.4-5",
    rule="For a fixed length, more chambers enable greater bending at lower pressure, and a more linear response.",
    sources=("Mosadegh et al. 2014", "Hwang et al. 2015", "Yang et al. 2020"),
    families=("fast_pneunet",),
    studies=(
        Study(
            title="Number of chambers on 59 mm",
            setup="Fast PneuNet, 59 x 20 x 19 mm, walls of 1.5 mm, gaps of 1 mm, Elastosil M4601 (Yeoh, 0.11 and 0.02 "
            "MPa), paper of 0.1 mm in the base; bending angle up to 14 kPa.",
            expected="The angle rises with the number of chambers, and so does R² of a straight line.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
