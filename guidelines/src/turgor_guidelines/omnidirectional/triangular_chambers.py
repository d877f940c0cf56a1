"""Guideline 7.3-2: triangular chambers bend further than round ones."""

import turgor as tg
from turgor.studies import Run
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import change, differs, verdict_of
from turgor_guidelines.omnidirectional.chambers import SETUP
from turgor_guidelines.omnidirectional.shapes import AREA, read, runs_of
from turgor_guidelines.values import listed

#: Pressures of the comparison [kPa], and the shapes.
PRESSURES = (10, 60)
NAMES = ("circular", "triangular, flat outward", "triangular, apex outward")


def runs(setting: Setting) -> tuple[Run, ...]:
    """Round and triangular chambers, both ways round."""
    return runs_of(NAMES, setting)


def judge(runs: Runs) -> Judgement:
    """Both ways round, at both pressures."""
    holds, parts, notes = [], [], []
    for pressure in PRESSURES:
        angles = read(runs, "bending_angle", pressure)
        rest = angles["circular"]
        parts.append(f"{pressure} kPa {listed(list(angles.values()))}")
        for name in NAMES[1:]:
            more = change(angles[name], rest)
            holds.append(more > 0 and differs(angles[name], rest))
            notes.append(f"{name} {more:+.0%} at {pressure} kPa")
    return Judgement(
        verdict=verdict_of(holds),
        finding=f"{'; '.join(runs)}: {'; '.join(parts)}",
        conditions=f"At equal area and equal wall, against round chambers: {', '.join(notes)}.",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Angle and ballooning against pressure."""
    curves = tuple((name, each.response) for name, each in runs.items())
    return (
        tg.pictures.Panel(x="pressure", y="bending_angle", responses=curves),
        tg.pictures.Panel(x="pressure", y="outside_ballooning", responses=curves),
    )


GUIDELINE = Guideline(
    key="7.3-2",
    rule="For three-chambered omnidirectional actuators, triangular chambers bend further than circular ones.",
    sources=("Xie et al. 2018",),
    families=("omnidirectional_actuator", "three_extenders"),
    studies=(
        GuidelineTest(
            title="Round and triangular chambers of equal area",
            setup=SETUP + f"; all chambers have {AREA:g} mm² and end 2 mm below the surface.",
            expected="Triangular chambers bend further, whichever way they point.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
