"""Guideline 7.4-5: more chambers on a fixed length bend further at lower pressure."""

from itertools import pairwise

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.judging import verdict_of
from turgor_guidelines.multi_chamber.pneunets import MULTI_CHAMBERED, SETUP, bend, pneunet
from turgor_guidelines.values import at, linearity, listed, rises

#: Length [mm] that the chambers share, and the pressure at which they are compared.
LENGTH, PRESSURE = 35, 9 * kPa

#: Difference of R² that is read as none.
SAME = 1e-6


def runs(setting: Setting) -> tuple[Run, ...]:
    """Three numbers of chambers, or four on twice the length."""
    size, counts, length = (6.0, (1, 2, 3), LENGTH) if setting == "quick" else (3.0, (2, 3, 4, 6), 2 * LENGTH)
    return tuple(
        Run(
            name=f"{count} chamber{'s' * (count > 1)}",
            function=bend,
            values={"given": pneunet(count, {"length": length}), "size": size, "pressure": PRESSURE / kPa},
        )
        for count in counts
    )


def judge(runs: Runs) -> Judgement:
    """More chambers, larger angle; and how straight the curves are."""
    angles = [at(each.response, "bending_angle", "pressure", PRESSURE) for each in runs.values()]
    straight = [linearity(each.response, "bending_angle", "pressure", PRESSURE) for each in runs.values()]
    straighter = all(b > a - SAME for a, b in pairwise(straight))
    return Judgement(
        verdict=verdict_of([True, straighter]) if rises(angles) else Verdict.NOT_REPRODUCED,
        finding=f"{', '.join(runs)}: {listed(angles)} at {PRESSURE / kPa:g} kPa; R² of a straight line "
        + ", ".join(f"{each:.4f}" for each in straight),
        conditions=""
        if straighter
        else "More chambers bend further, but not in a straighter line: those that bend further leave it sooner.",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Angle against pressure, and against the number of chambers."""
    angles = [at(each.response, "bending_angle", "pressure", PRESSURE) for each in runs.values()]
    line = tg.pictures.Line(
        x=[int(name.split()[0]) for name in runs],
        y=[each.number for each in angles],
        error=[each.error for each in angles],
    )
    curves = tuple((name, each.response) for name, each in runs.items())
    return (
        tg.pictures.Panel(x="pressure", y="bending_angle", responses=curves),
        tg.pictures.Panel(x="number of chambers", y=f"bending angle at {PRESSURE / kPa:g} kPa [deg]", lines=[line]),
    )


GUIDELINE = Guideline(
    key="7.4-5",
    rule="For a fixed length, more chambers enable greater bending at lower pressure, and a more linear response.",
    sources=("Mosadegh et al. 2014", "Hwang et al. 2015", "Yang et al. 2020"),
    families=MULTI_CHAMBERED,
    studies=(
        GuidelineTest(
            title="Number of chambers on 35 mm",
            setup="Fast "
            + SETUP.format(count="of 35 mm, or of 70 mm at the full setting")
            + "; bending angle up to 9 kPa.",
            expected="The angle rises with the number of chambers, and so does R² of a straight line.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
