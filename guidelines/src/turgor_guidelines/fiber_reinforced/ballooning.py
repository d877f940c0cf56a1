"""Guideline 7.2-1: without fibers, or with few, an actuator balloons."""

from turgor_guidelines.fiber_reinforced.banded import SETUP
from turgor_guidelines.fiber_reinforced.density import extension, injected, panels, runs
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Verdict
from turgor_guidelines.values import falls, last, listed


def judge(runs: Runs) -> Judgement:
    """Injected volume over the extension that it brings: all that is more went into the radius."""
    volumes = [injected(each.response) for each in runs.values()]
    stretch = [last(each.response, "principal_stretch_p99") for each in runs.values()]
    holds = falls(volumes)
    bare, *_, dense = runs
    return Judgement(
        verdict=Verdict.CONFIRMED if holds else Verdict.NOT_REPRODUCED,
        finding=f"{', '.join(runs)}: injected volume {listed(volumes)} of that at rest; largest stretch of the rubber "
        f"{listed(stretch)}.",
        conditions=f"Without hoops the tube takes {volumes[0].number / volumes[-1].number:.1f} times the volume "
        f"of that with {dense}, and its tip moves {extension(runs, bare)} where the other one moves "
        f"{extension(runs, dense)}. The bulges between hoops follow their distance over the wall: with hoops every "
        f"4 mm, two walls, the volume is "
        f"{injected(runs['hoops every 4 mm'].response).number / volumes[-1].number:.2f} times that of the densest, "
        f"every 16 mm, eight walls, "
        f"{injected(runs['hoops every 16 mm'].response).number / volumes[-1].number:.2f} times.",
    )


GUIDELINE = Guideline(
    key="7.2-1",
    rule="Actuators with no fiber wrapping, or with one of low density, balloon: they expand in their radius.",
    sources=("Polygerinos et al. 2015", "Galloway et al. 2013", "Zhang et al. 2019", "Xue et al. 2019"),
    families=("fiber_reinforced_cylinder", "extending_cylinder"),
    studies=(
        GuidelineTest(
            title="Hoops at five densities",
            setup=f"{SETUP}; volume that goes into the cavity up to 50 kPa, from no hoops to one every 2 mm.",
            expected="The injected volume falls with every step to denser hoops.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
