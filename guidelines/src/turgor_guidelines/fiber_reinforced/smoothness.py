"""Guideline 7.2-4: dense reinforcement makes an actuator more linear, more reliable and more durable."""

import turgor as tg
from turgor.units import kPa, mm
from turgor_guidelines.fiber_reinforced.banded import SETUP
from turgor_guidelines.fiber_reinforced.density import PRESSURE, along, panels, runs
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Verdict
from turgor_guidelines.values import linearity
from turgor_guidelines.wear import FLAW, lives

#: Extension at which the rubber is compared [m].
EXTENSION = 4 * mm


def judge(runs: Runs) -> Judgement:
    """R² of the extension, and the energy that opens cracks in the rubber at equal extension."""
    straight = [linearity(each.response, "tip_displacement_x", "pressure", PRESSURE * kPa) for each in runs.values()]
    stretched, opened = (
        [along(each.response, name, "tip_displacement_x", EXTENSION) for each in runs.values()]
        for name in ("principal_stretch_p99", "cracking_energy_p99")
    )
    torn = [
        float(tg.laws.tearing_energy_of_crack(energy, stretch, FLAW))
        for energy, stretch in zip(opened, stretched, strict=True)
    ]
    ordered = straight == sorted(straight)
    spared = torn == sorted(torn, reverse=True)
    dense = straight[-1] > straight[0] and torn[-1] < torn[0]
    verdict = Verdict.CONFIRMED if ordered and spared else Verdict.CONDITIONAL
    return Judgement(
        verdict=verdict if dense else Verdict.NOT_REPRODUCED,
        finding=f"{', '.join(runs)}: R² of a straight line up to {PRESSURE:g} kPa "
        f"{', '.join(f'{each:.4f}' for each in straight)}; stretch that 99 % of the rubber stay below at an extension "
        f"of {EXTENSION / mm:g} mm {', '.join(f'{each:.3f}' for each in stretched)}, and tearing energy of a flaw of "
        f"0.1 mm there {', '.join(f'{each:.3g}' for each in torn)} J/m².",
        conditions="Durability is judged by the energy that opens flaws, from which cracks grow with its 2nd to 4th "
        f"power: the densest hoops last {lives(torn[-1], torn[0])} as long as none at the same extension. Friction of "
        "threads on rubber, which wears it too, is not modeled. "
        + (
            "Every step to denser hoops helps."
            if ordered and spared
            else "Not every step to denser hoops helps: "
            f"the straightest is that with {list(runs)[straight.index(max(straight))]}, the rubber is spared most "
            f"with {list(runs)[torn.index(min(torn))]}."
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
            setup=f"{SETUP}; R² of extension against pressure up to 50 kPa, stretch of the rubber and tearing energy "
            "of a flaw at 4 mm of extension.",
            expected="R² rises and the tearing energy falls with every step to denser hoops.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
