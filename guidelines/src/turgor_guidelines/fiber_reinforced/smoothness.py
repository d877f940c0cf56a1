"""Guideline 7.2-4: dense reinforcement makes an actuator more linear, more reliable and more durable."""

from turgor.units import kPa, mm
from turgor_guidelines.fiber_reinforced.banded import SETUP
from turgor_guidelines.fiber_reinforced.density import PRESSURE, along, panels, runs
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Verdict
from turgor_guidelines.values import linearity

#: Extension at which the rubber is compared [m].
EXTENSION = 4 * mm


def judge(runs: Runs) -> Judgement:
    """R² of the extension, and the largest stretch of the rubber at equal extension."""
    straight = [linearity(each.response, "tip_displacement_x", "pressure", PRESSURE * kPa) for each in runs.values()]
    stretched = [
        along(each.response, "principal_stretch_p99", "tip_displacement_x", EXTENSION) for each in runs.values()
    ]
    ordered = straight == sorted(straight)
    spared = stretched == sorted(stretched, reverse=True)
    dense = straight[-1] > straight[0] and stretched[-1] < stretched[0]
    verdict = Verdict.CONFIRMED if ordered and spared else Verdict.CONDITIONAL
    return Judgement(
        verdict=verdict if dense else Verdict.NOT_REPRODUCED,
        finding=f"{', '.join(runs)}: R² of a straight line up to {PRESSURE:g} kPa "
        f"{', '.join(f'{each:.4f}' for each in straight)}; stretch that 99 % of the rubber stay below at an extension "
        f"of {EXTENSION / mm:g} mm {', '.join(f'{each:.3f}' for each in stretched)}.",
        conditions="Durability is judged by the stretch of the rubber alone; friction of threads on rubber is not "
        "modeled. "
        + (
            "Every step to denser hoops helps."
            if ordered and spared
            else "Not every step to denser hoops helps: "
            f"the straightest is that with {list(runs)[straight.index(max(straight))]}, the rubber is spared most "
            f"with {list(runs)[stretched.index(min(stretched))]}."
        ),
    )


GUIDELINE = Guideline(
    key="7.2-4",
    rule="Dense reinforcement improves the linearity, reliability and durability of actuators.",
    sources=("Zhang et al. 2019", "Fras and Althoefer 2019"),
    families=("fiber_reinforced_cylinder",),
    studies=(
        GuidelineTest(
            title="Straightness and stretch of the rubber at five densities",
            setup=f"{SETUP}; R² of extension against pressure up to 50 kPa, stretch of the rubber at 4 mm of "
            "extension.",
            expected="R² rises and the stretch falls with every step to denser hoops.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
