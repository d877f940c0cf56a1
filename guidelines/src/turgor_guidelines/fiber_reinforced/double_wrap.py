"""Guideline 7.2-7: a symmetric double wrap does not twist."""

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import deg, kPa, mm
from turgor_guidelines.fiber_reinforced.wound import TUBE, cells
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.parts import elastosil, threads
from turgor_guidelines.sections import solved_twice
from turgor_guidelines.values import last

#: Angle of the right-handed helix from the circumference [deg], and pressure [kPa].
ANGLE, PRESSURE = 30.0, 62.5

#: How much less a double wrap must twist than a single one.
NOTHING = 1e-3


def twist(left: float, spacing: float, size: float) -> Computed:
    """Inflate a tube with a right-handed helix, and a left-handed one at an angle with a distance (0 for none)."""
    wound = [threads(from_axis=90 - ANGLE, hand="right")]
    wound += [threads(from_axis=90 - left, spacing=spacing, hand="left")] if spacing else []
    shape = tg.actuators.FiberReinforcedCylinder(symmetric=False)

    def solve(cell: float) -> tg.sections.SectionSolution:
        section = tg.Section(shape, {"body": elastosil()}, reinforcements=wound, size=cell)
        return section.solve(np.linspace(0, PRESSURE * kPa, 11), throw=False, mesh_error=False)

    return solved_twice(solve, size * mm)


def runs(setting: Setting) -> tuple[Run, ...]:
    """One helix, two alike, and two that differ in angle or density as handmade ones do."""
    cases = {
        "single helix": (ANGLE, 0.0),
        "double, alike": (ANGLE, 2.0),
        "left helix 1 deg off": (ANGLE + 1, 2.0),
        "left helix 3 deg off": (ANGLE + 3, 2.0),
        "left helix half as dense": (ANGLE, 4.0),
    }
    return tuple(
        Run(name=name, function=twist, values={"left": left, "spacing": spacing, "size": cells(setting)})
        for name, (left, spacing) in cases.items()
    )


def judge(runs: Runs) -> Judgement:
    """Twist of two equal helices over that of one; what small differences bring back."""
    turned = {name: last(each.response, "twist") for name, each in runs.items()}
    single = abs(turned["single helix"].number)
    share = {name: abs(each.number) / single for name, each in turned.items()}
    summary = ", ".join(f"{name} {abs(each.number) / deg * mm:.3g} deg/mm" for name, each in turned.items())
    others = [f"{name}: {value:.1%}" for name, value in share.items() if name not in ("single helix", "double, alike")]
    return Judgement(
        verdict=Verdict.CONFIRMED if share["double, alike"] < NOTHING else Verdict.NOT_REPRODUCED,
        finding=f"Twist at {PRESSURE:g} kPa: {summary}.",
        conditions=f"Both helices must be alike; what remains of the twist of a single one: {'; '.join(others)}. The "
        f"double wrap also extends less: stretch {last(runs['double, alike'].response, 'stretch')}, single "
        f"{last(runs['single helix'].response, 'stretch')}.",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Twist and stretch against pressure."""
    lines = [
        tg.pictures.Line(x=each.response["pressure"] / kPa, y=np.abs(each.response["twist"]) / deg * mm, label=name)
        for name, each in runs.items()
    ]
    return (
        tg.pictures.Panel(x="pressure [kPa]", y="size of the twist [deg/mm]", lines=lines),
        tg.pictures.Panel(
            x="pressure", y="stretch", responses=tuple((name, each.response) for name, each in runs.items())
        ),
    )


GUIDELINE = Guideline(
    key="7.2-7",
    rule="A symmetric double fiber wrap does not twist.",
    sources=("Connolly et al. 2015",),
    families=("fiber_reinforced_cylinder",),
    studies=(
        GuidelineTest(
            title="One helix, two alike, two that differ a little",
            setup=f"{TUBE}, helices at 30 deg from the circumference, 2 mm between threads; twist at 62.5 kPa.",
            expected="Two helices alike twist less than a thousandth of what one twists.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
